# SPDX-License-Identifier: MIT
"""Builds the package out of ../include, ../src and ../sim, as they are in the repository, or
out of their copy in an sdist."""
import os
import re
import shutil
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
os.chdir(HERE)
sys.path.insert(0, HERE)  # build_library.py and headers.py

from setuptools import setup
from setuptools.command.build_clib import build_clib
from setuptools.command.build_py import build_py
from setuptools.command.sdist import sdist

import build_library
import headers

# pip builds where the package stands: what that leaves is kept out of the sources.
BUILT = "build" if build_library.ROOT == "c" else os.path.join("..", "build", "python", "setup")


class WithProse(build_py):
    """What the headers say is a part of the package."""

    def run(self):
        super().run()
        headers.write(os.path.join(self.build_lib, "fixpid"), build_library.HEADERS)


class InFolder(build_clib):
    """gcc writes to `temp/../sim`, for which `temp` has to be there."""

    def run(self):
        os.makedirs(self.build_temp, exist_ok=True)
        super().run()


class WithSources(sdist):
    """An sdist has the C in it, and so builds anywhere."""

    def make_release_tree(self, base_dir, files):
        super().make_release_tree(base_dir, [file for file in files if not file.startswith("..")])
        self.distribution.metadata.write_pkg_info(base_dir)
        for folder in "include", "src", "sim/identify", "sim/tuner", "sim/plant", "sim/loops", "sim/link":
            shutil.copytree(os.path.join(build_library.ROOT, folder), os.path.join(base_dir, "c", folder))
        if build_library.ROOT == "..":
            shutil.copy(os.path.join("..", "LICENSE"), base_dir)


def version():
    with open(os.path.join(build_library.INCLUDE, "fixpid.h"), encoding="ascii") as header:
        return ".".join(re.findall(r"#define FIXPID_VERSION_\w+ (\d+)", header.read()))


def readme():
    with open("README.md", encoding="utf-8") as page:
        return page.read()


os.makedirs(BUILT, exist_ok=True)
setup(
    name="fixpid",
    version=version(),
    description="Fixed-point PID controllers in C, step by step the same from Python",
    long_description=readme(),
    long_description_content_type="text/markdown",
    license="MIT",
    classifiers=["Development Status :: 4 - Beta", "Intended Audience :: Developers", "Programming Language :: C",
                 "Programming Language :: Python :: 3", "Topic :: Scientific/Engineering", "Typing :: Typed"],
    python_requires=">=3.8",
    packages=["fixpid"],
    package_data={"fixpid": ["py.typed", "*.pyi"]},
    cffi_modules=["build_library.py:ffi"],
    libraries=[build_library.PAGE_LIBRARY],
    install_requires=["cffi"],
    extras_require={"plot": ["matplotlib"], "arrays": ["numpy"]},
    cmdclass={"build_py": WithProse, "build_clib": InFolder, "sdist": WithSources},
    options={"build": {"build_base": BUILT}, "egg_info": {"egg_base": BUILT},
             "bdist_wheel": {"py_limited_api": "cp38"}},
)
