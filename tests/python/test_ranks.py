# SPDX-License-Identifier: GPL-3.0-or-later
"""Scripts under mpirun: the numbers of one process, and an exception in one process ends all."""
import os
import pathlib
import shutil
import subprocess
import sys
import unittest

import compiled  # noqa: F401  (skips where there is no compiled part)
import spam_mechanics as spam

if shutil.which("mpirun") is None:
    raise unittest.SkipTest("mpirun is not installed (openmpi-bin)")

script = pathlib.Path(__file__).parent / "ranks.py"


def started(count, *words, program=(script,)):
    more = {"OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_ALLOW_RUN_AS_ROOT": "1",
            "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    with compiled.python_processes():
        return subprocess.run(["mpirun", "-n", str(count), "--bind-to", "none", sys.executable, "-B", *program, *words],
                              env={**os.environ, **more}, timeout=120, text=True, capture_output=True)


class Ranks(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        ended = started(2, program=("-c", "import spam_mechanics as spam; spam.rank()"))
        if "this build has no MPI" in ended.stderr:
            assert ended.returncode != 0, "each of two processes has done the whole"
            raise unittest.SkipTest("this build has no MPI")

    def test_one_process(self):
        self.assertEqual((spam.rank(), spam.ranks()), (0, 1))
        self.assertEqual(list(compiled.moving().own), list(range(37)))

    def test_numbers_of_one_process(self):
        for count in (2, 3):
            ended = started(count)
            self.assertEqual(ended.returncode, 0, ended.stderr)
            self.assertIn(f"{count} processes, {37 // count}", ended.stdout)
            self.assertIn(": 0 of ", ended.stdout)

    def test_an_exception_in_one_ends_all(self):
        for where in ("law", "row", "step"):
            with self.subTest(where):
                ended = started(2, where)
                self.assertNotEqual(ended.returncode, 0)
                self.assertIn(f"ZeroDivisionError: a {where} has failed", ended.stderr)

    def test_one_simulation_at_a_time(self):
        ended = started(2, "two")
        self.assertNotEqual(ended.returncode, 0)
        for words in ("InputError", "simulation: processes share the particles of one Simulation at a time"):
            self.assertIn(words, ended.stderr)  # both say it at once, in pieces that mix
