# SPDX-License-Identifier: GPL-3.0-or-later
"""The pages of documentation: they build without a warning, links lead somewhere, nothing is fetched from elsewhere,
examples are those that tests compile, and members without docstring are named."""
import contextlib
import io
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "src" / "docs"
sys.path.insert(0, str(DOCS))
import build  # noqa: E402
import links  # noqa: E402
import members  # noqa: E402
import pages  # noqa: E402
import python_names  # noqa: E402

# The distribution's own, which has the modules that the distribution installs.
PYTHON = "/usr/bin/python3"


def run(*words, **more):
    return subprocess.run([PYTHON, "-B", DOCS / "build.py", *words], capture_output=True, text=True, check=False, **more)


class InFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)


class Site(InFolder):
    def test_the_pages_build_without_a_complaint(self):
        if not Path(PYTHON).exists():
            self.skipTest("there is no " + PYTHON)
        done = run("--out", self.folder)
        if done.returncode == 5:
            self.skipTest(done.stderr.strip())
        self.assertEqual(done.returncode, 0, done.stderr)
        for page in ("start", "install", "equations", "schemes", "limits", "methods", "results", "view", "recipes", "gallery",
                     "problems", "vectors", "numbers", "reference", "python"):
            self.assertTrue((self.folder / "html" / f"{page}.html").is_file(), page)
        equations = (self.folder / "html" / "equations.html").read_text(encoding="utf-8")
        self.assertIn("_static/mathjax/MathJax.js", equations)
        self.assertTrue((self.folder / "html" / "_static" / "mathjax" / "MathJax.js").is_file())
        self.assertIn(r"\dot\sigma", equations)

    def test_a_missing_tool_is_one_line(self):
        if not Path(PYTHON).exists():
            self.skipTest("there is no " + PYTHON)
        done = run("--out", self.folder, env={**os.environ, "PATH": str(self.folder)})
        self.assertEqual((done.returncode, done.stderr), (5, "spam: docs: there is no doxygen; install doxygen\n"))


class Reference(InFolder):
    def test_every_public_member_has_a_docstring(self):
        if not shutil.which("doxygen"):
            self.skipTest("there is no doxygen; install doxygen")
        self.assertEqual(build.doxygen(self.folder), [])
        reference = (DOCS / "reference.md").read_text(encoding="utf-8")
        self.assertGreaterEqual(len(re.findall(r"doxygen(?:class|struct)}", reference)), 15)
        self.assertEqual(members.undocumented(self.folder / "xml", reference), [])

    def test_a_member_without_docstring_is_named(self):
        if not shutil.which("doxygen"):
            self.skipTest("there is no doxygen; install doxygen")
        (self.folder / "box.hpp").write_text("namespace spam {\n/// A box.\nclass Box {\n  public:\n    /// Its length.\n"
                                             "    double length();\n    double width();\n};\n}\n")
        settings = (f"INPUT = {self.folder}\nOUTPUT_DIRECTORY = {self.folder}\nGENERATE_XML = YES\nGENERATE_HTML = NO\n"
                    "GENERATE_LATEX = NO\nQUIET = YES\nWARNINGS = NO\n")
        subprocess.run(["doxygen", "-"], input=settings, capture_output=True, text=True, check=True)
        reference = "```{doxygenclass} spam::Box\n```\n```{doxygenclass} spam::Ball\n```\n"
        complaints = members.undocumented(self.folder / "xml", reference)
        self.assertEqual(len(complaints), 2, complaints)
        self.assertIn("Box::width has no docstring", complaints[0])
        self.assertIn("no class Ball", complaints[1])


class Links(InFolder):
    def test_links_that_lead_nowhere_and_pages_that_fetch(self):
        (self.folder / "a.html").write_text('<h1 id="top">A</h1><a href="b.html#here">b</a><a href="#top">up</a>'
                                            '<a href="https://example.org">elsewhere</a><img src="a.html">')
        (self.folder / "b.html").write_text('<p id="here">B</p><a href="c.html">c</a><a href="a.html#bottom">a</a>'
                                            '<script src="https://example.org/x.js"></script>')
        self.assertEqual(links.broken(self.folder),
                         ["b.html: fetches https://example.org/x.js", "b.html: c.html leads nowhere",
                          "b.html: a.html#bottom: no such place in a.html"])

    def test_style_sheets_and_programs_that_a_file_cannot_have(self):
        (self.folder / "a.html").write_text('<link rel="stylesheet" href="a.css"><script src="a.js"></script>'
                                            '<link rel="stylesheet" href="b.css"><script src="b.js"></script>')
        (self.folder / "a.css").write_text("@import url(/javascript/c.css); p { background: url('none.png') }")
        (self.folder / "a.js").write_text('import C from "./c.js";\nC();\n')
        (self.folder / "b.css").write_text("p { background: url(b.js); cursor: url('data:image/png;base64,') }")
        (self.folder / "b.js").write_text("const important = 1;\n")
        self.assertEqual(links.broken(self.folder),
                         ["a.css: /javascript/c.css is a path of a server", "a.css: none.png leads nowhere",
                          "a.js: is a module, which no browser runs in a page that is opened as a file"])

    def test_the_theme_is_completed_by_what_it_asks_for(self):
        colours = "{ --color-background-primary: #111; }"
        sheet = 'body[data-theme="dark"] .icon { } body[data-theme="dark"] ' + colours + "\n"
        for name, content in (("styles/furo.css", "@import url(/javascript/n/n.css);\n" + sheet), ("n/n.css", "q {}\n"),
                              ("scripts/furo.js", 'import G from "./g.js";\nG();\n'), ("scripts/g.js", "window.G = 1;\n")):
            (self.folder / name).parent.mkdir(exist_ok=True)
            (self.folder / name).write_text(content)
        build.complete_theme(self.folder, shared=self.folder)
        dark = f'@media screen and (prefers-color-scheme: dark) {{ body:not([data-theme="light"]) {colours} }}\n'
        self.assertEqual((self.folder / "styles/furo.css").read_text(), "q {}\n\n" + sheet + dark)
        self.assertEqual((self.folder / "scripts/furo.js").read_text(), "window.G = 1;\n\nG();\n")


class PythonNames(InFolder):
    """What the page of the Python package is made from, in a small package of its own."""

    def setUp(self):
        super().setUp()
        package = self.folder / python_names.PACKAGE
        package.mkdir(parents=True)
        (package / "__init__.pyi").write_text(
            "_Array = NDArray\n\nclass Gas:\n    cold: bool\n    def __init__(self, a: float = 1.0) -> None: ...\n"
            "    @property\n    def t(self) -> _Array: ...\n    @staticmethod\n    def of(x: _Array) -> Gas: ...\n"
            "# --- other things ---\ndef find(n: int, *, out: str = 'a') -> Gas: ...\ndef lost() -> None: ...\n")
        (package / "gas.py").write_text('def find(n, *, out):\n    """Finds a_gas.\n\n    n    how many,\n'
                                        '         at least\n    out  where\n    """\n')
        (package.parent / "gas.cpp").write_text(
            'py::class_<Gas, std::shared_ptr<Gas>>(module, "Gas", "A \\"gas\\"; "\n    "*cold*.")\n'
            '    .def(py::init([](double a) { return f(a, "no, docstring"); }), "a"_a = 1.0)\n'
            '    .def_property_readonly("t", [](const Gas& g) { return g.t(\')\'); }, "When.")\n'
            '    .def_static("of", &of, "x"_a, "Made of x.");\n')

    def test_the_page_has_arguments_and_docstrings(self):
        text, _ = python_names.page(self.folder)
        for part in ("::::{py:class} Gas(a: float=1.0)\n\nA \"gas\"; \\*cold\\*\\.\n", ":::{py:attribute} cold\n:type: bool\n",
                     ":::{py:property} t\n:type: Array\n\nWhen\\.\n", ":::{py:method} of(x: Array) -> Gas\n:staticmethod:\n",
                     "Made of x\\.", "## Other things\n\n:::{py:function} find(n: int, *, out: str='a') -> Gas\n",
                     "Finds a\\_gas\\.\n\n- `n`: how many, at least\n- `out`: where\n", "Array = NDArray"):
            self.assertIn(part, text)
        self.assertNotIn("no, docstring", text)

    def test_a_name_without_docstring_is_named(self):
        self.assertEqual(python_names.page(self.folder)[1],
                         ["src/python/spam_mechanics/__init__.pyi:12: lost has no docstring"])

    def test_the_package_has_all_of_them(self):
        text, complaints = python_names.page(ROOT)
        self.assertEqual(complaints, [])
        for name in ("Simulation", "SmoothParticles", "Scheme", "integrate", "read"):
            self.assertRegex(text, r"\{py:\w+\} " + name + r"\b")
        self.assertGreater(text.count("{py:"), 100)


class Players(InFolder):
    def make(self, spam):
        (self.folder / "spam").write_text("#!/bin/sh\n" + spam)
        (self.folder / "spam").chmod(0o755)
        with contextlib.redirect_stdout(io.StringIO()):
            return pages.make_players(self.folder, self.folder / "out")

    def test_a_page_of_every_run_also_of_one_whose_checks_do_not_hold(self):
        players = self.make('test $1 = run && mkdir -p "$4" && exit 1\ntest -d "$2" && echo "plays $2" >"$4"\n')
        self.assertEqual(sorted(players), sorted(pages.PLAYERS))
        for name, player in players.items():
            self.assertEqual(player.read_text(), f"plays {self.folder}/out/runs/{name}\n")
            self.assertTrue((ROOT / "problems" / f"{name}.cpp").is_file())
            self.assertIn("players/" + name, pages.problem(pages.Writer(ROOT, DOCS, self.folder), name, players))

    def test_what_a_run_could_not_do_ends_it(self):
        with self.assertRaises(SystemExit) as end:
            self.make("exit 3\n")
        self.assertEqual(end.exception.code, 3)


class Pages(InFolder):
    def test_links_follow_their_text(self):
        writer = pages.Writer(ROOT, DOCS, self.folder)
        text = "[a](../README.md#limits), [b](README.md#options), [c](../LICENSE), [d](https://example.org), " \
               "[e](../include), `[f](g)` in\n```cpp\n[&](x)\n```\n[g/README.md](README.md)"
        self.assertEqual(writer.relinked(text, ROOT / "problems"),
                         "[a](start.md#limits), [b](problems.md#options), [c](files/LICENSE.txt), "
                         "[d](https://example.org), e, `[f](g)` in\n```cpp\n[&](x)\n```\n"
                         "[*The problems*](problems.md)")
        self.assertTrue((self.folder / "files" / "LICENSE.txt").is_file())

    def test_the_gallery_has_every_problem_once_with_a_picture(self):
        text = (DOCS / "gallery.md").read_text(encoding="utf-8")
        shown = re.findall(r"### (\w+)\n\n<!-- problem (\w+) -->\n\n!\[[^\]]+]\((\S+)\)\n", text)
        self.assertEqual([heading for heading, _, _ in shown], [name for _, name, _ in shown])
        self.assertEqual(sorted(name for _, name, _ in shown),
                         sorted(file.stem for file in (ROOT / "problems").glob("*.cpp")))
        for _, name, picture in shown:
            self.assertTrue((DOCS / picture).is_file(), name)

    def test_examples_are_those_that_tests_compile(self):
        recipes = (DOCS / "recipes.md").read_text(encoding="utf-8")
        compiled = (ROOT / "tests" / "tests.cmake").read_text(encoding="utf-8")
        included = re.findall(r"literalinclude} (\S+)\.cpp", recipes)
        self.assertEqual(included, re.findall(r"\[The file]\(\.\./\.\./tests/(\S+)\.cpp\)", recipes))
        self.assertGreaterEqual(len(included), 5)
        for example in included:
            self.assertTrue((ROOT / "tests" / f"{example}.cpp").is_file(), example)
            self.assertIn(f"spam_test({example} ", compiled)
        for page in DOCS.glob("*.md"):  # scripts of Python are run by tests/python/test_readme.py
            languages = re.findall(r"(?m)^```(.*)$", page.read_text(encoding="utf-8"))[::2]
            self.assertEqual([one for one in languages if one != "python" and not one.startswith("{")], [], page)


if __name__ == "__main__":
    tests = unittest.main(exit=False).result
    if tests.wasSuccessful() and tests.skipped:
        print("skipped: " + "; ".join(sorted({why for _, why in tests.skipped})))
    sys.exit(not tests.wasSuccessful())
