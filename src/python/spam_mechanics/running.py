# SPDX-License-Identifier: GPL-3.0-or-later
"""Problems run from Python: run(problem, **options)."""
import os
import pathlib
import re
import shutil
import signal
import subprocess

from .errors import GuardStop, InputError, OutputError, SetUpError, one_line
from .results import read


def _command(problem):
    """How to start a problem: from $SPAM_PROBLEMS, else by the front door of the source tree, of the same prefix, or
    in PATH."""
    folder = os.environ.get("SPAM_PROBLEMS")
    if folder:
        program = pathlib.Path(folder) / problem
        if program.is_file():
            return [str(program)]
        known = sorted(f.name for f in pathlib.Path(folder).glob("*")
                       if f.is_file() and os.access(f, os.X_OK)) if os.path.isdir(folder) else []
        raise InputError(f"run: no problem '{problem}' in SPAM_PROBLEMS = {one_line(folder)}; there are "
                         f"{', '.join(known) or 'none'}")
    above = pathlib.Path(__file__).resolve().parents
    if len(above) > 3 and (above[3] / "spam").is_file() and (above[3] / "problems").is_dir():
        door = above[3] / "spam"
    elif len(above) > 4 and (above[4] / "bin/spam").exists():
        door = above[4] / "bin/spam"
    else:
        door = shutil.which("spam")
    if door is None:
        raise InputError("run: the front door 'spam' is not in PATH; install SPAM's problems, or name the "
                         "folder of their programs in SPAM_PROBLEMS")
    return [str(door), "run", problem]


def _arguments(options):
    arguments = []
    for key, value in options.items():
        flag = "--" + key.replace("_", "-")
        if value is True:
            arguments.append(flag)
        elif value is None or value is False:
            continue
        elif isinstance(value, (str, os.PathLike)):
            arguments += [flag, os.fspath(value)]
        elif isinstance(value, (list, tuple)):
            arguments += [flag, ",".join(str(one) for one in value)]
        else:
            arguments += [flag, repr(float(value)) if isinstance(value, float) else str(value)]
    return arguments


def _ends(problem, status, text):
    """Raises what an exit status means; says nothing of 0 and 1, whose results are complete."""
    if status in (0, 1):
        return
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    line = one_line(lines[-1] if lines else f"{problem} ended with status {status}", 400)
    if status == 2:
        raise InputError(line)
    if status == 3:
        raise GuardStop(line)
    if status == 4:
        raise OutputError(line)
    if status == 5:
        raise SetUpError(line)
    if status in (129, 130, 143, -signal.SIGHUP, -signal.SIGINT, -signal.SIGTERM):
        raise KeyboardInterrupt
    if status < 0:
        line = f"{problem} was ended by signal {-status} ({signal.Signals(-status).name})"
    raise RuntimeError(line)


def run(problem, *, out=None, quiet=True, **options):
    """Runs a problem and returns its Results.

    Options are those of its program, with `_` for `-`: run("rotating_hexagon", size=16,
    transport="monaghan", out="here", force=True). True stands for a flag; False and None for an option that is
    not given. `out`: the folder (default <problem>-out). `quiet=False` lets it print.

    Results whose checks do not hold are returned too: `results.holds` is False. Raises InputError (wrong input,
    nothing is run), GuardStop (a numerical guard stopped it), OutputError (results could not be written),
    SetUpError (it could not be built), KeyboardInterrupt. In all but the first and the fourth what was
    computed so far can be had by read(out).
    """
    if not re.fullmatch(r"[a-z][a-z0-9_]*", str(problem)):
        raise InputError(f"run: '{one_line(problem)}' is no name of a problem, e.g. rotating_hexagon")
    out = pathlib.Path(out if out is not None else f"{problem}-out")
    command = _command(problem) + _arguments(options) + ["--out", str(out)]
    if quiet:
        command.append("--quiet")
    try:
        child = subprocess.Popen(command, stdin=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                 stdout=subprocess.DEVNULL if quiet else None, text=True,
                                 errors="replace")
    except OSError as error:
        raise InputError(f"run: {one_line(command[0])} cannot be started ({error.strerror})") from None
    with child:
        try:
            _, text = child.communicate()
        except KeyboardInterrupt:
            child.wait()  # it got the signal as well, and completes its results
            raise
    _ends(problem, child.returncode, text)
    return read(out)
