# SPDX-License-Identifier: GPL-3.0-or-later
"""The list of numbers (the .toml files of this folder): what it may hold, and where it is wrong."""
import dataclasses
import difflib
import re
import shlex
import tomllib
from pathlib import Path


class ListError(Exception):
    """The list asks for what does not exist: one line, exit status 2."""


@dataclasses.dataclass(frozen=True)
class Run:
    """A command whose results hold numbers."""

    name: str
    problem: str
    options: list[str]
    seconds: float  # of one core, about
    quick: bool  # belongs to --quick
    status: int  # that it ends with, where it is meant to stop early

    def command(self):
        return shlex.join(["./spam", "run", self.problem, *self.options])


@dataclasses.dataclass(frozen=True)
class Number:
    """One number of a document, and where in the results of a run it comes from."""

    key: str
    value: str  # as it was written last
    run: Run
    file: str  # in the result folder
    name: str  # of a check, a key or a column
    row: str  # of a table: first, last, largest or smallest, of the rows where COLUMN = VALUE
    scale: float  # document = offset + scale * result
    offset: float
    tolerance: float  # in the document's units; or, where `ratio`, largest quotient
    ratio: bool
    source: Path  # the file of the list that it stands in

    def agrees(self, expected):
        """Whether what is written agrees with what a run has given, in the document's units."""
        written = to_number(self.value)
        if not self.ratio:
            return abs(written - expected) <= self.tolerance * (1 + 1e-9)
        return written == expected or written * expected > 0 and 1 / self.tolerance <= written / expected <= self.tolerance

    def allowed(self):
        return f"a factor of {self.tolerance:g}" if self.ratio else f"{self.tolerance:g}"


@dataclasses.dataclass(frozen=True)
class Place:
    """A piece of a document, `text`, in which {name} stands for a number."""

    key: str
    document: str
    text: str
    numbers: dict[str, Number]


@dataclasses.dataclass(frozen=True)
class Document:
    """A document of which every decimal number is in a place or in `constants`, but for `open` of them."""

    name: str
    constants: list[str]
    open: int


@dataclasses.dataclass(frozen=True)
class Catalogue:
    runs: dict[str, Run]
    places: list[Place]
    documents: list[Document]

    def numbers(self):
        return [number for place in self.places for number in place.numbers.values()]


def to_number(text):
    return float(text.replace(",", "").replace("\u2212", "-"))


def in_shape_of(sample, value):
    """`value` with the decimals, exponent and commas of `sample`: in_shape_of("5e-13", 4.2e-13) = "4e-13"."""
    digits = re.split("[eE]", sample)[0]
    decimals = len(digits.partition(".")[2])
    if "e" in sample:
        mantissa, exponent = f"{value:.{decimals}e}".split("e")
        padded = len(sample.split("e")[1].lstrip("+-")) == 2 and sample.split("e")[1].lstrip("+-")[0] == "0"
        return f"{mantissa}e{exponent if padded else int(exponent)}"
    return f"{value:,.{decimals}f}" if "," in sample else f"{value:.{decimals}f}"


def suggestion(word, known):
    near = difflib.get_close_matches(word, known, 1)
    return f"; did you mean {near[0]}?" if near else f"; there are {', '.join(sorted(known)[:12])}"


def check_keys(where, table, needed, possible):
    for key in needed:
        if key not in table:
            raise ListError(f"{where}: '{key}' is missing")
    for key in table:
        if key not in needed + possible:
            raise ListError(f"{where}: unknown key '{key}'{suggestion(key, needed + possible)}")


def of_kind(where, table, key, kind, otherwise=None):
    value = table.get(key, otherwise)
    kinds = (int, float) if kind is float else kind
    if not isinstance(value, kinds) or (isinstance(value, bool) and kind is not bool):
        raise ListError(f"{where}: '{key}' must be a {kind.__name__}, not {value!r}")
    return value


def read_run(name, table, problems):
    where = f"runs.{name}"
    check_keys(where, table, ["command", "seconds"], ["quick", "status"])
    words = shlex.split(of_kind(where, table, "command", str))
    if not words or words[0] not in problems:
        problem = words[0] if words else ""
        raise ListError(f"{where}: no problem '{problem}'{suggestion(problem, problems)}")
    return Run(name, words[0], words[1:], of_kind(where, table, "seconds", float),
               of_kind(where, table, "quick", bool, False), of_kind(where, table, "status", int, 0))


def read_number(where, table, runs, run, source):
    check_keys(where, table, ["value", "name"],
               ["file", "run", "row", "scale", "offset", "tolerance", "within"])
    run = table.get("run", run)
    if run not in runs:
        raise ListError(f"{where}: no run '{run}'{suggestion(str(run), list(runs))}")
    if ("tolerance" in table) == ("within" in table):
        raise ListError(f"{where}: give 'tolerance' (a difference) or 'within' (a factor)")
    value = of_kind(where, table, "value", str)
    try:
        to_number(value)
    except ValueError:
        raise ListError(f"{where}: 'value' must be a number as the document writes it, not '{value}'") from None
    ratio = "within" in table
    return Number(where.removeprefix("places."), value, runs[run],
                  of_kind(where, table, "file", str, "result.json"), of_kind(where, table, "name", str),
                  of_kind(where, table, "row", str, "last"), of_kind(where, table, "scale", float, 1.0),
                  of_kind(where, table, "offset", float, 0.0),
                  of_kind(where, table, "within" if ratio else "tolerance", float), ratio, source)


def read_place(name, table, runs, root, source):
    where = f"places.{name}"
    if not isinstance(table, dict):
        raise ListError(f"{where}: must be a table")
    numbers = {key: value for key, value in table.items() if isinstance(value, dict)}
    check_keys(where, {k: v for k, v in table.items() if k not in numbers}, ["document", "text"], ["run"])
    document = of_kind(where, table, "document", str)
    if not (root / document).is_file():
        raise ListError(f"{where}: no document '{document}' in the repository")
    text = of_kind(where, table, "text", str).strip()
    named = re.findall(r"\{(\w+)\}", text)
    if not named or sorted(named) != sorted(numbers):
        raise ListError(f"{where}: the text names {named}, but there are numbers {sorted(numbers)}")
    return Place(name, document, text,
                 {key: read_number(f"{where}.{key}", numbers[key], runs, table.get("run"), source) for key in named})


def read_document(name, table, root):
    where = f"documents.{name}"
    check_keys(where, table, ["constants"], ["open"])
    if not (root / name).is_file():
        raise ListError(f"{where}: no document '{name}' in the repository")
    return Document(name, of_kind(where, table, "constants", list), of_kind(where, table, "open", int, 0))


def tables_of(file):
    try:
        table = tomllib.loads(file.read_text(encoding="utf-8"))
    except OSError as error:
        raise ListError(error.strerror.lower()) from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise ListError(str(error)) from None
    check_keys("list", table, [], ["runs", "places", "documents"])
    for part in table:
        of_kind("list", table, part, dict)
    return table


def read(folder, root):
    """The list in the .toml files of `folder`, whose places may name runs of each other; documents and problems
    are those of the source tree `root`. Throws ListError."""
    problems = [source.stem for source in (root / "problems").glob("*.cpp")]
    files = {file: {} for file in sorted(folder.glob("*.toml"))}
    if not files:
        raise ListError(f"{folder.relative_to(root)}: no list of numbers, no file NAME.toml, is there")
    parts = {"runs": {}, "places": {}, "documents": {}}
    makers = {"runs": lambda name, table, file: read_run(name, table, problems),
              "places": lambda name, table, file: read_place(name, table, parts["runs"], root, file),
              "documents": lambda name, table, file: read_document(name, table, root)}
    home = {}  # of every name, to say where it stands already
    for part in ("files", *parts):
        for file in files:
            try:
                if part == "files":
                    files[file] = tables_of(file)
                for name, table in files[file].get(part, {}).items():
                    if (part, name) in home:
                        raise ListError(f"{part}.{name} is in {home[part, name].name} already")
                    home[part, name] = file
                    parts[part][name] = makers[part](name, table, file)
            except ListError as error:
                raise ListError(f"{file.relative_to(root)}: {error}") from None
    return Catalogue(parts["runs"], list(parts["places"].values()), list(parts["documents"].values()))
