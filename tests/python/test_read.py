# SPDX-License-Identifier: GPL-3.0-or-later
"""What read() finds in a result folder."""
import csv
import importlib.util
import os
import pathlib
import tempfile
import unittest
import unittest.mock

import numpy as np
import spam_mechanics as spam
from results_of import hexagon, program, work


def needs(package):
    return unittest.skipUnless(importlib.util.find_spec(package), f"{package} is not installed")


class Read(unittest.TestCase):
    def test_cases_and_checks(self):
        results = hexagon()
        self.assertEqual(list(results.cases), ["md", "monaghan", "monaghan_torque_pair", "plain"])
        self.assertTrue(results.complete and results.holds)
        self.assertEqual(results.problem, "rotating_hexagon")
        self.assertEqual(results.case["size"], 3)
        check = results.checks["plain_momentum_drift"]
        self.assertTrue(check.holds and check.value < check.tolerance == 1e-12)
        self.assertIsNone(results.checks["plain_closest_pair"].expected)
        self.assertEqual(results["plain"].drifts["angular momentum"]["promise"], "not kept")
        with self.assertRaisesRegex(ValueError, "there is no case 'x'; there are md"):
            results["x"]
        with self.assertRaisesRegex(AttributeError, "several cases"):
            results.invariants

    def test_rows_are_those_of_the_file(self):
        case = hexagon()["plain"]
        with open(case.folder / "invariants.csv", newline="") as file:
            rows = list(csv.reader(file))
        self.assertEqual(list(case.invariants.names), rows[0])
        for k, name in enumerate(rows[0]):
            self.assertEqual(list(case.invariants[name]), [float(row[k]) for row in rows[1:]])
        self.assertEqual(case.invariants.array["t"][-1], case.invariants.t[-1])
        with self.assertRaises(ValueError):
            case.invariants["energy"][0] = 1.0
        with self.assertRaisesRegex(ValueError, "no column 'enrgy'"):
            case.invariants["enrgy"]

    def test_snapshots_add_up_to_the_invariants(self):
        case = hexagon()["plain"]
        self.assertEqual(case.dimensions, 2)
        for snapshot in case.snapshots:
            row = np.searchsorted(case.invariants.t, snapshot.t - 1e-9)
            x, v, m = snapshot.position, snapshot.velocity, snapshot.mass
            self.assertEqual((x.shape, v.shape, snapshot.stress.shape), ((37, 2), (37, 2), (37, 2, 2)))
            self.assertEqual(list(snapshot.id), list(range(37)))
            np.testing.assert_allclose(np.sum(m * (x[:, 0] * v[:, 1] - x[:, 1] * v[:, 0])),
                                       case.invariants["angular_momentum"][row], rtol=1e-13)
            np.testing.assert_allclose(np.sum(m * (v**2).sum(1)) / 2 + np.sum(m * snapshot.energy),
                                       case.invariants["energy"][row], rtol=1e-13)
            np.testing.assert_array_equal(snapshot.stress, snapshot.stress.transpose(0, 2, 1))
            low, high, periodic = snapshot.box
            self.assertTrue((x >= low).all() and (x <= high).all() and not periodic.any())
        self.assertEqual(len(case.snapshots[:2]), 2)
        with self.assertRaises(IndexError):
            case.snapshots[99]
        with self.assertRaisesRegex(ValueError, "no field 'pressure'"):
            case.snapshots[0]["pressure"]

    def test_a_run_of_one_case_and_options(self):
        one = hexagon("one", transport="monaghan", size=2)
        self.assertEqual(list(one.cases), [""])
        self.assertEqual(one.case["transport"], "monaghan")
        self.assertEqual(len(one.snapshots[0]), 19)
        self.assertEqual(one.invariants["mass"][0], 19)

    def test_finite_elements(self):
        program("ball_plate")
        results = spam.run("ball_plate", smoke=True, no_plots=True, out=work("plate"),
                           model="elements")
        snapshots = next(iter(results.cases.values())).snapshots
        snapshot = snapshots[0]  # before anything is broken, and turned inside out
        corners = snapshot.position[snapshot.elements]
        self.assertGreater(len(corners), 10)
        self.assertEqual(len(snapshots[-1].elements), len(corners))
        a, b = corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]
        self.assertTrue((a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0] > 0).all(), "counterclockwise")
        self.assertTrue(all(len(f) == len(corners) for f in snapshot.element_fields.values()))

    @needs("pandas")
    def test_pandas(self):
        frame = hexagon()["md"].invariants.to_pandas()
        self.assertEqual(frame.index.name, "t")
        self.assertEqual(frame["energy"].iloc[0], hexagon()["md"].invariants["energy"][0])

    @needs("xarray")
    def test_xarray(self):
        case = hexagon()["plain"]
        data = case.to_xarray()
        self.assertEqual(dict(data.sizes),
                         {"time": len(case.snapshots), "particle": 37, "axis": 2, "other_axis": 2})
        np.testing.assert_array_equal(data["velocity"].sel(particle=5).isel(time=-1),
                                      case.snapshots[-1].velocity[5])

    def test_frames(self):
        case = hexagon()["plain"]
        for (lengths, points), snapshot in zip(case.frames(), case.snapshots):
            self.assertEqual(len(lengths), 2)
            self.assertTrue((np.abs(points[:, :2]) <= 0.5 * np.array(lengths) + 1e-12).all())
            np.testing.assert_allclose(points[1] - points[0],
                                       [*(snapshot.position[1] - snapshot.position[0]), 0])

    @needs("h5py")
    def test_checkpoints(self):
        results = hexagon()
        for file in sorted(results.folder.glob("checkpoint_*.h5")):
            case = results.checkpoint(file.name)["plain"]
            self.assertEqual(case.fields["stress"].shape, (37, 3))
            inside = results["plain"].snapshots
            at = [s for s in inside if s.t == case.t]
            if at:
                order = np.argsort(case.id)
                np.testing.assert_array_equal(case.fields["position"][order], at[0].position)
                np.testing.assert_array_equal(case.fields["density"][order], at[0].density)
        self.assertTrue(results.checkpoint())


class Run(unittest.TestCase):
    def test_wrong_options_are_said_in_one_line(self):
        program("rotating_hexagon")
        for options, word in [({"sise": 3}, "size"), ({"size": -1}, "size"), ({"dt": "x"}, "dt")]:
            with self.assertRaisesRegex(ValueError, word) as caught:
                hexagon("wrong", **options)
            self.assertNotIn("\n", str(caught.exception))
            self.assertIsInstance(caught.exception, spam.InputError)
        self.assertFalse(work("wrong").exists())

    def test_unknown_problems(self):
        program("rotating_hexagon")
        for name, word in [("hexagon", "no problem 'hexagon'"), ("../drop", "no name of a problem")]:
            with self.assertRaisesRegex(spam.InputError, word):
                spam.run(name)

    def test_a_program_that_is_killed(self):
        with tempfile.TemporaryDirectory() as folder:
            for signal, error in (("SEGV", RuntimeError), ("KILL", RuntimeError), ("INT", KeyboardInterrupt)):
                file = pathlib.Path(folder) / "killed"
                file.write_text(f"#!/bin/sh\nkill -{signal} $$\n")
                file.chmod(0o755)
                with unittest.mock.patch.dict(os.environ, SPAM_PROBLEMS=folder), self.assertRaises(error) as caught:
                    spam.run("killed")
                if error is RuntimeError:
                    self.assertIn("SIG" + signal, str(caught.exception))

    def test_a_guard(self):
        program("rotating_hexagon")
        with self.assertRaisesRegex(spam.GuardStop, "steps"):
            hexagon("guarded", max_steps=10)
        results = spam.read(work("guarded"))
        self.assertTrue(results.complete and "too many steps" in results.stopped)
        self.assertFalse(results.holds)

    def test_an_existing_folder(self):
        hexagon()
        with self.assertRaisesRegex(spam.InputError, "force"):
            spam.run("rotating_hexagon", smoke=True, out=work("hexagon"))
