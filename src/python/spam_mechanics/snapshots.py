# SPDX-License-Identifier: GPL-3.0-or-later
"""Snapshots: .vtp files and the list of them, snapshots.pvd."""
import pathlib
import re
from xml.etree import ElementTree

import numpy as np

from .errors import InputError, contents, one_line, refuse, text_of

_BEGIN = re.compile(rb'<AppendedData encoding="raw">\s*_')
_TYPES = {"Int64": "<i8", "Float64": "<f8"}
_HEAD_AT_MOST = 1 << 20


class Snapshot:
    """Particles at one time, in ascending order of their ids.

    `t`; `position` and `velocity` (N, D); `id`, `mass`, `density`, `energy` (N,), `stress` (N, D, D),
    tension positive, and whatever else the run wrote: `names` lists them. D is the number of dimensions.
    `box` is (low, high, periodic), (D,) each: positions are inside. `elements` (M, 4): places of the corners of
    finite elements, whose fields are in `element_fields`. All in the units of the run.
    """

    def __init__(self, path, dimensions):
        self.path = pathlib.Path(path)
        self._file = _File(self.path)
        n = self._file.points
        ids = self._file.array("PointData", "id", n)
        if ids.dtype.kind != "i" or ids.ndim != 1:
            self._file.refuse("ids should be whole numbers")
        self._order = np.argsort(ids, kind="stable")
        self.id = ids[self._order]
        if n and (self.id[0] < 0 or np.any(np.diff(self.id) == 0)):
            self._file.refuse("two particles have the same id")
        self._space = self._file.array("Points", "Points", n)
        if self._space.shape != (n, 3) or not np.isfinite(self._space).all():
            self._file.refuse("positions should be three finite numbers")
        low, high, periodic = self._file.box
        self.dimensions = dimensions or _dimensions(self._space, low, high)
        D = self.dimensions
        self.t = self._file.time
        self.box = (low[:D], high[:D], periodic[:D])
        self.position = np.ascontiguousarray(self._space[self._order, :D])
        self.names = ("position",) + tuple(
            name for section, name in self._file.arrays if section == "PointData")

    def __len__(self):
        return len(self.id)

    def __contains__(self, name):
        return name in self.names

    def __getitem__(self, name):
        if name in ("id", "position"):
            return getattr(self, name)
        if ("PointData", name) not in self._file.arrays:
            raise InputError(f"there is no field '{one_line(name)}' in {one_line(self.path)}; "
                             f"there are {', '.join(self.names)}")
        return self._reduced(self._file.array("PointData", name, len(self)), self._order)

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        if name not in self.names:
            raise AttributeError(f"this snapshot has no '{name}'; there are {', '.join(self.names)}")
        return self[name]

    @property
    def elements(self):
        """Places of four particles each, counterclockwise (M, 4); M = 0 without finite elements."""
        m = self._file.polygons
        if m == 0:
            return np.empty((0, 4), dtype=np.int64)
        ends = self._file.array("Polys", "offsets", m)
        corners = self._file.array("Polys", "connectivity", 4 * m)
        if ends.dtype.kind != "i" or corners.dtype.kind != "i" or ends.ndim != 1 or corners.ndim != 1:
            self._file.refuse("corners should be whole numbers")
        if not np.array_equal(ends, 4 * np.arange(1, m + 1)):
            self._file.refuse("a polygon has other than four corners")
        if corners.min() < 0 or corners.max() >= len(self):
            self._file.refuse("an element has a corner that does not exist")
        place = np.empty(len(self), dtype=np.int64)
        place[self._order] = np.arange(len(self))
        return place[corners].reshape(m, 4)

    @property
    def element_fields(self):
        """What elements hold, by name: (M,), (M, D) or (M, D, D)."""
        first, m = self._file.vertices, self._file.polygons
        own = slice(first, first + m)
        return {name: self._reduced(self._file.array("CellData", name, first + m), own)
                for section, name in self._file.arrays if section == "CellData" and name != "element"}

    def _reduced(self, values, which):
        values, D = values[which], self.dimensions
        if values.ndim == 1:
            return values
        if values.shape[1] == 9:
            return np.ascontiguousarray(values.reshape(-1, 3, 3)[:, :D, :D])
        return np.ascontiguousarray(values[:, :D]) if values.shape[1] == 3 else values

    def __repr__(self):
        return f"<Snapshot of {len(self)} particles at t = {self.t:g}: {', '.join(self.names)}>"


def _dimensions(x, low, high):
    wide = [bool(np.any(x[:, a] != 0.0) or high[a] > low[a]) for a in range(3)]
    return max([a + 1 for a in range(3) if wide[a]], default=1)


class _File:
    """The arrays of one .vtp, checked against the length of the file before they are looked at."""

    def __init__(self, path):
        self.path = path
        self.arrays = {}  # (section, name): (type, components, offset)
        self.box = tuple(np.zeros(3) for _ in range(2)) + (np.zeros(3, dtype=bool),)
        self.time = None
        self.points = self.vertices = self.polygons = 0
        self._bytes = contents(path, "snapshot")
        # Numbers are no XML: the head ends before a reader of XML may see them.
        begin = _BEGIN.search(self._bytes, 0, _HEAD_AT_MOST)
        if begin is None:
            self.refuse("it has no appended raw numbers, or ends before them")
        if not self._bytes.rstrip().endswith(b"</VTKFile>"):
            self.refuse("it ends too early")
        self._tail = begin.end()
        try:
            head = self._bytes[: begin.start()]
            if b"<!" in head:  # nothing of ours declares entities
                self.refuse("it is no XML of ours")
            root = ElementTree.fromstring(head + b"</VTKFile>")
            self._read_head(root)
        except (ElementTree.ParseError, LookupError, TypeError, ValueError) as error:
            if isinstance(error, InputError):
                raise
            self.refuse(f"its head is not as it should be ({error})")
        if self.time is None:
            self.refuse("it has no TimeValue")

    def refuse(self, reason):
        refuse(self.path, f"is damaged, or no snapshot of spam: {reason}; run the problem again")

    def _read_head(self, root):
        if root.get("type") != "PolyData" or root.get("byte_order") != "LittleEndian" or \
                root.get("header_type") != "UInt64" or root.get("compressor") is not None:
            self.refuse("it is not uncompressed little-endian PolyData")
        if root.get("version") != "1.0":
            refuse(self.path, f"is of format {root.get('version')}, which this version of "
                              "spam_mechanics does not know (1.0); use the version that wrote it")
        poly = root.find("PolyData")
        piece = poly.find("Piece") if poly is not None else None
        if piece is None:
            self.refuse("it has no piece of PolyData")
        for array in poly.iterfind("FieldData/DataArray"):
            self._read_field(array.get("Name"), (array.text or "").split())
        self.points, self.vertices, self.polygons = (
            self._count(piece.get("NumberOf" + what)) for what in ("Points", "Verts", "Polys"))
        for section in piece:
            for array in section.iterfind("DataArray"):
                if array.get("format") != "appended" or array.get("type") not in _TYPES:
                    self.refuse(f"{array.get('Name')} is of no type that spam writes")
                self.arrays[section.tag, array.get("Name", "")] = (
                    _TYPES[array.get("type")], self._count(array.get("NumberOfComponents")),
                    self._count(array.get("offset")))

    def _count(self, word):
        # Nothing that the file holds is more than its bytes.
        if word is None or not word.isascii() or not word.isdigit() or len(word) > 18 or \
                int(word) > len(self._bytes):
            self.refuse(f"'{word}' is no number that the file could hold")
        return int(word)

    def _read_field(self, name, words):
        if name not in ("TimeValue", "box_low", "box_high", "periodic"):
            return
        values = np.array([float(word) for word in words])
        if len(values) != (1 if name == "TimeValue" else 3) or not np.isfinite(values).all():
            self.refuse(f"{name} is not as it should be")
        low, high, periodic = self.box
        if name == "TimeValue":
            self.time = float(values[0])
        elif name == "periodic":
            self.box = (low, high, values != 0)
        else:
            self.box = (values, high, periodic) if name == "box_low" else (low, values, periodic)

    def array(self, section, name, tuples):
        """(tuples,) or (tuples, components), read only, where it lies."""
        if (section, name) not in self.arrays:
            self.refuse(f"it has no {name}")
        kind, components, offset = self.arrays[section, name]
        begin = self._tail + offset
        if not 1 <= components <= 64 or begin + 8 > len(self._bytes):
            self.refuse(f"{name} begins behind its end")
        length = int.from_bytes(self._bytes[begin : begin + 8], "little")
        expected = 8 * components * tuples
        if length != expected or begin + 8 + expected > len(self._bytes):
            self.refuse(f"{name} has {length} bytes, and should have {expected}")
        values = np.frombuffer(self._bytes, dtype=kind, count=components * tuples, offset=begin + 8)
        return values if components == 1 else values.reshape(tuples, components)


def listed(path):
    """(time, file name) of the snapshots that snapshots.pvd lists."""
    try:
        text = text_of(path)
        if "<!" in text:
            raise ValueError("it declares something")
        root = ElementTree.fromstring(text)
        if root.tag != "VTKFile" or root.get("type") != "Collection":
            raise ValueError("it is no Collection")
        if root.get("version") != "1.0":
            refuse(path, f"is of format {root.get('version')}, which this version of spam_mechanics "
                         "does not know (1.0); use the version that wrote it")
        found = [(float(one.get("timestep")), one.get("file")) for one in root.iter("DataSet")]
    except (ElementTree.ParseError, TypeError, ValueError) as error:
        if isinstance(error, InputError):
            raise
        refuse(path, f"is damaged, or no list of snapshots ({error}); run the problem again")
    for _, name in found:
        # A list from elsewhere must not lead to files elsewhere.
        if not name or "/" in name or not name.endswith(".vtp") or not name.isprintable():
            refuse(path, f"lists '{name}', which is no snapshot beside it")
    return found
