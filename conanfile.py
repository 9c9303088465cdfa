# SPDX-License-Identifier: MIT
import os

from conan import ConanFile
from conan.tools.cmake import CMake, cmake_layout
from conan.tools.files import copy


class Fixpid(ConanFile):
    name = "fixpid"
    version = "1.0.0"
    description = "Fixed-point PID controllers with an autotuner, without float, for small chips"
    license = "MIT"
    topics = ("pid", "control", "fixed-point", "autotune", "motor", "heater")
    exports_sources = ("CMakeLists.txt", "LICENSE", "fixpid.pc.in", "include/*", "meson.build", "src/*")
    package_type = "static-library"
    languages = "C"
    settings = "os", "compiler", "build_type", "arch"
    generators = "CMakeToolchain"

    def layout(self):
        cmake_layout(self)

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", self.source_folder,
             os.path.join(self.package_folder, "licenses"))
        CMake(self).install()

    def package_info(self):
        self.cpp_info.libs = ["fixpid"]
        self.cpp_info.set_property("cmake_file_name", "fixpid")
        self.cpp_info.set_property("cmake_target_name", "fixpid::fixpid")
        self.cpp_info.set_property("pkg_config_name", "fixpid")
