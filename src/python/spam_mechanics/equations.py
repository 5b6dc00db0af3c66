# SPDX-License-Identifier: GPL-3.0-or-later
"""Any ordinary differential equation by all the methods of the library, and what they cost."""
import math
import time

import numpy as np

from . import _core
from .errors import GuardStop, InputError, needed


class Solution:
    """`t` (rows,), `y` (rows, n); steps, rejected_steps, rhs_evaluations, last_step."""

    def __init__(self, found):
        for name, value in found.items():
            setattr(self, name, value)

    def __repr__(self):
        return f"<Solution: {len(self.t)} rows to t = {self.t[-1]:g}, {self.rhs_evaluations} calls of f>"


def integrate(f, y0, t_end=None, *, times=None, method="arkode:DORMAND_PRINCE_7_4_5", dt=None, t0=0.0,
              **options):
    """Integrates dy/dt = f(t, y), y and the rates (n,), from y0 at t0, by any of methods().

    Rows of the Solution are at the start and after every step to t_end, or at `times` (ascending) alone.
    `dt`: fixed steps; without, adaptive ones by rtol (1e-8) and atol (1e-10). Other options as of Simulation.
    f gets arrays of its own. Its exceptions arrive unchanged; raises InputError for wrong input, GuardStop where
    rates are NaN or steps become too short.
    """
    if (t_end is None) == (times is None):
        raise InputError("integrate: give either t_end or times")
    stops = [float(t_end)] if times is None else [float(t) for t in np.ravel(times)]
    return Solution(_core.integrate(f, y0, t0, stops, times is None, method, dict(options, dt=dt)))


class WorkPrecision:
    """Rows (method, kind, setting, error, known, calls, seconds) of a study, `floor`, and the `reference`.

    error: root mean square over the entries of y at the end, each over its scale (the larger of its size at both
    ends, of all entries together where that is 0); known: whether it is above the floor, the difference of two
    references.
    """

    names = ("method", "kind", "setting", "error", "known", "calls", "seconds")

    def __init__(self, rows, reference, floor):
        self.rows, self.reference, self.floor = rows, reference, floor

    def __getitem__(self, name):
        if name not in self.names:
            raise InputError(f"there is no column '{name}'; there are {', '.join(self.names)}")
        return np.array([row[self.names.index(name)] for row in self.rows])

    def of(self, method, kind):
        """(errors, calls) of one method, 'fixed' or 'adaptive', where they are known."""
        rows = [row for row in self.rows if row[0] == method and row[1] == kind and row[4]]
        return np.array([row[3] for row in rows]), np.array([row[5] for row in rows])

    def order(self, method):
        """Slope of the errors of fixed steps, between the largest step of error < 0.01 and the floor; NaN where
        fewer than three are left."""
        rows = [row for row in self.rows if row[0] == method and row[1] == "fixed" and row[4]
                and 10 * self.floor < row[3] < 1e-2]
        if len(rows) < 3:
            return math.nan
        dt, error = np.log([row[2] for row in rows]), np.log([row[3] for row in rows])
        return float(np.polyfit(dt, error, 1)[0])

    def to_pandas(self):
        """A pandas.DataFrame. Needs python3-pandas."""
        pandas = needed("pandas", "python3-pandas")
        return pandas.DataFrame(self.rows, columns=self.names)


_REFERENCES = ("arkode:FEHLBERG_13_7_8", "arkode:VERNER_8_5_6")


def work_precision(f, y0, t_end, *, methods=("rk4", "arkode:DORMAND_PRINCE_7_4_5", "gsl:rk8pd"), t0=0.0,
                   steps=None, tolerances=None, reference=None):
    """Error against work of methods on dy/dt = f(t, y): ladders of fixed steps and of tolerances.

    `steps`: numbers of steps (default 16, 23, 32, ..., 1024), for methods that take fixed ones; `tolerances`:
    relative and absolute alike (default 1e-2 ... 1e-11), for adaptive ones. `reference`: y (n,) at t_end, where
    it is known; else found by arkode:FEHLBERG_13_7_8 with the tolerance 1e-13, and arkode:VERNER_8_5_6. Runs that
    a guard stops are left out. Returns a WorkPrecision.
    """
    known = _core.methods()
    methods = [m.replace("arkode:ARKODE_", "arkode:", 1) if isinstance(m, str) else m for m in methods]
    steps = [round(16 * 2 ** (k / 2)) for k in range(13)] if steps is None else list(steps)
    tolerances = [10.0**-k for k in range(2, 12)] if tolerances is None else list(tolerances)
    for method in methods:
        if method not in known:
            integrate(f, y0, t_end, method=method, t0=t0)  # says what is wrong with it
    floor = 0.0
    if reference is None:
        ends = [_end(f, y0, t0, t_end, m, rtol=1e-13, atol=1e-13)[0] for m in _REFERENCES]
        reference = ends[0]
    reference = np.asarray(reference, dtype=float)
    start = np.asarray(y0, dtype=float)
    scale = np.maximum(np.abs(reference), np.abs(start))
    whole = math.sqrt(np.mean(scale**2)) or 1.0
    scale = np.where(scale > 1e-3 * whole, scale, whole)

    def error_of(y):
        return math.sqrt(np.mean(((y - reference) / scale) ** 2))

    if "ends" in locals():
        floor = error_of(ends[1])
    rows = []
    for method in methods:
        ladder = [("fixed", (t_end - t0) / n, {"dt": (t_end - t0) / n}) for n in steps
                  if known[method]["fixed"]]
        ladder += [("adaptive", tol, {"rtol": tol, "atol": tol}) for tol in tolerances
                   if known[method]["adaptive"]]
        for kind, setting, options in ladder:
            try:
                y, calls, seconds = _end(f, y0, t0, t_end, method, **options)
            except GuardStop:
                continue
            error = error_of(y)
            rows.append((method, kind, setting, error, error > floor, calls, seconds))
    return WorkPrecision(rows, reference, floor)


def _end(f, y0, t0, t_end, method, **options):
    begin = time.thread_time()
    found = integrate(f, y0, times=[t_end], t0=t0, method=method, **options)
    return found.y[-1], found.rhs_evaluations, time.thread_time() - begin
