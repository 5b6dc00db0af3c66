# SPDX-License-Identifier: GPL-3.0-or-later
"""Interrupts, exceptions, threads, forks, wrong input."""
import multiprocessing
import os
import signal
import subprocess
import sys
import threading
import time
import unittest

import numpy as np
import spam_mechanics as spam
from compiled import hexagon, moving, python_processes, rotation


class Interrupts(unittest.TestCase):
    def test_ctrl_c_ends_a_run_at_once(self):
        model, v = hexagon(20)  # 1,261 particles
        sim = spam.Simulation(model, velocity=v, dt=0.001)
        sent = []

        def press():
            time.sleep(0.5)
            sent.append(time.perf_counter())
            os.kill(os.getpid(), signal.SIGINT)

        thread = threading.Thread(target=press)
        thread.start()
        with self.assertRaises(KeyboardInterrupt):
            sim.run(1000.0, every=0.01)
        waited = time.perf_counter() - sent[0]
        thread.join()
        self.assertLess(waited, 0.2 if len(os.sched_getaffinity(0)) > 1 and os.getloadavg()[0] < 3 else 2)
        self.assertEqual(signal.getsignal(signal.SIGINT), signal.default_int_handler)
        # The last accepted state, from which it goes on.
        self.assertGreater(sim.t, 0.0)
        steps = round(sim.t / 0.001)
        self.assertEqual(sim.statistics["steps"], steps)
        self.assertTrue(np.isfinite(sim.y).all() and len(sim.last_run) >= 1)
        other = spam.Simulation(hexagon(20)[0], velocity=v, dt=0.001)
        for _ in range(steps):
            other.step()
        np.testing.assert_array_equal(sim.y, other.y)
        sim.step()
        self.assertGreater(sim.t, other.t)

    def test_a_signal_that_is_handled_lets_it_go_on(self):
        seen = []
        before = signal.signal(signal.SIGUSR1, lambda *_: seen.append(1))
        try:
            sim = moving()
            threading.Timer(0.15, os.kill, (os.getpid(), signal.SIGUSR1)).start()
            begin = time.time()
            sim.run(1e6, every=50.0, enough=lambda m, s: seen or time.time() - begin > 20)
            self.assertEqual(seen, [1])
        finally:
            signal.signal(signal.SIGUSR1, before)


class Exceptions(unittest.TestCase):
    """They arrive as they were raised, and the simulation stands at an accepted state."""

    class Own(Exception):
        pass

    def raising(self, after=0, value=None):
        calls = [0]

        def f(*_):
            calls[0] += 1
            if calls[0] > after:
                self.raised = self.Own("mine", calls[0])
                raise self.raised
            return value(*_) if callable(value) else value

        return f

    def arrives(self, call):
        with self.assertRaises(self.Own) as caught:
            call()
        self.assertIs(caught.exception, self.raised)

    def test_of_columns_and_observers(self):
        for where in ("column", "on_row", "on_snapshot", "revise", "enough"):
            f = self.raising(after=2, value=0)
            sim = moving()
            keywords = {"columns": {"own": f}} if where == "column" else {where: f}
            with self.subTest(where):
                self.arrives(lambda: sim.run(3.0, every=0.5, snapshot_every=0.5, **keywords))
                self.assertGreater(sim.t, 0.4)
                sim.step()
        with self.assertRaisesRegex(ValueError, "columns: own: returned str, which is no number"):
            moving().run(1.0, columns={"own": lambda m, s: "much"})

    def test_of_laws_and_forces(self):
        zero = lambda g, s: np.zeros_like(s)  # noqa: E731
        for method, options in [("rk4", {"dt": 0.1}), ("arkode:DORMAND_PRINCE_7_4_5", {}),
                                ("cvode:adams", {}), ("gsl:rk8pd", {})]:
            for what in ("law", "force"):
                value = zero if what == "law" else lambda t, x, v: np.zeros_like(v)
                f = self.raising(after=50, value=value)
                keywords = {"material": spam.Material(f)} if what == "law" else {
                    "externals": [spam.Force(f)]}
                model, v = hexagon(**keywords)
                sim = spam.Simulation(model, velocity=v, method=method, **options)
                with self.subTest(method=method, what=what):
                    self.arrives(lambda: sim.run(1000.0))
                    self.assertTrue(np.isfinite(sim.y).all())
        model, v = hexagon(material=spam.Material(self.raising()))
        self.arrives(lambda: model.rates(0.0, model.start(v)))

    def test_of_many_threads_only_the_first_arrives(self):
        model, v = hexagon(20, material=spam.Material(self.raising(after=9, value=lambda g, s: 0 * s)))
        sim = spam.Simulation(model, velocity=v, dt=0.1, threads=2)
        with self.assertRaises(self.Own):
            sim.run(100.0)

    def test_of_an_equation(self):
        f = self.raising(after=5, value=lambda t, y: -y)
        self.arrives(lambda: spam.integrate(f, [1.0], 1e3))

    def test_shapes_that_functions_return(self):
        for law, words in [(lambda g, s: s[:, 0], r"stress law: has the shape \(37,\), and should have \(37, 3\)"),
                           (lambda g, s: "no", "stress law: returned no array"),
                           (lambda g, s: None, "stress law")]:
            model, v = hexagon(material=spam.Material(law))
            with self.assertRaisesRegex(ValueError, words):
                spam.Simulation(model, velocity=v, dt=0.1).step()
        model, v = hexagon(material=spam.Material(lambda g, s: np.nan * s))
        with self.assertRaises(spam.GuardStop):
            spam.Simulation(model, velocity=v, dt=0.1).run(1.0)
        with self.assertRaisesRegex(ValueError, r"f: has the shape \(2,\), and should have \(1,\)"):
            spam.integrate(lambda t, y: [1.0, 2.0], [1.0], 1.0)


class Threads(unittest.TestCase):
    def simulations(self):
        made = []
        for _ in range(2):
            model, v = hexagon(20)
            made.append(spam.Simulation(model, velocity=v, dt=0.1, threads=1))
        return made

    def test_two_simulations_at_once(self):
        ends = []
        for at_once in (False, True):
            sims = self.simulations()
            threads = [threading.Thread(target=s.run, args=(3.0,), kwargs={"every": 1.0}) for s in sims]
            for thread in threads:
                thread.start()
                if not at_once:
                    thread.join()
            for thread in threads:
                thread.join()
            ends += [s.y for s in sims]
        for end in ends[1:]:
            np.testing.assert_array_equal(end, ends[0])

    def test_others_go_on_meanwhile(self):
        sim = self.simulations()[0]
        thread = threading.Thread(target=sim.run, args=(100.0,), kwargs={"every": 100.0})  # a quarter of a second
        counted = 0
        thread.start()
        while thread.is_alive():
            counted += 1
            time.sleep(0.001)
        self.assertGreater(counted, 5)

    def test_one_model_is_used_by_one_thread(self):
        sim, ended = self.simulations()[0], threading.Event()

        def edited():
            with sim.edit() as s:
                s.velocity *= 1.0

        thread = threading.Thread(target=sim.run, args=(1e6,), kwargs={
            "every": 0.1, "enough": lambda m, s: ended.is_set()})
        thread.start()
        try:
            while sim.t == 0.0:
                time.sleep(0.001)
            for _ in range(50):  # also while it calls functions
                for call in (lambda: sim.model.rates(0.0, np.zeros(sim.model.size)), lambda: sim.last_run, edited):
                    with self.assertRaisesRegex(RuntimeError, "at work"):
                        call()
        finally:
            ended.set()
            thread.join()
        sim.model.rates(0.0, sim.y)

    def test_calls_from_inside(self):
        sim = moving()
        for call in (sim.step, lambda: sim.run(9.0)):
            with self.assertRaisesRegex(RuntimeError, "running"):
                sim.run(sim.t + 1.0, on_row=lambda m, s: call())
        sim.run(sim.t + 1.0, on_row=lambda m, s: m.rates(s.t, s.y))
        newer = spam.Simulation(sim.model, sim.y, dt=0.1)
        newer.step()
        with self.assertRaisesRegex(RuntimeError, "another Simulation"):
            sim.step()


_AFTER_FORK = """
import os, sys
import numpy as np
import spam_mechanics as spam
x = spam.triangular_hexagon(20)
def make(x): return spam.Simulation(spam.SmoothParticles(x), dt=0.1, threads=2)
if {first}:
    make(x).step()
    model = spam.SmoothParticles(x)
    y = model.start()
    before = model.rates(0.0, y)
child = os.fork()
if child == 0:
    try:
        {call}
        os._exit(0)
    finally:
        os._exit(7)
print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
"""


class Forks(unittest.TestCase):
    def forked(self, first, n, call=None):
        call = call or f"make(spam.triangular_hexagon({n})).step()"
        with python_processes():
            return subprocess.run([sys.executable, "-c", _AFTER_FORK.format(first=first, call=call)], text=True,
                                  capture_output=True, timeout=60).stdout

    def test_whatever_computes_goes_on_with_threads_of_its_own(self):
        for call in (None, "model.rates(0.0, y)", "model.density(y)", "model.shape_error(x)", "model.closest_pair(x)",
                     "spam.integrate(lambda t, y: -y, [1.0] * 60000, 1.0)"):
            for first in (True, False):
                with self.subTest(call=call, first=first):
                    self.assertEqual(self.forked(first or call is not None, 20, call), "0\n")

    def test_the_child_computes_the_same(self):
        self.assertEqual(self.forked(True, 20, "assert np.array_equal(model.rates(0.0, y), before)"), "0\n")

    def test_spawned_processes(self):
        moving(20).step()
        with python_processes(), multiprocessing.get_context("spawn").Pool(1) as pool:
            self.assertEqual(pool.apply(turned, (20,)), moving(20).step())


def turned(n):
    """The time after a step, in another process."""
    return moving(n).step()


class WrongInput(unittest.TestCase):
    def refused(self, word, call):
        with self.assertRaisesRegex(ValueError, word) as caught:
            call()
        self.assertNotIn("\n", str(caught.exception))

    def test_arrays(self):
        x, v = rotation(2)
        make = spam.SmoothParticles
        model = make(x)
        for word, call in [
            (r"x: has the shape \(38,\), and should have \(n, 1\), \(n, 2\) or \(n, 3\)", lambda: make(x.ravel())),
            (r"x: has the shape \(19, 4\)", lambda: make(np.zeros((19, 4)))),
            ("x: is empty", lambda: make(np.zeros((0, 2)))),
            ("x: its numbers are complex128", lambda: make(x + 1j)),
            ("x: its numbers are <U1", lambda: make([["a", "b"]])),
            ("x: its numbers are object|x: is no array", lambda: make([[1.0], [1.0, 2.0]])),
            ("x: entry 3 is nan", lambda: make(np.where(np.arange(38).reshape(19, 2) == 3, np.nan, x))),
            ("x: entry 0 is inf", lambda: make(np.full((3, 2), np.inf))),
            ("mass: -1", lambda: make(x, mass=-1)),
            (r"mass: has the shape \(2,\), and should have \(19,\)", lambda: make(x, mass=[1, 2])),
            ("spacing: 0", lambda: make(x, spacing=0.0)),
            ("density: -1", lambda: make(x, density=-1.0)),
            ("box: has 3 lengths", lambda: make(x, box=[1, 2, 3])),
            ("box: -1", lambda: make(x, box=[-1, 2])),
            ("velocity: is of 18 particles", lambda: model.start(v[1:])),
            ("velocity: entry 0 is nan", lambda: spam.Simulation(model, velocity=v * np.nan, dt=0.1)),
            (r"y0: has the shape \(3,\)", lambda: spam.Simulation(model, [1, 2, 3], dt=0.1)),
            ("y0: holds the velocities", lambda: spam.Simulation(model, [1], velocity=v, dt=0.1)),
            (r"y: has the shape \(2,\), and should have \(171,\)", lambda: model.rates(0.0, [1.0, 2.0])),
            ("position: is of 3 particles, and the model has 19", lambda: model.shape_error(x[:3])),
            ("y: entry 0 is nan", lambda: model.rates(0.0, np.full(model.size, np.nan))),
            ("g: has 3 components", lambda: make(x, externals=[spam.Gravity([0, 0, 1])])),
        ]:
            with self.subTest(word):
                self.refused(word, call)

    def test_words_and_numbers(self):
        x, v = rotation(2)
        model = spam.SmoothParticles(x)
        sim = moving(2)
        make = lambda **k: spam.Simulation(model, **k)  # noqa: E731
        for word, call in [
            ("transport: 'monagan' is not known; use plain, .*did you mean monaghan",
             lambda: spam.Scheme(transport="monagan")),
            ("kernel: 'gauss'", lambda: spam.Scheme(kernel="gauss")),
            ("angular_momentum: 'a.nb' is not known", lambda: spam.Scheme(angular_momentum="a\nb")),
            ("range", lambda: spam.SmoothParticles(x, scheme=spam.Scheme(range=0.5))),
            ("eta: -1", lambda: spam.ElasticSolid(1, -1)),
            ("yield-stress: 0", lambda: spam.VonMisesSolid(1, 1, 0.0)),
            ("address: 0", lambda: spam.Material.from_address(0)),
            ("sound speed|sound_speed", lambda: spam.SmoothParticles(
                x, material=spam.Material(lambda g, s: s), scheme=spam.Scheme(viscosity=1.0))),
            ("integrator|method", lambda: make(method="rk5")),
            ("dt", lambda: make(method="rk4")),
            ("dt: is no number", lambda: make(dt="much")),
            ("rtol: dt asks for fixed steps", lambda: make(dt=0.1, rtol=1e-3)),
            ("max_step: dt asks for fixed steps", lambda: make(dt=0.1, max_step=0.01)),
            ("safety: gsl:rk8pd has its own step-size control", lambda: make(method="gsl:rk8pd", safety=0.3)),
            ("controller: cvode:adams has its own", lambda: make(method="cvode:adams", controller="pi")),
            ("dt", lambda: make(dt=-0.1)),
            ("'rtoll' is no option of an integrator; did you mean rtol", lambda: make(dt=0.1, rtoll=1)),
            ("max_steps: 0", lambda: make(dt=0.1, max_steps=0)),
            ("threads: -1", lambda: make(dt=0.1, threads=-1)),
            ("t0: nan", lambda: make(dt=0.1, t0=np.nan)),
            ("temperature: -1", lambda: make(dt=0.1, temperature=-1.0)),
            ("t_end: 0", lambda: sim.run(0.0)),
            ("t_end: nan", lambda: sim.run(np.nan)),
            ("every: 0", lambda: sim.run(1.0, every=0.0)),
            ("steps", lambda: make(dt=1e-9).run(1e3)),
            ("columns", lambda: sim.run(1.0, columns={"a": 3})),
            ("the name 'a,b' is empty or has a comma", lambda: sim.run(1.0, columns={"a,b": len})),
            ("the name '' is empty", lambda: sim.run(1.0, columns={"": len})),
            ("there is a column 'energy' already", lambda: sim.run(1.0, columns={"energy": lambda m, s: 1.0})),
            ("there is a column 't' already", lambda: sim.run(1.0, columns={"own": len, "t": lambda m, s: 1.0})),
            ("t_stop: -1", lambda: sim.step(-1.0)),
            ("three dimensions", lambda: spam.MaterialVectors(np.arange(5.0)[:, None])),
            ("material: total_lagrangian takes an ElasticSolid", lambda: spam.TotalLagrangian(
                x, material=spam.VonMisesSolid(1, 1, 1))),
            ("cells: 0", lambda: spam.square_lattice([0])),
            ("of: 'all'", lambda: spam.Friction(0.1, "all")),
        ]:
            with self.subTest(word):
                self.refused(word, call)
        for call in (lambda: spam.SmoothParticles(x, material="steel"), lambda: spam.Scheme("plain")):
            with self.assertRaises(TypeError):
                call()
