# SPDX-License-Identifier: GPL-3.0-or-later
# A recipe of Spack. Put this folder as packages/spam into a repository of your own (`spack repo create`), and say in
# `git` where your clone of SPAM is. Written by Spack's manual; not run.
from spack.package import *


class Spam(CMakePackage):
    """Smooth-particle applied mechanics as an ODE system on SUNDIALS."""

    git = "file:///path/to/spam"
    license("GPL-3.0-or-later")

    version("main", branch="main")
    version("0.1.0", tag="v0.1.0")

    variant("shared", default=True, description="Build a shared library")
    variant("problems", default=True, description="Build problems, spam-view and the command spam")

    variant("python", default=False, description="Build the Python module spam_mechanics")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("cli11@2.1:", type="build")
    depends_on("nlohmann-json@3.10:", type="build")
    depends_on("tomlplusplus@3.3:")
    depends_on("sundials@6.4: +arkode+cvode~mpi")
    depends_on("hdf5@1.10: ~mpi")
    depends_on("eigen@3.4:")
    depends_on("gsl")
    depends_on("boost@1.74:", type="build", when="+problems")
    depends_on("fmt@9:")
    depends_on("fftw@3: precision=double")
    depends_on("nettle@3:")
    depends_on("gnuplot", type="run", when="+problems")

    with when("+python"):
        extends("python")
        depends_on("python@3.9:", type=("build", "link", "run"))
        depends_on("py-pybind11@2.10:", type="build")
        depends_on("py-numpy", type=("build", "run"))

    generator("ninja")

    def cmake_args(self):
        arguments = [
            self.define("SPAM_BUILD_TESTS", self.run_tests),
            self.define_from_variant("BUILD_SHARED_LIBS", "shared"),
            self.define_from_variant("SPAM_BUILD_PROBLEMS", "problems"),
            self.define_from_variant("SPAM_BUILD_VIEW", "problems"),
            self.define_from_variant("SPAM_BUILD_PYTHON", "python"),
        ]
        if self.spec.satisfies("+python"):
            arguments += [
                self.define("Python_EXECUTABLE", self.spec["python"].command.path),
                self.define("SPAM_PYTHON_INSTALL_DIR", self.spec["python"].package.platlib),
            ]
        return arguments
