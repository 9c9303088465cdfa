# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# shellcheck disable=SC2154 # root: of the runner, which sources this
# Meson and pkg-config, the tools themselves. The user's program is the quick start.

# uses_pc FOLDER: a program that pkg-config finds the library for, in FOLDER.
uses_pc() {
    export PKG_CONFIG_PATH="$1/pkgconfig"
    pkg-config --validate fixpid
    same "$(version_of_header)" "$(pkg-config --modversion fixpid)"
    # shellcheck disable=SC2046 # lists of options
    quiet cc $(pkg-config --cflags fixpid) "$root/examples/quick_start.c" \
        $(pkg-config --libs fixpid) -o app
    ./app >printed
    quick_start_printed printed
}

# with_cmake OPTION...: fixpid installed by CMake, in ./prefix.
with_cmake() {
    small_files fixpid
    cmake -S fixpid -B build -DCMAKE_INSTALL_PREFIX="$PWD/prefix" "$@"
    cmake --build build
    cmake --install build
}

# A package may be moved.
pkgconfig_relative() {
    with_cmake -DCMAKE_INSTALL_LIBDIR=lib
    uses_pc "$PWD/prefix/lib"
    mv prefix moved
    export PKG_CONFIG_PATH="$PWD/moved/lib/pkgconfig"
    same "-I$PWD/moved/include -L$PWD/moved/lib -lfixpid" \
        "$(pkg-config --define-prefix --cflags --libs fixpid | sed 's/ *$//')"
}

# As some distributions have it.
pkgconfig_absolute() {
    with_cmake -DCMAKE_INSTALL_LIBDIR="$PWD/there/lib" \
        -DCMAKE_INSTALL_INCLUDEDIR="$PWD/there/include"
    uses_pc "$PWD/there/lib"
    same "-I$PWD/there/include -L$PWD/there/lib -lfixpid" \
        "$(pkg-config --cflags --libs fixpid | sed 's/ *$//')"
}

# What was left out of the library, its users leave out, too, or it does not link.
pkgconfig_features() {
    with_cmake -DCMAKE_INSTALL_LIBDIR=lib -DFIXPID_PID_FEATURES=0x00
    uses_pc "$PWD/prefix/lib"
    refused undefined cc -Iprefix/include "$root/examples/quick_start.c" \
        -Lprefix/lib -lfixpid -o app
}

meson_install() {
    small_files fixpid
    for libdir in lib "$PWD/prefix/lib64"; do
        rm -rf build prefix
        meson setup build fixpid -Dwerror=true --prefix "$PWD/prefix" --libdir "$libdir"
        meson install -C build
        uses_pc "$PWD/prefix/$(basename "$libdir")"
        diff -r fixpid/include prefix/include
    done
}

# heater OPTION...: a project of the user's that has the archive as a subproject, by
# the wrap of docs/installing.md.
heater() {
    small_files fixpid
    archive=heater/subprojects/packagefiles/fixpid-VERSION.tar.xz
    mkdir -p "${archive%/*}"
    tar -cJf "$archive" fixpid
    hash=$(sha256sum "$archive" | cut -d ' ' -f 1)
    sed -n '/^    \[wrap-file\]/,/^$/s/^    //p' "$root/docs/installing.md" |
        sed "s/^source_hash = .*/source_hash = $hash/" >heater/subprojects/fixpid.wrap
    cp "$root/examples/quick_start.c" heater
    cat >heater/meson.build <<'END'
project('heater', 'c')
executable('heater', 'quick_start.c', dependencies: dependency('fixpid'),
           install: true)
END
    meson setup build heater --prefix "$PWD/prefix" "$@"
    meson install -C build
    same bin/heater "$(cd prefix && find . -type f | sed 's,^./,,')"
}

meson_wrap() {
    heater
    prefix/bin/heater >printed
    quick_start_printed printed
}

meson_avr() {
    cat >avr.ini <<'END'
[binaries]
c = 'avr-gcc'
ar = 'avr-ar'
strip = 'avr-strip'
[built-in options]
c_args = ['-mmcu=atmega328p']
c_link_args = ['-mmcu=atmega328p']
[host_machine]
system = 'none'
cpu_family = 'avr'
cpu = 'atmega328p'
endian = 'little'
END
    heater --cross-file avr.ini
    avr-nm prefix/bin/heater | grep -q ' T fixpid_pid_step$'
}
