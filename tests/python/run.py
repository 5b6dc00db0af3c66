# SPDX-License-Identifier: GPL-3.0-or-later
# Runs the tests of one file: run.py test_read.py. Exit status 77: all of them are skipped, and why.
import importlib.util
import os
import pathlib
import sys
import unittest


def load(file):
    sys.path.insert(0, str(file.parent))
    spec = importlib.util.spec_from_file_location(file.stem, file)
    module = importlib.util.module_from_spec(spec)
    sys.modules[file.stem] = module
    spec.loader.exec_module(module)
    return unittest.defaultTestLoader.loadTestsFromModule(module)


def skip(reason):
    print("skipped:", reason)
    sys.exit(77)


def main():
    try:
        import numpy  # noqa: F401
    except ImportError:
        skip("numpy is not installed (python3-numpy)")
    try:
        suite = load(pathlib.Path(sys.argv[1]))
    except unittest.SkipTest as reason:
        skip(reason)
    result = unittest.TextTestRunner(verbosity=2).run(suite)
    if not result.wasSuccessful() or result.testsRun + len(result.skipped) == 0:
        sys.exit(1)
    if len(result.skipped) >= result.testsRun:  # a class that is skipped as a whole has run none
        skip("; ".join(sorted({reason for _, reason in result.skipped})))


# A sanitizer that was loaded for the extension is in this process; programs that tests start have their own.
if "LD_PRELOAD" in os.environ:
    os.environ["SPAM_PRELOAD"] = os.environ.pop("LD_PRELOAD")  # for compiled.python_processes

if __name__ == "__main__":  # processes that tests start import this file
    main()
