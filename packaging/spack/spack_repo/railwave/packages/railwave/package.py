# A recipe for Spack 1; docs/install.md says how it is used and what was tried.
import pathlib

from spack_repo.builtin.build_systems.cmake import CMakePackage, generator

from spack.package import *

CHECKOUT = pathlib.Path(__file__).resolve().parents[6]


class Railwave(CMakePackage):
    """Explicit finite elements for the dynamic interaction of wheel and rail: frictional rolling contact and the
    high-frequency dynamics of wheel, rail and track in one calculation."""

    # Railwave has no address yet: what is fetched is the checkout that this recipe lies in.
    git = CHECKOUT.as_uri()

    license("Apache-2.0")

    version("main", branch="main")

    variant("mpi", default=True, description="Runs over several processes")
    variant("python", default=True, description="The Python module")
    variant("pictures", default=True, description="What railwave-picture needs", when="+python")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.21:", type="build")
    generator("ninja")
    # The completion and the manual page are written by Python.
    depends_on("python@3.9:", type="build")

    # Builds for CUDA go by scripts/cuda.
    depends_on("kokkos@3.4: +openmp +serial +pic ~shared ~cuda cxxstd=17")
    depends_on("hdf5@1.10: ~mpi")
    depends_on("zlib-api")
    depends_on("eigen@3.4:3")
    depends_on("fmt@9:")
    depends_on("spdlog@1.10:")
    depends_on("tomlplusplus@3:", type="build")
    depends_on("nlohmann-json@3:", type="build")
    depends_on("cli11@2:", type="build")
    depends_on("spectra@1:", type="build")
    depends_on("mpi", when="+mpi")
    depends_on("metis@5:", when="+mpi")

    extends("python", when="+python")
    depends_on("py-pybind11@2.9:", when="+python", type="build")
    depends_on("py-numpy", when="+python", type=("build", "run"))
    depends_on("py-h5py", when="+pictures", type="run")
    depends_on("py-matplotlib", when="+pictures", type="run")
    depends_on("py-pillow", when="+pictures", type="run")

    def cmake_args(self):
        arguments = [
            self.define("RAILWAVE_NATIVE", False),  # Spack's compilers know the target
            self.define("RAILWAVE_SOURCE_PLACES", False),
            self.define("RAILWAVE_TESTS", False),
            self.define_from_variant("RAILWAVE_MPI", "mpi"),
            self.define_from_variant("RAILWAVE_MODULE", "python"),
        ]
        if self.spec.satisfies("+python"):
            arguments += [
                self.define("RAILWAVE_PYTHON_DIR", python_platlib),
                self.define("PYTHON_EXECUTABLE", self.spec["python"].command.path),
            ]
        return arguments
