# SPDX-License-Identifier: GPL-3.0-or-later
"""Particles split and merged on the way: the bits of the program, what is kept, views, refusals; series of snapshots
whose ids change."""
import math
import unittest

import numpy as np
import spam_mechanics as spam
from compiled import rotation
from results_of import program, work

summed = dict(density="summed", kernel="w4", range=3.0)
AS_THE_PROGRAM = dict(every=0.25, volume=(2.0, 0.5), neighbours=(0.0, 0.6 * math.pi * 9.0))


def cloud():
    """A small ellipse that flies apart and comes back; not run again where it is there."""
    program("gas_cloud")
    out = work("cloud")
    if out.exists():
        return spam.read(out)
    return spam.run("gas_cloud", dimension=2, size=5, rezone=True, time=1.6, **{"return": True}, output_every=0.5,
                    snapshot_every=1.0, no_plots=True, out=out)


def square(n=12, rate=0.4, dt=0.05):
    """A square of gas that expands."""
    x = spam.square_lattice([n, n]) - 0.5 * (n - 1)
    model = spam.SmoothParticles(x, material=spam.Fluid(spam.GammaGas(2.0)), scheme=spam.Scheme(**summed))
    return model, spam.Simulation(model, velocity=rate * x, temperature=0.05, dt=dt)


class Runs(unittest.TestCase):
    def test_bits_of_the_program(self):
        case = cloud()
        first = case.snapshots[0]
        model = spam.SmoothParticles(first.position, material=spam.Fluid(spam.GammaGas(2.0)),
                                     scheme=spam.Scheme(**summed), mass=first.mass)
        sim = spam.Simulation(model, dt=0.05)
        with sim.edit() as s:
            s.energy = first.energy[model.id]
        out = case.invariants.t <= 7.5  # before velocities are reversed
        run = sim.run(7.5, every=0.5, rezone=spam.Rezoning(**AS_THE_PROGRAM))
        self.assertGreater(run["splits"][-1], 20)
        for column in run.names:
            np.testing.assert_array_equal(run[column], case.invariants[column][out], column)

    def test_a_function_of_python_acts_in_several_threads(self):
        x = spam.square_lattice([40, 40])
        model = spam.SmoothParticles(x, material=spam.Fluid(spam.GammaGas(2.0)), scheme=spam.Scheme(**summed),
                                     externals=[spam.Force(lambda t, x, v: 0.0 * x)])
        sim = spam.Simulation(model, velocity=0.4 * (x - x.mean(axis=0)), temperature=0.05, dt=0.05, threads=2)
        run = sim.run(1.0, every=0.5, rezone=spam.Rezoning(0.5, volume=(1.2, 0.3)))
        self.assertGreater(run["splits"][-1], 0)

    def test_what_is_kept_and_what_changes(self):
        model, sim = square()
        before, seen = sim.state.position, []
        run = sim.run(2.0, every=0.25, rezone=spam.Rezoning(0.5, volume=(1.5, 0.3)),
                      on_row=lambda m, s: seen.append((len(m), len(s.energy), s.y.size)))
        self.assertEqual(run["particles"][-1], 144 + 3 * run["splits"][-1])
        self.assertGreater(run["splits"][-1], 20)
        self.assertEqual([n for n, _, _ in seen], [int(n) for n in run["particles"]])
        self.assertTrue(all(e == n and y == sim.model.size // len(sim.model) * n for n, e, y in seen))
        for name, limit in (("mass", 1e-13), ("momentum", 1e-12), ("angular momentum", 1e-12), ("energy", 1e-6)):
            self.assertLess(run.drifts[name].change, limit, name)
        self.assertTrue(any("particles split" in what for _, what, _ in run.remarks))
        # The model given stays, the one that moves has others, whose ids are new.
        self.assertEqual((len(model), len(sim.model)), (144, int(run["particles"][-1])))
        self.assertEqual(len(set(sim.id)), len(sim.id))
        self.assertGreater(max(sim.id), 143)
        self.assertEqual(before.shape, (144, 2))
        self.assertTrue(np.isfinite(before).all())
        np.testing.assert_array_equal(sim.by_id(sim.id), np.sort(sim.id))
        with self.assertRaisesRegex(spam.InputError, "no start any more"):
            sim.model.start()
        self.assertEqual(len(model.start()), model.size)
        # It goes on, with rezoning and without, and numbers are never used again.
        used = set(sim.id)
        sim.step()
        again = sim.run(3.0, every=0.5, rezone=spam.Rezoning(0.5, neighbours=(12.0, 60.0), in_two=True))
        self.assertGreaterEqual(again["particles"][0], run["particles"][-1])
        self.assertFalse({i for i in sim.id if i not in used} & set(range(144)))
        other = spam.Simulation(sim.model, sim.y, t0=sim.t, dt=0.05)
        other.run(sim.t + 0.2)
        self.assertEqual(len(other.y), len(sim.y))

    def test_refusals(self):
        model, sim = square(6)
        for words, says in (({}, "give a criterion"), ({"volume": (2.0, 0.6)}, "merged again"),
                            ({"gradient": (1.0, 0.9)}, "split and merged in turn")):
            with self.assertRaisesRegex(spam.InputError, says):
                sim.run(1.0, rezone=spam.Rezoning(0.5, **words))
        with self.assertRaisesRegex(spam.InputError, "no time between looks"):
            sim.run(1.0, rezone=spam.Rezoning(0.0, volume=(2.0, 0.5)))
        self.assertEqual(sim.t, 0.0)
        x, v = rotation(3)
        how = spam.Rezoning(0.5, volume=(2.0, 0.5))
        cold = spam.Fluid(spam.EmbeddedAtom())
        for one, says in ((spam.Springs(x), "use smooth particles"), (spam.MaterialVectors(x), "use an updated solid"),
                          (spam.SmoothParticles(x, material=cold), "use a law with an energy"),
                          (spam.Elements(*spam.rectangle_mesh(3, 3)), "use a model of particles alone")):
            with self.subTest(repr(one)), self.assertRaisesRegex(spam.InputError, says):
                spam.Simulation(one, dt=0.05).run(1.0, rezone=how)
        sim = spam.Simulation(spam.SmoothParticles(x), velocity=v, dt=0.05)
        self.assertEqual(sim.run(1.0, rezone=how)["particles"][-1], 37)


class Series(unittest.TestCase):
    def test_snapshots_with_other_ids(self):
        results = cloud()
        case = next(iter(results.cases.values()))
        shots = case.snapshots[:]
        counts = [len(one) for one in shots]
        self.assertGreater(max(counts), 1.5 * counts[0])
        self.assertLess(counts[-1], max(counts))
        rows = case.invariants
        for one in shots:
            row = int(np.flatnonzero(rows.t == one.t)[0])
            self.assertEqual(len(one), rows["particles"][row])
            self.assertEqual(len(np.unique(one.id)), len(one))
            self.assertLess(abs(one.mass.sum() / shots[0].mass.sum() - 1.0), 1e-13)
            energy = (one.mass * (one.energy + 0.5 * (one.velocity**2).sum(axis=1))).sum()
            self.assertLess(abs(energy / rows["energy"][row] - 1.0), 1e-12)
        self.assertEqual([len(points) for _, points in case.frames()], counts)
        self.assertTrue(any("particles split" in event[1] for event in case.events))

    def test_xarray(self):
        case = next(iter(cloud().cases.values()))
        try:
            whole = case.to_xarray()
        except ImportError as error:
            raise unittest.SkipTest(str(error))
        there = np.isfinite(whole.mass.values)
        np.testing.assert_array_equal(there.sum(axis=1), [len(one) for one in case.snapshots])
        last = case.snapshots[-1]
        np.testing.assert_array_equal(whole.particle.values[there[-1]], last.id)
        np.testing.assert_array_equal(whole.position.values[-1][there[-1]], last.position)


if __name__ == "__main__":
    unittest.main()
