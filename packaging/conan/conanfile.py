import os

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy

required_conan_version = ">=2.0"


class GeneClocksConan(ConanFile):
    name = "gene-clocks"
    version = "0.1.0"
    description = "Decentralized innovation marking for distributed NEAT"
    license = "Apache-2.0"
    topics = ("neat", "neuroevolution", "logical-clocks", "swarm-robotics")
    package_type = "static-library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"neat": [True, False]}
    default_options = {"neat": False}

    def export_sources(self):
        root = os.path.join(self.recipe_folder, "..", "..")
        for pattern in ("CMakeLists.txt", "LICENSE", "cmake/*", "protocol/*", "neat/*"):
            copy(self, pattern, root, self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def requirements(self):
        if self.options.neat:
            self.requires("eigen/3.4.0", transitive_headers=True)

    def validate(self):
        check_min_cppstd(self, 20)

    def generate(self):
        CMakeDeps(self).generate()
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["GENE_CLOCKS_BUILD_NEAT"] = bool(self.options.neat)
        toolchain.cache_variables["GENE_CLOCKS_BUILD_SIM"] = False
        toolchain.cache_variables["GENE_CLOCKS_BUILD_TESTS"] = False
        toolchain.cache_variables["GENE_CLOCKS_BUILD_BENCH"] = False
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()

    def package_info(self):
        # The project's own package file has the targets and finds what they need.
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs.append(os.path.join("lib", "cmake", "GeneClocks"))
