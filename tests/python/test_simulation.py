# SPDX-License-Identifier: GPL-3.0-or-later
"""Models and simulations: the same numbers as the programs', views without copies, steps, edits."""
import gc
import importlib.util
import unittest

import numpy as np
import spam_mechanics as spam
from compiled import hexagon, moving, rotation
from results_of import hexagon as executable


def scipy():
    if importlib.util.find_spec("scipy") is None:
        raise unittest.SkipTest("scipy is not installed")
    import scipy.integrate

    return scipy.integrate


class LikeThePrograms(unittest.TestCase):
    def compare(self, name, model, velocity):
        case = executable("compared")[name]
        t = case.invariants.t
        sim = spam.Simulation(model, velocity=velocity, dt=0.1)
        columns = {"closest_pair": spam.closest_pair, "shape_error": spam.shape_error}
        run = sim.run(t[-1], every=t[-1] / 240, columns=columns)
        self.assertEqual(run.names, case.invariants.names)
        for column in run.names:
            np.testing.assert_array_equal(run[column], case.invariants[column], column)
        for one in run.drifts.values():
            there = case.drifts[one.name]
            self.assertEqual((one.promise, one.scale, one.change),
                             (there["promise"], there["scale"], there["change"]))
        last = case.snapshots[-1]
        np.testing.assert_array_equal(sim.by_id("velocity"), last.velocity)
        np.testing.assert_array_equal(sim.by_id("density"), last.density)
        np.testing.assert_array_equal(sim.by_id("stress")[:, 2], last.stress[:, 0, 1])

    def test_three_schemes(self):
        x, v = rotation(3)
        for name, words in [("plain", {}), ("monaghan", {"transport": "monaghan"}),
                            ("monaghan_torque_pair",
                             {"transport": "monaghan", "angular_momentum": "torque_pair"})]:
            with self.subTest(name):
                self.compare(name, spam.SmoothParticles(x, scheme=spam.Scheme(**words)), v)

    def test_springs(self):
        x, v = rotation(3)
        case = executable("compared")["md"]
        sim = spam.Simulation(spam.Springs(x), velocity=v, dt=0.1)
        run = sim.run(case.invariants.t[-1], every=case.invariants.t[-1] / 240)
        for column in run.names:
            np.testing.assert_array_equal(run[column], case.invariants[column], column)


class Views(unittest.TestCase):
    def test_share_memory_with_the_state(self):
        sim = moving()
        y, x = sim.y, sim.state.position
        self.assertTrue(np.shares_memory(y, x))
        self.assertEqual(x.__array_interface__["data"][0], y.__array_interface__["data"][0])
        self.assertEqual((x.shape, sim.state.stress.shape, sim.state.density.shape),
                         ((37, 2), (37, 3), (37,)))
        before = x.copy()
        sim.step()
        self.assertFalse(np.array_equal(before, x), "a view shows the present state")
        np.testing.assert_array_equal(x, sim.state.position)

    def test_cannot_be_written_to(self):
        sim = moving()
        for array in (sim.y, sim.state.position, sim.state.density):
            with self.assertRaises(ValueError):
                array[...] = 0.0
            with self.assertRaises(ValueError):
                array.flags.writeable = True

    def test_outlive_their_simulation(self):
        sim = moving()
        sim.run(1.0)
        x, expected = sim.state.position, sim.state.position.copy()
        del sim
        gc.collect()
        junk = [np.full(1000, np.nan) for _ in range(1000)]
        np.testing.assert_array_equal(x, expected)
        del junk

    def test_order(self):
        x, v = rotation(8)
        sim = spam.Simulation(spam.SmoothParticles(x), velocity=v, dt=0.1)
        self.assertFalse(np.array_equal(sim.state.position, x), "strips have another order")
        np.testing.assert_array_equal(sim.state.position, x[sim.id])
        np.testing.assert_array_equal(sim.by_id("position"), x)
        np.testing.assert_array_equal(sim.by_id(sim.state.velocity), v)

    def test_unknown_fields(self):
        with self.assertRaisesRegex(AttributeError, "no field 'presure'"):
            moving().state.presure


class Steps(unittest.TestCase):
    def test_steps_and_runs_give_the_same_bits(self):
        one, other = moving(), moving()
        for _ in range(20):
            one.step()
        other.run(2.0, every=2.0)
        self.assertEqual(one.statistics["steps"], 20)
        np.testing.assert_array_equal(one.y, other.y)
        one.step(2.05)
        self.assertEqual(one.t, 2.05)

    def test_threads_do_not_change_bits(self):
        ends = []
        for threads in (1, 2):
            model, v = hexagon(20)
            sim = spam.Simulation(model, velocity=v, dt=0.1, threads=threads)
            sim.run(1.0, every=1.0)
            ends.append(sim.y.copy())
        np.testing.assert_array_equal(*ends)

    def test_edit(self):
        sim = moving()
        sim.run(1.0)
        velocity = sim.state.velocity.copy()
        with sim.edit() as s:
            s.velocity *= 0.5
            kept = s.velocity
            with self.assertRaisesRegex(RuntimeError, "being edited"):
                sim.step()
        np.testing.assert_array_equal(sim.state.velocity, 0.5 * velocity)
        with self.assertRaises(ValueError):
            kept[0] = 1.0
        before = sim.y.copy()
        with self.assertRaises(ZeroDivisionError), sim.edit() as s:
            s.velocity[...] = 7.0
            1 / 0
        for bad in (np.nan, np.inf):
            with self.assertRaisesRegex(ValueError, "velocity: entry 0 is"), sim.edit() as s:
                s.velocity = bad
        with self.assertRaisesRegex(ValueError, "velocity"), sim.edit() as s:
            s.velocity = np.zeros(3)
        np.testing.assert_array_equal(sim.y, before)
        sim.step()

    def test_an_edited_state_is_that_of_a_new_simulation(self):
        for method, options in [("rk4", {"dt": 0.1}), ("arkode:DORMAND_PRINCE_7_4_5", {"rtol": 1e-6}),
                                ("cvode:adams", {"rtol": 1e-6})]:
            model, v = hexagon()
            sim = spam.Simulation(model, velocity=v, method=method, **options)
            sim.run(1.0, every=1.0)
            with sim.edit() as s:
                s.velocity *= 1.5
            other = spam.Simulation(hexagon()[0], sim.y, method=method, t0=sim.t, **options)
            for one in (sim, other):
                one.run(2.0, every=1.0)
            with self.subTest(method):
                np.testing.assert_allclose(sim.y, other.y, rtol=1e-5, atol=1e-6)

    def test_columns_rows_and_revision(self):
        sim = moving()
        seen = []

        def stop_turning(model, state):
            if state.t < 1.0:
                return False
            state.velocity *= 0.9
            return True

        run = sim.run(2.0, every=0.5, columns={"speed": lambda m, s: s.speed.max()},
                      on_row=lambda m, s: seen.append(s.t), revise=stop_turning)
        np.testing.assert_allclose(seen, [0, 0.5, 1, 1.5, 2])
        self.assertLess(run["kinetic"][-1], 0.7 * run["kinetic"][0])
        self.assertAlmostEqual(run["speed"][0], 0.1)
        self.assertEqual(run["speed"][-1] > 0.05, True)
        end = sim.run(9.0, every=0.5, enough=lambda m, s: s.t >= 4.0)
        self.assertEqual(round(end.t[-1], 6), 4.0)

    def test_a_guard(self):
        sim = moving(transport="plain")
        sim._core.step(0.1)
        model, v = hexagon()
        sim = spam.Simulation(model, velocity=v, dt=0.1, max_steps=5)
        with self.assertRaisesRegex(spam.GuardStop, "too many steps"):
            sim.run(5.0)
        self.assertAlmostEqual(sim.t, 0.5)
        self.assertEqual(sim.last_run.t[-1], sim.t)


class Rates(unittest.TestCase):
    def test_scipy_agrees_with_gsl(self):
        integrate = scipy()
        model, v = hexagon()
        y0 = model.start(v)
        there = integrate.solve_ivp(model.rates, (0, 20), y0, method="DOP853", rtol=1e-11, atol=1e-13)
        sim = spam.Simulation(model, y0, method="gsl:rk8pd", rtol=1e-11, atol=1e-13)
        sim.run(20.0, every=20.0)
        self.assertLess(np.abs(there.y[:, -1] - sim.y).max(), 1e-8)

    def test_what_they_are(self):
        model, v = hexagon()
        y = model.start(v)
        rates = model.rates(0.0, y)
        first, size, _ = model.fields["density"]
        np.testing.assert_allclose(rates[first : first + size], 0, atol=1e-15)  # a rigid rotation
        np.testing.assert_array_equal(rates, model.rates(0.0, list(y)))
        self.assertEqual(model.failure, "")

    def test_a_state_without_meaning(self):
        model, v = hexagon()
        y = model.start(v)
        first, size, _ = model.fields["density"]
        y[first] = -1.0
        self.assertTrue(np.isnan(model.rates(0.0, y)).any())
        self.assertIn("density", model.failure)


class Kinds(unittest.TestCase):
    def test_dimensions_by_shape(self):
        for cells in ([60], [8, 8], [4, 4, 4]):
            x = spam.square_lattice(cells)
            model = spam.SmoothParticles(x, density=1.0)
            self.assertEqual(model.dimensions, len(cells))
            v = 0.01 * np.sin(np.arange(x.size)).reshape(x.shape)
            run = spam.Simulation(model, velocity=v, dt=0.05).run(0.5, every=0.5)
            self.assertTrue(run.drifts["momentum"].kept and run.drifts["energy"].kept)
            self.assertEqual("momentum_z" in run, len(cells) == 3)

    def test_fluids_boxes_and_externals(self):
        x = spam.square_lattice([12, 12]) + 0.5
        gas = spam.Fluid(spam.IdealGas(), eta=0.5, lam=0.0, kappa=0.5)
        model = spam.SmoothParticles(x, material=gas, box=[12, 12], externals=[spam.Gravity([0, -0.1])])
        v = 0.1 * np.sin(2 * np.pi * x / 12)
        sim = spam.Simulation(model, velocity=v, temperature=1.0, dt=0.05)
        run = sim.run(1.0)
        self.assertTrue(all(drift.kept for drift in run.drifts.values()), run.drifts)
        self.assertAlmostEqual(run["momentum_y"][-1] / 144, -0.1, 3)
        self.assertLess(run["kinetic"][10], run["kinetic"][0])
        self.assertAlmostEqual(sim.model.density(sim.y).mean(), 1.0, 1)

    def test_remembering_solids_keep_their_shape(self):
        x, v = rotation(3)
        for make in (spam.TotalLagrangian, spam.MaterialVectors):
            run = spam.Simulation(make(x), velocity=v, dt=0.1).run(20.0, columns={"e": spam.shape_error})
            self.assertTrue(run.drifts["angular momentum"].kept)
            self.assertLess(run["e"][-1], 0.03)

    def test_several_materials(self):
        x, v = rotation(4)
        v = v + 0.1 * np.sin(3.0 * x[:, ::-1])
        which = (x[:, 0] > 0.0).astype(int)
        soft, stiff = spam.ElasticSolid(0.43, 0.43), spam.ElasticSolid(2.0, 1.5)
        for make in (spam.SmoothParticles, spam.TotalLagrangian, spam.MaterialVectors):
            runs = []
            for laws in (soft, [soft, soft], [soft, stiff], (stiff, soft)):
                several = {"which": which} if isinstance(laws, (list, tuple)) else {}
                sim = spam.Simulation(make(x, material=laws, **several), velocity=v, dt=0.05)
                drifts = sim.run(5.0).drifts
                self.assertTrue(drifts["momentum"].kept, drifts)
                self.assertLess(drifts["energy"].change, 1e-5)  # of material vectors that meet and lose some
                runs.append(sim.by_id(sim.state.velocity).copy())
            self.assertTrue(np.array_equal(runs[0], runs[1]))
            self.assertGreater(abs(runs[2] - runs[0])[which == 1].max(), 0.01)
            self.assertGreater(abs(runs[3] - runs[2]).max(), 0.01)
        gases = [spam.Fluid(spam.IdealGas(2)), spam.Fluid(spam.GammaGas(1.4))]
        model = spam.SmoothParticles(x, material=gases, which=which)
        self.assertTrue(np.isfinite(model.rates(0.0, model.start(v, temperature=0.2))).all())
        for wrong, word in (({"material": [soft, stiff], "which": which[:-1]}, "which"),
                            ({"material": [soft, stiff], "which": 2 * which}, "2 materials"),
                            ({"material": [soft, gases[0]], "which": which}, "solids and fluids"),
                            ({"material": [], "which": which}, "none is given")):
            with self.assertRaisesRegex(spam.InputError, word):
                spam.SmoothParticles(x, **wrong)

    def test_viscosity_and_reflections_beside_solids_that_remember(self):
        x, v = rotation(3)
        v = v + 0.2 * np.sin(3.0 * x[:, ::-1])
        for make in (spam.TotalLagrangian, spam.MaterialVectors):
            sim = spam.Simulation(make(x, viscosity=1.0, closest_approach=0.8), velocity=v, dt=0.05)
            run = sim.run(5.0)
            self.assertTrue(all(drift.kept for drift in run.drifts.values()), run.drifts)
            self.assertGreater(sim.state.viscous_heat.max(), 0.0)
            self.assertGreaterEqual(spam.closest_pair(sim.model, sim.state), 0.8 - 1e-9)
        for wrong in (-1.0, float("nan"), float("inf")):
            with self.assertRaises(spam.InputError):
                spam.TotalLagrangian(x, viscosity=wrong)
            with self.assertRaises(spam.InputError):
                spam.Springs(x, closest_approach=wrong)

    def test_yielding(self):
        x, v = rotation(3, speed=1.0)
        solid = spam.VonMisesSolid(0.433, 0.433, yield_stress=0.01)
        sim = spam.Simulation(spam.SmoothParticles(x, material=solid), velocity=v, dt=0.05)
        sim.run(2.0)
        self.assertGreater(sim.state.plastic_strain.max(), 0.0)

    def test_methods(self):
        self.assertEqual(spam.methods()["rk4"]["order"], 4)
        x, v = rotation(2)
        ends = {}
        for name, what in spam.methods().items():
            if what["separable"]:
                continue
            options = {"rtol": 1e-8, "atol": 1e-10} if what["adaptive"] else {"dt": 0.01}
            sim = spam.Simulation(spam.SmoothParticles(x), velocity=v, method=name, **options)
            sim.run(1.0, every=1.0)
            ends[name] = sim.y.copy()
        for name, end in ends.items():
            np.testing.assert_allclose(end, ends["gsl:rk8pd"], atol=2e-4, err_msg=name)
        self.assertGreater(len(ends), 10)
