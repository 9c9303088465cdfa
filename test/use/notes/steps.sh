# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# shellcheck disable=SC2154 # root, here: from test/matrix.txt, whose rows these are steps of

# program CHIP NAME WORD...: of C, with SDCC
program() {
    chip=$1 name=$2
    shift 2
    "$root/tools/lib/build/build_pic" "$chip" "$PWD/$name" "-I$root/include" \
        "-I$root/port/pic/$chip" "-I$here" "$@"
}

# differ BEFORE AFTER WORD...: how many of the outputs do that both programs have in gpsim.
differ() {
    before=$1 after=$2
    shift 2
    ../notes "$before.cod" "$@" >"$before.txt"
    ../notes "$after.cod" "$@" >"$after.txt"
    [ "$(grep -c '' "$before.txt")" -ge 400 ] || return 1
    diff "$before.txt" "$after.txt" | grep -c '^>'
}
