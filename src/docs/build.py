# SPDX-License-Identifier: GPL-3.0-or-later
"""./spam docs: the pages of documentation, in build/docs/html."""
import argparse
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(HERE))
import links  # noqa: E402
import members  # noqa: E402
import pages  # noqa: E402
import python_names  # noqa: E402

MATHJAX = Path("/usr/share/javascript/mathjax")
# What formulas of these pages need of MathJax: a tenth of it.
PARTS = ["MathJax.js", "config/TeX-AMS_CHTML.js", "extensions", "jax/element", "jax/input/TeX", "jax/output/CommonHTML",
         "fonts/HTML-CSS/TeX/woff"]


class Missing(Exception):
    """A tool that is not there: one line, exit status 5."""


def look_for_tools():
    if not shutil.which("doxygen"):
        raise Missing("there is no doxygen; install doxygen")
    for module, package in (("sphinx", "python3-sphinx"), ("myst_parser", "python3-myst-parser"),
                            ("breathe", "python3-breathe"), ("furo", "furo")):
        done = subprocess.run([sys.executable, "-c", f"import {module}"], capture_output=True, check=False)
        if done.returncode != 0:
            raise Missing(f"{sys.executable} has no module {module}; install {package}")
    if not (MATHJAX / "MathJax.js").is_file():
        raise Missing(f"there is no {MATHJAX}; install libjs-mathjax")


def doxygen(out):
    """XML for Breathe and pages of all headers; returns warnings."""
    warnings = out / "doxygen.log"
    settings = (HERE / "Doxyfile").read_text(encoding="utf-8")
    settings += f"\nOUTPUT_DIRECTORY = {out}\nWARN_LOGFILE = {warnings}\n"
    subprocess.run(["doxygen", "-"], input=settings, text=True, cwd=ROOT, check=True)
    return sorted(set(warnings.read_text(encoding="utf-8").splitlines()))


def copy_mathjax(to):
    for part in PARTS:
        source, target = MATHJAX / part, to / part
        target.parent.mkdir(parents=True, exist_ok=True)
        if source.is_dir():
            shutil.copytree(source, target, dirs_exist_ok=True)
        else:
            shutil.copyfile(source, target)


def complete_theme(static, shared=Path("/usr/share/javascript")):
    """The theme of Debian names a style sheet by a path of its server, and its program is a module, which browsers do
    not run in pages that are opened as files: what each asks for is put into it. Where the system prefers dark pages the
    sheet has no colours but for code; those of the button for dark pages are given to such systems too."""
    sheet, program = static / "styles" / "furo.css", static / "scripts" / "furo.js"
    if sheet.is_file():
        text = re.sub(r"@import url\(/javascript/([^)]+)\);",
                      lambda match: (shared / match[1]).read_text(encoding="utf-8"), sheet.read_text(encoding="utf-8"))
        dark = re.search(r'body\[data-theme="dark"\] (\{[^}]*--color-background-primary:[^}]*\})', text)
        if dark and "prefers-color-scheme" not in text:
            text += f'@media screen and (prefers-color-scheme: dark) {{ body:not([data-theme="light"]) {dark[1]} }}\n'
        sheet.write_text(text, encoding="utf-8")
    if program.is_file():
        program.write_text(re.sub(r'(?m)^import \w+ from "\./([\w.-]+)";$',
                                  lambda match: (program.parent / match[1]).read_text(encoding="utf-8"),
                                  program.read_text(encoding="utf-8")), encoding="utf-8")


def version():
    done = subprocess.run([ROOT / "spam", "--version"], capture_output=True, text=True, check=False)
    return done.stdout.strip().removeprefix("spam ") if done.returncode == 0 else ""


def sphinx(source, out):
    """Pages; returns warnings."""
    environment = {**os.environ, "SPAM_DOXYGEN_XML": str(out / "xml"), "SPAM_VERSION": version()}
    done = subprocess.run([sys.executable, "-m", "sphinx", "-q", "--keep-going", "-b", "html", "-d", out / "doctrees",
                           source, out / "html"], env=environment, stderr=subprocess.PIPE, text=True, check=False)
    complaints = [line for line in done.stderr.splitlines() if line.strip()]
    return complaints or ([] if done.returncode == 0 else [f"sphinx ended with {done.returncode}"])


def main(argv):
    parser = argparse.ArgumentParser(prog="./spam docs", allow_abbrev=False,
                                     description="Builds the pages of documentation; build/docs/html/index.html is the "
                                                 "first. They ask for nothing from elsewhere.",
                                     epilog="Exit status: 0 done; 1 something is wrong in the pages; 5 a tool is missing.")
    parser.add_argument("--out", type=Path, default=ROOT / "build" / "docs", metavar="DIR",
                        help="in place of build/docs")
    parser.add_argument("--players", action="store_true",
                        help="runs four problems as well (./spam run, ./spam view) and puts their pages into the gallery")
    asked = parser.parse_args(argv)
    out = asked.out.resolve()
    try:
        look_for_tools()
    except Missing as missing:
        print(f"spam: docs: {missing}", file=sys.stderr)
        return 5
    for old in ("source", "html", "xml", "api", "doctrees"):
        shutil.rmtree(out / old, ignore_errors=True)
    out.mkdir(parents=True, exist_ok=True)

    wrong = doxygen(out)
    source = out / "source"
    players = pages.make_players(ROOT, out) if asked.players else {}
    pages.write(ROOT, HERE, source, players)
    shutil.copyfile(HERE / "conf.py", source / "conf.py")
    copy_mathjax(source / "_static" / "mathjax")
    wrong += members.undocumented(out / "xml", (HERE / "reference.md").read_text(encoding="utf-8"))
    wrong += python_names.page(ROOT)[1]
    wrong += sphinx(source, out)
    complete_theme(out / "html" / "_static")
    shutil.copytree(out / "api", out / "html" / "api")
    wrong += links.broken(out / "html")
    for line in wrong:
        print(line, file=sys.stderr)
    if wrong:
        print(f"spam: docs: {len(wrong)} lines of complaints above", file=sys.stderr)
        return 1
    print(f"spam: docs: {out / 'html' / 'index.html'}")
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except KeyboardInterrupt:
        sys.exit(130)
