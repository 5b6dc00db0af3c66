# SPDX-License-Identifier: GPL-3.0-or-later
"""Results that tests read, made once by the problems' programs."""
import atexit
import os
import pathlib
import shutil
import tempfile
import unittest

import spam_mechanics as spam

_folder = pathlib.Path(tempfile.mkdtemp(prefix="spam-python-"))
atexit.register(shutil.rmtree, _folder, ignore_errors=True)


def work(name):
    """A folder that does not exist yet."""
    return _folder / name


def program(problem):
    """Skips where the program has not been built."""
    path = pathlib.Path(os.environ.get("SPAM_PROBLEMS", "")) / problem
    if not path.is_file():
        raise unittest.SkipTest(f"the program {problem} is not built")
    return path


def hexagon(name="hexagon", **options):
    """A short run of the rotating hexagon in work(name), not run again where it is there."""
    program("rotating_hexagon")
    out = work(name)
    if out.exists():
        return spam.read(out)
    return spam.run("rotating_hexagon", smoke=True, no_plots=True, out=out, **options)
