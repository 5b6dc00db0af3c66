# SPDX-License-Identifier: GPL-3.0-or-later
"""Simulations: a model that moves, and what its runs leave."""
import contextlib
import sys
from collections import namedtuple

import numpy as np

from . import _core
from .errors import InputError
from .tables import Table

Drift = namedtuple("Drift", "name promise scale limit change kept")
Drift.__doc__ = "How an invariant fared: its change over a run, in parts of `scale`, against what is promised."

_simulations = {1: _core.Simulation1, 2: _core.Simulation2, 3: _core.Simulation3}


class State:
    """Fields of a simulation's y, read only, where they lie: no copy, and always the present state.

    position, velocity (N, D); density, energy (N,); stress (N, D(D+1)/2) as xx, yy, xy, tension positive; and
    whatever else the model integrates. `t`, `id` (N,), `y`. The order of particles is the library's: id[i] is the
    number in the arrays that the model was made from. Views stay valid when the simulation is gone; where particles
    were split or merged they show the last state before.
    """

    def __init__(self, core):
        self._core = core

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        return self._core.view(name)

    def __dir__(self):
        return [*super().__dir__(), *self._core.model.fields]

    @property
    def t(self):
        """The time."""
        return self._core.t

    @property
    def y(self):
        """All of it (size,): the N_Vector."""
        return self._core.y

    @property
    def id(self):
        """Which of the particles given lies where (N,)."""
        return self._core.model.id

    @property
    def speed(self):
        """|v| (N,), an array of its own."""
        return np.sqrt((self.velocity**2).sum(axis=1))


class _Edited:
    """Copies of fields that may be written to; they become the state at the end of edit()."""

    def __init__(self, state, model):
        fields = {name: np.array(getattr(state, name)) for name in model.fields}
        object.__setattr__(self, "_fields", fields)
        object.__setattr__(self, "_state", state)

    def __getattr__(self, name):
        if name in ("t", "id"):
            return getattr(self._state, name)
        if name.startswith("_") or name not in self._fields:
            raise AttributeError(f"y has no field '{name}'; there are {', '.join(self._fields)}")
        return self._fields[name]

    def __setattr__(self, name, value):
        field = getattr(self, name)
        try:
            field[...] = value
        except (ValueError, TypeError) as error:
            raise InputError(f"{name}: {error}") from None

    def _end(self):
        for field in self._fields.values():
            field.flags.writeable = False
        return self._fields


class Run(Table):
    """The rows of a run: t, dt, mass, momentum_x, ..., angular_momentum, kinetic, internal, energy, what externals
    gave, and columns of one's own, as in invariants.csv.

    `drifts`: by invariant a Drift (name, promise, scale, limit, change, kept); `remarks`: (t, what, value);
    `statistics`: steps, right-hand sides, ... of the simulation so far.
    """

    def __init__(self, core):
        names, rows = core.rows() or ((), np.empty((0, 0)))
        super().__init__(names, [np.ascontiguousarray(rows[:, k]) for k in range(len(names))])
        self.drifts = {row[0]: Drift(*row) for row in core.drifts()}
        self.remarks = core.remarks()
        self.statistics = core.statistics()


class Simulation:
    """A model on its way through time.

    model        what SmoothParticles() and the like make; one simulation moves it at a time
    y0           the state to start from (size,), as model.start() or another simulation's y; default
                 model.start(velocity, temperature)
    velocity     (N, D) in the order in which the particles were given; default at rest (length/time)
    temperature  of a fluid
    method       one of methods(): "rk4", "arkode:DORMAND_PRINCE_7_4_5", "cvode:adams", "cvode:bdf",
                 "gsl:rk8pd", ...
    dt           the step; methods of adaptive steps leave it out
    t0           the time at the start
    threads      of its sums; 0: as many as there are cores (OMP_NUM_THREADS)
    options      rtol, atol (times each field's scale), min_step, max_step, initial_step, max_steps,
                 controller, safety, relaxation: as of the programs

    Raises InputError (ValueError) of one line.
    """

    def __init__(self, model, y0=None, *, velocity=None, temperature=0.0, method="rk4", dt=None, t0=0.0,
                 threads=0, **options):
        if y0 is not None and velocity is not None:
            raise InputError("y0: holds the velocities; leave velocity out")
        if y0 is None:
            y0 = model.start(velocity, temperature)
        self._core = _simulations[model.dimensions](model, y0, method, dict(options, dt=dt), t0, threads)
        #: Views of the fields of y.
        self.state = State(self._core)
        self._editing = False

    model = property(lambda self: self._core.model,
                     doc="What moves: another one than the given, where particles were split or merged.")
    t = property(lambda self: self._core.t, doc="The time.")
    y = property(lambda self: self._core.y, doc="The state (size,), read only: the N_Vector itself. Where processes share\n"
                 "the particles (ranks()), all of them hold the whole, and must ask for it together.")
    own = property(lambda self: np.array(self._core.own, dtype=np.int64),
                   doc="Numbers in y of the particles that this process computes, ascending: all where there is one.")
    id = property(lambda self: self.model.id, doc="Which of the particles given lies where (N,).")
    statistics = property(lambda self: self._core.statistics(),
                          doc="steps, rejected_steps, rhs_evaluations, events, last_step, pair_interactions.")

    @property
    def last_run(self):
        """The rows of the latest run so far, also of one that an exception has ended."""
        return Run(self._core)

    def by_id(self, field):
        """A field (its name, or an array (N, ...) in the order of `id`) in the order of the particles given: in that
        of their ids, where some have come and gone."""
        field = getattr(self.state, field) if isinstance(field, str) else np.asarray(field)
        return field[np.argsort(self.id, kind="stable")]

    def step(self, t_stop=1e100):
        """One accepted step, not past t_stop; the new time.

        Raises GuardStop with the reason where there is no way on; the state is then the last accepted one.
        """
        self._refuse_editing()
        return self._core.step(t_stop)

    def run(self, t_end, *, every=None, columns=None, snapshot_every=None, on_row=None, on_snapshot=None,
            revise=None, enough=None, rezone=None, progress=False):
        """Integrates to t_end and returns the rows, a Run: one at the start, every `every` (default 240 rows),
        one at the end. Other threads go on meanwhile.

        columns      {name: f(model, state) -> number}: further columns, e.g. {"shape": shape_error}
        on_row       f(model, state), at every row; on_snapshot: likewise every `snapshot_every` (default 12)
        revise       f(model, state), after every row but the first: may write to the fields of `state`, and
                     returns whether it did; the integrator then begins anew
        enough       f(model, state) -> whether the run ends here
        rezone       a Rezoning: particles are split and merged on the way. `model`, `id` and `state` are then those of
                     the present particles, whose ids are never used again; the model given stays as it was
        progress     a line on the terminal

        Ctrl-C (KeyboardInterrupt), an exception of a function or law, and GuardStop leave the last accepted state,
        and the rows so far in `last_run`.
        """
        self._refuse_editing()
        length = t_end - self.t
        call = lambda f: None if f is None else lambda: f(self.model, self.state)  # noqa: E731
        self._core.run(t_end, length / 240 if every is None else every,
                       length / 12 if snapshot_every is None else snapshot_every,
                       [(name, call(f)) for name, f in _functions(columns)],
                       self._progress(t_end, call(on_row)) if progress else call(on_row),
                       call(on_snapshot), None if revise is None else lambda: self._revised(revise),
                       call(enough), rezone)
        return Run(self._core)

    @contextlib.contextmanager
    def edit(self):
        """Fields that may be written to: `with sim.edit() as s: s.velocity *= 0.5`.

        At the end they are checked, become the state, and the integrator begins anew. An exception inside leaves
        the state as it was. Raises InputError for what is not finite.
        """
        self._refuse_editing()
        edited, self._editing = _Edited(self.state, self.model), True
        try:
            yield edited
            self._core.replace(edited._end())
        finally:
            self._editing = False
            edited._end()

    def _refuse_editing(self):
        if self._editing:
            raise RuntimeError("the state is being edited; leave the edit() block first")

    def _revised(self, revise):
        edited = _Edited(self.state, self.model)
        if not revise(self.model, edited):
            return False
        self._core.replace(edited._end())
        return True

    def _progress(self, t_end, then):
        t0 = self.t

        def show():
            share = (self.t - t0) / (t_end - t0)
            if sys.stderr.isatty():
                sys.stderr.write(f"\r{100 * share:3.0f} %  t = {self.t:.4g}" + ("\n" if share >= 1 else ""))
                sys.stderr.flush()
            if then is not None:
                then()

        return show

    def __repr__(self):
        return f"<Simulation of {len(self.model)} particles at t = {self.t:g}>"


def _functions(columns):
    if columns is None:
        return []
    if not hasattr(columns, "items"):
        raise InputError("columns: is no dict of names and functions")
    for name, f in columns.items():
        if not isinstance(name, str) or not callable(f):
            raise InputError(f"columns: {name!r} needs a function of (model, state)")
    return list(columns.items())
