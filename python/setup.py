# SPDX-License-Identifier: MIT
"""Builds the package out of ../include and ../src, as they are in the repository."""
import os
import re

from setuptools import setup

# pip builds where the package stands: what that leaves is kept out of the sources.
BUILT = os.path.join("..", "build", "python", "setup")


def version():
    with open(os.path.join("..", "include", "fixpid.h"), encoding="ascii") as header:
        return ".".join(re.findall(r"#define FIXPID_VERSION_\w+ (\d+)", header.read()))


os.chdir(os.path.dirname(os.path.abspath(__file__)))
os.makedirs(BUILT, exist_ok=True)
setup(
    name="fixpid",
    version=version(),
    description="Fixed-point PID controllers in C, step by step the same from Python",
    license="MIT",
    packages=["fixpid"],
    cffi_modules=["build_library.py:ffi"],
    install_requires=["cffi", "numpy"],
    options={"build": {"build_base": BUILT}, "egg_info": {"egg_base": BUILT}},
)
