# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# Sourced by refit and study, after setup.sh, with `root` set: builds
# sim/random_plants and sets `program` to it.

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
    need cmake cc:gcc :libc6-dev make ruby
    build=${root:?}/build/host-examples
    work_folder "$build" 64
    {
        cmake -S "$root" -B "$build" -G 'Unix Makefiles' \
            -DCMAKE_BUILD_TYPE=Release \
            -DFIXPID_BUILD_EXAMPLES=ON -DFIXPID_BUILD_TESTS=OFF &&
            make -C "$build" fixpid_random_plants
    } >"$build/log" 2>&1 || {
        tail -n 30 "$build/log" >&2
        die "could not build sim/random_plants (all of it: $build/log)"
    }
    # shellcheck disable=SC2034 # for what sources this
    program=$build/sim/random_plants
}
