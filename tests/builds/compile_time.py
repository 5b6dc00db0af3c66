# SPDX-License-Identifier: GPL-3.0-or-later
"""No source takes more than 30 s of a quiet core to compile.

Judged is the source that took longest in the build, by ninja's log. Seconds on a busy machine are at least those of a
quiet one: where they are few enough, nothing is compiled again. Where they are not, processor time compared with that of a
source compiled beside it counts. A unit of several sources (SPAM_UNITY) is no source: its own limit is twice that."""
import json
import os
import re
import resource
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

BUILD = Path(sys.argv.pop(1)) if len(sys.argv) > 1 else Path("build/release")
MOST = 30.0
# Its processor time on a quiet core of the quicker kind (1.8 s on a slower one), so that noise fails no build.
REFERENCE, REFERENCE_SECONDS = "tests/support/main.cpp", 1.3


def commands():
    """Object file to (source, command), of what was compiled here."""
    known = {}
    for entry in json.loads((BUILD / "compile_commands.json").read_text(encoding="utf-8")):
        output = re.search(r" -o (\S+)", entry["command"])
        if output:
            known[output[1]] = (entry["file"], entry["command"])
    return known


def slowest(known):
    """The object file that took longest in the build, and its seconds."""
    took = {}
    for line in (BUILD / ".ninja_log").read_text(encoding="utf-8").splitlines():
        fields = line.split("\t")
        if len(fields) == 5 and fields[3] in known:
            took[fields[3]] = int(fields[1]) - int(fields[0])
    most = max(took, key=took.get)
    return most, took[most] / 1000.0


def processor_seconds(command, folder):
    """Of compiling once more, into a folder of its own."""
    command = re.sub(r" -o \S+", f" -o {folder}/object.o", command)
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run(command, shell=True, cwd=BUILD, check=True, capture_output=True)
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


class CompileTimes(unittest.TestCase):
    def test_no_source_takes_more_than_thirty_seconds(self):
        if not (BUILD / ".ninja_log").is_file():
            self.skipTest("skipped: not built by ninja")
        known = commands()
        reference = next(command for file, command in known.values() if file.endswith(REFERENCE))
        with tempfile.TemporaryDirectory() as folder:
            seconds = min(processor_seconds(reference, folder) for _ in range(2)) / REFERENCE_SECONDS
            slow, in_build = slowest(known)
            file, command = known[slow]
            most = 2.0 * MOST if "/Unity/" in file else MOST
            taken = in_build / seconds
            if taken >= most:
                taken = processor_seconds(command, folder) / seconds
            print(f"{os.path.relpath(file, BUILD)}: {taken:.1f} s of a quiet core, at most")
            self.assertLess(taken, most, file)


if __name__ == "__main__":
    unittest.main()
