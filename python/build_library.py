# SPDX-License-Identifier: MIT
"""The library as a Python module: its declarations are the headers themselves.

The C preprocessor leaves of include/ what a compiler would see; cffi reads that. Of the
macros it takes those that are a number, and the C compiler says which number.
"""
import glob
import os
import re
import subprocess
import tempfile

from cffi import FFI

INCLUDE = os.path.join("..", "include")
SOURCE = os.path.join("..", "src")
TUNER = os.path.join("..", "sim", "tuner")  # the search for a table's points
NUMBER = re.compile(r"(?:UINT32_C\()?(?:0x[0-9A-F]+|\d+)[uUlL]*\)?|UINT32_MAX")

HEADERS = sorted(glob.glob(os.path.join(INCLUDE, "*.h"))) + [os.path.join(TUNER, "fit.h")]
TEXT = "".join(f'#include "{os.path.basename(path)}"\n' for path in HEADERS)


def preprocessed(*options):
    """TEXT without what the system's headers say, which cffi knows by itself."""
    with tempfile.TemporaryDirectory() as empty:
        for name in ("limits", "stdbool", "stddef", "stdint"):
            open(os.path.join(empty, name + ".h"), "w").close()
        command = [os.environ.get("CC", "cc"), "-E", "-P", "-nostdinc", "-I", INCLUDE, "-I", TUNER,
                   "-I", empty]
        return subprocess.run(command + list(options) + ["-x", "c", "-"], input=TEXT, check=True,
                              stdout=subprocess.PIPE, universal_newlines=True).stdout


def declarations():
    macros = re.findall(r"^#define (FIXPID_\w+) (.*)$", preprocessed("-dM"), re.MULTILINE)
    numbers = [name for name, value in macros if NUMBER.fullmatch(value)]
    # An inline function is declared like any other.
    declared = re.sub(r"static inline ([^{]*)\{[^}]*\}", r"\1;", preprocessed())
    return "".join(f"#define {name} ...\n" for name in sorted(numbers)) + declared


def beside(name):
    return sorted(glob.glob(os.path.join(SOURCE, name), recursive=True))


ffi = FFI()
ffi.cdef(declarations())
ffi.set_source("fixpid._library", TEXT, sources=beside("*/*.c") + [os.path.join(TUNER, "fit.c")],
               depends=beside("**/*.h") + HEADERS, include_dirs=[INCLUDE, TUNER], extra_compile_args=["-std=c99"])
