# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# shellcheck disable=SC2154 # root, here, work: of the runner, which sources this
# Arduino: the IDE's own builder with Debian's core for AVR, and a simulated Uno.

# sketch NAME BOARD [PREFERENCE]: builds it as the IDE does, into ./built, with what
# users get as an installed library. All warnings are on; those of Debian's core
# are not ours. (Its compiler lacks a name of the standard that the core uses.)
sketch() {
    user_files libraries/fixpid
    build_sketch "$@"
}

build_sketch() {
    rm -rf built
    mkdir built
    arduino-builder -compile -fqbn "arduino:avr:$2" -warnings all \
        -hardware /usr/share/arduino/hardware \
        -hardware /usr/share/arduino-builder -tools /usr/bin \
        -libraries "$PWD/libraries" -build-path "$PWD/built" -build-cache "$work/core" \
        -prefs=compiler.cpp.extra_flags=-DDECIMAL_DIG=__DECIMAL_DIG__ \
        ${3:+"-prefs=$3"} \
        "libraries/fixpid/examples/arduino/$1/$1.ino" >said 2>&1 || {
        cat said
        return 1
    }
    if grep -e "libraries/fixpid.*warning" -e "$1.ino.*warning" \
        -e '^WARNING' said; then
        return 1
    fi
}

# same_output NAME LINES: what the sketch prints on the simulated Uno is what it
# prints on this machine; LINES of it in loop().
same_output() {
    sketch "$1" uno
    {
        echo '#include <Arduino.h>'
        cat "libraries/fixpid/examples/arduino/$1/$1.ino"
    } >host.cpp
    find libraries/fixpid/src -name '*.c' -exec \
        gcc -O1 -Ilibraries/fixpid/src -c {} +
    g++ -std=gnu++11 -Wall -Wextra "-I$here/arduino" -Ilibraries/fixpid/src \
        host.cpp "$here/arduino/host.cc" ./*.o -o host
    ./host "$2" >host.txt
    gcc -O2 "$here/arduino/uno.c" -lsimavr -o uno
    ./uno "built/$1.ino.elf" "$(grep -c '' host.txt)" >uno.txt
    cat uno.txt
    cmp host.txt uno.txt
}

arduino_heater() {
    same_output Heater 60
    # It holds its setpoint.
    tail -n 1 uno.txt | grep -qE '^600 (599|600|601) '
}

arduino_autotune() {
    same_output Autotune 0
    grep -q '^status 2 after ' uno.txt # FIXPID_AUTOTUNE_DONE
    grep -q '^step .*: phase 6, 100 %' uno.txt
    same '400' "$(tail -n 2 uno.txt | sed -n '1s/ .*//p')"
}

# Nobody can define a macro in the IDE: the assembly must be there without one.
arduino_assembly() {
    sketch Heater uno 'compiler.c.extra_flags=-fno-lto -save-temps=obj'
    for noun in pid an937 an964 an964_8bit; do
        found=$(grep -A 1 '#APP' "built/libraries/fixpid/$noun/fixpid_$noun.c.s" |
            grep -c '/fixpid_[a-z0-9_]*avr.h"') || true
        echo "$noun: $found places of assembly"
        [ "$found" -gt 0 ]
    done
}

# The core's other chips: an ATmega32U4, an ATmega2560.
arduino_boards() {
    for board in leonardo mega:cpu=atmega2560; do
        rm -rf libraries built
        sketch Heater "$board"
    done
}

# Features for who cannot define a macro: fixpid_config.h is in a folder of its own
# beside the library, for each sketch that includes it, or in the library's src/,
# for all sketches.
arduino_config() {
    heater=libraries/fixpid/examples/arduino/Heater/Heater.ino
    mkdir -p libraries/fixpid_config
    echo '#define FIXPID_PID_FEATURES 0x01' >libraries/fixpid_config/fixpid_config.h
    sketch Heater uno compiler.c.extra_flags=-fno-lto
    step_is fixpid_pid_step
    sed -i '1i #include <fixpid_config.h>' "$heater"
    build_sketch Heater uno compiler.c.extra_flags=-fno-lto
    step_is fixpid_pid_step_0x01
    sed -i 1d "$heater"
    mv libraries/fixpid_config/fixpid_config.h libraries/fixpid/src
    build_sketch Heater uno compiler.c.extra_flags=-fno-lto
    step_is fixpid_pid_step_0x01
}

# step_is NAME: what the library's step is called, and the sketch calls.
step_is() {
    avr-nm built/libraries/fixpid/pid/fixpid_pid.c.o | grep " T $1$"
    avr-nm built/Heater.ino.elf | grep -i " t $1$"
}
