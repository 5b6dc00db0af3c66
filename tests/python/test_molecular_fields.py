# SPDX-License-Identifier: GPL-3.0-or-later
"""Fields of molecules from Python: sums by the formula, momentum that is balanced, what is refused."""
import unittest

import numpy as np
import spam_mechanics as spam
from compiled import hexagon


def lucy(r, h):
    u = np.minimum(r / h, 1.0)
    return 5.0 / (np.pi * h * h) * (1.0 + 3.0 * u) * (1.0 - u) ** 3


def molecules(length=12.0):
    """A periodic square of molecules that are not on a lattice, and a state of it."""
    random = np.random.default_rng(4)
    x = spam.square_lattice([12, 12]) + random.uniform(-0.1, 0.1, (144, 2))
    model = spam.Molecules(x, box=[length, length], mass=1.3)
    return model, model.start(velocity=random.normal(size=(144, 2)))


def block(model, y, name):
    first, size, components = model.fields[name]
    return y[first:first + size].reshape(-1, components)


class Fields(unittest.TestCase):
    def test_are_the_sums_of_their_definition(self):
        model, y = molecules()
        places = np.random.default_rng(5).uniform(0.0, 12.0, (7, 2))
        found = spam.molecular_fields(model, y, places, range=2.5)
        s = places[:, None] - block(model, y, "position")[None]
        w = 1.3 * lucy(np.linalg.norm(s - 12.0 * np.round(s / 12.0), axis=2), 2.5)
        v = block(model, y, "velocity")
        u = w @ v / w.sum(axis=1)[:, None]
        np.testing.assert_allclose(found["density"], w.sum(axis=1), rtol=1e-12)
        np.testing.assert_allclose(found["velocity"], u, rtol=1e-10)
        apart = ((v[None] - u[:, None]) ** 2).sum(axis=2)
        temperature = 1.3 * (w * apart).sum(axis=1) / (2.0 * w.sum(axis=1))
        np.testing.assert_allclose(found["temperature"], temperature, rtol=1e-10)
        self.assertEqual(found["pressure"].shape, (7, 3))
        self.assertEqual(found["energy"].shape, (7,))

    def test_balance_momentum(self):
        model, y = molecules()
        d, place = 1e-4, np.array([5.3, 6.1])

        def fields(y, at):
            return spam.molecular_fields(model, y, [at], kernel="w6", range=2.5)

        def flux(at, a):
            one = fields(y, at)
            row = one["pressure"][0][[0, 2] if a == 0 else [2, 1]]
            return row + one["density"][0] * one["velocity"][0][a] * one["velocity"][0]

        def momentum(y):
            one = fields(y, place)
            return one["density"][0] * one["velocity"][0]

        out = sum((flux(place + d * e, a) - flux(place - d * e, a)) / (2.0 * d) for a, e in enumerate(np.eye(2)))
        rate = model.rates(0.0, y)
        change = (momentum(y + d * rate) - momentum(y - d * rate)) / (2.0 * d)
        self.assertLess(np.linalg.norm(change + out), 1e-5 * np.linalg.norm(change))

    def test_of_springs_and_of_a_state(self):
        sim = spam.Simulation(spam.Springs([[0.0], [1.0]]), dt=0.1)
        with sim.edit() as s:
            s.position[:] = [[0.0], [3.0]]
        found = spam.molecular_fields(sim.model, sim.state, [[1.5], [9.0]], range=1.0)
        np.testing.assert_allclose(found["pressure"], [[-2.0], [0.0]], atol=1e-14)
        self.assertTrue(np.isnan(found["velocity"][1, 0]))

    def test_what_makes_no_sense_is_refused(self):
        model, v = hexagon()
        with self.assertRaisesRegex(spam.InputError, "not known pair by pair"):
            spam.molecular_fields(model, model.start(v), [[0.0, 0.0]])
        model, y = molecules()
        for words in [{"kernel": "none"}, {"range": -1.0}, {"range": 6.1}, {"range": float("nan")}]:
            with self.assertRaises(spam.InputError, msg=str(words)):
                spam.molecular_fields(model, y, [[0.0, 0.0]], **words)
        with self.assertRaisesRegex(spam.InputError, "places"):
            spam.molecular_fields(model, y, [[0.0, 0.0, 0.0]])
