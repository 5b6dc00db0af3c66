# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs that numbers come from: kept by case and version, in build/numbers/RUN/DIGEST."""
import csv
import hashlib
import json
import math
import os
import re
import shutil
import subprocess
import time

from catalogue import ListError, suggestion


class RunFailed(Exception):
    """A run left no complete results: one line, and the exit status to end with."""

    def __init__(self, message, status):
        super().__init__(message)
        self.status = status


class Store:
    """`programs`: a folder of problem executables; None: ./spam builds them, in build/release/problems."""

    def __init__(self, root, programs=None, front_door=()):
        self.root, self.front_door = root, list(front_door)
        self.programs = programs.resolve() if programs else None
        self.folder = root / "build" / "numbers"
        self.versions = {}

    def program(self, problem):
        return (self.programs or self.root / "build" / "release" / "problems") / problem

    def version(self, problem):
        """What the program says of itself; with its digest where no commit tells one build from another."""
        if problem not in self.versions:
            if self.programs is None:
                command = [self.root / "spam", *self.front_door, "run", problem, "--version"]
            else:
                command = [self.program(problem), "--version"]
            try:
                done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=False)
            except OSError as error:
                raise RunFailed(f"{command[0]}: {error.strerror}; build it with ./spam run {problem}", 5) from None
            if done.returncode != 0:
                raise RunFailed(f"'{' '.join(map(str, command))}' failed", done.returncode)
            version = done.stdout.strip()
            if "commit" not in version or "changed" in version or "dirty" in version:
                version += hashlib.sha256(self.program(problem).read_bytes()).hexdigest()
            self.versions[problem] = version
        return self.versions[problem]

    def results(self, run):
        """The result folder of a run, which is done where it has not been."""
        version = self.version(run.problem)
        digest = hashlib.sha256(json.dumps([run.problem, run.options, version]).encode()).hexdigest()[:16]
        folder = self.folder / run.name / digest
        if not (folder / "kept.json").is_file():
            self.make(run, version, folder)
        return folder

    def make(self, run, version, folder):
        shutil.rmtree(folder, ignore_errors=True)
        folder.parent.mkdir(parents=True, exist_ok=True)
        command = [self.program(run.problem), *run.options, "--out", folder, "--no-plots", "--quiet"]
        start = time.monotonic()
        try:
            done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                  stderr=subprocess.PIPE, text=True, check=False,
                                  env={**os.environ, "OMP_NUM_THREADS": "1"})  # beside other work
        except OSError as error:
            raise RunFailed(f"{command[0]}: {error.strerror}", 5) from None
        if done.returncode not in (0, 1, run.status):  # 1: complete, and a check of its own does not hold
            why = (done.stderr.strip().splitlines() or ["it says nothing"])[-1]
            status = done.returncode if done.returncode > 0 else 128 - done.returncode
            raise RunFailed(f"run '{run.name}' ({run.command()}) ended with {status}: {why}", status)
        for large in [*folder.rglob("*.vtp"), *folder.rglob("*.vti"), *folder.rglob("*.h5")]:
            large.unlink()
        kept = {"command": run.command(), "version": version, "seconds": round(time.monotonic() - start, 2)}
        (folder / "kept.json").write_text(json.dumps(kept) + "\n", encoding="utf-8")


def value_of(number, folder):
    """What the results in `folder` say of a number, in the units of its document. Throws ListError."""
    path = folder / number.file
    if not path.is_file():
        files = [str(file.relative_to(folder)) for file in folder.rglob("*") if file.is_file()]
        raise ListError(f"{number.key}: run '{number.run.name}' leaves no '{number.file}'"
                        f"{suggestion(number.file, files)}")
    if path.suffix == ".json":
        value = of_json(number, json.loads(path.read_text(encoding="utf-8")))
    else:
        value = of_table(number, path)
    if not isinstance(value, (int, float)) or not math.isfinite(value):
        raise ListError(f"{number.key}: {number.file} has no number '{number.name}'")
    return number.offset + number.scale * value


def of_json(number, content):
    """A check by its name, or a value by keys and names joined by '/'."""
    for key in number.name.split("/"):
        if isinstance(content, list):
            content = {item.get("name", item.get("label", "")): item for item in content}
        if not isinstance(content, dict) or key not in content:
            known = list(content) if isinstance(content, dict) else []
            raise ListError(f"{number.key}: {number.file} of run '{number.run.name}' has no '{key}'"
                            f"{suggestion(key, known)}")
        content = content[key]
    return content["value"] if isinstance(content, dict) and "value" in content else content


PICKS = {"first": lambda values: values[0], "last": lambda values: values[-1], "largest": max, "smallest": min}


def of_table(number, path):
    """A column, in the row that number.row says: one of PICKS, of the rows with this VALUE in column WHERE."""
    with path.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    if not rows or number.name not in rows[0]:
        raise ListError(f"{number.key}: {number.file} of run '{number.run.name}' has no column '{number.name}'"
                        f"{suggestion(number.name, list(rows[0]) if rows else [])}")
    pick = "last"
    for part in (part.strip() for part in number.row.split(",")):
        condition = re.fullmatch(r"(.+?)\s*(!?=)\s*(.+)", part)
        if condition:
            column, relation, wanted = condition.groups()
            if column not in rows[0]:
                known = suggestion(column, list(rows[0]))
                raise ListError(f"{number.key}: {number.file} has no column '{column}'{known}")
            left = [row for row in rows if same(row[column], wanted) == (relation == "=")]
            if not left:
                raise ListError(f"{number.key}: {number.file} has no row with {number.row}")
            rows = left
        elif part in PICKS:
            pick = part
        else:
            raise ListError(f"{number.key}: 'row' must be {', '.join(PICKS)}, COLUMN = VALUE or COLUMN != VALUE, or "
                            "several of these with commas")
    values = [float(row[number.name]) for row in rows if row[number.name]]
    if not values:
        raise ListError(f"{number.key}: column '{number.name}' of {number.file} is empty")
    return PICKS[pick](values)


def same(text, wanted):
    try:
        return math.isclose(float(text), float(wanted), rel_tol=1e-9, abs_tol=1e-12)
    except ValueError:
        return text == wanted
