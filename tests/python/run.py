# SPDX-License-Identifier: GPL-3.0-or-later
# Runs the tests of one file: run.py test_read.py. Exit status 77: all of them are skipped, and why.
import importlib.util
import pathlib
import sys
import unittest

file = pathlib.Path(sys.argv[1])
sys.path.insert(0, str(file.parent))
try:
    import numpy  # noqa: F401
except ImportError:
    print("skipped: numpy is not installed (python3-numpy)")
    sys.exit(77)
spec = importlib.util.spec_from_file_location(file.stem, file)
module = importlib.util.module_from_spec(spec)
sys.modules[file.stem] = module
try:
    spec.loader.exec_module(module)
except unittest.SkipTest as reason:
    print("skipped:", reason)
    sys.exit(77)
suite = unittest.defaultTestLoader.loadTestsFromModule(module)
result = unittest.TextTestRunner(verbosity=2).run(suite)
if not result.wasSuccessful() or result.testsRun == 0:
    sys.exit(1)
if len(result.skipped) == result.testsRun:
    print("skipped:", "; ".join(sorted({reason for _, reason in result.skipped})))
    sys.exit(77)
