# SPDX-License-Identifier: GPL-3.0-or-later
"""The scripts of the documents, word for word: every block of Python in the README and in the pages of ./spam docs."""
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

source = pathlib.Path(os.environ["SPAM_SOURCE"])
NUMBER = r"\d+\.\d+"
BLOCK = re.compile(r"^```python\n(.*?)^```$", re.S | re.M)


def scripts():
    """(names, blocks, numbers) of every section with a script: the file names in `backquotes` in its text, its blocks,
    and what the lines of its text with 'L/L0 =' promise that the script prints."""
    for document in [source / "README.md", *sorted((source / "src" / "docs").glob("*.md"))]:
        for section in re.split(r"(?m)^##+ ", document.read_text(encoding="utf-8")):
            blocks, text = BLOCK.findall(section), BLOCK.sub("", section)
            if blocks:
                promised = [line for line in text.splitlines() if "L/L0 =" in line]
                yield re.findall(r"`(\w+\.py)`", text), blocks, re.findall(NUMBER, " ".join(promised))


class Readme(unittest.TestCase):
    @unittest.skipUnless(importlib.util.find_spec("matplotlib"), "matplotlib is not installed")
    def test_every_script(self):
        found = list(scripts())
        self.assertGreaterEqual(len(found), 3)
        self.assertTrue(any(promised for _, _, promised in found))
        for names, blocks, promised in found:
            self.assertEqual((len(names), len(blocks)), (1, 1), f"one script a section, and its file's name: {names}")
            name, script = names[0], blocks[0]
            with self.subTest(name):
                folder = work("readme_" + name)
                folder.mkdir()
                (folder / name).write_text(script, encoding="utf-8")
                with python_processes():
                    ended = subprocess.run([sys.executable, name], cwd=folder, text=True, capture_output=True,
                                           env={**os.environ, "MPLBACKEND": "Agg"})
                self.assertEqual(ended.returncode, 0, ended.stderr)
                printed = re.findall(NUMBER, ended.stdout)
                # Clumps of the plain scheme follow the last digits, which an instruction set has of its own.
                np.testing.assert_allclose(*[np.array(numbers, dtype=float) for numbers in (printed, promised)], atol=0.025)
                for picture in re.findall(r'savefig\("(\w+\.png)"', script):
                    self.assertGreater((folder / picture).stat().st_size, 10000)
