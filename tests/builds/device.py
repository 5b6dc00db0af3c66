# SPDX-License-Identifier: GPL-3.0-or-later
"""Sweeps over lists of neighbours, loops over bonds and what a material does with a particle are code for a device: no
exception, no std::function, no function of the host.

Every sweep of the library is instantiated for one lane, as device code of CUDA, by clang, which needs neither a device
nor its libraries to check it. Which there are the library's symbols say; those of a source's own laws are left out.
What a sweep calls is checked as well: clang finds what cannot be compiled for a device in all that an instantiation
for it leads to. A virtual call it would let pass. The loop over a block of particles that calls a material opens the
columns of the state before, which is the host's."""
import json
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD, LIBRARY = (Path(sys.argv.pop(1)), Path(sys.argv.pop(1))) if len(sys.argv) > 2 else (None, None)
CLANG = next(filter(None, map(shutil.which, ["clang++", *(f"clang++-{n}" for n in range(25, 13, -1))])), None)

SOURCE = """
#include <cstdlib>
#define __device__ __attribute__((device))
#define __host__ __attribute__((host))
#define __global__ __attribute__((global))
{libraries}
#include <__clang_cuda_math_forward_declares.h>
#pragma clang force_cuda_host_device begin
{headers}
{code}
#pragma clang force_cuda_host_device end
"""

# Laws of spam/material, by what a right-hand side asks them for.
CLOSURES = """
namespace spam {
template <class Law>
void of_state(const Law& law, double& x) {
    x = law.pressure(x, x) + sound_speed(law, x, x);
    if constexpr (requires { law.temperature(x, x); }) x = law.temperature(x, x);
}
template <int Dim, class Law>
void by_rates(const Law& law, const Mat<Dim>& grad_v, SymTensor<Dim>& stress) {
    stress = law.stress_rate(grad_v, stress);
}
template <int Dim, class Law>
void by_deformation(const Law& law, const Mat<Dim>& F, Mat<Dim>& stress) {
    if constexpr (requires { law.stress(F); })
        stress = law.stress(F);
    else
        stress = static_cast<decltype(law.in_state(std::declval<ConstState<Dim>>()))*>(nullptr)->stress(0, F);
}
template <int Dim, class Law>
void returned(const Law& law, SymTensor<Dim>& stress) {
    using Map = decltype(law.return_map(0.0, std::declval<ConstState<Dim>>()));
    stress = (*static_cast<Map*>(nullptr))(0, stress);
}
template <int Dim, class Law>
void smooth(const Law& law, const Mat<Dim>& grad_v, SymTensor<Dim>& stress) {
    using Rates = decltype(law.rates(std::declval<ConstState<Dim>>(), std::declval<State<Dim>>()));
    stress = (*static_cast<Rates*>(nullptr))(0, grad_v, stress);
}
""" + "".join(
    [f"template void of_state(const {law}&, double&);\n"
     for law in ("IdealGas", "GammaGas", "IsentropicGas", "LucyGas", "VanDerWaals", "VanDerWaalsIsotherm",
                 "EmbeddedAtom", "CavitatingEmbeddedAtom", "Cavitating<IdealGas>")]
    + [f"template void by_rates(const ElasticSolid&, const Mat<{n}>&, SymTensor<{n}>&);\n" for n in (2, 3)]
    + [f"template void by_deformation(const {law}&, const Mat<2>&, Mat<2>&);\n"
       for law in ("StVenantKirchhoff", "PolynomialSolid")]
    + [f"template void by_deformation(const HenckySolid<{surface}>&, const Mat<{n}>&, Mat<{n}>&);\n"
       f"template void returned(const YieldingSolid<{surface}, JohnsonCook>&, SymTensor<{n}>&);\n"
       f"template void returned(const YieldingSolid<{surface}, Perzyna>&, SymTensor<{n}>&);\n"
       f"template void smooth(const SmoothYield<{surface}>&, const Mat<{n}>&, SymTensor<{n}>&);\n"
       for surface, n in (("PlaneVonMises", 2), ("PlaneStrainVonMises", 2), ("SpaceVonMises", 3))]
    + ["template void returned(const YieldingSolid<PlaneStressVonMises>&, SymTensor<2>&);\n}\n"])

# Their sources, with four lanes of the compiler's own: fewer have instructions of their own on the host.
BONDS = """
#define native_lanes(level) 4
#define SPAM_LEVEL generic
#include "src/rhs/material_vectors/bond_sweeps.lanes.cpp"
#include "src/rhs/material_vectors/bond_updates.lanes.cpp"
"""

# A pass that cannot be one: what it calls is known to the host alone.
FOR_THE_HOST = """
namespace spam {
struct ByFunction {
    template <class T> struct Sums { T sum{}; };
    std::function<double(double)> of = [](double r) { return r; };
    template <class T, class Record>
    void add(const Pair<2, T>& pair, const Record&, const Record&, Sums<T>& sums) const { sums.sum += of(pair.w); }
    template <class To, class T>
    static void store(const To& to, const Sums<T>& sums) { to.set(to.out.e_dot, sums.sum); }
};
template void sweep_run<1, 2, RecordOf<2, double, column::Position, column::Mass>, ByFunction>(SweepInput<2> const&,
    unsigned long, unsigned long, GeneralWeight<2> const&, StoreSums<1, 2, ByFunction> const&,
    std::tuple<ByFunction> const&);
}
"""


def headers():
    """All that define passes or materials, and what makes sweeps of them; and those of libraries that they include."""
    include = ROOT / "include"
    ours = [f"spam/{path.parent.name}/{path.name}"
            for path in sorted((*(include / "spam/physics").glob("*.hpp"), *(include / "spam/material").glob("*.hpp")))
            # Events between steps and a solver over all particles are no passes.
            if path.stem not in ("closest_approach", "gauss_constraint")] + ["spam/rhs/run_sweep.hpp"]
    libraries, known, todo = [], set(ours), list(ours)
    while todo:
        for name in re.findall(r"^ *# *include <(.+)>", (include / todo.pop()).read_text(encoding="utf-8"), re.M):
            if name in known:
                continue
            known.add(name)
            (todo if name.startswith("spam/") else libraries).append(name)
    return ours, libraries + ["functional"]


def sweeps():
    """Explicit instantiations of all sweeps in the library, for one lane; their arguments say weight and store."""
    symbols = subprocess.run(["nm", "-C", LIBRARY], capture_output=True, text=True, check=True).stdout
    found = set(re.findall(r"void spam::(lanes_\w+)::(sweep_run<\d+, .*)", symbols))
    level = max({level for level, _ in found}, key=lambda one: sum(one == level for level, _ in found))
    for _, sweep in sorted(one for one in found if one[0] == level and "(anonymous namespace)" not in one[1]):
        sweep = re.sub(r"\b(sweep_run|\w+Sums)<\d+, (\d,)", r"\1<1, \2", sweep.replace(f"{level}::", ""))
        depth, commas, end = 0, [], sweep.index("<") + 1
        while depth > 0 or sweep[end] != ">":
            depth += (sweep[end] in "<(") - (sweep[end] in ">)")
            if sweep[end] == "," and depth == 0:
                commas.append(end)
            end += 1
        yield f"template void spam::{sweep[:commas[-2]]}{sweep[end:]};"


def compiled(code):
    """What clang says of it."""
    commands = json.loads((BUILD / "compile_commands.json").read_text(encoding="utf-8"))
    command = next(one["command"] for one in commands if one["file"].endswith("rhs/pairs/pair_sweeps.lanes.cpp"))
    include = re.findall(r"-I ?\S+|-isystem \S+", command)
    ours, libraries = headers()
    as_includes = ["\n".join(f"#include <{name}>" for name in names) for names in (libraries, ours)]
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / "sweeps.cu"
        source.write_text(SOURCE.format(libraries=as_includes[0], headers=as_includes[1], code=code), encoding="utf-8")
        return subprocess.run([CLANG, "-x", "cuda", "--cuda-device-only", "--cuda-gpu-arch=sm_70", "-nocudainc",
                               "-nocudalib", "-fsyntax-only", "-std=c++20", "-DEIGEN_NO_CUDA", "-DFMT_USE_FLOAT128=0",
                               *" ".join(include).split(), f"-I{ROOT}", source],
                              cwd=BUILD, capture_output=True, text=True, check=False)


@unittest.skipIf(CLANG is None, "skipped: clang is not installed")
class Device(unittest.TestCase):
    def test_sweeps_closures_and_loops_over_bonds_compile(self):
        code = list(sweeps())
        self.assertGreater(len(code), 190)
        done = compiled("\n".join(code) + CLOSURES + BONDS)
        self.assertEqual(done.returncode, 0, done.stderr[:4000])
        print(f"{len(code)} sweeps compile for a device")

    def test_what_needs_the_host_is_found(self):
        done = compiled(FOR_THE_HOST + CLOSURES.replace("stress = law.stress_rate(",
                                                        "law.describe(), stress = law.stress_rate("))
        self.assertNotEqual(done.returncode, 0)
        for function in ("operator()", "format<"):  # of each of the two
            self.assertTrue(f"reference to __host__ function '{function}" in done.stderr, function)


if __name__ == "__main__":
    unittest.main()
