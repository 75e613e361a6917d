# SPDX-License-Identifier: Zlib
"""The library, from the tree that this stands in: conan create packaging/conan."""
import os

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy

PARTS = ("CMakeLists.txt", "LICENSE", "bullet_wetcloth/*", "cmake/*")


class BulletWetclothConan(ConanFile):
    name = "bullet_wetcloth"
    version = "0.1.0"
    description = "Cloth that gets wet, for applications that use Bullet"
    license = "Zlib"
    topics = ("bullet", "cloth", "physics", "simulation")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "exact": [True, False]}
    default_options = {"shared": False, "exact": True}

    def export_sources(self):
        root = os.path.join(self.recipe_folder, "..", "..")
        for part in PARTS:
            copy(self, part, root, self.export_sources_folder)

    def layout(self):
        cmake_layout(self, src_folder=".")

    def requirements(self):
        # Bullet's classes are in the headers, and its layout in the archives.
        self.requires("bullet3/3.25", transitive_headers=True, transitive_libs=True)
        self.requires("eigen/3.4.0", visible=False)
        if self.options.exact:
            self.requires("boost/1.86.0", visible=False, headers=True, libs=False)

    def validate(self):
        check_min_cppstd(self, 17)

    @property
    def _bullet(self):
        return self.dependencies["bullet3"]

    @property
    def _suffix(self):
        return "-float64" if self._bullet.options.get_safe("double_precision") else ""

    def generate(self):
        CMakeDeps(self).generate()
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["BULLET_ROOT"] = self._bullet.package_folder
        toolchain.cache_variables["WETCLOTH_BUILD_TESTS"] = False
        toolchain.cache_variables["WETCLOTH_BUILD_EXAMPLES"] = False
        toolchain.cache_variables["WETCLOTH_BUILD_COMMAND"] = False
        toolchain.cache_variables["WETCLOTH_EXACT_COLLISION"] = bool(self.options.exact)
        if self.options.exact:
            toolchain.cache_variables["WETCLOTH_BOOST_INCLUDE_DIR"] = self.dependencies["boost"].cpp_info.includedirs[0]
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        CMake(self).install()

    def package_info(self):
        self.cpp_info.set_property("cmake_file_name", "bullet_wetcloth")
        collision = self.cpp_info.components["collision"]
        collision.set_property("cmake_target_name", "bullet_wetcloth::collision")
        collision.libs = ["bullet_wetcloth_collision"]
        cloth = self.cpp_info.components["cloth"]
        cloth.set_property("cmake_target_name", f"bullet_wetcloth::bullet_wetcloth{self._suffix}")
        cloth.libs = [f"bullet_wetcloth{self._suffix}"]
        cloth.requires = ["collision", "bullet3::bullet3"]
        for component in (collision, cloth):
            if self.options.shared:
                component.defines.append("WETCLOTH_SHARED")
        if self._suffix:
            cloth.defines.append("BT_USE_DOUBLE_PRECISION")
