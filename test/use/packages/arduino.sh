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
    rebuild_sketch "$@"
}

# rebuild_sketch NAME BOARD [PREFERENCE]: with what is newer than in ./built.
rebuild_sketch() {
    arduino-builder -compile -fqbn "arduino:avr:$2" -warnings all \
        -hardware /usr/share/arduino/hardware \
        -hardware /usr/share/arduino-builder -tools /usr/bin \
        -built-in-libraries /usr/share/arduino/hardware/arduino/avr/libraries \
        -libraries "$PWD/libraries" -build-path "$PWD/built" -build-cache "$work/core" \
        -prefs=compiler.cpp.extra_flags=-DDECIMAL_DIG=__DECIMAL_DIG__ \
        ${3:+"-prefs=$3"} \
        "libraries/fixpid/examples/arduino/$1/$1.ino" >said 2>&1 || {
        cat said
        return 1
    }
    if grep -e "libraries/fixpid.*warning" -e "$1.ino.*warning" \
        -e '^WARNING' said | grep -v '^WARNING: Spurious \.[a-z]* folder in'; then
        return 1
    fi
}

# on_host NAME LINES: what the sketch prints on this machine, LINES of it in
# loop(), is host.txt. `world` is what room.h has to know.
world=
on_host() {
    {
        echo '#include <Arduino.h>'
        cat "libraries/fixpid/examples/arduino/$1/$1.ino"
    } >host.cpp
    [ -e fixpid_pid.o ] || find libraries/fixpid/src -name '*.c' -exec \
        gcc -O1 -Ilibraries/fixpid/src -c {} +
    g++ -std=gnu++11 -Wall -Wextra "-I$here/arduino" -Ilibraries/fixpid/src \
        ${world:+"-D$world"} host.cpp "$here/arduino/host.cc" ./*.o -o host &&
        ./host "$2" >host.txt
}

# judged NAME LINES OVERSHOOT STEPS: what the sketch prints on the simulated Uno is what
# it prints on this machine; the loop is as good as judge.rb is told; and the judge
# refuses the faults of test/faults.txt. Those run on this machine alone.
judged() {
    sketch "$1" uno
    on_host "$1" "$2"
    gcc -O2 "$here/arduino/uno.c" -lsimavr -o uno
    ./uno "built/$1.ino.elf" "$(grep -c '' host.txt)" >uno.txt
    cat uno.txt
    cmp host.txt uno.txt
    ruby "$here/arduino/judge.rb" uno.txt "$3" "$4"
    ino=libraries/fixpid/examples/arduino/$1/$1.ino
    cp "$ino" sound.ino
    mkdir -p "examples/arduino/$1"
    for number in 1 2; do
        cp sound.ino "examples/arduino/$1/$1.ino"
        ruby "$root/tools/lib/faults/seed.rb" "arduino $1" . "$number"
        cp "examples/arduino/$1/$1.ino" "$ino"
        on_host "$1" "$2"
        refused '^overshoot' ruby "$here/arduino/judge.rb" host.txt "$3" "$4"
        cat output
    done
    # A rate whose period is not whole milliseconds does not compile.
    sed 's/^\(const int RATE = \)[0-9]*;/\17;/' sound.ino >"$ino"
    refused 'RATE must divide 1000 ms' on_host "$1" "$2"
    cp sound.ino "$ino"
}

arduino_simulated() {
    judged 01.SimulatedHeater 320 5 70
}

arduino_heater() {
    judged 02.Heater 60 2 40
}

arduino_autotune() {
    judged 03.Autotune 0 5 120
    grep -q '^status 2 after ' uno.txt # FIXPID__DONE
    grep -q '^step .*: phase 6, 100 %' uno.txt
}

# The oven a hundred times as fast, by its RATE. It tunes from an erased EEPROM; then its
# sensor falls off, and it stays off until a person acknowledges; and when it starts the
# next time, it has its tuning.
arduino_oven() {
    world=OVEN
    user_files libraries/fixpid
    ino=libraries/fixpid/examples/arduino/04.OvenSsr/04.OvenSsr.ino
    sed -i 's/^\(const int RATE = \)1;/\1100;/' "$ino"
    build_sketch 04.OvenSsr uno
    on_host 04.OvenSsr 5000
    gcc -O2 -DOVEN "$here/arduino/uno.c" -lsimavr -o uno
    ./uno built/04.OvenSsr.ino.elf 5000 >uno.txt
    grep -v '^setpoint' uno.txt
    cmp host.txt uno.txt
    same 'kept ALARM acknowledged' \
        "$(grep -oE '^(kept|ALARM 0x1|acknowledged)' uno.txt | sed 's/ 0x1//' | xargs)"
    sed -n '/^ALARM/,/^acknowledged/p' uno.txt >latched.txt
    [ "$(grep -c '^setpoint.*,duty:0' latched.txt)" -gt 1000 ]
    same '' "$(grep '^setpoint' latched.txt | grep -v ',duty:0')"
    same 'setpoint:4000,reading:4000' "$(tail -n 1 uno.txt | sed 's/,duty.*//')"
    ./host 2500 >second.txt
    same '' "$(grep -e tuning -e ALARM second.txt)"
    ruby "$here/arduino/judge.rb" second.txt 5 150
    cp "$ino" sound.ino
    for factor in '* 10' '/ 10'; do
        sed "s|(void)fixpid_pid_init(|config.gains.ki_q24 = config.gains.ki_q24 $factor; &|" sound.ino >"$ino"
        on_host 04.OvenSsr 2500
        refused '^overshoot' ruby "$here/arduino/judge.rb" host.txt 5 150
        cat output
    done
}

# The sketch Live fifty times as fast, by its RATE, at a baud rate of its UART, of which
# simavr makes half.
fast_live() {
    sed -i -e 's/^\(const int RATE = \)50;/\12500;/' \
        -e 's/^\(const unsigned long BAUD = \)115200;/\1500000;/' \
        libraries/fixpid/examples/arduino/05.Live/05.Live.ino
    build_sketch 05.Live uno
}

# Its steps are made again on this machine, while commands change setpoint and gains, and
# while the wire is noisy. A bit of the library that is another, and a sketch that does not
# use the link's setpoint, are noticed.
arduino_live() {
    user_files libraries/fixpid
    fast_live
    support=$root/test/support
    # shellcheck disable=SC2046 # a list of files
    gcc -std=c99 -O2 -Wall -Wextra -Ilibraries/fixpid/src -Ilibraries/fixpid/include \
        "-I$support" "-I$root/sim/link" "$here/arduino/live.c" \
        $(find libraries/fixpid/src/link libraries/fixpid/src/pid libraries/fixpid/src/record -name '*.c') \
        "$support/link_session.c" "$support/numbers.c" \
        "$root"/sim/link/link_twin.c "$root"/sim/link/link_frames.c -lsimavr -o live
    ./live built/05.Live.ino.elf 100000 5000 1000
    mkdir sound
    mv libraries built sound
    for number in 1 2; do
        rm -rf libraries built
        cp -Rp sound/* .
        ruby "$root/tools/lib/faults/seed.rb" 'arduino 05.Live' libraries/fixpid "$number"
        rebuild_sketch 05.Live uno
        refused 'a step is different\|not all are right' \
            ./live built/05.Live.ino.elf 3000 500 500
        cat output
    done
}

# Nobody can define a macro in the IDE: the assembly must be there without one.
arduino_assembly() {
    sketch 02.Heater uno 'compiler.c.extra_flags=-fno-lto -save-temps=obj'
    for noun in pid an937 an964 an964_8bit; do
        found=$(grep -A 1 '#APP' "built/libraries/fixpid/$noun/fixpid_$noun.c.s" |
            grep -c '/fixpid_[a-z0-9_]*avr.h"') || true
        echo "$noun: $found places of assembly"
        [ "$found" -gt 0 ]
    done
}

# The core's other chips: an ATmega32U4, an ATmega2560.
# With a clone as the library, of whose folders with a dot the builder says that they are
# spurious.
arduino_boards() {
    mkdir libraries
    whole_tree libraries/fixpid
    for board in leonardo mega:cpu=atmega2560; do
        build_sketch 02.Heater "$board"
    done
}

# What the library manager demands, and a fault of each kind.
arduino_lint() {
    user_files fixpid
    quiet ruby "$here/arduino_lint.rb" fixpid
    while IFS='|' read -r change message; do
        cp -R fixpid kept
        (cd fixpid && eval "$change")
        refused "^$message" ruby "$here/arduino_lint.rb" fixpid
        rm -rf fixpid
        mv kept fixpid
    done <<'FAULTS'
sed -i /^paragraph=/d library.properties|no paragraph$
sed -i s/^version=.*/version=1.0/ library.properties|the version is not that
sed -i s/^category=.*/category=Control/ library.properties|Control is no category$
sed -i s/^url=.*/url=fixpid/ library.properties|the url is none$
sed -i s/^includes=/includes=none.h,/ library.properties|src has no none.h$
mkdir utility|the folder utility$
ln -s src more|the link .*/more$
mv examples/arduino/02.Heater examples/arduino/Heater|.*02.Heater.ino is not called as its folder$
sed -i 1p keywords.txt|a keyword stands twice$
FAULTS
}

# Features for who cannot define a macro: fixpid_config.h is in a folder of its own
# beside the library, for each sketch that includes it, or in the library's src/,
# for all sketches.
arduino_config() {
    heater=libraries/fixpid/examples/arduino/02.Heater/02.Heater.ino
    mkdir -p libraries/fixpid_config
    echo '#define FIXPID_PID_FEATURES 0x01' >libraries/fixpid_config/fixpid_config.h
    sketch 02.Heater uno compiler.c.extra_flags=-fno-lto
    step_is fixpid_pid_step
    sed -i '1i #include <fixpid_config.h>' "$heater"
    build_sketch 02.Heater uno compiler.c.extra_flags=-fno-lto
    step_is fixpid_pid_step_0x01
    sed -i 1d "$heater"
    mv libraries/fixpid_config/fixpid_config.h libraries/fixpid/src
    build_sketch 02.Heater uno compiler.c.extra_flags=-fno-lto
    step_is fixpid_pid_step_0x01
}

# Points in flash, from a sketch.
arduino_table() {
    heater=libraries/fixpid/examples/arduino/02.Heater/02.Heater.ino
    user_files libraries/fixpid
    cat - "$heater" >with_table <<'END'
#include <fixpid_table.h>
static const fixpid_table_point points[] PROGMEM = {{0, 0}, {2, -1}};
static const fixpid_table curve = FIXPID_TABLE(points);
volatile int16_t height = fixpid_table_at_P(&curve, 1);
END
    mv with_table "$heater"
    build_sketch 02.Heater uno compiler.c.extra_flags=-fno-lto
    avr-nm built/02.Heater.ino.elf | grep ' T fixpid_table_at_P$'
}

# step_is NAME: what the library's step is called, and the sketch calls.
step_is() {
    avr-nm built/libraries/fixpid/pid/fixpid_pid.c.o | grep " T $1$"
    avr-nm built/02.Heater.ino.elf | grep -i " t $1$"
}
