# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# Sourced after setup.sh by the tools that build for PIC: finds SDCC with its
# pic14 and pic16 ports, or builds a private one from Debian's source package. So
# does need_spdk with a Padauk's simulator, which Debian's package has not.

# need_sdcc: exports SDCC, the compiler, and SDCC_LIB, the folder above
# pic14/libsdcc.lib, pic14/libsdcce.lib, of the enhanced PIC16s,
# pic16/libsdcc.lib and pic16/crt0iz.o. Takes the caller's
# SDCC, the `sdcc` of PATH if it has both ports and their libraries, or the
# private one in the user's cache, which it builds when there is none. From
# the project's folder, or with `root` set to it. What one tool has tried, those
# that it starts need not: SDCC_TRIED.
need_sdcc() {
    sdcc_home=${XDG_CACHE_HOME:-${HOME:?}/.cache}/fixpid/sdcc-4.2.0-2
    if [ -n "${SDCC-}" ] || [ -d "$sdcc_home" ] || command -v sdcc >/dev/null; then
        need ruby gpasm:gputils
    else
        need_to_build_sdcc
    fi
    [ -z "${SDCC-}" ] || [ "${SDCC_TRIED-}" != "$SDCC" ] || return 0
    if [ -n "${SDCC-}" ]; then
        sdcc_works "$SDCC" || die "SDCC=$SDCC cannot compile for PIC:" \
            "it needs the ports pic14 and pic16 and their libraries"
        return 0
    fi
    sdcc_works sdcc && return 0
    sealed "$sdcc_home" && sdcc_works "$sdcc_home/bin/sdcc" && return 0
    say "no sdcc with the ports pic14 and pic16: building a private one," \
        "once, in $sdcc_home"
    "${root:-.}/tools/lib/build/build_sdcc" "$sdcc_home" || exit 1
    sdcc_works "$sdcc_home/bin/sdcc" ||
        die "the private sdcc in $sdcc_home does not work"
}

# With what its callers need, so that somebody who is not root is asked once.
need_to_build_sdcc() {
    need ruby g++ make bison flex :libboost-dev :libboost-graph-dev :zlib1g-dev \
        dpkg-source:dpkg-dev patch gpasm:gputils flock:util-linux
}

# sdcc_works COMPILER: whether it compiles for both chips and has its libraries;
# then exports SDCC and SDCC_LIB.
sdcc_works() {
    command -v "$1" >/dev/null 2>&1 || return 1
    sdcc_try=$(mktemp -d) || return 1
    printf '#include <stdint.h>\nuint8_t a;\nvoid f(void) { a++; }\n' \
        >"$sdcc_try/try.c"
    sdcc_status=0
    for sdcc_target in pic14:16f684 pic16:18f4520; do
        "$1" --use-non-free "-m${sdcc_target%:*}" "-p${sdcc_target#*:}" \
            -Wa,-w2 -c "$sdcc_try/try.c" -o "$sdcc_try/try.o" >/dev/null 2>&1 ||
            sdcc_status=1
    done
    rm -rf "$sdcc_try"
    [ $sdcc_status -eq 0 ] || return 1
    sdcc_folders=$("$1" -mpic16 --print-search-dirs |
        sed -n '/^libdir:/,/^libpath:/s,/pic16$,,p')
    while read -r sdcc_folder; do
        if [ -f "$sdcc_folder/pic14/libsdcc.lib" ] &&
            [ -f "$sdcc_folder/pic14/libsdcce.lib" ] &&
            [ -f "$sdcc_folder/pic16/libsdcc.lib" ] &&
            [ -f "$sdcc_folder/pic16/crt0iz.o" ]; then
            SDCC=$(command -v "$1")
            SDCC_LIB=$(CDPATH='' cd -- "$sdcc_folder" && pwd)
            SDCC_TRIED=$SDCC
            export SDCC SDCC_LIB SDCC_TRIED
            return 0
        fi
    done <<END
$sdcc_folders
END
    return 1
}

# need_spdk: exports SPDK, the simulator: the caller's, that of PATH, or a private
# one like SDCC's.
need_spdk() {
    spdk_home=${XDG_CACHE_HOME:-${HOME:?}/.cache}/fixpid/spdk-4.2.0
    if ! SPDK=$(command -v "${SPDK:-spdk}"); then
        SPDK=$spdk_home/bin/spdk
        sealed "$spdk_home" || {
            say "no spdk: building a private one, once, in $spdk_home"
            "${root:-.}/tools/lib/build/build_sdcc" "$spdk_home" spdk || exit 1
        }
    fi
    export SPDK
}
