# SPDX-License-Identifier: GPL-3.0-or-later
"""What can go wrong, by the same kinds as in the library and its programs."""
import importlib
import os
import stat


class InputError(ValueError):
    """Something that was asked for cannot be done: one line with what, why, what is allowed and the fix.

    Programs end with exit status 2 for it.
    """


class GuardStop(RuntimeError):
    """A numerical guard stopped a run: the reason and the time. Programs: exit status 3."""


class OutputError(OSError):
    """Results could not be written during a run. Programs: exit status 4."""


class SetUpError(RuntimeError):
    """A problem could not be installed or built. The front door `spam`: exit status 5."""


def needed(module, package):
    """A module that only some functions need; ImportError says what to install."""
    try:
        return importlib.import_module(module)
    except ImportError:
        raise ImportError(f"{module} is not installed; install {package}", name=module) from None


def one_line(text, most=160):
    """Text that shows as one line, whatever it holds."""
    text = "".join(c if c.isprintable() else repr(c)[1:-1] for c in str(text))
    return text if len(text) <= most else text[: most - 3] + "..."


def refuse(path, reason):
    """Raises InputError of one line about a file or folder."""
    raise InputError(f"{one_line(path)}: {one_line(reason)}") from None


def contents(path, what="file"):
    """All bytes of a file; InputError where there is none to be had."""
    try:
        mode = os.stat(path).st_mode
        if not (stat.S_ISREG(mode) or stat.S_ISDIR(mode)):  # a pipe would wait, a device may do something
            refuse(path, f"the {what} cannot be read (it is no regular file)")
        with open(path, "rb") as file:
            return file.read()
    except OSError as error:
        refuse(path, f"the {what} cannot be read ({error.strerror})")


def text_of(path):
    """The same as text."""
    try:
        return contents(path).decode("utf-8")
    except UnicodeDecodeError:
        refuse(path, "is damaged, it is no text; run the problem again")
