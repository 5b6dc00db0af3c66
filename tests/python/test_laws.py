# SPDX-License-Identifier: GPL-3.0-or-later
"""Laws of one's own: stress in numpy and by an address, forces, the accounts of what they give."""
import ctypes
import importlib.util
import math
import unittest

import numpy as np
import spam_mechanics as spam
from compiled import hexagon, rotation

LAM = ETA = (3 / 16) ** 0.5


def elastic(grad_v, stress):
    """ElasticSolid in the plane, in numpy: Hooke's law and the Jaumann rotation."""
    xx, yy, xy = stress.T
    a, b, c, d = grad_v.reshape(-1, 4).T  # b = d v_y/dx, c = d v_x/dy
    dilation, turn = LAM * (a + d), c - b  # turn = 2 W_xy
    rate = np.empty_like(stress)
    rate[:, 0] = dilation + 2 * ETA * a + turn * xy
    rate[:, 1] = dilation + 2 * ETA * d - turn * xy
    rate[:, 2] = ETA * (b + c) + 0.5 * turn * (yy - xx)
    return rate


@ctypes.CFUNCTYPE(None, ctypes.c_int64, *[ctypes.POINTER(ctypes.c_double)] * 3)
def compiled(n, grad_v, stress, rate):
    """The same behind an address; a function of C needs no interpreter, this one takes it."""
    grad = np.ctypeslib.as_array(grad_v, (n, 2, 2))
    np.ctypeslib.as_array(rate, (n, 3))[...] = elastic(grad, np.ctypeslib.as_array(stress, (n, 3)))


def strained(n, material, **keywords):
    """A model and a state of it with stresses, velocities and all that depends on them."""
    model, v = hexagon(n, material=material, **keywords)
    sim = spam.Simulation(model, velocity=v, dt=0.1)
    with sim.edit() as s:
        s.stress += 0.01 * np.sin(np.arange(s.stress.size)).reshape(s.stress.shape)
        s.velocity += 0.01 * np.cos(np.arange(s.velocity.size)).reshape(s.velocity.shape)
    return model, sim


class Stress(unittest.TestCase):
    def test_in_numpy(self):
        own, sim = strained(4, spam.Material(elastic))
        built_in, _ = strained(4, spam.ElasticSolid(LAM, ETA))
        rates, expected = own.rates(0, sim.y), built_in.rates(0, sim.y)
        first, size, _ = own.fields["stress"]
        self.assertGreater(np.abs(expected[first : first + size]).max(), 1e-3)
        np.testing.assert_allclose(rates, expected, rtol=1e-12, atol=1e-15)

    def test_an_address(self):
        address = ctypes.cast(compiled, ctypes.c_void_p).value
        model, sim = strained(4, spam.Material.from_address(address))
        other, _ = strained(4, spam.Material(elastic))
        np.testing.assert_array_equal(model.rates(0, sim.y), other.rates(0, sim.y))

    @unittest.skipUnless(importlib.util.find_spec("numba"), "numba is not installed")
    def test_numba(self):
        law = numba_law()
        model, sim = strained(20, spam.Material.from_address(law.address))
        built_in, _ = strained(20, spam.ElasticSolid(LAM, ETA))
        np.testing.assert_allclose(model.rates(0, sim.y), built_in.rates(0, sim.y), rtol=1e-12, atol=1e-15)

    def test_blocks_and_threads_do_not_matter(self):
        sizes = []

        def noted(grad_v, stress):
            sizes.append(len(stress))
            return elastic(grad_v, stress)

        ends = []
        for threads in (1, 2):
            model, v = hexagon(20, material=spam.Material(noted))
            sim = spam.Simulation(model, velocity=v, dt=0.1, threads=threads)
            sim.step()
            ends.append(sim.y)
        np.testing.assert_array_equal(*ends)
        self.assertLessEqual(max(sizes), 256)
        self.assertEqual(sum(sizes), 2 * 4 * 1261)

    def test_arrays_may_be_kept(self):
        kept = []

        def keeping(grad_v, stress):
            kept.append((stress, stress.copy()))
            return elastic(grad_v, stress)

        model, v = hexagon(2, material=spam.Material(keeping))
        spam.Simulation(model, velocity=v, dt=0.1).run(2.0)
        del model
        for array, copy in kept:
            np.testing.assert_array_equal(array, copy)

    def test_in_one_and_three_dimensions(self):
        for cells, components in (([40], 1), ([5, 5, 5], 6)):
            D = len(cells)

            def law(grad_v, stress):
                self.assertEqual((grad_v.shape[1:], stress.shape[1:]), ((D, D), (components,)))
                return ETA * np.repeat(np.trace(grad_v, axis1=1, axis2=2)[:, None], components, 1)

            x = spam.square_lattice(cells)
            model = spam.SmoothParticles(x, material=spam.Material(law), density=1.0)
            v = 0.01 * np.sin(np.arange(x.size)).reshape(x.shape)
            spam.Simulation(model, velocity=v, dt=0.1).run(1.0)

    def test_viscosity_wants_a_sound_speed(self):
        x, v = rotation(3)
        scheme = spam.Scheme(viscosity=1.0)
        own = spam.SmoothParticles(x, scheme=scheme, material=spam.Material(
            elastic, sound_speed=spam.ElasticSolid(LAM, ETA).sound_speed))
        other = spam.SmoothParticles(x, scheme=scheme)
        y = other.start(v)
        y[other.fields["velocity"][0]] += 0.1
        np.testing.assert_allclose(own.rates(0, y), other.rates(0, y), rtol=1e-12, atol=1e-15)


class Defaults(unittest.TestCase):
    """What is not given follows from masses, dimensions and spacing."""

    def start(self, x, **keywords):
        model = spam.SmoothParticles(x, **keywords)
        first, n, _ = model.fields["density"]
        return model.start()[first : first + n]

    def test_densities(self):
        triangular = math.sqrt(4 / 3)
        for x, spacing, number in [
            (spam.triangular_hexagon(3), 1.0, triangular),
            (spam.triangular_block(64, 64, 0.1), 0.1, triangular / 0.1**2),
            (spam.triangular_block(40, 3), 1.0, triangular),
            (spam.square_lattice([40], 0.1), 0.1, 10.0),
            (spam.square_lattice([64, 64], 0.1), 0.1, 100.0),
            (spam.square_lattice([6, 6, 6], 0.1), 0.1, 1000.0),
        ]:
            masses = np.where(np.arange(len(x)) % 2 == 0, 6.0, 8.0)
            for mass, mean in [(1.0, 1.0), (7.0, 7.0), (np.full(len(x), 7.0), 7.0), (masses, masses.mean())]:
                with self.subTest(n=len(x), spacing=spacing, mass=mean):
                    density = self.start(x, mass=mass, spacing=spacing)
                    np.testing.assert_allclose(density, number * mean, rtol=1e-14)
        np.testing.assert_array_equal(self.start(spam.triangular_hexagon(3), density=3.0), 3.0)

    def test_an_array_of_one_mass_is_that_mass(self):
        x = spam.triangular_hexagon(3)
        v = 0.1 * np.sin(np.arange(x.size)).reshape(x.shape)
        for make in (spam.SmoothParticles, spam.TotalLagrangian, spam.MaterialVectors, spam.Springs):
            rates = []
            for mass in (7.0, np.full(len(x), 7.0)):
                model = make(x, mass=mass)
                rates.append(model.rates(0.0, model.start(v)))
            np.testing.assert_array_equal(*rates)

    def test_scales_of_bonds_are_in_their_units(self):
        """As many steps in every unit of length, which is a power of two, on lines, in planes and in space."""
        for n in (1, 2, 3):
            x = spam.square_lattice([4] * n) if n > 1 else spam.square_lattice([12])
            v = 0.05 * np.sin(1.0 + np.arange(x.size)).reshape(x.shape)
            for make in (lambda L: spam.Springs(x * L, kappa=0.7, spacing=L),
                         lambda L: spam.Molecules(x * L, energy=0.7 * L**2, spacing=L)):
                steps = set()
                for L in (1.0, 2.0**10, 2.0**-10):
                    sim = spam.Simulation(make(L), velocity=v * L, method="arkode:DORMAND_PRINCE_7_4_5")
                    sim.run(10.0)
                    steps.add(sim.statistics["steps"])
                self.assertEqual(len(steps), 1, (n, steps))

    def test_a_box_may_be_an_array(self):
        x = spam.square_lattice([12, 12])
        for make in (spam.SmoothParticles, spam.TotalLagrangian, spam.Springs, spam.Molecules):
            self.assertEqual(len(make(x, box=np.array([12.0, 12.0]))), 144)

    def test_ranges_are_three_spacings(self):
        """In a unit of length eight times as long stress has the same rate, and accelerations are an eighth."""
        x = spam.triangular_hexagon(4)
        moved = x + 0.01 * np.sin(np.arange(x.size)).reshape(x.shape)
        for make in (spam.SmoothParticles, spam.TotalLagrangian, spam.MaterialVectors):
            found = []
            field, power = ("stress", 0) if make is spam.SmoothParticles else ("velocity", 1)
            for unit in (1.0, 0.125):
                model = make(x * unit, spacing=unit)
                y = model.start(0.1 * moved * unit)
                first, n, _ = model.fields["position"]
                y[first : first + n] = moved[model.id].ravel() * unit
                first, n, _ = model.fields[field]
                found.append(model.rates(0.0, y)[first : first + n] / unit**power)
            self.assertGreater(np.abs(found[0]).max(), 1e-3)
            np.testing.assert_allclose(*found, rtol=1e-12, atol=1e-15)
        self.assertIsNone(spam.Scheme().range)
        self.assertEqual(spam.Scheme(range=2.5).range, 2.5)
        self.assertEqual(spam.Scheme(), spam.Scheme())
        self.assertNotEqual(spam.Scheme(), spam.Scheme(range=2.5))

    def test_rates_say_their_order(self):
        model = spam.SmoothParticles(spam.triangular_hexagon(2))
        for words in ("id[i] is the number of the i-th one among those given", "by_id"):
            self.assertIn(words, type(model).rates.__doc__)


def numba_law():
    """ElasticSolid in the plane as a function of C."""
    import numba
    from numba import types

    pointer = types.CPointer(types.float64)

    @numba.cfunc(types.void(types.int64, pointer, pointer, pointer))
    def law(n, grad_v, stress, rate):
        for i in range(n):
            a, b, c, d = grad_v[4 * i], grad_v[4 * i + 1], grad_v[4 * i + 2], grad_v[4 * i + 3]
            xx, yy, xy = stress[3 * i], stress[3 * i + 1], stress[3 * i + 2]
            dilation, w = LAM * (a + d), 0.5 * (c - b)
            rate[3 * i] = dilation + 2 * ETA * a + 2 * w * xy
            rate[3 * i + 1] = dilation + 2 * ETA * d - 2 * w * xy
            rate[3 * i + 2] = ETA * (b + c) + w * (yy - xx)

    return law


class OneTemperature(unittest.TestCase):
    def test_heat_of_an_isotherm_is_refused(self):
        cold = spam.VanDerWaalsIsotherm(T=0.25)
        for words in ({"eta": 0.1}, {"kappa": 1.0}, {"eta": 0.1, "by_pairs": True}):
            with self.subTest(words), self.assertRaisesRegex(spam.InputError, "^(eta|kappa): .*use VanDerWaals, or"):
                spam.Fluid(cold, **words)
        spam.Fluid(cold)
        spam.Fluid(spam.VanDerWaals(), eta=0.1, kappa=1.0)
        spam.Fluid(spam.EmbeddedAtom(), eta=0.1)


class Forces(unittest.TestCase):
    def test_a_start_with_functions_in_several_threads(self):
        x = spam.square_lattice([40, 40])
        model = spam.SmoothParticles(x, material=spam.Fluid(spam.IdealGas()),
                                     externals=[spam.Force(lambda t, x, v: 0.0 * x)])
        self.assertEqual(spam.Simulation(model, dt=0.1, threads=2).step(), 0.1)

    def test_a_spring_to_the_origin(self):
        x, v = rotation(3)
        force = spam.Force(lambda t, x, v: -0.01 * x)
        model = spam.SmoothParticles(x + [1.0, 0.0], externals=[force])
        sim = spam.Simulation(model, velocity=v, dt=0.05)
        run = sim.run(20.0)
        np.testing.assert_allclose(sim.state.position.mean(0), [np.cos(2.0), 0], atol=1e-6)
        self.assertTrue(all(drift.kept for drift in run.drifts.values()), run.drifts)
        np.testing.assert_allclose(run["impulse_x"][-1], run["momentum_x"][-1] - run["momentum_x"][0], atol=1e-10)

    def test_of_time_and_velocity(self):
        x, v = rotation(3)
        model = spam.SmoothParticles(x, externals=[spam.Force(lambda t, x, v: -0.5 * v + np.cos(t))])
        run = spam.Simulation(model, dt=0.01).run(3.0)
        t = run.t  # p' = -p/2 + cos t
        expected = 37 * (0.5 * np.cos(t) + np.sin(t) - 0.5 * np.exp(-0.5 * t)) / 1.25
        np.testing.assert_allclose(run["momentum_x"], expected, atol=1e-7)

    def test_gravity_as_built_in(self):
        x, v = rotation(3)
        ends = []
        for external in (spam.Gravity([0.0, -0.1]), spam.Force(lambda t, x, v: np.tile([0, -0.1], (len(x), 1)))):
            sim = spam.Simulation(spam.SmoothParticles(x, externals=[external]), velocity=v, dt=0.1)
            sim.run(2.0)
            ends.append(sim.state.position)
        np.testing.assert_allclose(*ends, atol=1e-13)
