# SPDX-License-Identifier: GPL-3.0-or-later
"""What Python costs, as ratios of processor times that alternate: overheads.py [<rotating_hexagon>].

Processor times are disturbed by other jobs through caches only; the speed of two threads, a wall time, says
something on two idle cores alone.
"""
import os

os.environ.setdefault("OMP_NUM_THREADS", "1")

import math  # noqa: E402
import pathlib  # noqa: E402
import resource  # noqa: E402
import subprocess  # noqa: E402
import sys  # noqa: E402
import tempfile  # noqa: E402
import threading  # noqa: E402
import time  # noqa: E402

import numpy as np  # noqa: E402
import spam_mechanics as spam  # noqa: E402

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from compiled import hexagon  # noqa: E402
from test_laws import ETA, LAM, elastic, numba_law  # noqa: E402


def least(rounds, *calls):
    """The least time of each of several calls, taken in turn."""
    times = [math.inf] * len(calls)
    for _ in range(rounds):
        for k, call in enumerate(calls):
            times[k] = min(times[k], call())
    return times


def timed(f, n=1):
    def call():
        begin = time.process_time()
        for _ in range(n):
            f()
        return (time.process_time() - begin) / n

    return call


def run_against_program(program):
    """sim.run against the program, whose start and end (a run of one step) are taken off; both without pictures and
    with the same rows. The program writes them, Python keeps them."""
    turn = 20 * np.pi * 8

    def executable(t_end):
        with tempfile.TemporaryDirectory() as folder:
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            subprocess.run([program, "--transport", "monaghan", "--t-end", repr(t_end), "--output-every",
                            "5", "--snapshot-every", "1000", "--checkpoint-every", "1000", "--no-plots",
                            "--threads", "1", "--quiet", "--out", folder + "/out"], check=False,
                           stdout=subprocess.DEVNULL)
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

    def python():
        model, v = hexagon(8)
        sim = spam.Simulation(model, velocity=v, dt=0.1, threads=1)
        columns = {"closest_pair": spam.closest_pair, "shape_error": spam.shape_error}
        begin = time.process_time()
        sim.run(turn, every=5.0, columns=columns)
        return time.process_time() - begin

    there, start, here = least(5, lambda: executable(turn), lambda: executable(0.1), python)
    print(f"sim.run / program: {here:.3f} s / {there - start:.3f} s = {here / (there - start):.3f}")


def rates_of_few():
    model, v = hexagon(1)
    y = model.start(v)
    sim = spam.Simulation(model, y, dt=0.01)

    def steps():
        before, begin = sim.statistics["rhs_evaluations"], time.process_time()
        sim.run(sim.t + 100.0, every=1e9)
        return (time.process_time() - begin) / (sim.statistics["rhs_evaluations"] - before)

    inside, called = least(5, steps, timed(lambda: model.rates(0.0, y), 20000))
    print(f"model.rates of 7 particles: {called * 1e6:.2f} us, inside rk4 {inside * 1e6:.2f} us: "
          f"{(called - inside) * 1e6:.2f} us more")


def laws(n=128):
    x = spam.square_lattice([n, n])
    law = numba_law()
    models = [spam.SmoothParticles(x, material=m, density=1.0) for m in (
        spam.ElasticSolid(LAM, ETA), spam.Material(elastic), spam.Material.from_address(law.address))]
    y = models[0].start(0.01 * np.sin(x))
    built_in, numpy_law, compiled = least(5, *[timed(lambda m=m: m.rates(0.0, y), 5) for m in models])
    print(f"{n * n} particles: built in {built_in * 1e3:.2f} ms, numpy {numpy_law / built_in:.2f}, "
          f"numba {compiled / built_in:.3f} times")


def two_threads():
    def take(at_once):
        sims = []
        for _ in range(2):
            model, v = hexagon(30)
            sims.append(spam.Simulation(model, velocity=v, dt=0.1, threads=1))
        threads = [threading.Thread(target=s.run, args=(20.0,), kwargs={"every": 20.0}) for s in sims]
        begin = time.perf_counter()
        for thread in threads:
            thread.start()
            if not at_once:
                thread.join()
        for thread in threads:
            thread.join()
        return time.perf_counter() - begin

    in_turn, at_once = least(3, lambda: take(False), lambda: take(True))
    print(f"two threads: {in_turn / at_once:.2f} times as fast as in turn (load {os.getloadavg()[0]:.1f})")


rates_of_few()
laws()
if len(sys.argv) > 1:
    run_against_program(sys.argv[1])
    two_threads()
