# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# Sourced by refit and study, after setup.sh, with `root` set: builds
# sim/random_plants and sets `program` to it.
# shellcheck source=tools/lib/build/cmake.sh
. "${root:?}/tools/lib/build/cmake.sh"

# numbers WORD...: whether all are whole numbers, two at most.
numbers() {
    [ $# -le 2 ] || return 1
    for number in "$@"; do
        case $number in
        '' | *[!0-9]*) return 1 ;;
        esac
    done
}

build_random_plants() {
    need cmake ninja:ninja-build cc:gcc :libc6-dev ruby
    build=$root/build/host-examples
    work_folder "$build" 64
    cmake_build sim/random_plants "$root" "$build" -DCMAKE_BUILD_TYPE=Release \
        -DFIXPID_BUILD_EXAMPLES=ON -DFIXPID_BUILD_TESTS=OFF -- fixpid_random_plants
    # shellcheck disable=SC2034 # for what sources this
    program=$build/sim/random_plants
}
