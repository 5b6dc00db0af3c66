# SPDX-License-Identifier: GPL-3.0-or-later
"""Models of particles. Positions (N, 1), (N, 2) or (N, 3) say in how many dimensions."""
import math

import numpy as np

from .errors import InputError
from ._core import ElasticSolid, MatterOfElements, Scheme, elements, remembering, smooth_particles
from ._core import element_fields as _element_fields, rectangle_mesh as _rectangle_mesh
from ._core import molecular_fields as _molecular_fields


def SmoothParticles(x, *, material=None, which=None, scheme=None, mass=1.0, density=None, spacing=1.0, box=None,
                    externals=()):
    """A solid or fluid of smooth particles with stress and energy, [HHM04] II, [HH07] 4.

    x          positions (N, D): of a solid its reference configuration, free of stress (length)
    material   ElasticSolid, VonMisesSolid, Material (a law of one's own) or Fluid; default the elastic
               constants of the triangular lattice. Or a list of solids, or of fluids, of which `which` (N,) names one
               for each particle
    scheme     a Scheme; default Scheme(). Its range is 3 spacings where it says none
    mass       one number, or (N,)
    density    of a solid at the start (mass/length^D); default the mean mass by the volume spacing^D of a
               particle, and in the plane, where one has six neighbours, sqrt(3/4) spacing^2. A fluid's is summed
    spacing    distance of nearest neighbours (length)
    box        periods (D,), 0 where space is open; default open space
    externals  Gravity, Friction, Drag, Force: applied in this order

    Raises InputError (ValueError) of one line: wrong shapes, types or numbers, and what makes no sense together.
    """
    return smooth_particles(x, _several(material), Scheme() if scheme is None else scheme, mass,
                            _density(density, mass, spacing, x, box), spacing, _periods(box), list(externals),
                            _which(which))


def TotalLagrangian(x, *, material=None, which=None, density=None, range=None, penalty=0.1, kernel="lucy",
                    viscosity=0.0, closest_approach=0.0, mass=1.0, spacing=1.0, box=None, externals=()):
    """A solid that sums over the neighbours of its reference configuration x (N, D): p, L and E are kept.

    material: ElasticSolid, or a list of which `which` (N,) names one for each particle; range of the weight (length;
    default 3 spacings); penalty kappa against zero-energy modes; kernel, viscosity and closest_approach as of Scheme. What viscosity takes from the motion is booked as
    viscous_heat, and heats nothing. Others as of SmoothParticles().
    """
    return _solid("total_lagrangian", x, material, which, density, range, penalty, kernel, viscosity, closest_approach,
                  mass, spacing, box, externals)


def MaterialVectors(x, *, material=None, which=None, density=None, range=None, penalty=2.0, viscosity=0.0,
                    closest_approach=0.0, mass=1.0, spacing=1.0, box=None, externals=()):
    """A solid whose particles remember a material vector for each present neighbour: p, L and E are kept, and
    bodies meet. Arguments as of TotalLagrangian(), but for kernel."""
    return _solid("material_vectors", x, material, which, density, range, penalty, "lucy", viscosity, closest_approach,
                  mass, spacing, box, externals)


def Springs(x, *, kappa=1.0, rest_length=None, closest_approach=0.0, mass=1.0, spacing=1.0, box=None,
            externals=()):
    """Molecular dynamics: harmonic springs kappa between neighbours nearer than 1.2 spacings in x (N, D);
    closest_approach as of Scheme."""
    rest_length = spacing if rest_length is None else rest_length
    like = _of_bonds(lambda: kappa * spacing**2, spacing, x)
    return remembering(x, "springs", [like], kappa, rest_length, mass,
                       _density(None, mass, spacing, x, box), 1.0, 0.0, "lucy", 0.0, closest_approach, spacing,
                       _periods(box), list(externals), [])


def Elements(x, corners, *, material=None, density=1.0, which=None, temperature=0.0, hourglass_viscosity=0.0,
             hourglass_stiffness=0.0, held_x=(), held_y=(), spacing=1.0, externals=()):
    """Plane finite elements with one point of integration, of solids and fluids, in free space.

    x, corners  nodes (N, 2), and of each element the numbers of its four, counterclockwise (M, 4)
    material    ElasticSolid (default: of the triangular lattice), VonMisesSolid, Material or Fluid; or several,
                of which `which` (M,) names one for each element. A fluid has the density of its corners, and a cold
                one (EmbeddedAtom, ...) its energy as well. Conduction and friction by pairs are refused
    density     at the start (mass/length^2); masses of the nodes follow. Of several materials one for each,
                where they differ
    temperature likewise, of gases; start(temperature=...) may give another
    hourglass_viscosity, hourglass_stiffness
                resistance to motions that leave the gradient at the centre zero (1: critical damping of 1)
    held_x, held_y
                numbers of nodes that are held along x, along y: floors and walls on which they slide
    spacing     typical side of an element; externals as of SmoothParticles()
    """
    several = _several(material)
    numbers = zip(several, _one_each("density", density, several), _one_each("temperature", temperature, several))
    materials = [MatterOfElements(one, rho, hourglass_viscosity, hourglass_stiffness, T) for one, rho, T in numbers]
    return elements(x, _whole("corners", corners, (-1, 4)), materials,
                    _which(which), spacing, list(externals),
                    _whole("held_x", held_x, (-1,)), _whole("held_y", held_y, (-1,)))


def _periods(box):
    return [] if box is None else list(box)


def _of_bonds(energy, length, x):
    """The solid whose moduli, energies by volume, are those of bonds: what scales of fields are taken from."""
    try:
        modulus = float(energy()) / float(length) ** np.shape(x)[1]
    except (IndexError, TypeError, ValueError, ArithmeticError):
        modulus = 1.0  # what is wrong with them is said where the model is made
    return ElasticSolid.triangular_lattice(modulus if modulus > 0 else 1.0)


def _several(material):
    """A list of materials, of one where one is given."""
    material = ElasticSolid.triangular_lattice() if material is None else material
    return list(material) if isinstance(material, (list, tuple)) else [material]


def _which(numbers):
    return [] if numbers is None else _whole("which", numbers, (-1,))


def _one_each(name, given, several):
    """A number for each of several materials."""
    try:
        return np.broadcast_to(np.asarray(given, float), (len(several),)).tolist()
    except (TypeError, ValueError):
        raise InputError(f"{name}: give a number, or one for each of the {len(several)} materials") from None


def _whole(name, given, shape):
    """A list of whole numbers of this shape, -1 for any length; an empty one has none."""
    try:
        array = np.asarray(given)
        if array.size == 0:
            return []
        if array.dtype.kind in "iu" and array.ndim == len(shape) and array.shape[1:] == shape[1:]:
            return array.tolist()
    except ValueError:
        pass
    raise InputError(f"{name}: give whole numbers of the shape {str(shape).replace('-1', 'n')}")


def element_fields(model, y):
    """density (M,), energy by mass (M,) and stress (M, 3: xx, yy, xy) of all elements, as their corners and y say."""
    return _element_fields(model, y)


def rectangle_mesh(columns, rows, spacing=1.0):
    """columns x rows squares about the origin, row by row from the lower left: nodes (N, 2), corners (M, 4)."""
    x, corners = _rectangle_mesh(columns, rows, spacing)
    return x, np.array(corners)


def Molecules(x, *, energy=1.0, length=None, closest_approach=0.0, mass=1.0, spacing=1.0, box=None, externals=()):
    """Molecular dynamics: all pairs of x (N, D) repel each other below `length` (default: spacing) and attract each
    other up to sqrt(2) of it, energy (q^8 - 2 q^4) with q = 2 - r^2/length^2, [HH07] 13; others as of Springs()."""
    length = spacing if length is None else length
    like = _of_bonds(lambda: energy, length, x)
    return remembering(x, "molecules", [like], energy, length, mass,
                       _density(None, mass, spacing, x, box), 1.0, 0.0, "lucy", 0.0, closest_approach, spacing,
                       _periods(box), list(externals), [])


def molecular_fields(model, state, places, *, kernel="lucy", range=None):
    """Fields of Molecules() or Springs() in a state (or y) at places (M, D), by a weight function (Hardy, J. Chem.
    Phys. 76, 622, 1982): density, temperature and energy by volume (M,), velocity (M, D), pressure (M, S: xx; xx, yy,
    xy; xx, yy, zz, xy, yz, xz), whose bonds are spread along their lines: d(rho u)/dt + div(rho u u + P) = 0.

    range (length; default 3 spacings). The temperature, that of velocities less u, is too low by the part
    sum w^2/(sum w)^2. Where no particle is in range, velocity and temperature are NaN.

    Raises InputError for a model whose forces are not those of pairs.
    """
    return _molecular_fields(model, getattr(state, "y", state), places, kernel, range)


def _solid(kind, x, material, which, density, range, penalty, kernel, viscosity, closest_approach, mass, spacing, box,
           externals):
    return remembering(x, kind, _several(material), 1.0, 1.0, mass, _density(density, mass, spacing, x, box),
                       3.0 * spacing if range is None else range, penalty, kernel, viscosity, closest_approach,
                       spacing, _periods(box), list(externals), _which(which))


def _density(density, mass, spacing, x, box):
    """Mass by volume of the lattice that x is likely to be; what is wrong with the others the model says."""
    if density is not None:
        return density
    try:
        x, mass = np.asarray(x), np.asarray(mass)
        if not (x.dtype.kind in "biuf" and mass.dtype.kind in "biuf" and np.isfinite(x).all()):
            return 1.0
        dimensions = x.shape[1]
        one = float(mass.flat[0] if np.all(mass == mass.flat[0]) else mass.mean())
        if not (spacing > 0 and one > 0):
            return 1.0
        factor = math.sqrt(4.0 / 3.0) if _is_triangular(x, spacing, box) else 1.0
    except (IndexError, TypeError, ValueError):
        return 1.0
    return factor * one / spacing**dimensions


def _is_triangular(x, spacing, box):
    """Whether one of 64 particles, spread over x, has six neighbours within 1.2 spacings in the plane."""
    if x.shape[1] != 2 or len(x) == 0:
        return False
    periods = np.array([float(length) or np.inf for length in _periods(box) or (0.0, 0.0)])
    golden = (math.sqrt(5.0) - 1.0) / 2.0  # no step through rows and columns
    some = np.unique((np.arange(64) * golden % 1.0 * len(x)).astype(int)) if len(x) > 64 else np.arange(len(x))
    for k in some:
        apart = x - x[k]
        apart -= np.where(np.isinf(periods), 0.0, periods) * np.round(apart / periods)
        if np.count_nonzero(np.einsum("ia,ia->i", apart, apart) < (1.2 * spacing) ** 2) > 6:
            return True
    return False


def shape_error(model, state):
    """Distance of a body from the best-fitting rigid motion of its reference, root mean square in spacings: for
    `columns` of Simulation.run()."""
    return model.shape_error(state.position)


def closest_pair(model, state):
    """Distance of the closest two particles (length): for `columns` of Simulation.run()."""
    return model.closest_pair(state.position)
