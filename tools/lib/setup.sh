# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# Sourced by the tools: says what is missing and installs it.

# Large pages, where the kernel gives them only to what asks, and of these a heap that is
# kept: gpasm, of which there are thousands of runs, asks for 4 MB for each section of a
# file, and takes far less of a virtual machine's time then.
export GLIBC_TUNABLES="${GLIBC_TUNABLES:-glibc.malloc.hugetlb=1:glibc.malloc.mmap_threshold=268435456}"

say() {
    printf '%s: %s\n' "${0##*/}" "$*" >&2
}

# announce WORDS: what takes long is said also where tools/test keeps a program's
# messages; its own are descriptor 8. Whether it is open is tried in a shell of its
# own: a redirection that fails on `:` ends dash.
announce() {
    told=2
    (: >&8) 2>/dev/null && told=8
    say "$@" 2>&"$told"
}

die() {
    say "$@"
    exit 1
}

# room FOLDER MEGABYTES: dies if fewer are free there, as far as df can tell.
room() {
    free_megabytes=$(df -Pm "$1" 2>/dev/null | awk 'NR == 2 { print $4 + 0 }')
    [ "${free_megabytes:-$2}" -ge "$2" ] || die "less than $2 MB free for $1"
}

# Every tool makes temporary files, some only after minutes. What one has tried, those that
# it starts need not: TMPDIR_TRIED.
[ "${TMPDIR_TRIED-}" = "${TMPDIR:-/tmp}" ] || {
    [ -w "${TMPDIR:-/tmp}/" ] ||
        die "cannot write to ${TMPDIR:-/tmp}, the folder for temporary files (TMPDIR)"
    room "${TMPDIR:-/tmp}" 1
    export TMPDIR_TRIED="${TMPDIR:-/tmp}"
}

# work_folder FOLDER MEGABYTES: makes it, or says why nothing can be written
# there.
work_folder() {
    mkdir -p "$1" 2>/dev/null ||
        die "cannot create $1: is the disk full, or the folder read-only?"
    [ -w "$1" ] || die "cannot write to $1"
    room "$1" "$2"
}

# remember NAME [failed]: for --failed, in the file that `record` names.
remember() {
    mkdir -p "$(dirname "${record:?}")"
    [ -f "$record" ] || : >"$record"
    grep -vxF -e "$1" "$record" >"$record.new" || : # which has no line then
    [ $# -eq 1 ] || echo "$1" >>"$record.new"
    mv "$record.new" "$record"
}

# builds LINES COMPILER [OPTION]...: whether a program that begins with these
# lines can be compiled and linked.
builds() {
    try_folder=$(mktemp -d) || die "cannot make a temporary folder"
    try_lines=$1 try_compiler=$2
    shift 2
    case $try_compiler in
    *++) try_source=$try_folder/try.cc ;;
    *) try_source=$try_folder/try.c ;;
    esac
    printf '%s\nint main(void) { return 0; }\n' "$try_lines" >"$try_source"
    try_status=0
    "$try_compiler" "$try_source" "$@" -o "$try_folder/try.out" \
        >/dev/null 2>&1 || try_status=1
    rm -rf "$try_folder"
    return $try_status
}

# has_module NAME: of Debian's Python, or of the one that PYTHON names.
has_module() {
    "${PYTHON:-/usr/bin/python3}" -c "import $1" >/dev/null 2>&1
}

# has_package NAME: whether what this Debian package is needed for is there.
# The compilers are asked, so that it may have come in any other way.
has_package() {
    case $1 in
    libc6-dev) builds '#include <stdio.h>' cc ;;
    zlib1g-dev) builds '#include <zlib.h>' cc -lz ;;
    libboost-dev) builds '#include <boost/config.hpp>' c++ ;;
    libboost-graph-dev)
        builds '#include <boost/graph/adjacency_list.hpp>' c++
        ;;
    libsimavr-dev) builds '#include <simavr/sim_avr.h>' cc -lsimavr ;;
    gpsim-dev)
        # Not included: gpsim's headers want glib's, and sim/gpsim does not.
        builds '#if !__has_include(<gpsim/processor.h>)
#error
#endif' c++ -lgpsim
        ;;
    avr-libc) builds '#include <avr/io.h>' avr-gcc -mmcu=atmega328p ;;
    picolibc-arm-none-eabi)
        builds '#include <picolibc.h>' arm-none-eabi-gcc --specs=picolibc.specs
        ;;
    picolibc-riscv64-unknown-elf)
        builds '#include <picolibc.h>' riscv64-unknown-elf-gcc --specs=picolibc.specs
        ;;
    arduino-core-avr) [ -f /usr/share/arduino/hardware/arduino/avr/boards.txt ] ;;
    python3-kconfiglib) has_module kconfiglib ;;
    libclang-rt-14-dev) builds '' clang -fsanitize=address,undefined ;;
    sdcc-libraries) builds '#include <stdint.h>' sdcc -mmcs51 ;;
    mkdocs-material)
        has_module 'mkdocs.utils; assert "material" in mkdocs.utils.get_theme_names()'
        ;;
    python3-cffi) has_module cffi ;;
    python3-dev) builds '#include <Python.h>' cc \
        "-I$("${PYTHON:-/usr/bin/python3}" -c 'import sysconfig
print(sysconfig.get_path("include"))' 2>/dev/null)" ;;
    python3-matplotlib) has_module matplotlib ;;
    python3-numpy) has_module numpy ;;
    python3-scipy) has_module scipy ;;
    python3-setuptools) has_module setuptools ;;
    python3-venv) has_module venv && has_module ensurepip ;;
    python3-wheel) has_module wheel ;;
    *) die "setup.sh cannot check whether $1 is installed" ;;
    esac
}

# found_package NAME: has_package. What one tool has found, those that it starts with the
# same PATH and PYTHON need not look for: PACKAGES_FOUND.
found_package() {
    case ${PACKAGES_FOUND-} in
    "$PATH:${PYTHON-}: "*" $1 "*) return 0 ;;
    "$PATH:${PYTHON-}: "*) ;;
    *) PACKAGES_FOUND="$PATH:${PYTHON-}:  " ;;
    esac
    has_package "$1" || return 1
    PACKAGES_FOUND="$PACKAGES_FOUND$1 "
    export PACKAGES_FOUND
}

# missing_of ITEM...: sets `missing` to the packages of what is not there.
missing_of() {
    missing=
    # Commands first: what has none is asked with them.
    for item in "$@"; do
        [ -z "${item%%:*}" ] || command -v "${item%%:*}" >/dev/null 2>&1 ||
            missing="$missing ${item##*:}"
    done
    for item in "$@"; do
        [ -n "${item%%:*}" ] || found_package "${item##*:}" ||
            missing="$missing ${item##*:}"
    done
}

# apt_get ARGUMENT...: into $install_log. Says that another program has the lock, and waits
# for five minutes: apt's own DPkg::Lock::Timeout is silent, and not for that of `update`.
apt_get() {
    tries=60
    until LC_ALL=C DEBIAN_FRONTEND=noninteractive apt-get "$@" >"$install_log" 2>&1 </dev/null; do
        apt_is_locked && [ $tries -gt 0 ] || return 1
        [ $tries -ne 60 ] ||
            announce "another program has apt's lock$holder: waiting for it, five minutes at most"
        tries=$((tries - 1))
        sleep 5
    done
}

# apt_is_locked: by what $install_log says; then `holder` is who has it, if that is known.
apt_is_locked() {
    holder=$(sed -n 's/.*Could not get lock.* It is held by \(process.*)\).*/, \1/p' "$install_log" | head -n 1)
    grep -q 'Could not get lock' "$install_log"
}

# need ITEM...: each is `command`, `command:package` or `:package`, in Debian's
# names. Installs what is missing, or says what is and stops.
need() {
    missing_of "$@"
    [ -n "$missing" ] || return 0
    how="sudo apt-get install --no-install-recommends$missing"
    if ! command -v apt-get >/dev/null 2>&1; then
        die "missing (names of Debian packages):$missing"
    elif [ "$(id -u)" -ne 0 ]; then
        die "missing:$missing; not root, so please run: $how"
    fi
    announce "installing$missing (Debian packages)"
    install_log=$(mktemp)
    # shellcheck disable=SC2086 # a list of package names
    if ! { apt_get update -qq &&
        apt_get install -y -qq --no-install-recommends $missing; }; then
        tail -n 5 "$install_log" >&2
        why="is there a network, and room on the disk?"
        ! apt_is_locked || why="another program still has apt's lock$holder; once it has ended, try again."
        rm -f "$install_log"
        die "could not install$missing; $why By hand: $how"
    fi
    rm -f "$install_log"
    missing_of "$@"
    [ -z "$missing" ] || die "installed, but not usable:$missing"
}

# expect_digest FILE SHA256: or dies, and FILE is not to be used.
expect_digest() {
    digest_found=$(sha256sum <"$1")
    [ "${digest_found%% *}" = "$2" ] ||
        die "${1##*/} has the SHA-256 ${digest_found%% *}, expected $2:" \
            "it is not used"
}

# seal FOLDER: keeps the digests of all its files in it.
seal() {
    (cd "$1" && find . -type f ! -path ./SHA256SUMS -exec sha256sum {} + >SHA256SUMS)
}

# sealed FOLDER: whether they are as they were then.
sealed() {
    [ -d "$1" ] || return 1
    (cd "$1" && sha256sum --check --quiet --strict SHA256SUMS) >/dev/null 2>&1 ||
        {
            say "$1 is not as it was put there: it is not used"
            return 1
        }
}

# The Ceedling gem, in the system's or in the user's own gem folder. It asks for
# gcc, whatever compiles the tests.
need_ceedling() {
    need ruby gcc :libc6-dev
    PATH=$PATH:$(ruby -rrubygems -e 'print Gem.bindir, ":", Gem.user_dir, "/bin"')
    command -v ceedling >/dev/null 2>&1 && return 0
    where=
    [ "$(id -u)" -eq 0 ] || where=--user-install
    gem="gem install --no-document --conservative $where ceedling -v 1.2.1"
    announce "installing ceedling (Ruby gem)"
    gems=$(mktemp -d) || die "cannot make a temporary folder"
    fetched=$gems/cache/ceedling-1.2.1.gem
    # It is unpacked there, and nothing of it is run.
    printed=$(gem install --no-document --ignore-dependencies --install-dir \
        "$gems" ceedling -v 1.2.1 2>&1 </dev/null) || no_ceedling
    expect_digest "$fetched" \
        928095286b7a25777a2d520b9da6b6ee8255e17689910ddf60b12ec996ec115e
    # What it needs comes from the registry by its name.
    printed=$(eval "${gem% ceedling*} '$fetched'" 2>&1 </dev/null) ||
        no_ceedling
    rm -rf "$gems"
    command -v ceedling >/dev/null 2>&1 ||
        die "ceedling was installed, but it is in no folder of PATH"
}

no_ceedling() {
    printf '%s\n' "$printed" | tail -n 5 >&2
    rm -rf "$gems"
    die "could not install ceedling; is there a network? By hand: $gem"
}
