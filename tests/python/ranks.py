# SPDX-License-Identifier: GPL-3.0-or-later
"""Several processes that share the particles of every run: mpirun -n 2 python3 tests/python/ranks.py

prints how many numbers of rows and states are not those of one process, and ends with 1 where there are any. With a word
more: `law`, `row` and `step` raise an exception in one process, in a law of Python, at a row and between two steps; `two`
goes on with a simulation when another one has been made, which is refused.
"""
import io
import os
import pathlib
import subprocess
import sys

import numpy as np
import spam_mechanics as spam
from compiled import hexagon, rotation


def hexagon_with_a_force():
    model, v = hexagon(6, angular_momentum="torque_pair",
                       externals=[spam.Force(lambda t, x, v: -0.01 * x - 0.02 * v)])
    return spam.Simulation(model, velocity=v, dt=0.2), {}


def total_lagrangian():
    x, v = rotation(5)
    return spam.Simulation(spam.TotalLagrangian(x), velocity=v, method="arkode:DORMAND_PRINCE_7_4_5"), {}


def gas():
    x = spam.square_lattice([16, 16]) + 0.1 * np.sin(np.arange(512.0)).reshape(256, 2)
    model = spam.SmoothParticles(x, material=spam.Fluid(spam.GammaGas(1.4)), box=[20.0, 20.0],
                                 scheme=spam.Scheme(density="summed", range=3.0))
    return spam.Simulation(model, temperature=0.5, dt=0.05), {"rezone": spam.Rezoning(1.0, volume=(1.4, 0.3))}


def numbers(make):
    """Everything that a run leaves, and the state after a change of it by hand and some steps."""
    sim, words = make()
    slowed = []

    def slow(model, state):
        if state.t < 1.5 or slowed:
            return False
        slowed.append(state.t)
        state.velocity *= 0.5
        return True

    run = sim.run(3.0, every=0.5, columns={"speed": lambda m, s: s.speed.max()}, revise=slow, **words)
    with sim.edit() as s:
        s.velocity *= 1.5
    for _ in range(3):
        sim.step()
    return np.concatenate([np.concatenate([run[name] for name in run.names]), sim.by_id("position").ravel(), sim.y])


def raise_in_one(where):
    mine = spam.rank() == 1

    def force(t, x, v):
        if mine and where == "law" and t > 1.0:
            raise ZeroDivisionError("a law has failed")
        return 0.0 * x

    def on_row(model, state):
        if mine and where == "row" and state.t > 1.0:
            raise ZeroDivisionError("a row has failed")

    model, v = hexagon(4, externals=[spam.Force(force)])
    sim = spam.Simulation(model, velocity=v, dt=0.1)
    if where == "two":
        spam.Simulation(hexagon(3)[0], dt=0.1)
    sim.run(3.0, every=0.5, on_row=on_row)
    if mine:
        raise ZeroDivisionError("a step has failed")
    sim.run(6.0)


def main():
    if sys.argv[1:] and sys.argv[1] != "alone":
        return raise_in_one(sys.argv[1])
    found = {make.__name__: numbers(make) for make in (hexagon_with_a_force, total_lagrangian, gas)}
    if sys.argv[1:]:
        np.savez(sys.stdout.buffer, **found)
        return
    own = spam.Simulation(hexagon(3)[0], dt=0.1).own
    if spam.rank() > 0:
        return
    alone = {key: value for key, value in os.environ.items() if not key.startswith(("OMPI_", "PMIX_", "PMI_"))}
    output = subprocess.run([sys.executable, __file__, "alone"], env=alone, check=True, stdout=subprocess.PIPE).stdout
    different = sum(int((value != there).sum()) if value.shape == there.shape else value.size
                    for there, value in zip(np.load(io.BytesIO(output)).values(), found.values()))
    print(f"{spam.ranks()} processes, {len(own)} of 37 particles in the first: {different} of "
          f"{sum(value.size for value in found.values())} numbers differ")
    sys.exit(different > 0)


sys.path.insert(0, str(pathlib.Path(__file__).parent))
if __name__ == "__main__":
    main()
