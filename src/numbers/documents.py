# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers in documents: where a place of the list stands, and which decimal numbers no place covers."""
import re

NUMBER = r"[-\u2212]?\d+(?:,\d{3})*(?:\.\d+)?(?:e[-+]?\d+)?"
# What a reader takes for a measured number: a decimal point or an exponent, no version and no file name.
DECIMAL = re.compile(r"(?<![\w.\-/])[-\u2212]?\d+(?:,\d{3})*(?:\.\d+(?:e[-+]?\d+)?|e[-+]?\d+)(?![\w]|\.\d)")


def pattern_of(text, numbers):
    """`text` as a regular expression: any white space for white space, a number for {name}."""
    parts = []
    for part in re.split(r"(\{\w+\})", text):
        if part[:1] == "{" and part[1:-1] in numbers:
            parts.append(f"(?P<{part[1:-1]}>{NUMBER})")
        else:
            parts.append(re.sub(r"(\\?\s)+", r"\\s+", re.escape(part)))
    return re.compile("".join(parts))


def line_of(text, position):
    return text.count("\n", 0, position) + 1


def find(place, text):
    """The match of a place in its document; or None, and how often it was found."""
    matches = list(pattern_of(place.text, place.numbers).finditer(text))
    return (matches[0] if len(matches) == 1 else None), len(matches)


def where_it_ends(place, text):
    """(line, words of the list, words of the document) where a place that is not found ceases to agree."""
    words = place.text.split()
    for count in range(len(words) - 1, 0, -1):
        match = pattern_of(" ".join(words[:count]), place.numbers).search(text)
        if match:
            found = text[match.end():].split(maxsplit=3)[:3]
            return line_of(text, match.end()), " ".join(words[count:count + 3]), " ".join(found)
    return 1, " ".join(words[:3]), "nothing like it"


def without_code(text):
    """The same length, with blanks for blocks of code, formulas and what stands in `backquotes`."""

    def blank(match):
        return re.sub(r"[^\n]", " ", match[0])

    for code in (r"(?ms)^```.*?^```", r"(?m)^    .*$", r"(?s)\$\$.*?\$\$", r"`[^`\n]+`", r"\$[^$\n]+\$",
                 r"\]\([^)\n]*\)"):
        text = re.sub(code, blank, text)
    return text


def uncovered(text, places, constants):
    """(line, number) of every decimal number outside code that is in no place and in no constant."""
    covered = []
    for place in places:
        match, _ = find(place, text)
        if match:
            covered += [match.span(name) for name in place.numbers]
    for constant in constants:
        covered += [match.span() for match in pattern_of(constant, {}).finditer(text)]
    return [(line_of(text, match.start()), match[0]) for match in DECIMAL.finditer(without_code(text))
            if not any(first <= match.start() and match.end() <= last for first, last in covered)]


def missing(text, constants):
    """The constants that stand nowhere in `text`."""
    return [constant for constant in constants if not pattern_of(constant, {}).search(text)]


def replaced(match, values):
    """The text of a match with these values for its numbers."""
    text, start = match[0], match.start()
    for name, value in sorted(values.items(), key=lambda item: -match.start(item[0])):
        first, last = match.start(name) - start, match.end(name) - start
        text = text[:first] + value + text[last:]
    return text


def listing(listed):
    """Every number with the command, file and tolerance it comes from: a page in Markdown."""
    lines = ["| number | document | command | file | name | tolerance | seconds |", "|---|---|---|---|---|---|---|"]
    for place in listed.places:
        for number in place.numbers.values():
            run = number.run
            lines.append(f"| {number.value} | {place.document} | `{run.command()}` | `{number.file}` | "
                         f"`{number.name}` | {number.allowed()} | {run.seconds:g}{'' if run.quick else ' (long)'} |")
    return "\n".join(lines)
