# SPDX-License-Identifier: GPL-3.0-or-later
"""What tests of the compiled part share. Skips them where it is not built."""
import contextlib
import os
import unittest

import numpy as np
import spam_mechanics as spam

try:
    spam.Scheme
except ImportError as error:
    raise unittest.SkipTest(str(error))


@contextlib.contextmanager
def python_processes():
    """Other processes of Python that start in here load a sanitizer first where this one has; programs must not."""
    if "SPAM_PRELOAD" in os.environ:
        os.environ["LD_PRELOAD"] = os.environ["SPAM_PRELOAD"]
    try:
        yield
    finally:
        os.environ.pop("LD_PRELOAD", None)


def rotation(n, speed=0.1):
    """The hexagon of the 2004 paper: positions, and velocities of a rotation with this speed at the corners."""
    x = spam.triangular_hexagon(n)
    return x, speed / n * np.column_stack([-x[:, 1], x[:, 0]])


def hexagon(n=3, transport="monaghan", angular_momentum="free", **keywords):
    """A model of it, and the velocities."""
    x, v = rotation(n)
    keywords.setdefault("scheme", spam.Scheme(transport=transport, angular_momentum=angular_momentum))
    return spam.SmoothParticles(x, **keywords), v


def moving(n=3, **keywords):
    """A simulation of it by rk4 with dt = 0.1."""
    model, v = hexagon(n, **keywords)
    return spam.Simulation(model, velocity=v, dt=0.1)
