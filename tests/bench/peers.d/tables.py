# SPDX-License-Identifier: GPL-3.0-or-later
# Writes the pair potentials for pair_style table of LAMMPS: lucy.table and solid.table, into the
# folder named by the argument.
import math
import sys
from pathlib import Path


def write_table(name, key, energy, force, inner, cutoff, rows=1000):
    """Rows equidistant in r^2, which is how LAMMPS looks them up."""
    with open(Path(sys.argv[1]) / name, 'w', encoding='ascii') as table:
        table.write(f'# {key}\n\n{key}\nN {rows} RSQ {inner} {cutoff}\n\n')
        for row in range(rows):
            r = math.sqrt(inner**2 + (cutoff**2 - inner**2) * row / (rows - 1))
            table.write(f'{row + 1} {r:.16g} {energy(r):.16g} {force(r):.16g}\n')


# Lucy's weight function in two dimensions as a potential
h = 6.0
c = 5.0 / (math.pi * h * h)
write_table('lucy.table', 'LUCY', lambda r: c * (1.0 + 3.0 * r / h) * (1.0 - r / h)**3,
            lambda r: 12.0 * c * r / (h * h) * (1.0 - r / h)**2, 1e-6, h)


# Lennard-Jones less its force at the cutoff, scaled so that spacing 1 is in equilibrium
def lj_energy(r, sigma):
    return 4.0 * ((sigma / r)**12 - (sigma / r)**6)


def lj_force(r, sigma):
    return 24.0 / r * (2.0 * (sigma / r)**12 - (sigma / r)**6)


cutoff = 3.0
squares = [i * i + i * j + j * j for i in range(-4, 5) for j in range(-4, 5)]
distances = [math.sqrt(square) for square in squares if 0 < square < cutoff**2]
low, high = 0.8, 1.0
for _ in range(60):
    sigma = 0.5 * (low + high)
    last = lj_force(cutoff, sigma)
    if sum(r * (lj_force(r, sigma) - last) for r in distances) > 0.0:
        high = sigma
    else:
        low = sigma
shift = lj_energy(cutoff, sigma)
write_table('solid.table', 'SOLID', lambda r: lj_energy(r, sigma) - shift + (r - cutoff) * last,
            lambda r: lj_force(r, sigma) - last, 0.6, cutoff)
