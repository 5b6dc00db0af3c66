# SPDX-License-Identifier: GPL-3.0-or-later
"""integrate() and work_precision(): equations of one's own by the library's methods."""
import importlib.util
import math
import unittest

import numpy as np
import spam_mechanics as spam
import compiled  # noqa: F401  (skips where there is no compiled part)

TURN = 2 * np.pi


def oscillator(t, y):
    return np.array([y[1], -y[0]])


class Integrate(unittest.TestCase):
    def test_every_method(self):
        tried = 0
        for name, what in spam.methods().items():
            if what["separable"]:
                with self.assertRaisesRegex(ValueError, "positions"):
                    spam.integrate(oscillator, [1.0, 0.0], TURN, method=name, dt=0.01)
                continue
            for options in [{"dt": TURN / 500}] * what["fixed"] + [{"rtol": 1e-8, "atol": 1e-8}] * what["adaptive"]:
                end = spam.integrate(oscillator, [1.0, 0.0], TURN, method=name, **options)
                limit = 2e-3 if what["order"] < 4 else 1e-5
                with self.subTest(name, **options):
                    np.testing.assert_allclose(end.y[-1], [1, 0], atol=limit)
                    self.assertEqual(end.t[-1], TURN)
                    self.assertGreater(end.rhs_evaluations, 10)
                tried += 1
        self.assertGreater(tried, 20)

    def test_rows(self):
        steps = spam.integrate(oscillator, [1.0, 0.0], 1.0, method="rk4", dt=0.1)
        self.assertEqual((steps.t.shape, steps.y.shape, steps.steps), ((11,), (11, 2), 10))
        self.assertEqual(steps.rhs_evaluations, 40)
        times = spam.integrate(oscillator, [1.0, 0.0], times=[0.0, 0.3, 1.0])
        np.testing.assert_array_equal(times.t, [0.0, 0.3, 1.0])
        np.testing.assert_allclose(times.y[:, 0], np.cos([0.0, 0.3, 1.0]), atol=1e-7)

    def test_arrays_are_its_own(self):
        kept = []

        def f(t, y):
            kept.append((y, y.copy()))
            y += 0.0
            return -y

        spam.integrate(f, np.ones(5), 1.0)
        for array, copy in kept:
            np.testing.assert_array_equal(array, copy)

    def test_short_times(self):
        for method in ("arkode:DORMAND_PRINCE_7_4_5", "gsl:rk8pd", "cvode:adams"):
            y = spam.integrate(lambda t, y: np.array([y[1], -1e28 * y[0]]), [1.0, 0.0], 1e-14, method=method,
                               atol=1e-6).y[-1]
            self.assertAlmostEqual(y[0], math.cos(1.0), delta=1e-4, msg=method)

    def test_a_stiff_equation(self):
        f = lambda t, y: -1e4 * (y - np.cos(t))  # noqa: E731
        bdf = [name for name in spam.methods() if "bdf" in name]
        for name in bdf:
            end = spam.integrate(f, [0.0], 2.0, method=name, rtol=1e-6, atol=1e-8)
            self.assertAlmostEqual(end.y[-1, 0], np.cos(2.0), 3)

    def test_wrong_input(self):
        for word, call in [("either", lambda: spam.integrate(oscillator, [1, 0])),
                           ("is not after", lambda: spam.integrate(oscillator, [1, 0], 0.0)),
                           ("is not after", lambda: spam.integrate(oscillator, [1, 0], times=[1, 0.5])),
                           ("y0: is empty", lambda: spam.integrate(oscillator, [], 1.0)),
                           ("y0: entry 0", lambda: spam.integrate(oscillator, [np.nan], 1.0)),
                           ("y0: has the shape", lambda: spam.integrate(oscillator, [[1, 0]], 1.0)),
                           ("dt", lambda: spam.integrate(oscillator, [1, 0], 1.0, method="rk4"))]:
            with self.subTest(word), self.assertRaisesRegex(spam.InputError, word):
                call()
        with self.assertRaises(spam.GuardStop):
            spam.integrate(lambda t, y: y * y, [1.0], 2.0)  # infinite at t = 1
        with self.assertRaises(spam.GuardStop):
            spam.integrate(lambda t, y: y * np.nan, [1.0], 2.0)


class WorkPrecision(unittest.TestCase):
    def test_orders_and_tolerances(self):
        methods = ["rk4", "arkode:DORMAND_PRINCE_7_4_5", "gsl:rk8pd"]
        study = spam.work_precision(oscillator, [1.0, 0.0], TURN, methods=methods)
        np.testing.assert_allclose(study.reference, [1.0, 0.0], atol=1e-11)
        self.assertLess(study.floor, 1e-11)
        self.assertAlmostEqual(study.order("rk4"), 4, delta=0.15)
        self.assertAlmostEqual(study.order("arkode:DORMAND_PRINCE_7_4_5"), 5, delta=0.3)
        errors, calls = study.of("gsl:rk8pd", "adaptive")
        self.assertLess(errors[-1], 1e-3 * errors[0])
        self.assertGreater(calls[-1], calls[0])
        np.testing.assert_array_equal(study["calls"][:2], [64, 92])
        if importlib.util.find_spec("pandas"):
            self.assertEqual(len(study.to_pandas()), len(study.rows))

    def test_a_known_end(self):
        study = spam.work_precision(oscillator, [1.0, 0.0], TURN, methods=["rk4"], reference=[1.0, 0.0],
                                    steps=[50, 100])
        self.assertEqual(study.floor, 0.0)
        self.assertAlmostEqual(np.log2(study["error"][0] / study["error"][1]), 4, delta=0.1)

    def test_names_of_arkode(self):
        study = spam.work_precision(oscillator, [1.0, 0.0], 1.0, methods=["arkode:ARKODE_DORMAND_PRINCE_7_4_5"],
                                    steps=[], tolerances=[1e-6], reference=[math.cos(1.0), -math.sin(1.0)])
        self.assertLess(study["error"][0], 1e-4)

    def test_unknown_methods(self):
        with self.assertRaises(spam.InputError):
            spam.work_precision(oscillator, [1.0, 0.0], 1.0, methods=["rk5"])
