# SPDX-License-Identifier: GPL-3.0-or-later
"""Result folders: read(folder)."""
import json
import pathlib
from dataclasses import dataclass
from typing import Optional

import numpy as np

from .checkpoints import read_checkpoint
from .errors import InputError, needed, one_line, refuse, text_of
from .snapshots import Snapshot, listed
from .tables import Table, read_events, read_table


@dataclass(frozen=True)
class Check:
    """What a problem measured, and what it must be: `expected` is None where nothing is claimed."""

    name: str
    value: Optional[float]
    expected: Optional[float]
    tolerance: Optional[float]
    holds: bool
    source: str


class Snapshots:
    """The snapshots of one case, a sequence that reads its files when they are asked for."""

    def __init__(self, folder, found, dimensions):
        self._folder, self._found, self._dimensions = folder, found, dimensions
        self.times = np.array([t for t, _ in found])

    def __len__(self):
        return len(self._found)

    def __getitem__(self, k):
        if isinstance(k, slice):
            return [self[i] for i in range(*k.indices(len(self)))]
        return Snapshot(self._folder / self._found[k][1], self._dimensions)

    def __repr__(self):
        return f"<{len(self)} snapshots in {one_line(self._folder)}>"


class Case:
    """One run: `invariants` (a Table), `statistics` (a dict), `events`, `snapshots`."""

    def __init__(self, folder, name):
        self.folder, self.name = folder, name
        inside = folder / "invariants.csv"
        self.invariants = read_table(inside) if inside.exists() else Table((), ())
        self.statistics = _object(folder / "statistics.json", dict) or {}
        self.events = read_events(folder / "events.csv") if (folder / "events.csv").exists() else []
        found = listed(folder / "snapshots.pvd") if (folder / "snapshots.pvd").exists() else []
        self.dimensions = sum("momentum_" + a in self.invariants for a in "xyz") or None
        self.snapshots = Snapshots(folder, found, self.dimensions)

    @property
    def drifts(self):
        """By invariant, a dict of promise, scale, limit, change (in parts of the scale) and kept."""
        return self.statistics.get("invariants", {})

    def frames(self):
        """(lengths of the box, points (N, 3) about its middle) by snapshot, as freud takes them."""
        for snapshot in self.snapshots:
            low, high, _ = snapshot.box
            points = np.zeros((len(snapshot), 3))
            points[:, : snapshot.dimensions] = snapshot.position - 0.5 * (low + high)
            yield list(high - low), points

    def to_xarray(self):
        """An xarray.Dataset of all snapshots over (time, particle, axis, other_axis); the coordinate
        `particle` is the id. Particles that are not there at a time are NaN. Needs python3-xarray."""
        xarray = needed("xarray", "python3-xarray")
        snapshots = self.snapshots[:]
        if not snapshots:
            raise InputError(f"{one_line(self.folder)}: there are no snapshots")
        ids = np.unique(np.concatenate([one.id for one in snapshots]))
        over = ("time", "particle", "axis", "other_axis")
        arrays = {}
        for name in snapshots[0].names:
            if name == "id":
                continue
            shape = snapshots[0][name].shape[1:]
            whole = np.full((len(snapshots), len(ids)) + shape, np.nan)
            for k, one in enumerate(snapshots):
                if name in one and one[name].shape[1:] == shape:
                    whole[k, np.searchsorted(ids, one.id)] = one[name]
            arrays[name] = (over[: whole.ndim], whole)
        axes = list("xyz"[: snapshots[0].dimensions])
        return xarray.Dataset(arrays, {"time": [one.t for one in snapshots], "particle": ids,
                                       "axis": axes, "other_axis": axes})

    def __repr__(self):
        return (f"<Case {self.name or self.folder.name}: {len(self.invariants)} rows, "
                f"{len(self.snapshots)} snapshots>")


class Results:
    """What a problem has left: `cases` by name, `checks` by name, and what it was asked for.

    Of a folder with one case its invariants, snapshots, ... are those of the results, too.
    """

    def __init__(self, folder):
        self.folder = folder
        self.cases = {one.name: one for one in (Case(f, n) for f, n in _cases(folder))}
        checks = _object(folder / "result.json", list)
        #: Whether the run has ended, at its end or before.
        self.complete = checks is not None
        self.checks = _checks(folder / "result.json", checks or [])
        statistics = [one.statistics for one in self.cases.values()]
        self.problem = next((s["problem"] for s in statistics if "problem" in s), "")
        self.version = next((s["version"] for s in statistics if "version" in s), "")

        #: Why a guard stopped it, in words; empty where none did.
        self.stopped = next((s["stopped"] for s in statistics if "stopped" in s), "")

    @property
    def holds(self):
        """Whether the run has come to its end and all its checks hold: exit status 0."""
        return self.complete and not self.stopped and all(c.holds for c in self.checks.values())

    @property
    def case(self):
        """The options of the run, from case.toml."""
        path = self.folder / "case.toml"
        try:
            import tomllib
        except ImportError:
            import tomli as tomllib  # before Python 3.11
        try:
            return tomllib.loads(text_of(path))
        except (tomllib.TOMLDecodeError, RecursionError) as error:
            refuse(path, f"is damaged, it is no TOML ({error})")

    def checkpoint(self, file=None):
        """The state of every case in the latest checkpoint, or in this file of the folder (checkpoints.py).
        Needs python3-h5py."""
        if file is not None:
            return read_checkpoint(self.folder / file)
        there = [f for f in self.folder.glob("checkpoint_*.h5") if f.is_file()]
        if not there:
            refuse(self.folder, "holds no checkpoint")
        return read_checkpoint(max(there, key=lambda f: f.stat().st_mtime_ns))

    def __getitem__(self, name):
        if name not in self.cases:
            raise InputError(f"there is no case '{one_line(name)}'; there are {', '.join(self.cases)}")
        return self.cases[name]

    def __getattr__(self, name):
        if name.startswith("_") or not hasattr(Case, name) and name not in (
                "invariants", "statistics", "events", "snapshots", "dimensions"):
            raise AttributeError(f"results have no '{name}'")
        if len(self.cases) != 1:
            raise AttributeError(f"there are several cases, each with its {name}: "
                                 f"{', '.join(self.cases)}")
        return getattr(next(iter(self.cases.values())), name)

    def __repr__(self):
        state = "" if self.complete else ", not complete"
        return f"<Results of {self.problem or self.folder.name}{state}: {', '.join(self.cases) or 'no case'}>"


def read(folder):
    """The results in a folder that a problem has left.

    Invariants, checks and lists are read at once, snapshots when they are asked for. Needs numpy only.
    Raises InputError (a ValueError) of one line where the folder is none, is empty, belongs to something
    else, is damaged or of a newer format.
    """
    folder = pathlib.Path(folder)
    try:
        entries = sorted(entry.name for entry in folder.iterdir())
    except NotADirectoryError:
        refuse(folder, "is no folder; name the result folder of a run")
    except FileNotFoundError:
        refuse(folder, "there is no such folder")
    except OSError as error:
        refuse(folder, f"cannot be read ({error.strerror})")
    if not entries:
        refuse(folder, "is empty; name the result folder of a run")
    if "case.toml" not in entries and "snapshots.pvd" not in entries:
        refuse(folder, "is no result folder of spam: it has neither case.toml nor snapshots.pvd")
    try:
        return Results(folder)
    except OSError as error:
        refuse(error.filename or folder, f"cannot be read ({error.strerror})")


def _cases(folder):
    """(folder, name) of the cases inside: the folder itself, or those two levels below at most."""
    marks = ("invariants.csv", "snapshots.pvd")
    found = [(folder, "")] if any((folder / mark).exists() for mark in marks) else []
    inside = {path.parent for depth in ("*/", "*/*/") for mark in marks
              for path in folder.glob(depth + mark)}
    return found + [(one, one.relative_to(folder).as_posix()) for one in sorted(inside)]


def _object(path, kind):
    if not path.exists():
        return None
    try:
        value = json.loads(text_of(path))
    except InputError:
        raise
    except (ValueError, RecursionError):
        refuse(path, "is damaged, it is no JSON; run the problem again")
    if not isinstance(value, kind):
        refuse(path, "is damaged, or of another version; run the problem again")
    return value


def _checks(path, rows):
    checks = {}
    for row in rows:
        try:
            check = Check(**{key: row[key] for key in Check.__dataclass_fields__})
        except (KeyError, TypeError):
            refuse(path, "is no list of checks; run the problem again")
        checks[check.name] = check
    return checks
