# SPDX-License-Identifier: GPL-3.0-or-later
"""The list of numbers: documents agree with it, every decimal number is in it, and what is wrong is named."""
import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TOOL = ROOT / "src" / "numbers" / "numbers.py"
sys.path.insert(0, str(TOOL.parent))
import catalogue  # noqa: E402
import documents  # noqa: E402

PYTHON = [sys.executable, "-S"]  # without the packages of the site, of which none is used; it starts in half of the time

# Stands for a problem: says its version, or leaves results and counts how often it was run.
PROGRAM = '''#!{python} -S
import json, pathlib, sys
here = pathlib.Path(__file__).parent
if "--version" in sys.argv:
    print((here / "version").read_text())
    sys.exit()
out = pathlib.Path(sys.argv[sys.argv.index("--out") + 1])
out.mkdir(parents=True)
(here / "calls").open("a").write("x")
(out / "result.json").write_text((here / "result").read_text())
(out / "invariants.csv").write_text("t,shape_error\\n0,0\\n1,0.25\\n2,0.125\\n")
if "--fail" in sys.argv:
    print("fall: the ground is missing", file=sys.stderr)
    sys.exit(3)
'''

LIST = '''[documents."README.md"]
constants = ["version 1.5"]

[runs.fall]
command = "fall --height 2"
seconds = 1
quick = true

[places.time]
document = "README.md"
text = "takes {time} s, of which {share} % in the air"
run = "fall"
time = {value = "0.639", name = "time", tolerance = 0.0005}
share = {value = "12", name = "share", scale = 100, tolerance = 0.5}

[places.drift]
document = "README.md"
text = "drifts by {drift}"
run = "fall"
drift = {value = "2e-13", name = "drift", within = 10}
'''

README = "# Fall\n\nWith version 1.5 it takes\n0.639 s, of which 12 % in the air, and drifts by 2e-13.\n"


class Tree(unittest.TestCase):
    """A small repository with one problem, one document and a list."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = Path(self.folder.name)
        self.addCleanup(self.folder.cleanup)
        self.list = self.root / "src" / "numbers" / "numbers.toml"
        self.list.parent.mkdir(parents=True)
        self.readme = self.root / "README.md"
        self.programs = self.root / "programs"
        self.programs.mkdir()
        (self.root / "problems").mkdir()
        (self.root / "problems" / "fall.cpp").touch()
        (self.programs / "fall").write_text(PROGRAM.format(python=sys.executable))
        (self.programs / "fall").chmod(0o755)
        (self.programs / "version").write_text("fall: spam 0.1.0, commit 123")
        self.results(time=0.6389, share=0.1204, drift=4e-13)
        self.list.write_text(LIST)
        self.readme.write_text(README)

    def results(self, **values):
        checks = [{"name": name, "value": value} for name, value in values.items()]
        (self.programs / "result").write_text(json.dumps(checks))

    def calls(self):
        file = self.programs / "calls"
        return len(file.read_text()) if file.exists() else 0

    def numbers(self, *options):
        done = subprocess.run([*PYTHON, TOOL, "--root", self.root, "--programs", self.programs, *options],
                              capture_output=True, text=True, check=False)
        return done.returncode, done.stdout, done.stderr

    def refused(self, old, new, *words):
        """With this change of the list: one line that holds the words, and exit status 2."""
        self.assertIn(old, LIST)
        self.list.write_text(LIST.replace(old, new))
        status, out, err = self.numbers()
        self.assertEqual((status, out), (2, ""), err)
        self.assertEqual(err.count("\n"), 1, err)
        for word in words:
            self.assertIn(word, err)

    def test_a_tree_that_agrees(self):
        status, out, err = self.numbers("--check", "--quick")
        self.assertEqual(status, 0, out + err)
        self.assertIn("3 in 1 documents, 3 compared with runs", out)

    def test_a_changed_digit_is_named(self):
        for old, new, key in (("0.639", "0.629", "time.time"), ("12 %", "13 %", "time.share"),
                              ("2e-13", "3e-13", "drift.drift")):
            for option in ("--quick", "--no-runs"):
                self.readme.write_text(README.replace(old, new))
                status, out, _ = self.numbers(option)
                self.assertEqual(status, 1)
                self.assertRegex(out, rf"README.md:4: {key}: found {new.split()[0]}, expected {old.split()[0]}.*tolerance")

    def test_a_run_that_gives_something_else(self):
        self.results(time=0.65, share=0.1204, drift=4e-13)
        status, out, _ = self.numbers()
        self.assertEqual(status, 1)
        self.assertIn("README.md:4: time.time: found 0.639, expected 0.65, tolerance 0.0005 (./spam run fall", out)
        self.assertEqual(self.numbers("--write")[0], 0)
        self.assertEqual(self.readme.read_text(), README.replace("0.639", "0.650"))
        self.assertEqual(self.list.read_text(), LIST.replace("0.639", "0.650"))
        self.assertEqual(self.numbers()[0], 0)

    def test_what_agrees_is_not_written_anew(self):
        self.assertEqual(self.numbers("--write")[0], 0)
        self.assertEqual((self.readme.read_text(), self.list.read_text()), (README, LIST))
        self.readme.write_text(README.replace("12 %", "13 %"))
        self.assertEqual(self.numbers("--write", "--no-runs")[0], 0)
        self.assertEqual(self.readme.read_text(), README)

    def test_runs_are_kept_by_case_and_version(self):
        self.numbers()
        self.numbers()
        self.assertEqual(self.calls(), 1)
        (self.programs / "version").write_text("fall: spam 0.1.0, commit 124")
        self.numbers()
        self.assertEqual(self.calls(), 2)
        self.list.write_text(LIST.replace("--height 2", "--height 3"))
        self.numbers()
        self.assertEqual(self.calls(), 3)
        self.numbers("--no-runs")
        self.list.write_text(LIST.replace("quick = true", "quick = false").replace("--height 2", "--height 4"))
        self.assertIn("none wrong", self.numbers("--quick")[1])
        self.assertEqual(self.calls(), 3)

    def test_a_number_that_nothing_covers(self):
        self.readme.write_text(README + "\nThe ball bounces 0.55 m high (`--bounce 0.55`).\n")
        status, out, _ = self.numbers()
        self.assertEqual(status, 1)
        self.assertIn("README.md:6: 0.55 is neither", out)
        self.assertEqual(out.count("neither"), 1)

    def test_a_document_with_numbers_that_are_known_to_be_open(self):
        self.readme.write_text(README + "\nThe ball bounces 0.55 m and 0.45 m high.\n")
        listed = LIST.replace('constants = ["version 1.5"]', 'constants = ["version 1.5"]\nopen = {}')
        for known, status in ((1, 1), (2, 0), (3, 0)):
            self.list.write_text(listed.replace("{}", str(known), 1))
            self.assertEqual(self.numbers("--no-runs")[0], status)

    def test_a_constant_that_is_gone(self):
        self.readme.write_text(README.replace("version 1.5", "any version"))
        status, out, _ = self.numbers("--no-runs")
        self.assertEqual(status, 1)
        self.assertIn("README.md: the constant 'version 1.5' of the list is not there any more", out)

    def test_a_text_that_is_gone(self):
        self.readme.write_text(README.replace("in the air", "in air"))
        status, out, _ = self.numbers("--no-runs")
        self.assertEqual(status, 1)
        self.assertIn("README.md:4: time: found 'air, and drifts', expected 'the air'", out)
        self.assertNotIn("neither", out)
        self.readme.write_text(README + README)
        self.assertIn("README.md: time: the text of the list is there 2 times", self.numbers("--no-runs")[1])

    def test_wrong_entries(self):
        self.refused('"fall --height 2"', '"fal --height 2"', "no problem 'fal'; did you mean fall?")
        self.refused('document = "README.md"\ntext = "takes', 'document = "READ.md"\ntext = "takes', "READ.md")
        self.refused('run = "fall"\ntime', 'run = "fell"\ntime', "places.time.time", "no run 'fell'")
        self.refused('name = "time"', 'name = "times"', "has no 'times'; did you mean time?")
        self.refused('name = "time"', 'name = "t", file = "invariant.csv"', "did you mean invariants.csv?")
        self.refused('name = "time"', 'name = "shape", file = "invariants.csv"', "no column 'shape'")
        self.refused(', within = 10', '', "'tolerance' (a difference)")
        self.refused("seconds = 1", "second = 1", "'seconds' is missing")
        self.refused("scale = 100", "scael = 100", "unknown key 'scael'; did you mean scale?")
        self.refused('"2e-13"', '"two"', "not 'two'")
        self.refused("{drift}", "{drifts}", "places.drift")
        self.refused("[places.drift]", "[places.drift", "line")
        self.list.unlink()
        status, _, err = self.numbers()
        self.assertEqual((status, err.count("\n")), (2, 1))
        self.assertIn("src/numbers: no list of numbers", err)
        status, _, err = self.numbers("--only", "fell")
        self.assertEqual((status, err.count("\n")), (2, 1))

    def test_a_list_in_several_files(self):
        runs, places = LIST.split("[places.time]")
        self.list.write_text(runs)
        other = self.list.with_name("falls.toml")
        other.write_text("[places.time]" + places)
        self.assertEqual(self.numbers("--no-runs")[0], 0)
        self.results(time=0.65, share=0.1204, drift=4e-13)
        self.assertEqual(self.numbers("--write")[0], 0)
        self.assertEqual((self.list.read_text(), other.read_text()),
                         (runs, "[places.time]" + places.replace("0.639", "0.650")))
        twice = places + '\n[runs.fall]\ncommand = "fall"\nseconds = 1\n'
        for text, message in ((places.replace('"share"', '"chair"'), "no 'chair'; did you mean share?"),
                              (twice, "numbers.toml: runs.fall is in falls.toml already")):
            other.write_text("[places.time]" + text)
            status, _, err = self.numbers()
            self.assertEqual((status, err.count("\n")), (2, 1), err)
            self.assertIn("src/numbers/", err)
            self.assertIn(message, err)

    def test_programs_that_fail(self):
        self.list.write_text(LIST.replace("--height 2", "--fail"))
        status, _, err = self.numbers()
        self.assertEqual((status, err.count("\n")), (3, 1))
        self.assertIn("the ground is missing", err)
        (self.programs / "fall").unlink()
        status, _, err = self.numbers()
        self.assertEqual((status, err.count("\n")), (5, 1))

    def of_row(self, row, value):
        """What the tool says of a number in this row."""
        entry = f'time = {{value = "{value}", name = "shape_error", file = "invariants.csv", row = "{row}", ' \
                'tolerance = 1e-9}'
        self.list.write_text(re.sub("time = {.*", entry, LIST))
        self.readme.write_text(README.replace("0.639", value))
        return self.numbers()

    def test_rows_of_a_table(self):
        for row, value in (("first", "0"), ("last", "0.125"), ("largest", "0.250"), ("t = 1", "0.250"),
                           ("largest, t != 1", "0.125"), ("t != 2, smallest, t != 0", "0.250")):
            self.assertEqual(self.of_row(row, value)[0], 0, row)
        for row, message in (("middle", "'row' must be first"), ("t = 7", "no row with t = 7"),
                             ("time = 1", "no column 'time'")):
            status, _, err = self.of_row(row, "0.250")
            self.assertEqual((status, err.count("\n")), (2, 1))
            self.assertIn(message, err)

    def test_a_run_that_is_meant_to_stop(self):
        (self.programs / "fall").write_text((self.programs / "fall").read_text() + "sys.exit(3)\n")
        self.assertEqual(self.numbers()[0], 3)
        self.list.write_text(LIST.replace("seconds = 1", "seconds = 1\nstatus = 3"))
        self.assertEqual(self.numbers()[0], 0)


class Committed(unittest.TestCase):
    """The repository as it is, without a run."""

    def test_documents_agree_with_the_list(self):
        done = subprocess.run([*PYTHON, TOOL, "--check", "--no-runs"], capture_output=True, text=True,
                              check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_quick_runs_take_less_than_a_minute(self):
        listed = catalogue.read(ROOT / "src" / "numbers", ROOT)
        self.assertLess(sum(run.seconds for run in listed.runs.values() if run.quick), 60)
        for run in listed.runs.values():
            self.assertTrue(any(number.run == run for number in listed.numbers()), f"nothing comes from {run.name}")

    def test_readme_is_covered(self):
        listed = catalogue.read(ROOT / "src" / "numbers", ROOT)
        self.assertIn("README.md", [document.name for document in listed.documents])

    def test_any_digit_of_any_number_counts(self):
        listed = catalogue.read(ROOT / "src" / "numbers", ROOT)
        for place in listed.places:
            match, _ = documents.find(place, (ROOT / place.document).read_text(encoding="utf-8"))
            for name, number in place.numbers.items():
                self.assertEqual(match[name], number.value)


class Shapes(unittest.TestCase):
    def test_numbers_keep_the_shape_that_they_had(self):
        for sample, value, written in (("0.612", 0.61179, "0.612"), ("5e-13", 4.2e-13, "4e-13"),
                                       ("3,169", 1234567.0, "1,234,567"), ("39", 38.7, "39"),
                                       ("1.6e-10", 1.24e-9, "1.2e-9"), ("-5.0e-12", -5.1e-11, "-5.1e-11")):
            self.assertEqual(catalogue.in_shape_of(sample, value), written)

    def test_what_counts_as_a_number(self):
        text = "at 0.5, 1e-6 and -2.5e-3; not 7, v1.2.3, 2.1.3, `0.7`, $0.8$, a/0.9 or\n\n    code 0.1\n"
        self.assertEqual([number for _, number in documents.uncovered(text, [], [])], ["0.5", "1e-6", "-2.5e-3"])


if __name__ == "__main__":
    unittest.main()
