# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# shellcheck disable=SC2154 # root, here: of the runner, which sources this
# PlatformIO, ESP-IDF, Zephyr, CMSIS packs, Conan and vcpkg, of which Debian has none.
# What users get is built as they build it, where the tool is a package of CMake's by a
# stand-in for that, and of a pack what each component names; of Conan's recipe is known
# that it is Python.

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

platformio_native() {
    platformio gcc
    ./program >printed
    quick_start_printed printed
}

platformio_avr() {
    platformio avr-gcc -mmcu=atmega328p -Os -ffunction-sections \
        -fdata-sections -flto -fno-fat-lto-objects -Wl,--gc-sections
    avr-nm program | grep -q ' T main$'
}

# esp_idf OPTION...: the example, as the users' files have it, in ./build.
esp_idf() {
    user_files fixpid
    export IDF_PATH="$here/esp-idf"
    cmake -S fixpid/examples/esp-idf/heater -B build "$@"
    cmake --build build
}

esp_idf_host() {
    esp_idf
    build/heater >printed
    quick_start_printed printed
}

esp_idf_riscv() {
    esp_idf -DCMAKE_SYSTEM_NAME=Generic \
        -DCMAKE_C_COMPILER=riscv64-unknown-elf-gcc \
        -DCMAKE_TRY_COMPILE_TARGET_TYPE=STATIC_LIBRARY \
        "-DCMAKE_C_FLAGS=-march=rv32imc -mabi=ilp32 -ffreestanding -I$here/esp-idf/no_library"
    riscv64-unknown-elf-nm build/fixpid/libidf_fixpid.a |
        grep -q ' T fixpid_pid_step$'
    riscv64-unknown-elf-nm build/main/libidf_main.a | grep -q ' T app_main$'
}

# zephyr OPTION...: the sample, likewise.
zephyr() {
    [ -d fixpid ] || user_files fixpid
    rm -rf build
    cmake -DZephyr_DIR="$here/zephyr" -S fixpid/examples/zephyr/heater -B build &&
        cmake --build build
}

zephyr_sample() {
    zephyr
    build/zephyr >printed
    quick_start_printed printed
    if nm build/zephyr | grep -e fixpid_an937 -e fixpid_slew; then
        return 1 # called by nobody
    fi
}

zephyr_options() {
    user_files fixpid
    options=fixpid/examples/zephyr/heater/prj.conf
    printf 'CONFIG_FIXPID_PID_FEATURES=0x00\nCONFIG_FIXPID_NO_ASSEMBLY=y\n' >>$options
    zephyr
    build/zephyr >printed
    quick_start_printed printed
    nm build/zephyr | grep -q 'fixpid_pid_init_0x00'
    echo 'CONFIG_FIXPID=n' >$options
    refused 'fixpid_pid.h: No such file' zephyr
    for wrong in CONFIG_FIXPID_AUTOTUNER=y CONFIG_FIXPID_PID_FEATURES=0x100 \
        CONFIG_FIXPID=maybe; do
        printf 'CONFIG_FIXPID=y\n%s\n' $wrong >$options
        refused "${wrong%=*}\\|${wrong#CONFIG_}\\|${wrong#*=}" zephyr
        grep -q 'CMake Error.*\|the configuration' output
    done
}

# That every file is there, and no other, is a check of tools/lib/manifests.rb.
cmsis_pack() {
    quiet xmllint --noout "$root/fixpid.fixpid.pdsc"
    sed 's,</files>,,' "$root/fixpid.fixpid.pdsc" >broken.pdsc
    refused 'tag mismatch' xmllint --noout broken.pdsc
    user_files pack
    quiet ruby "$here/cmsis_pack.rb" pack fixpid.fixpid.pdsc objects
    quiet cc -Ipack/include "$root/examples/quick_start.c" objects/PID/*.o -o program
    ./program >printed
    quick_start_printed printed
    # A component without a file that it needs, or without the one that it stands on.
    sed '/src.link.fixpid_link.c/d' pack/fixpid.fixpid.pdsc >pack/lacking.pdsc
    refused '^Link lacks .*fixpid_link_' ruby "$here/cmsis_pack.rb" pack lacking.pdsc objects
    sed '/Csub="Link"/s/ condition="[^"]*"//' pack/fixpid.fixpid.pdsc >pack/alone.pdsc
    refused '^Link lacks .*fixpid_record_' ruby "$here/cmsis_pack.rb" pack alone.pdsc objects
}

conan() {
    cp "$root/conanfile.py" .
    quiet "${PYTHON:-/usr/bin/python3}" -m py_compile conanfile.py
}

# A project of CMake's finds the package.
vcpkg() {
    user_files fixpid
    cmake -DPORT="$PWD/fixpid/vcpkg/fixpid" -DPREFIX="$PWD/packages" \
        -P "$here/vcpkg.cmake"
    cmp "$root/LICENSE" packages/share/fixpid/LICENSE
    mkdir app
    cp "$root/examples/quick_start.c" app
    cat >app/CMakeLists.txt <<'END'
cmake_minimum_required(VERSION 3.16)
project(app C)
find_package(fixpid CONFIG REQUIRED)
add_executable(app quick_start.c)
target_link_libraries(app PRIVATE fixpid::fixpid)
END
    cmake -S app -B build -DCMAKE_PREFIX_PATH="$PWD/packages"
    cmake --build build
    build/app >printed
    quick_start_printed printed
}
