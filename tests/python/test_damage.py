# SPDX-License-Identifier: GPL-3.0-or-later
"""Folders and files that are not as they should be: one line of ValueError, or numbers; nothing else."""
import os
import random
import shutil
import unittest
import importlib.util

import numpy as np
import spam_mechanics as spam
from results_of import hexagon, work


def look(folder):
    """Everything that can be asked for."""
    results = spam.read(folder)
    results.case
    for case in results.cases.values():
        case.drifts
        for snapshot in case.snapshots:
            for name in snapshot.names:
                snapshot[name]
            snapshot.elements, snapshot.element_fields
    if importlib.util.find_spec("h5py") and list(results.folder.glob("*.h5")):
        results.checkpoint()


class Damage(unittest.TestCase):
    def refuses(self, folder, word, what=look):
        with self.assertRaisesRegex(ValueError, word) as caught:
            what(folder)
        self.assertIsInstance(caught.exception, spam.InputError)
        self.assertNotIn("\n", str(caught.exception))
        self.assertLess(len(str(caught.exception)), 400)

    def copy(self, name="damaged"):
        source = hexagon().folder
        target = work(name)
        shutil.rmtree(target, ignore_errors=True)
        shutil.copytree(source, target)
        return target

    def change(self, inside, text, by, word, count=1):
        folder = self.copy()
        file = folder / inside
        data = file.read_bytes()
        self.assertIn(text, data)
        file.write_bytes(data.replace(text, by, count))
        self.refuses(folder, word)

    def test_folders(self):
        hexagon()
        empty, foreign = work("empty"), work("foreign")
        empty.mkdir(exist_ok=True)
        foreign.mkdir(exist_ok=True)
        (foreign / "letter.txt").write_text("Dear")
        self.refuses(work("nowhere"), "no such folder")
        self.refuses(empty, "is empty")
        self.refuses(foreign, "no result folder of spam")
        self.refuses(foreign / "letter.txt", "is no folder")
        self.refuses(work("new\nline"), "no such folder")
        if os.getuid() != 0:
            empty.chmod(0)
            self.refuses(empty, "cannot be read")

    def test_an_unfinished_run_is_read(self):
        folder = self.copy()
        (folder / "result.json").unlink()
        (folder / "plain/statistics.json").unlink()
        rows = folder / "plain/invariants.csv"
        rows.write_bytes(rows.read_bytes()[:-7])
        results = spam.read(folder)
        self.assertFalse(results.complete or results.holds)
        self.assertEqual(len(results["plain"].invariants) + 1, len(results["md"].invariants))
        look(folder)

    def test_half_written_and_newer_files(self):
        self.change("result.json", b"]", b"", "no JSON")
        self.change("result.json", b'"value"', b'"walue"', "no list of checks")
        self.change("plain/statistics.json", b"{", b"", "no JSON")
        self.change("case.toml", b"size = 3", b"size = = 3", "no TOML")
        self.change("plain/invariants.csv", b"0,0,37", b"0,0,thirty-seven", "line 2: column mass")
        self.change("plain/invariants.csv", b"0,0,37", b"0,0,37,1", "line 2: 12 columns")
        self.change("plain/invariants.csv", b"t,dt", b"dt,t", "line 1")
        self.change("plain/snapshots.pvd", b"</VTKFile>", b"", "no list of snapshots")
        self.change("plain/snapshots.pvd", b'version="1.0"', b'version="3.1"', "format 3.1", 2)
        self.change("plain/snapshots.pvd", b'"snapshot_0001', b'"../../etc/x', "no snapshot beside")
        self.change("plain/snapshot_0001.vtp", b' version="1.0"', b' version="2.0"', "format 2.0", 2)
        self.change("plain/snapshot_0001.vtp", b"</VTKFile>", b"", "ends too early")
        self.change("plain/snapshot_0001.vtp", b"TimeValue", b"Time", "no TimeValue")
        self.change("plain/snapshot_0001.vtp", b'Points="37"', b'Points="36"', "has 296 bytes")

    def test_what_is_no_file_is_not_opened(self):
        for inside in ("result.json", "case.toml", "plain/statistics.json", "plain/invariants.csv",
                       "plain/snapshots.pvd", "plain/snapshot_0001.vtp"):
            folder = self.copy()
            (folder / inside).unlink()
            os.mkfifo(folder / inside)
            self.refuses(folder, "no regular file")

    @unittest.skipUnless(importlib.util.find_spec("h5py"), "h5py is not installed")
    def test_checkpoints(self):
        folder = self.copy()
        for file in folder.glob("*.h5"):
            data = file.read_bytes()
            for text, word in [(data[:-1], "no checkpoint of spam"), (b"", "no checkpoint of spam"),
                               (data[: len(data) // 2] + b"?" + data[len(data) // 2 + 1 :], "SHA-256"),
                               (data[:-48] + b"\x02" + data[-47:], "format 2")]:
                file.write_bytes(text)
                self.refuses(folder, word, lambda f: spam.read(f).checkpoint(file.name))

    def test_hundred_mutations_of_a_snapshot(self):
        source = hexagon()["plain"].folder / "snapshot_0001.vtp"
        data, refused = source.read_bytes(), 0
        file = work("mutant.vtp")
        draw = random.Random(20040116)
        head = data.index(b"_", data.index(b"<AppendedData"))
        for turn in range(100):
            mutant = bytearray(data)
            at = draw.randrange(head if turn % 4 else len(data))
            how = draw.randrange(4)
            if how == 0:
                mutant[at] = draw.randrange(256)
            elif how == 1:
                del mutant[at : at + draw.randrange(1, 40)]
            elif how == 2:
                mutant[at:at] = bytes(draw.randrange(256) for _ in range(draw.randrange(1, 9)))
            else:
                del mutant[at:]
            file.write_bytes(mutant)
            with self.subTest(turn=turn), np.errstate(all="ignore"):
                try:
                    snapshot = spam.Snapshot(file, 2)
                    for name in snapshot.names:
                        snapshot[name]
                    snapshot.elements, snapshot.element_fields
                except ValueError as error:
                    self.assertIsInstance(error, spam.InputError)
                    self.assertNotIn("\n", str(error))
                    refused += 1
        self.assertGreater(refused, 50)
