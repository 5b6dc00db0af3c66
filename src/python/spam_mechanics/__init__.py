# SPDX-License-Identifier: GPL-3.0-or-later
"""SPAM, smooth-particle applied mechanics, from Python.

    import spam_mechanics as spam

Results of problems: read(folder), run(problem, **options); these need numpy only.

Simulations: lattices (triangular_hexagon, ...), materials (ElasticSolid, Fluid, Material, ...), Scheme, models
(SmoothParticles, TotalLagrangian, MaterialVectors, Springs, Elements), Simulation. Equations of one's own: integrate,
work_precision, methods. These need the compiled part, spam_mechanics._core.

Units are reduced, as in the papers: nothing is converted. Errors are InputError (a ValueError), GuardStop (a
RuntimeError), OutputError (an OSError), SetUpError (a RuntimeError), each of one line.
"""
import importlib

from .errors import GuardStop, InputError, OutputError, SetUpError
from .results import Case, Check, Results, read
from .running import run
from .snapshots import Snapshot
from .tables import Table

_COMPILED = {
    "modelling": ("SmoothParticles", "TotalLagrangian", "MaterialVectors", "Springs", "Molecules", "molecular_fields", "Elements",
                  "element_fields", "rectangle_mesh", "shape_error",
                  "closest_pair"),
    "simulating": ("Drift", "Run", "Simulation", "State"),
    "equations": ("Solution", "WorkPrecision", "integrate", "work_precision"),
    "_core": ("Drag", "ElasticSolid", "EmbeddedAtom", "Fluid", "Force", "Friction", "GammaGas", "Gravity", "IdealGas",
              "IsentropicGas", "LucyGas", "Material", "Rezoning", "Scheme", "VanDerWaals",
              "VanDerWaalsIsotherm", "VonMisesSolid", "ball_of",
              "cubic_lattice", "cylinder_of", "methods", "rank", "ranks", "square_lattice", "triangular_block", "triangular_disk", "triangular_hexagon",
              "usable_cores"),
}
_HOME = {name: module for module, names in _COMPILED.items() for name in names}

__all__ = ["Case", "Check", "GuardStop", "InputError", "OutputError", "Results", "SetUpError", "Snapshot",
           "Table", "read", "run", *sorted(_HOME)]


def __getattr__(name):
    if name not in _HOME:
        raise AttributeError(f"spam_mechanics has no '{name}'")
    try:
        module = importlib.import_module("." + _HOME[name], __name__)
    except ModuleNotFoundError as error:
        if error.name != __name__ + "._core":
            raise
        raise ImportError(f"spam_mechanics.{name} needs the compiled part, which is not there; start the "
                          "script by ./spam python, or build with -DSPAM_BUILD_PYTHON=ON",
                          name=__name__ + "._core") from None
    return getattr(module, name)


def __dir__():
    return __all__
