# SPDX-License-Identifier: GPL-3.0-or-later
"""Columns of numbers against time: invariants.csv, and the rows of a run in memory."""
import numpy as np

from .errors import InputError, needed, one_line, refuse, text_of


class Table:
    """Named columns of numbers, one row per output time; column `t` is the time.

    `table["energy"]` is an array of doubles (rows,); NaN where a cell is empty. `table.names` lists the
    columns, `table.array` is all of it as a structured array, `table.to_pandas()` a DataFrame by t.
    """

    def __init__(self, names, columns):
        self.names = tuple(names)
        self._columns = {n: np.asarray(c, dtype=float) for n, c in zip(self.names, columns)}
        for column in self._columns.values():
            column.flags.writeable = False

    @property
    def t(self):
        """Times (rows,)."""
        return self["t"]

    def __len__(self):
        return len(self._columns[self.names[0]]) if self.names else 0

    def __contains__(self, name):
        return name in self._columns

    def __iter__(self):
        return iter(self.names)

    def __getitem__(self, name):
        if name not in self._columns:
            raise InputError(f"there is no column '{one_line(name)}'; there are {', '.join(self.names)}")
        return self._columns[name]

    def keys(self):
        """Names of columns, as those of a dict: dict(table) and pandas.DataFrame(dict(table)) work."""
        return self.names

    @property
    def array(self):
        """A structured array (rows,) with a field of doubles per column."""
        rows = np.empty(len(self), dtype=[(name, float) for name in self.names])
        for name in self.names:
            rows[name] = self._columns[name]
        return rows

    def to_pandas(self):
        """A pandas.DataFrame with the times as its index. Needs python3-pandas."""
        pandas = needed("pandas", "python3-pandas")
        return pandas.DataFrame({n: self[n] for n in self.names if n != "t"},
                                index=pandas.Index(self.t, name="t"))

    def __repr__(self):
        return f"<Table of {len(self)} rows: {', '.join(self.names)}>"


def _number(cell):
    if cell == "":
        return np.nan
    if cell != cell.strip() or "_" in cell:  # what float() allows and no CSV of ours holds
        raise ValueError(cell)
    return float(cell)


def read_table(path, first="t"):
    """The table in a CSV file. What follows the last end of a line is left out: a run that was killed may
    have left half a row. Raises InputError with file, line and column."""
    lines = text_of(path).split("\n")[:-1]
    if not lines:
        refuse(path, "is empty; run the problem again")
    names = lines[0].split(",")
    if names[0] != first or len(set(names)) != len(names) or "" in names:
        refuse(path, f"line 1: should name columns, {first} the first of them")
    columns = [np.empty(len(lines) - 1) for _ in names]
    for row, line in enumerate(lines[1:]):
        cells = line.split(",")
        if len(cells) != len(names):
            refuse(path, f"line {row + 2}: {len(cells)} columns, and should have {len(names)}")
        for column, name, cell in zip(columns, names, cells):
            try:
                column[row] = _number(cell)
            except ValueError:
                refuse(path, f"line {row + 2}: column {name}: '{cell[:40]}' is no number")
    return Table(names, columns)


def read_events(path):
    """Rows (t, event, value) of events.csv."""
    lines = text_of(path).split("\n")[:-1]
    if not lines or lines[0] != "t,event,value":
        refuse(path, "line 1: should be t,event,value")
    events = []
    for number, line in enumerate(lines[1:], 2):
        try:
            t, rest = line.split(",", 1)
            event, value = rest.rsplit(",", 1)
            events.append((_number(t), event, _number(value)))
        except ValueError:
            refuse(path, f"line {number}: is no time, event and value")
    return events
