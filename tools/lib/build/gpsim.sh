# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# Sourced after setup.sh by the tools that run firmware: builds the simulated
# chips and their worlds into build/gpsim. `root` is the project's folder.

build_gpsim() {
    root=${root:-.}
    need cc:gcc c++:g++ :libc6-dev make cmake gpasm:gputils :gpsim-dev \
        :libsimavr-dev
    gpsim_build=$root/build/gpsim
    mkdir -p "$gpsim_build" 2>/dev/null || die "cannot create $gpsim_build"
    # A build from before the folder was moved would be refused.
    grep -qsxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root/sim/chip" \
        "$gpsim_build/CMakeCache.txt" ||
        rm -rf "$gpsim_build/CMakeCache.txt" "$gpsim_build/CMakeFiles"
    if ! { cmake -S "$root/sim/chip" -B "$gpsim_build" -G 'Unix Makefiles' &&
        make -C "$gpsim_build" -j 2; } >"$gpsim_build/log" 2>&1; then
        tail -n 30 "$gpsim_build/log" >&2
        die "could not build the simulated chips (all of it: $gpsim_build/log)"
    fi
}
