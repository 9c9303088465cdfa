# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# shellcheck disable=SC2154 # root: from test/matrix.txt, whose rows these are steps of

registers=registers # a folder for what device.rb makes
mild=               # warnings that are no errors

# project: its files, in the working folder.
project() {
    for entry in include src port examples test; do
        [ -e "$entry" ] || ln -s "$root/$entry" .
    done
    # Object mode of every controller, whatever an example calls its own.
    objects=
    for header in include/fixpid_*.h; do
        noun=$(basename "$header" .h)
        objects="$objects -D$(echo "$noun" | tr '[:lower:]' '[:upper:]')_OBJECT=a_$noun"
    done
}

# device FOLDER | CHIP WORD...: what the port there or a user's files say of the
# chip, and its registers for <xc.h>.
device() {
    mkdir -p "$registers/$(basename "$1")"
    ruby "$root/test/use/xc8_check/device.rb" "$@" >"$registers/$(basename "$1")/xc_device.h"
}

# front_end CHIP WORD...: the files among the words, and options.
front_end() {
    chip=$1
    shift
    case $chip in
    pic18*) class=_PIC18 ;;
    *) class=_PIC14 ;; # or another one, for which the library is the same
    esac
    # shellcheck disable=SC2086 # a list of options
    for gnu in -UAS_XC8_GNU -DAS_XC8_GNU; do
        clang --target=avr -std=c99 -ffreestanding -funsigned-char "-D$class" \
            $gnu -include "$root/test/support/as_xc8.h" -fsyntax-only -Wall -Wextra \
            -Wconversion -Werror $mild -Wno-unknown-pragmas \
            -Wno-avr-rtlib-linking-quirks -isystem "$root/test/use/xc8_check" \
            -isystem "$registers/$chip" "-I$root/include" "$@" || return 1
        mild=$(echo "$mild" | sed 's/error=//g') # shown once
    done
}

# compiled CHIP FILE...: with the chip's port and its registers.
compiled() {
    folder=port/pic/$1
    device "$folder" || return 1
    shift
    for file; do
        # shellcheck disable=SC2086 # a list of definitions
        front_end "$(basename "$folder")" "-I$folder" "-I$folder/../.." -Iport $objects "$file" || return 1
    done
}

# port_of CHIP: and on a PIC18 its interrupt with a UART.
port_of() {
    compiled "$1" "port/pic/$1/port.c" port/port_wait_ticks.c || return 1
    case $1 in
    pic18*)
        objects="$objects -DPORT_UART"
        compiled "$1" "port/pic/$1/port.c" port/pic/pic18/port_uart.c
        ;;
    esac
}

# own_files CHIP WORD...: a user's.
own_files() {
    chip=$1 count=0
    shift
    for word; do
        case $word in
        -*) ;;
        *)
            [ -f "$word" ] || die "there is no file $word"
            count=$((count + 1))
            ;;
        esac
    done
    [ $count -gt 0 ] || die "which files? test/use/xc8_check/run $chip FILE.c..."
    mild='-Wno-error=conversion -Wno-error=unused -Wno-error=unused-parameter'
    device "$chip" "$@" && front_end "$chip" "$@" &&
        echo "ok: $count of your files for $chip, as far as can be told without XC8"
}
