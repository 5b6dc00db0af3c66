# SPDX-License-Identifier: GPL-3.0-or-later
"""The script of the README, word for word."""
import importlib.util
import os
import pathlib
import re
import subprocess
import sys
import unittest

import numpy as np

from compiled import python_processes
from results_of import work

readme = (pathlib.Path(os.environ["SPAM_SOURCE"]) / "README.md").read_text()

NUMBER = r"\d+\.\d+"


class Readme(unittest.TestCase):
    @unittest.skipUnless(importlib.util.find_spec("matplotlib"), "matplotlib is not installed")
    def test_its_script(self):
        section = readme[readme.index("## From Python") :]
        script = re.search(r"```python\n(.*?)```", section, re.S)[1]
        self.assertLessEqual(script.count("\n"), 25)
        promised = re.findall(r"^    (\w+, \w+: L/L0 = .*)$", section, re.M)
        self.assertEqual(len(promised), 3)
        folder = work("readme")
        folder.mkdir()
        (folder / "hexagon.py").write_text(script)
        with python_processes():
            ended = subprocess.run([sys.executable, "hexagon.py"], cwd=folder, text=True, capture_output=True,
                                   env={**os.environ, "MPLBACKEND": "Agg"})
        self.assertEqual(ended.returncode, 0, ended.stderr)
        for line, expected in zip(ended.stdout.splitlines(), promised, strict=True):
            self.assertEqual(re.sub(NUMBER, "", line), re.sub(NUMBER, "", expected))
            numbers = [[float(one) for one in re.findall(NUMBER, text)] for text in (line, expected)]
            # Clumps of the plain scheme follow the last digits, which an instruction set has of its own.
            np.testing.assert_allclose(*numbers, rtol=0.1 if "plain" in line else 0, atol=0.015)
        self.assertGreater((folder / "hexagon.png").stat().st_size, 10000)
