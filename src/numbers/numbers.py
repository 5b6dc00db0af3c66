# SPDX-License-Identifier: GPL-3.0-or-later
"""./spam numbers: compares the numbers of documents with runs, and writes them anew."""
import argparse
import sys
from pathlib import Path

try:
    import tomllib  # noqa: F401
except ImportError:
    print("spam: numbers: needs Python 3.11 or later; install python3 (Debian 12, Ubuntu 24.04 or later)",
          file=sys.stderr)
    sys.exit(5)

sys.path.insert(0, str(Path(__file__).resolve().parent))
import catalogue  # noqa: E402
import documents  # noqa: E402
import runs  # noqa: E402


def say(text):
    print(text, flush=True)


def arguments(argv):
    parser = argparse.ArgumentParser(
        prog="./spam numbers", allow_abbrev=False,
        description="Compares every number of the documents with the run that it comes from "
                    "(src/numbers/*.toml). Runs are kept in build/numbers, by case and version.",
        epilog="Exit status: 0 all agree; 1 a number differs, or is in no list; 2 the list asks for what is "
               "not there; 5 a program or its tools are missing.")
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--check", action="store_true", help="compare (this is done when nothing is asked for)")
    what.add_argument("--write", action="store_true",
                      help="write numbers that differ by more than their tolerance anew, here and in the list")
    what.add_argument("--list", action="store_true", help="print every number with its run, as a page in Markdown")
    extent = parser.add_mutually_exclusive_group()
    extent.add_argument("--quick", action="store_true",
                        help="only the runs marked as quick, less than a minute in all; numbers of the others "
                             "are compared with what was written last")
    extent.add_argument("--no-runs", action="store_true", help="none at all: documents against the list")
    parser.add_argument("--only", metavar="RUN", action="append", default=[], help="this run alone; may be repeated")
    parser.add_argument("--programs", type=Path, metavar="DIR",
                        help="take the problems' programs from here instead of building them")
    parser.add_argument("--root", type=Path, default=Path(__file__).resolve().parents[2], help=argparse.SUPPRESS)
    parser.add_argument("--no-install", action="store_true", help="leave missing packages to you")
    return parser.parse_args(argv)


def wanted(run, asked):
    if asked.no_runs or asked.only and run.name not in asked.only:
        return False
    return run.quick or not asked.quick or bool(asked.only)


def value_of(number, folder, root):
    try:
        return runs.value_of(number, folder)
    except catalogue.ListError as error:
        raise catalogue.ListError(f"{number.source.relative_to(root)}: {error}") from None


def measure(listed, asked):
    """What runs say of the numbers, by key, in the documents' units."""
    front_door = ["--no-install"] if asked.no_install else []
    store = runs.Store(asked.root, asked.programs, front_door)
    measured = {}
    for run in listed.runs.values():
        mine = [number for number in listed.numbers() if number.run == run]
        if mine and wanted(run, asked):
            folder = store.results(run)
            measured |= {number.key: value_of(number, folder, asked.root) for number in mine}
    return measured


def told_apart(place, text, found):
    """What is wrong with a place that is not found, or more than once."""
    if found:
        return f"{place.document}: {place.key}: the text of the list is there {found} times, not once"
    line, listed, there = documents.where_it_ends(place, text)
    return f"{place.document}:{line}: {place.key}: found '{there}', expected '{listed}' as in the text of the list"


def differences(listed, texts, measured):
    """One line for everything that is wrong."""
    torn = set()  # documents with a place that is not found, whose numbers count as covered
    for place in listed.places:
        text = texts[place.document]
        match, found = documents.find(place, text)
        if not match:
            torn.add(place.document)
            yield told_apart(place, text, found)
            continue
        for name, number in place.numbers.items():
            line = documents.line_of(text, match.start(name))
            where = f"{place.document}:{line}: {number.key}"
            if match[name] != number.value:
                expected = measured.get(number.key)
                also = "" if expected is None else f" (its run: {expected:.6g})"
                yield f"{where}: found {match[name]}, expected {number.value}{also}, tolerance {number.allowed()}"
            elif number.key in measured and not number.agrees(measured[number.key]):
                yield (f"{where}: found {number.value}, expected {measured[number.key]:.6g}, tolerance "
                       f"{number.allowed()} ({number.run.command()}, {number.file}, {number.name})")
    for document in listed.documents:
        places = [place for place in listed.places if place.document == document.name]
        left = documents.uncovered(texts[document.name], places, document.constants)
        if document.open and len(left) > document.open:
            yield (f"{document.name}: {len(left)} decimal numbers are in no place of the list, which knows of "
                   f"{document.open} ('open'): add the places of new ones")
        for constant in documents.missing(texts[document.name], document.constants):
            yield f"{document.name}: the constant '{constant}' of the list is not there any more"
        for line, number in [] if document.open or document.name in torn else left:
            yield f"{document.name}:{line}: {number} is neither in a place of the list nor among its constants"


def with_value(listing, place, name, old, new):
    """The text of a list's file with another value for this number of this place."""
    start = listing.index(f"\n{name} = ", listing.index(f"[places.{place.key}]"))
    at = listing.index(f'value = "{old}"', start)
    return listing[:at] + f'value = "{new}"' + listing[at + len(f'value = "{old}"'):]


def write(listed, texts, lists, measured):
    """Numbers as runs give them, into `texts` of documents and `lists`. Returns what was changed, a line each."""
    changed = []
    for place in listed.places:
        text = texts[place.document]
        match, _ = documents.find(place, text)
        if not match:
            continue
        values = {}
        for name, number in place.numbers.items():
            value = values[name] = number.value
            if number.key in measured and not number.agrees(measured[number.key]):
                value = values[name] = catalogue.in_shape_of(number.value, measured[number.key])
                lists[number.source] = with_value(lists[number.source], place, name, number.value, value)
            if match[name] != value:
                line = documents.line_of(text, match.start(name))
                changed.append(f"{place.document}:{line}: {number.key}: {match[name]} -> {value}")
        texts[place.document] = (text[:match.start()] + documents.replaced(match, values) + text[match.end():])
    return changed


def main(argv):
    asked = arguments(argv)
    try:
        listed = catalogue.read(asked.root / "src" / "numbers", asked.root)
        for name in asked.only:
            if name not in listed.runs:
                raise catalogue.ListError(f"--only: no run '{name}'{catalogue.suggestion(name, list(listed.runs))}")
        if asked.list:
            say(documents.listing(listed))
            return 0
        names = {place.document for place in listed.places} | {document.name for document in listed.documents}
        texts = {name: (asked.root / name).read_text(encoding="utf-8") for name in sorted(names)}
        measured = measure(listed, asked)
    except catalogue.ListError as error:
        print(f"spam: numbers: {error}", file=sys.stderr)
        return 2
    except runs.RunFailed as error:
        print(f"spam: numbers: {error}", file=sys.stderr)
        return error.status
    if asked.write:
        lists = {number.source: number.source.read_text(encoding="utf-8") for number in listed.numbers()}
        found = [(place, documents.find(place, texts[place.document])) for place in listed.places]
        lost = [told_apart(place, texts[place.document], times) for place, (match, times) in found if not match]
        changed = write(listed, texts, lists, measured)
        for file, text in [*((asked.root / name, text) for name, text in texts.items()), *lists.items()]:
            if file.read_text(encoding="utf-8") != text:
                file.write_text(text, encoding="utf-8")
        say("\n".join(lost + changed) if lost or changed else "numbers: nothing to write")
        return 1 if lost else 0
    wrong = list(differences(listed, texts, measured))
    for line in wrong:
        say(line)
    total = len(listed.numbers())
    say(f"numbers: {total} in {len(names)} documents, {len(measured)} compared with runs and "
        f"{total - len(measured)} with what was written last: {len(wrong) or 'none'} wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except KeyboardInterrupt:
        sys.exit(130)
