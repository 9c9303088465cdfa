# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# Sourced after setup.sh by the tools that run firmware: builds the simulated
# chips and their worlds into build/gpsim. `root` is the project's folder.
# shellcheck source=tools/lib/build/cmake.sh
. "${root:?}/tools/lib/build/cmake.sh"

build_gpsim() {
    need cc:gcc c++:g++ :libc6-dev cmake ninja:ninja-build gpasm:gputils :gpsim-dev \
        :libsimavr-dev
    gpsim_build=$root/build/gpsim
    cmake_build 'the simulated chips' "$root/sim/chip" "$gpsim_build"
}
