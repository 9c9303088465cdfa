# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# Sourced after setup.sh by the tools that build with CMake.

# cmake_build WHAT SOURCE BUILD [OPTION]... [-- TARGET...]: builds a folder with CMake and
# Ninja, which starts nothing where nothing has changed. Quiet unless it fails; `WHAT` is
# what could not be built then. A build from before the folder was moved, or by make, would
# be refused, and one that was killed may have left a file half written: they begin anew.
cmake_build() {
    what=$1 source=$(CDPATH='' cd -- "$2" && pwd -P) build=$3 options=
    shift 3
    while [ $# -gt 0 ] && [ "$1" != -- ]; do
        options="$options $1"
        shift
    done
    [ $# -eq 0 ] || shift
    if [ -e "$build/unfinished" ] ||
        ! grep -qsxF "CMAKE_HOME_DIRECTORY:INTERNAL=$source" "$build/CMakeCache.txt" ||
        ! grep -qsxF CMAKE_GENERATOR:INTERNAL=Ninja "$build/CMakeCache.txt"; then
        rm -rf "$build"
    fi
    { mkdir -p "$build" && : >"$build/unfinished"; } 2>/dev/null || die "cannot write in $build"
    built=0
    # shellcheck disable=SC2086 # a list of options
    { cmake -S "$source" -B "$build" -G Ninja $options &&
        ninja -C "$build" -j 2 "$@"; } >"$build/log" 2>&1 || built=$?
    rm "$build/unfinished"
    [ $built -eq 0 ] || {
        tail -n 30 "$build/log" >&2
        die "could not build $what (all of it: $build/log)"
    }
}
