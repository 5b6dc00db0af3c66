# SPDX-License-Identifier: GPL-3.0-or-later
"""The .pyi says what is there: every public name, its members and the names of its arguments; and everything has a
docstring."""
import ast
import inspect
import pathlib
import re
import unittest

import compiled  # noqa: F401  (skips where there is no compiled part)
import spam_mechanics as spam

stub = ast.parse((pathlib.Path(spam.__file__).parent / "__init__.pyi").read_text())
declared = {node.name: node for node in stub.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}


def arguments(node):
    a = node.args
    names = [one.arg for one in a.posonlyargs + a.args + a.kwonlyargs]
    return [name for name in names if name not in ("self", "cls")]


def actual_arguments(f):
    """Of Python from the signature, of the compiled part from the first line of its docstring."""
    try:
        parameters = inspect.signature(f).parameters.values()
        return [p.name for p in parameters if p.name != "self" and p.kind != p.VAR_KEYWORD]
    except ValueError:
        inside = f.__doc__[f.__doc__.index("(") + 1 : f.__doc__.index(") ->")]
        return [name for name in re.findall(r"(?:^|, )(\w+):", inside) if name != "self"]


class Stub(unittest.TestCase):
    def test_names(self):
        public = {name for name in declared if not name.startswith("_")}
        self.assertEqual(public, set(spam.__all__))

    def test_arguments(self):
        compared = 0
        for name in spam.__all__:
            thing, node = getattr(spam, name), declared[name]
            pairs = [(name, thing, node)] if isinstance(node, ast.FunctionDef) else [
                (f"{name}.{one.name}", getattr(thing, one.name), one) for one in node.body
                if isinstance(one, ast.FunctionDef) and one.name != "__getattr__"]
            for title, f, one in pairs:
                if not callable(f) or any(getattr(d, "id", "") == "property" for d in one.decorator_list):
                    continue
                if one.name.startswith("__") and one.name != "__init__":
                    continue
                with self.subTest(title):
                    self.assertEqual(actual_arguments(f), arguments(one))
                    compared += 1
        self.assertGreater(compared, 40)

    def test_docstrings(self):
        for name in spam.__all__:
            thing = getattr(spam, name)
            with self.subTest(name):
                self.assertTrue(thing.__doc__ and len(thing.__doc__.strip()) > 20)
            for member, value in vars(thing).items() if inspect.isclass(thing) else ():
                if member.startswith("_") or not (inspect.isfunction(value) or isinstance(value, property)):
                    continue
                with self.subTest(f"{name}.{member}"):
                    self.assertTrue(value.__doc__)
