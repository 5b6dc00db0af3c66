# SPDX-License-Identifier: GPL-3.0-or-later
"""Pages in Markdown for Sphinx, from those of this folder and from the documents of the repository."""
import re
import shutil
import subprocess
import sys
from pathlib import Path

import python_names

# Documents that are pages as they are.
WHOLE = {"README.md": "start.md", "problems/README.md": "problems.md", "problems/material_vectors.md": "vectors.md",
         "src/integrate/README.md": "methods.md", "tests/bench/README.md": "bench.md", "src/README.md": "code.md",
         ".github/CONTRIBUTING.md": "contributing.md", "CHANGELOG.md": "changes.md"}


def title_of(document):
    """The words of its first heading."""
    return re.search(r"(?m)^# (.*)$", document.read_text(encoding="utf-8"))[1]


class Writer:
    """Writes pages into `source`; links are those of the place that a text comes from."""

    def __init__(self, root, here, source):
        self.root, self.source = root, source
        self.pages = {(root / name).resolve(): page for name, page in WHOLE.items()}
        self.pages |= {file.resolve(): file.name for file in here.glob("*.md")}

    def target(self, link, folder):
        """Where a link of a text from `folder` leads on the pages; None: to nothing there."""
        if re.match(r"[a-z]+:|#|mailto:", link):
            return link
        path, _, anchor = link.partition("#")
        file = (folder / path).resolve()
        if file in self.pages:
            return self.pages[file] + (f"#{anchor}" if anchor else "")
        if not file.exists():
            raise SystemExit(f"spam: docs: a link leads nowhere: {link} in a text of {folder}")
        if not file.is_file() or not file.is_relative_to(self.root):
            return None
        copy = Path("files") / file.relative_to(self.root)
        if file.suffix not in (".png", ".svg"):
            copy = copy.with_name(copy.name + ".txt")
        (self.source / copy).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(file, self.source / copy)
        return str(copy)

    def relinked(self, text, folder):
        def relink(match):
            target, words = self.target(match[3], folder), match[2]
            if target is None:
                return words
            if words.endswith(".md"):  # a document by its name in the repository, which the pages do not have
                title = title_of(folder / match[3].partition("#")[0])
                words = f"*{title}*"
            return f"{match[1]}[{words}]({target})"

        parts = re.split(r"((?ms:^```.*?^```$)|`[^`\n]+`)", text)
        parts[::2] = [re.sub(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^)\s]+)\)", relink, part) for part in parts[::2]]
        return "".join(parts)

    def write(self, page, text):
        (self.source / page).write_text(text, encoding="utf-8")

    def page_of(self, file, generated):
        """A page of this folder, with what is generated."""
        text = self.relinked(file.read_text(encoding="utf-8"), file.parent)
        for pattern, make in generated.items():
            text = re.sub(pattern, lambda match, make=make: make(self, *match.groups()), text)
        return text


def problem(writer, name, players):
    """What a problem is, its command and its time: by the line `// spam-list:` of its source."""
    source = (writer.root / "problems" / f"{name}.cpp").read_text(encoding="utf-8")
    what, _, time = re.search(r"(?m)^// spam-list: *(.*)$", source)[1].rpartition("; ")
    play = f'\n\n<p><a href="players/{name}.html">Play it</a></p>' if name in players else ""
    return f"{what[:1].upper()}{what[1:]}. About {time}.\n\n```sh\n./spam run {name}\n```{play}"


def numbers(writer):
    tool = writer.root / "src" / "numbers" / "numbers.py"
    return subprocess.run([sys.executable, "-B", tool, "--list"], stdout=subprocess.PIPE, text=True, check=True).stdout


def write(root, here, source, players):
    """All pages, into the folder `source`."""
    source.mkdir(parents=True)
    (source / "_static").mkdir()
    (source / "_extra" / "players").mkdir(parents=True)
    for name, player in players.items():
        shutil.copyfile(player, source / "_extra" / "players" / f"{name}.html")
    writer = Writer(root, here, source)
    generated = {"<!-- problem (\\w+) -->": lambda w, name: problem(w, name, players), "<!-- numbers -->": numbers,
                 "<!-- python -->": lambda w: python_names.page(w.root)[0]}
    for file in here.glob("*.md"):
        writer.write(file.name, writer.page_of(file, generated))
    for name, page in WHOLE.items():
        document = root / name
        writer.write(page, writer.relinked(document.read_text(encoding="utf-8"), document.parent))
    for example in (root / "tests" / "extend").iterdir():  # for literalinclude
        (source / "extend").mkdir(exist_ok=True)
        shutil.copyfile(example, source / "extend" / example.name)


PLAYERS = ["rotating_hexagon", "colliding_rings", "fragmenting_bar", "taylor_green"]


def make_players(root, out):
    """Runs problems and makes a page of each that plays it. Returns the pages by problem."""
    players = {}
    shutil.rmtree(out / "runs", ignore_errors=True)
    for name in PLAYERS:
        print(f"spam: docs: ./spam run {name}, ./spam view", flush=True)
        results = out / "runs" / name
        for command in (["run", name, "--out", results, "--quiet", "--no-plots"],
                        ["view", results, "--out", out / "runs" / f"{name}.html"]):
            done = subprocess.run([root / "spam", *command], stdout=subprocess.DEVNULL, check=False)
            if done.returncode not in (0, 1):
                sys.exit(done.returncode)
        players[name] = out / "runs" / f"{name}.html"
    return players
