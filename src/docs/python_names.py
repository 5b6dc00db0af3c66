# SPDX-License-Identifier: GPL-3.0-or-later
"""The names of the Python package as a page: what they take from __init__.pyi, what they are from the docstrings, read
in the sources of both parts. Nothing is compiled or imported."""
import ast
import re
from pathlib import Path

PACKAGE = Path("src/python/spam_mechanics")
# One string literal of C++ after another, and nothing else.
STRINGS = re.compile(r'\s*(?:"(?:[^"\\]|\\.)*"\s*)+', re.DOTALL)
OPENING = re.compile(r"(?:py::class_<(\w+)[^>]*(?:<[^>]*>[^>]*)*>|gas<\w+>|\bmodule\.def)\(|\.(def\w*)\(")
MARKS = re.compile(r"([\\`*_{}\[\]<>()#+.!|~$^-])")


def string_of(literals):
    """Text of the literals of an argument; None where it is anything else."""
    if not STRINGS.fullmatch(literals):
        return None
    return "".join(ast.literal_eval(one) for one in re.findall(r'"(?:[^"\\]|\\.)*"', literals))


def arguments_of(text, begin):
    """Arguments of a call of C++ whose text begins behind its parenthesis."""
    arguments, depth, start, at = [], 0, begin, begin
    while True:
        if text[at] in "\"'":
            quote, at = text[at], at + 1
            while text[at] != quote:
                at += 2 if text[at] == "\\" else 1
        elif text.startswith("//", at):
            at = text.index("\n", at)
        elif text[at] in "([{":
            depth += 1
        elif text[at] in ")]}":
            if depth == 0:
                return [*arguments, text[start:at]]
            depth -= 1
        elif text[at] == "," and depth == 0:
            arguments.append(text[start:at])
            start = at + 1
        at += 1


def compiled_docstrings(folder):
    """name or class.name -> docstring, of what sources of the compiled part bind. A class that is bound once for each
    number of dimensions has an underscore before the name of its template."""
    found = {}
    for file in sorted(folder.glob("*.cpp")):
        text, holder = file.read_text(encoding="utf-8"), None
        for call in OPENING.finditer(text):
            arguments = arguments_of(text, call.end())
            if call[2]:  # of the class before it
                name, last = string_of(arguments[0]), string_of(arguments[-1]) if len(arguments) > 2 else None
                if holder and name and last:
                    found[f"{holder}.{name}"] = last
                continue
            if call[0].startswith("module"):
                holder, name = None, string_of(arguments[0])
            else:
                name = string_of(arguments[1]) or f"_{call[1]}"
                holder = name
            last = string_of(arguments[-1])
            if name and last and len(arguments) > 2:
                found[name] = last
    return found


def property_docstring(value):
    """Of `property(..., doc="...")`; None of anything else."""
    if isinstance(value, ast.Call) and getattr(value.func, "id", "") == "property":
        return next((ast.literal_eval(one.value) for one in value.keywords if one.arg == "doc"), None)
    return None


def written_docstrings(folder):
    """The same of the modules in Python."""
    found = {}
    for file in sorted(folder.glob("*.py")):
        for node in ast.parse(file.read_text(encoding="utf-8")).body:
            if isinstance(node, (ast.ClassDef, ast.FunctionDef)) and ast.get_docstring(node):
                found[node.name] = ast.get_docstring(node)
            if isinstance(node, ast.ClassDef):
                for one in node.body:
                    if isinstance(one, ast.FunctionDef) and ast.get_docstring(one):
                        found[f"{node.name}.{one.name}"] = ast.get_docstring(one)
                    elif isinstance(one, ast.Assign) and property_docstring(one.value):
                        found[f"{node.name}.{one.targets[0].id}"] = property_docstring(one.value)
            if isinstance(node, ast.Assign) and getattr(node.targets[0], "attr", "") == "__doc__":
                found[node.targets[0].value.id] = ast.literal_eval(node.value)
    return found


def marked(text):
    """Text for Markdown: nothing in it is markup but what stands between backquotes."""
    pieces = re.split(r"(`[^`]+`)", text)
    pieces[::2] = [MARKS.sub(r"\\\1", piece) for piece in pieces[::2]]
    return "".join(pieces)


def described(docstring):
    """A docstring in Markdown: paragraphs, and lists of what stands in two columns."""
    blocks = []
    for paragraph in re.split(r"\n\s*\n", docstring.strip()):
        lines, rows = paragraph.splitlines(), []
        for line in lines:
            row = re.match(r"(\S+)  +(\S.*)", line)
            if row:
                rows.append([row[1], row[2]])
            elif rows and line.startswith("    "):
                rows[-1][1] += " " + line.strip()
            else:
                rows = None
                break
        if rows:
            blocks.append("\n".join(f"- `{name}`: {marked(what)}" for name, what in rows))
        else:
            blocks.append(marked(" ".join(line.strip() for line in lines)))
    return "\n\n".join(blocks)


def shown(node):
    """The source of an annotation or a list of arguments, with the names of types that the page explains."""
    return re.sub(r"(?<![\w.])_(?=[A-Z])", "", ast.unparse(node))


def arguments_shown(node):
    arguments = ast.parse(ast.unparse(node)).body[0].args
    arguments.args = [one for one in arguments.args if one.arg not in ("self", "cls")]
    return f"({shown(arguments)})"


def directive(kind, signature, content, options=(), fence=":::"):
    return "\n".join([f"{fence}{{py:{kind}}} {signature}", *options, "", content, fence, ""])


def member(node, holder, docstrings):
    """An attribute, property or method of a class."""
    if isinstance(node, ast.AnnAssign):
        name = node.target.id
        return directive("attribute", name, described(docstrings.get(f"{holder}.{name}", "")),
                         [f":type: {shown(node.annotation)}"])
    text = described(docstrings.get(f"{holder}.{node.name}", ""))
    marks = {getattr(one, "id", "") for one in node.decorator_list}
    if "property" in marks:
        return directive("property", node.name, text, [f":type: {shown(node.returns)}"])
    options = [":staticmethod:"] if "staticmethod" in marks else []
    return directive("method", f"{node.name}{arguments_shown(node)} -> {shown(node.returns)}", text, options)


def is_shown(node):
    name = node.target.id if isinstance(node, ast.AnnAssign) else getattr(node, "name", "_")
    return not name.startswith("_")


def page(root):
    """The page in Markdown, and a line for every public name without docstring."""
    source = (root / PACKAGE / "__init__.pyi").read_text(encoding="utf-8")
    docstrings = {**compiled_docstrings(root / PACKAGE.parent), **written_docstrings(root / PACKAGE)}
    headings = {number: title for number, line in enumerate(source.splitlines(), 1)
                for title in re.findall(r"^# --- (.*?) -+$", line)}
    parts, types, complaints = ["## Errors\n"], [], []
    for node in ast.parse(source).body:
        if isinstance(node, ast.Assign):
            types.append(f"{shown(node.targets[0])} = {shown(node.value)}")
        if not isinstance(node, (ast.ClassDef, ast.FunctionDef)):
            continue
        for number in [number for number in headings if number < node.lineno]:
            title = headings.pop(number)
            parts.append(f"## {title[:1].upper()}{title[1:]}\n")
        if node.name not in docstrings:
            complaints.append(f"{PACKAGE}/__init__.pyi:{node.lineno}: {node.name} has no docstring")
        text = described(docstrings.get(node.name, ""))
        if isinstance(node, ast.FunctionDef):
            parts.append(directive("function", f"{node.name}{arguments_shown(node)} -> {shown(node.returns)}", text))
            continue
        made = next((arguments_shown(one) for one in node.body if getattr(one, "name", "") == "__init__"), "")
        kind = "exception" if any("Error" in shown(base) for base in node.bases) else "class"
        inside = [member(one, node.name, docstrings) for one in node.body if is_shown(one)]
        parts.append(directive(kind, node.name.lstrip("_") + made, "\n\n".join([text, *inside]), fence="::::"))
    return "\n".join([*parts, "## Types\n", "```python", *types, "```", ""]), complaints
