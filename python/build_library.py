# SPDX-License-Identifier: MIT
"""The library as a Python module: its declarations are the headers themselves.

The C preprocessor leaves of include/ what a compiler would see; cffi reads that. Of the
macros it takes those that are a number, and the C compiler says which number.

The sources are those of the repository, or in an sdist their copy, `c/`. The tuner page's C,
with its plants, is a library of its own, because it has its own math.h.
"""
import glob
import os
import re
import subprocess
import tempfile

from cffi import FFI

from headers import NUMBER

ROOT = "c" if os.path.isdir("c") else ".."
INCLUDE, SOURCE, SIM = (os.path.join(ROOT, folder) for folder in ("include", "src", "sim"))
IDENTIFY, LINK, TUNER = (os.path.join(SIM, folder) for folder in ("identify", "link", "tuner"))


def beside(*names):
    return sorted(glob.glob(os.path.join(*names), recursive=True))


HEADERS = beside(INCLUDE, "*.h")
READ = HEADERS + [os.path.join(SIM, *path.split("/")) for path in (
    "identify/identify.h", "identify/loop.h", "identify/verdict.h", "tuner/fit.h", "tuner/margins.h", "tuner/tuner.h", "link/link_frames.h", "link/link_twin.h")]
TEXT = "".join(f'#include "{os.path.basename(path)}"\n' for path in READ)

# What the page is made of: tools/lib/pages/tuner/sources.rb has the same.
PAGE = beside(TUNER, "*.c") + beside(IDENTIFY, "*.c") + [
    os.path.join(SIM, "loops", "pid_double.c"),
    *(os.path.join(SIM, "plant", f"plant_{plant}.c") for plant in ("motor", "oven", "pendulum", "process"))]
PAGE_LIBRARY = ("fixpid_tuner", {
    "sources": PAGE, "cflags": ["-std=c99", "-ffp-contract=off", "-fno-builtin", "-D_DEFAULT_SOURCE"],
    "include_dirs": [os.path.join(TUNER, "libm"), INCLUDE, os.path.join(SIM, "plant"), os.path.join(SIM, "loops"), IDENTIFY, TUNER],
    "obj_deps": {"": beside(SIM, "**", "*.h") + HEADERS}})


def preprocessed(*options):
    """TEXT without what the system's headers say, which cffi knows by itself."""
    with tempfile.TemporaryDirectory() as empty:
        for name in ("limits", "stdbool", "stddef", "stdint"):
            open(os.path.join(empty, name + ".h"), "w").close()
        command = [os.environ.get("CC", "cc"), "-E", "-P", "-nostdinc", "-I", INCLUDE, "-I", TUNER,
                   "-I", IDENTIFY, "-I", LINK, "-I", empty]
        return subprocess.run(command + list(options) + ["-x", "c", "-"], input=TEXT, check=True,
                              stdout=subprocess.PIPE, universal_newlines=True).stdout


def declarations():
    macros = re.findall(r"^#define ((?:FIXPID|IDENTIFY|LINK|LOOP|TUNER)_\w+) (.*)$", preprocessed("-dM"), re.MULTILINE)
    numbers = [name for name, value in macros if NUMBER.fullmatch(value)]
    # An inline function is declared like any other.
    declared = re.sub(r"static inline ([^{]*)\{[^}]*\}", r"\1;", preprocessed())
    return "".join(f"#define {name} ...\n" for name in sorted(numbers)) + declared


def loops(declared):
    """{a declaration: its body}: for each step, and for a table, a function of whole arrays."""
    found = {}
    for result, name, noun, arguments in re.findall(
            r"(\w+) (fixpid_(\w+?)_(?:step|at))\((?:const)? *struct fixpid_\3 \*self,([^*;)]*)\);", declared):
        names = [one.split()[-1] for one in arguments.split(",")]
        columns = "".join(f"const {one.strip().replace(' ', ' *')}, " for one in arguments.split(","))
        found[f"void each_{name}(struct fixpid_{noun} *self, size_t count, {columns}{result} *results)"] = (
            f"{{\n    for (size_t at = 0; at < count; at++) {{\n        results[at] = {name}"
            f"(self, {', '.join(f'{one}[at]' for one in names)});\n    }}\n}}\n")
    return found


ffi = FFI()
DECLARED = declarations()
LOOPS = loops(DECLARED)
ffi.cdef(DECLARED + "".join(f"{one};\n" for one in LOOPS))
# The twin of a live link is in the library itself: it is a controller.
SOURCES = beside(SOURCE, "*", "*.c") + [os.path.join(LINK, name) for name in ("link_frames.c", "link_twin.c")]
ffi.set_source("fixpid._library", TEXT + "".join(f"static {one}\n{body}" for one, body in LOOPS.items()), sources=SOURCES, depends=beside(SOURCE, "**", "*.h") + READ + PAGE,
               include_dirs=[INCLUDE, IDENTIFY, TUNER, LINK], extra_compile_args=["-std=c99"])
