# SPDX-License-Identifier: GPL-3.0-or-later
# Elastic solid of PySPH on the hexagon of the SPAM benchmark: continuity, Hooke's law with
# Jaumann's rate, momentum with stress, XSPH; no artificial viscosity or stress, as in SPAM. Cubic
# spline with support 3 spacings. Or, with a second argument 'scheme', PySPH's own scheme for elastic
# solids as it comes: the same with artificial viscosity and artificial stress. Prints what one
# evaluation costs as JSON; first argument: how many to time.
import json
import sys
from time import perf_counter, process_time

import numpy as np
import pysph
from cyarray.carray import UIntArray
from pysph.base.kernels import CubicSpline
from pysph.sph.basic_equations import ContinuityEquation, VelocityGradient2D, XSPHCorrection
from pysph.sph.equation import Group
from pysph.sph.solid_mech.basic import (HookesDeviatoricStressRate, IsothermalEOS,
                                        MomentumEquationWithStress,
                                        get_particle_array_elastic_dynamics)
from pysph.tools.sph_evaluator import SPHEvaluator

evaluations = int(sys.argv[1])

# A hexagon of 82 spacings that turns, jittered, with some stress.
size = 82
random = np.random.RandomState(1)
i, j = np.mgrid[-size:size + 1, -size:size + 1]
inside = np.abs(i + j) <= size
i, j = i[inside], j[inside]
x, y = i + 0.5 * j, np.sqrt(0.75) * j
u, v = -1e-3 * y, 1e-3 * x
x = x + random.uniform(-0.01, 0.01, x.size)
y = y + random.uniform(-0.01, 0.01, x.size)
density = np.sqrt(4.0 / 3.0)
solid = get_particle_array_elastic_dynamics(
    name='solid', x=x, y=y, u=u, v=v, m=np.ones_like(x), rho=np.full_like(x, density),
    h=np.full_like(x, 1.5), constants={'E': 1.0, 'nu': 1.0 / 3.0, 'rho_ref': density})
for name in ('s00', 's01', 's11'):
    solid.get(name)[:] = random.uniform(-0.01, 0.01, x.size)

# PySPH's own scheme goes through the pairs twice; in this order once gives the same rates.
sources = ['solid']
equations = [
    Group([IsothermalEOS('solid', None)]),
    Group([VelocityGradient2D('solid', sources), ContinuityEquation('solid', sources),
           MomentumEquationWithStress('solid', sources), XSPHCorrection('solid', sources)]),
    Group([HookesDeviatoricStressRate('solid', None)]),
]
if sys.argv[2:] == ['scheme']:
    from pysph.sph.solid_mech.basic import ElasticSolidsScheme
    equations = ElasticSolidsScheme(elastic_solids=sources, solids=[], dim=2).get_equations()
evaluator = SPHEvaluator([solid], equations, 2, CubicSpline(dim=2))


def seconds(work):
    start = perf_counter()
    work()
    return perf_counter() - start


evaluator.evaluate()
used = process_time()
evaluation = seconds(lambda: [evaluator.evaluate() for _ in range(evaluations)]) / evaluations
share = (process_time() - used) / (evaluations * evaluation)
# The list is made at the first evaluation after an update.
search = seconds(evaluator.update) + seconds(evaluator.evaluate) - evaluation

rates = ('au', 'av', 'arho', 'as00', 'as01', 'as11', 'ax', 'ay')
if not all(np.isfinite(solid.get(name)).all() and solid.get(name).any() for name in rates):
    sys.exit('a rate is not finite or zero everywhere')
near, found = 0, UIntArray()
for particle in range(x.size):
    evaluator.nnps.get_nearest_particles(0, 0, particle, found)
    near += found.length - 1
print(json.dumps({
    'version': pysph.__version__, 'particles': x.size, 'in_range': near / x.size, 'share': share,
    'evaluation': 1e9 * evaluation / x.size, 'search': 1e9 * search / x.size}))
