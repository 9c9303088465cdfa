# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# shellcheck disable=SC2154 # root, here, work: from test/matrix.txt, whose rows these are steps of

export CMAKE_GENERATOR=Ninja # as west, idf.py and vcpkg have it

# whole_tree FOLDER: what git has, and no history.
whole_tree() {
    mkdir "$1"
    for entry in "$root"/* "$root"/.[a-z]*; do
        case ${entry##*/} in
        build | .git) ;;
        *) cp -R "$entry" "$1" ;;
        esac
    done
}

# of_project EXPRESSION: in Ruby, such as Project::VERSION.
of_project() {
    (cd "$root" && ruby -r./tools/lib/project -e "puts $1")
}

# small_files FOLDER: what a program's sources take in.
small_files() {
    mkdir "$1"
    of_project Project::SMALL_FILES | while read -r path; do
        cp -R "$root/$path" "$1"
    done
}

# quick_start COMMAND...: it prints what docs/start/index.md has for the quick start.
quick_start() {
    "$@" >printed || return 1
    sed -n '/quick_start_output:begin/,/quick_start_output:end/p' "$root/docs/start/index.md" |
        grep ' s: ' | cmp - printed
}

# --- single headers, as tools/release makes them ---

# single_headers: all of them, and a source that implements each, where another header
# includes it once more, in the working folder.
single_headers() {
    (cd "$root" && ruby tools/lib/build/single_header.rb "$OLDPWD")
    for header in *_single.h; do
        noun=${header%_single.h}
        printf '#define %s_IMPLEMENTATION\n#include "%s"\n#include "%s"\n' \
            "$(echo "$noun" | tr '[:lower:]' '[:upper:]')" "$header" "$header" \
            >"$noun.c"
    done
}

# --- Meson and pkg-config ---

# uses_pc FOLDER: a program that pkg-config finds the library for, in FOLDER.
uses_pc() {
    export PKG_CONFIG_PATH="$1/pkgconfig"
    pkg-config --validate fixpid
    same "$(of_project Project::VERSION)" "$(pkg-config --modversion fixpid)"
    # shellcheck disable=SC2046 # lists of options
    quiet cc $(pkg-config --cflags fixpid) "$root/examples/quick_start.c" \
        $(pkg-config --libs fixpid) -o app
    quick_start ./app
}

# flags_are FLAGS COMMAND...: what pkg-config says.
flags_are() {
    wanted=$1
    shift
    same "$wanted" "$("$@" --cflags --libs fixpid | sed 's/ *$//')"
}

# with_cmake OPTION...: fixpid installed by CMake, in ./prefix.
with_cmake() {
    small_files fixpid
    cmake -S fixpid -B build -DCMAKE_INSTALL_PREFIX="$PWD/prefix" "$@"
    cmake --build build
    cmake --install build
}

# heater OPTION...: a project of the user's that has the archive as a subproject, by the
# wrap of docs/installing.md, and the dependency as README.md and that page say it.
heater() {
    small_files fixpid
    archive=heater/subprojects/packagefiles/fixpid-VERSION.tar.xz
    mkdir -p "${archive%/*}"
    tar -cJf "$archive" fixpid
    hash=$(sha256sum "$archive" | cut -d ' ' -f 1)
    sed -n '/^    \[wrap-file\]/,/^$/s/^    //p' "$root/docs/installing.md" |
        sed "s/^source_hash = .*/source_hash = $hash/" >heater/subprojects/fixpid.wrap
    cp "$root/examples/quick_start.c" heater
    dependency=$(how_with Meson README.md)
    same "$dependency" "$(how_with Meson docs/installing.md)"
    echo "project('heater', 'c')
executable('heater', 'quick_start.c', dependencies: $dependency, install: true)" >heater/meson.build
    meson setup build heater --prefix "$PWD/prefix" "$@"
    meson install -C build
    same bin/heater "$(cd prefix && find . -type f | sed 's,^./,,')"
}

# how_with TOOL PAGE: the code that the page's table has for it.
how_with() {
    sed -n "s/^| $1 | \`\([^\`]*\)\`.*/\1/p" "$root/$2"
}

# --- PlatformIO, ESP-IDF, Zephyr, of which Debian has none: by stand-ins for their parts ---

# platformio COMPILER OPTION...: every source of the packed library becomes a part of
# an archive, with the flags of library.json, and a program is linked with it.
platformio() {
    user_files lib
    flags=$(ruby -rjson -e 'puts JSON.parse(File.read("lib/library.json"))["build"]["flags"]')
    mkdir objects
    find lib/src -name '*.c' | while read -r source; do
        # shellcheck disable=SC2086 # a list of options
        quiet "$@" $flags -Wall -Wextra -Werror -Ilib/include -Ilib/src \
            -c "$source" -o "objects/$(basename "$source").o"
    done
    ar rcs libfixpid.a objects/*.o
    quiet "$@" -Wall -Wextra -Werror -Ilib/include -Ilib/src \
        "$root/examples/quick_start.c" libfixpid.a -o program
}

# esp_idf OPTION...: the example, as the users' files have it, in ./build.
esp_idf() {
    user_files fixpid
    export IDF_PATH="$here/esp-idf"
    cmake -S fixpid/examples/esp-idf/heater -B build "$@"
    cmake --build build
}

# zephyr OPTION...: the sample, likewise.
zephyr() {
    [ -d fixpid ] || user_files fixpid
    rm -rf build
    cmake -DZephyr_DIR="$here/zephyr" -S fixpid/examples/zephyr/heater -B build &&
        cmake --build build
}

# --- Arduino: the IDE's own builder with Debian's core for AVR, and a simulated Uno ---

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
    mkdir -p "$work/core" # of all sketches
    flock "$work/core" arduino-builder -compile -fqbn "arduino:avr:$2" -warnings all \
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

# oven_with_ntc EDIT LINES: what OvenSsr, sound.ino, prints with a thermistor, as on_host.
oven_with_ntc() {
    sed "$1" sound.ino >"$ino"
    world=WITH_NTC
    on_host 04.OvenSsr "$2"
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
    done
    # A rate whose period is not whole milliseconds does not compile.
    sed 's/^\(const int RATE = \)[0-9]*;/\17;/' sound.ino >"$ino"
    refused 'RATE must divide 1000 ms' on_host "$1" "$2"
    cp sound.ino "$ino"
}

# The sketch Live fifty times as fast, by its RATE, at a baud rate of its UART, of which
# simavr makes half.
fast_live() {
    sed -i -e 's/^\(const int RATE = \)50;/\12500;/' \
        -e 's/^\(const unsigned long BAUD = \)115200;/\1500000;/' \
        libraries/fixpid/examples/arduino/05.Live/05.Live.ino
    build_sketch 05.Live uno
}

# step_is NAME: what the library's step is called, and the sketch calls.
step_is() {
    avr-nm built/libraries/fixpid/pid/fixpid_pid.c.o | grep " T $1$"
    avr-nm built/02.Heater.ino.elf | grep -i " t $1$"
}

# --- tools/release, on a repository of its own that holds what is here ---

# repository FOLDER: with its version released and tagged, and an address.
repository() {
    whole_tree "$1"
    cd "$1" || return 1
    export GIT_AUTHOR_NAME=a GIT_AUTHOR_EMAIL=a GIT_COMMITTER_NAME=a \
        GIT_COMMITTER_EMAIL=a GIT_AUTHOR_DATE='2026-12-01T00:00:00Z' \
        GIT_COMMITTER_DATE='2026-12-01T00:00:00Z' GIT_CONFIG_GLOBAL=/dev/null
    version=$(of_project Project::VERSION)
    sed -i "s/^## $version, .*/## $version, 2026-12-01/" CHANGELOG.md
    sed -i "s,^  ADDRESS = .*,  ADDRESS = 'https://fixpid.invalid'," tools/lib/project.rb
    ruby tools/lib/manifests.rb --update >output
    git init -q
    echo output >.git/info/exclude # of `refused`
    git add -A
    git commit -qm 'All of it'
    git tag "v$version"
}

# retag: what is there now is the release.
retag() {
    git commit -qam 'A fault'
    git tag -f "v$version" >/dev/null
}

# release_faults RELEASE: the bill of materials and the links are right there; and a fault of
# each is seen.
release_faults() (
    cd "$1/.." || exit 1 # what is judged stays as it is
    set -- ruby "$here/release.rb" release release/users/fixpid release/small/fixpid
    quiet "$@"
    while read -r path edit message; do
        cp "release/$path" kept_file
        sed -i "$edit" "release/$path"
        refused "$message" "$@"
        mv kept_file "release/$path"
    done <<FAULTS
users/fixpid/include/fixpid.h \$a// ^fixpid-$version.zip: ./include/fixpid.h is
users/fixpid/README.md \$a[a](docs/none.md) ^README.md leads to docs/none.md,
fixpid-$version.spdx.json s/"versionInfo":[^,]*/"versionInfo":"9.9"/ ^a package of version 9.9, not $version
FAULTS
)
