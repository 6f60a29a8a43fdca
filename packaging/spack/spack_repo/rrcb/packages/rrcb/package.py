from spack_repo.builtin.build_systems.cmake import CMakePackage

from spack.package import *


class Rrcb(CMakePackage):
    """Reduced recursive coordinate bisection: divides the particles of a parallel code among its
    processes so that each gets the same load, also in place of a method of Zoltan."""

    # rrcb.invalid stands for the address of the releases, the checksum for that of tools/release.
    homepage = "https://rrcb.invalid"
    url = "https://rrcb.invalid/releases/rrcb-0.2.0.tar.gz"
    git = "https://rrcb.invalid/rrcb.git"

    test_requires_compiler = True

    license("BSD-3-Clause")

    version("main", branch="main")
    version("0.2.0", sha256="0" * 64)

    variant("shared", default=True, description="rrcb::rrcb is the shared library")
    variant("zoltan", default=False, description="Build the plug-in for Zoltan")
    variant("teuchos", default=False, description="Build the parameter lists of Teuchos")
    variant("fortran", default=True, description="Build the module for Fortran")
    variant("tests", default=False, description="Build the tests, which spack install --test runs")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("fortran", type="build", when="+fortran")
    depends_on("cmake@3.22:", type="build")
    depends_on("mpi")
    depends_on("trilinos+zoltan", when="+zoltan")
    depends_on("trilinos+tpetra", when="+teuchos")
    depends_on("eigen@3.4:", type="build")
    depends_on("googletest", type="build", when="+tests")

    requires("platform=linux", msg="other linkers do not read the version script")
    conflicts("%gcc@:10", msg="C++20 is needed")
    conflicts("%clang@:13", msg="C++20 is needed")

    def cmake_args(self):
        return [
            self.define_from_variant("BUILD_SHARED_LIBS", "shared"),
            self.define_from_variant("RRCB_ZOLTAN", "zoltan"),
            self.define_from_variant("RRCB_TEUCHOS", "teuchos"),
            self.define_from_variant("RRCB_FORTRAN", "fortran"),
            self.define_from_variant("RRCB_TESTS", "tests"),
            self.define("RRCB_EXAMPLES", False),
            self.define("RRCB_BENCHMARKS", False),
        ]

    @run_after("install")
    def keep_the_consumer(self):
        cache_extra_test_sources(self, "tests/consumer")

    def test_consumer(self):
        """a project of its own against the installed package"""
        source = join_path(self.test_suite.current_test_cache_dir, "tests", "consumer")
        cmake = Executable(self.spec["cmake"].prefix.bin.cmake)
        prefixes = [self.prefix, *get_cmake_prefix_path(self)]
        cmake("-S", source, "-B", "build", self.define("CMAKE_PREFIX_PATH", prefixes))
        cmake("--build", "build")
        Executable(self.spec["cmake"].prefix.bin.ctest)("--test-dir", "build", "--no-tests=error")
