# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# Sourced by the runners that compile for several chips: one call for all compilers.

strict() {
    "$@" -std=c99 -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion \
        -Wshadow -Wundef -Wstrict-prototypes -Wmissing-prototypes \
        -Wredundant-decls -Werror
}

# messages TARGET ARGUMENT...: what it says of a source, of which nothing is made.
messages() {
    case $1 in
    sdcc-* | pic1[46]) compile "$@" -S -o messages.asm ;;
    *) compile "$@" -fsyntax-only ;;
    esac
}

# compile TARGET ARGUMENT...: `ARGUMENT...` are those of gcc.
compile() {
    target=$1
    shift
    case $target in
    gcc | clang) strict "$target" -O2 "$@" ;;
    avr-gcc) strict avr-gcc -mmcu=atmega328p -Os "$@" ;;
    arm-none-eabi-gcc) # freestanding: there may be no C library
        strict arm-none-eabi-gcc -mcpu=cortex-m0 -mthumb -ffreestanding -Os "$@"
        ;;
    arm-cortex-m4) # saturating instructions
        strict arm-none-eabi-gcc -mcpu=cortex-m4 -mthumb -ffreestanding -Os "$@"
        ;;
    riscv64-unknown-elf-gcc) # likewise
        strict riscv64-unknown-elf-gcc -march=rv32imc -mabi=ilp32 \
            -ffreestanding -Os "$@"
        ;;
    g++ | clang++)
        "$target" -x c++ -std=c++11 -Wall -Wextra -Wpedantic -Werror "$@"
        ;;
    sdcc-mcs51 | sdcc-hc08) # else the locals of all sources lie side by side
        sdcc "-m${target#sdcc-}" --std-c99 --stack-auto "$@"
        ;;
    sdcc-*) sdcc "-m${target#sdcc-}" --std-c99 "$@" ;;
    pic14) "$SDCC" -mpic14 -p16f684 --use-non-free -Wa,-w2 --std-c99 "$@" ;;
    pic16) "$SDCC" -mpic16 -p18f4520 --use-non-free -Wa,-w2 --std-c99 "$@" ;;
    esac
}
