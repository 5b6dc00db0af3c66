# SPDX-License-Identifier: GPL-3.0-or-later
"""SPAM, smooth-particle applied mechanics, from Python.

    import spam_mechanics as spam

Results of problems: read(folder), run(problem, **options); these need numpy only.
"""
from .errors import GuardStop, InputError, OutputError, SetUpError
from .results import Case, Check, Results, read
from .running import run
from .snapshots import Snapshot
from .tables import Table

__all__ = ["Case", "Check", "GuardStop", "InputError", "OutputError", "Results", "SetUpError",
           "Snapshot", "Table", "read", "run"]
