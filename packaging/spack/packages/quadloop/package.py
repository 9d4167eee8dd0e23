# The Spack recipe: `spack repo add packaging/spack && spack install quadloop` (docs/how-to/cluster.md).
from spack_repo.builtin.build_systems.cmake import CMakePackage

from spack.package import *


class Quadloop(CMakePackage):
    """Parallel 2D mesh generation, smoothing and adaptive remeshing for flow solvers."""

    license("GPL-3.0-or-later")

    # From a checkout: spack dev-build, or spack develop in an environment.
    version("main", branch="main")

    variant("python", default=True, description="Python package")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("pkgconfig", type="build")

    depends_on("mpi")
    depends_on("p4est@2.2: +mpi")
    depends_on("hdf5@1.10: +hl")
    depends_on("cgns@4.3: +hdf5")
    depends_on("nlopt@2.7: +cxx")
    depends_on("cgal@5.5:")
    depends_on("boost")
    depends_on("eigen@3.4:")
    depends_on("tomlplusplus@3:")
    depends_on("fmt@9:")
    depends_on("spdlog@1.10:")
    depends_on("nlohmann-json@3.11:")
    depends_on("expat")
    depends_on("zlib-api")
    depends_on("cli11@2.2:")
    depends_on("cairo +png +pdf +svg")
    depends_on("libpng")
    depends_on("gdal@3.6:")

    extends("python@3.11:", when="+python")
    depends_on("py-pybind11@2.10:", type="build", when="+python")
    depends_on("py-numpy", type=("build", "run"), when="+python")
    depends_on("py-mpi4py", type="run", when="+python")

    generator("ninja")

    def cmake_args(self):
        arguments = [self.define("QUADLOOP_TESTS", False), self.define("CMAKE_UNITY_BUILD", True)]
        if self.spec.satisfies("+python"):
            python = self.spec["python"]
            folder = f"lib/python{python.version.up_to(2)}/site-packages"
            arguments += [self.define("QUADLOOP_PYTHON", python.command.path), self.define("QUADLOOP_PYTHON_DIR", folder)]
        return arguments
