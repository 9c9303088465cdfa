# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# shellcheck disable=SC2154 # root: from test/matrix.txt, whose rows these are steps of

# The tool builds into build/firmware, whatever folder it is started in.
folder=$root/build/firmware

firmware() {
    "$root/tools/firmware" "$@"
}

# ends STATUS WORDS COMMAND...: it ends so, and says that.
ends() {
    status=$1 words=$2 found=0
    shift 2
    "$@" >output 2>&1 || found=$?
    cat output
    same "$status and $words" "$found and $(grep -oF -m 1 -e "$words" output)"
}

# made NAME CHIP: the firmware that was asked for last is for that chip.
made() {
    [ -f "$folder/$1.hex" ]
    same "$2" "$(ruby -rjson -e 'puts JSON.parse(File.read(ARGV[0])).fetch(ARGV[1])["chip"]' "$folder/sizes.json" "$1")"
}

# template COMMAND...: tools/firmware with a copy of port/template, ./own, as a port of one's own.
template() {
    [ -d own ] || cp -R "$root/port/template" own
    chip=$1
    shift
    firmware --chip "$chip" --port "$PWD/own" "$@"
}

# cleared CHIP RANGE...: the start-up that was made for it clears its RAM.
cleared() {
    chip=$1
    shift
    [ -x cleared ] ||
        g++ -std=c++17 -O1 -Wall -Wextra -Wpedantic -Wshadow -Werror "-I$root/sim/chip" \
            "$root/test/use/firmware/cleared.cc" "$root/build/gpsim/libchip.a" -lgpsim -o cleared
    template "$chip" pendulum >/dev/null
    ./cleared "$folder/pendulum_$chip.cod" "$@"
}
