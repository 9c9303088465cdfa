# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# shellcheck disable=SC2034,SC2154 # for and from test/matrix.txt, whose rows these are steps of

default_limits='limits 30000 120 1000 7500 30'
fixpid=../fixpid # as a consumer's folder sees it
I=-I$fixpid/include

# All of the library; what has a header of its own, but for what all include; and of these
# what has an object mode.
sources=$(cd "$root/src" && find . -name '*.c' | LC_ALL=C sort | sed 's,^\.,../fixpid/src,')
headers=$(cd "$root/include" && printf '%s\n' *.h)
nouns=$(cd "$root/include" && printf '%s\n' fixpid_*.h | sed 's/\.h$//')
named_nouns=$(cd "$root/include" && grep -l '_OBJECT$' fixpid_*.h | sed 's/\.h$//')

# How gcc, clang, both as C++ and sdcc refuse a constant out of range.
not_a_constant='out_of_range\|array.*negative\|sizeof applied to an incomplete'

# app PROGRAM LIMITS: the user's program works and has these limits.
app() {
    output=$("$1") || return 1
    same "$2" "$(echo "$output" | sed -n 2p)"
}

upper() {
    echo "$1" | tr '[:lower:]' '[:upper:]'
}

# objects: the definitions by which all that has an object mode is in it.
objects() {
    for noun in $named_nouns; do
        echo "-D$(upper "$noun")_OBJECT=${noun#fixpid_}"
    done
}

# symbols FILE...: of objects of any gcc, `T NAME` of a function, `D NAME` of what else
# they have, and `U NAME` of what they need. nm loads LLVM, each time.
symbols() {
    readelf -sW "$@" | awk '$5 != "LOCAL" && $8 != "" {
        print $7 == "UND" ? "U" : $4 == "FUNC" ? "T" : "D", $8 }'
}

# only TEXT: a source of that text, as the header of a user's may be alone in one.
only() {
    printf '%s\ntypedef int nothing_else;\n' "$1" >only.c
}

# --- CMake ---

export CMAKE_GENERATOR=Ninja # make starts a CMake for each target; `package` has make

# configure BUILD OPTION...: fixpid itself.
configure() {
    build=$1
    shift
    cmake -Werror=dev -S "$root" -B "$build" -DCMAKE_INSTALL_PREFIX="$PWD/prefix" \
        -DFIXPID_BUILD_EXAMPLES=OFF -DFIXPID_WERROR=ON "$@"
}

# installed OPTION...: so, in ./prefix.
installed() {
    configure build "$@"
    cmake --build build
    cmake --install build
}

# make_app PROJECT OPTION...: the consumer's project, in ./app and ./app/build.
make_app() {
    project=$1
    shift
    rm -rf app
    cp -R "$here/$project" app
    case $project in
    cplusplus | pic) ;; # has its own
    *) cp "$here/app/main.c" app ;;
    esac
    [ "$project" != subdirectory ] || cp -R "$fixpid" app/fixpid
    cmake -S app -B app/build -DCMAKE_PREFIX_PATH="$PWD/prefix" "$@" >configured || return 1
    cmake --build app/build
}

# Inside another project fixpid is a library: no tests, nothing installed.
is_modest() {
    same '' "$(find app/build -name 'replay*')"
    cmake --install app/build --prefix "$PWD/prefix"
    same '' "$(find prefix -name '*fixpid*' 2>/dev/null)"
}

# All of the project, as a contributor builds it.
whole() {
    cmake -Werror=dev -S "$root" -B build -DFIXPID_WERROR=ON "$@"
    cmake --build build
    (cd build && ctest --output-on-failure) >tested
    cat tested
    [ "$(grep -c ' Passed ' tested)" -ge 11 ] # so many there were at least
}

# pic PORT CHIP: cross-compiled with SDCC into a firmware.
pic() {
    toolchain=-DCMAKE_TOOLCHAIN_FILE=$root/tools/cmake/sdcc-$1.cmake
    installed "$toolchain" -DSDCC_CHIP="$2"
    make_app pic "$toolchain" -DSDCC_CHIP="$2"
    cmake app/build # a second time
    rm app/build/firmware.hex
    cmake --build app/build >built 2>&1
    same '' "$(grep -i -e warning -e mismatch built)"
    grep -q ' _fixpid_an964_step  *0x.*program' app/build/firmware.map
    [ -s app/build/firmware.cod ]
    tail -n 1 app/build/firmware.hex | tr -d '\r' | grep -qx ':00000001FF'
}

pic_app() {
    make_app pic -DSDCC_ONE_BANK="$1" "-DMAIN_OPTIONS=$2" \
        "-DCMAKE_TOOLCHAIN_FILE=$root/tools/cmake/sdcc-pic14.cmake"
}

# build_pic with the pendulum's files: ONE_BANK_FILE... [--all-banks FILE...]
pendulum() {
    "$root/tools/lib/build/build_pic" pic16f684 pendulum "-I$root/include" \
        "-I$root/port" "-I$root/port/pic" "-I$root/port/pic/pic16f684" \
        "-I$root/examples/pendulum" -DFIXPID_AN964_OBJECT=pendulum "$@"
}

# --- sources that disagree ---

# link NOUN DEFINITIONS PROGRAM: a program of disagree.c with its own definitions, and the
# module's files with these, compiled once; with the link, which calls the others, all.
link() {
    module=${1#fixpid_}
    compiled=$1_with$(printf '%s' "$2" | tr -c 'A-Za-z0-9' _)
    [ "$module" != link ] || module='*'
    [ -d "$compiled" ] || {
        mkdir "$compiled"
        # shellcheck disable=SC2086 # lists of definitions and files
        (cd "$compiled" && cc "-I../$fixpid/include" $2 -c ../$fixpid/src/$module/*.c) || {
            rm -r "$compiled"
            return 1
        }
    }
    # shellcheck disable=SC2086 # a list of definitions
    cc $I "-DNOUN=${1#fixpid_}" $3 "$here/disagree.c" "$compiled"/*.o -o app
}

# called NOUN: what a program calls of it.
called() {
    case $1 in
    fixpid_link) echo '-DUSE=fixpid_link_init(&one,1)' ;;
    fixpid_an964*) echo -DCONFIGURED=_gains ;;
    *) echo -DCONFIGURED=_config ;;
    esac
}

# agrees NOUN AS DEFINITION...: a program links with a library that has the same
# definition, and not with one that has another or none.
agrees() {
    noun=$1 as=$2
    shift 2
    link "$noun" '' "$as"
    for definition; do
        link "$noun" "$definition" "$as $definition"
        refused undefined link "$noun" "$definition" "$as"
        refused undefined link "$noun" '' "$as $definition"
    done
}

# marks NOUN DEFINITIONS...: with each of these no function has the name that it has with
# another.
marks() {
    noun=$1
    shift
    for source in "$fixpid/src/${noun#fixpid_}"/*.c; do
        : >all
        for definitions; do
            # shellcheck disable=SC2086 # a list of definitions
            gcc $I $definitions -S "$source" -o marked.s
            sed -n 's/^\t\.globl\t//p' marked.s >>all
        done
        same '' "$(sort all | uniq -d)"
    done
}

# The same of SDCC's addresses, for the program's one object.
marks_on_pic() {
    for source in "$fixpid/src/${1#fixpid_}"/*.c; do
        : >all
        for place in '' "-D$(upper "$1")_PLACE=__at(0x20)" "-D$(upper "$1")_PLACE=__at(0x30)"; do
            assembled pic16 marked "$source" "-D$(upper "$1")_OBJECT=one" ${place:+"$place"}
            declared global marked.asm | grep "^_${1}_.*_one" >>all || true
        done
        same '' "$(sort all | uniq -d)"
    done
}

# assembled TARGET NAME SOURCE DEFINITION...: SDCC's assembly, in NAME.asm
assembled() {
    target=$1 assembled=$2
    shift 2
    compile "$target" "$I" -S "$@" -o "$assembled.asm" >log
}

# declared global|extern ASSEMBLY: the names that SDCC's assembly for a PIC has, or needs.
declared() {
    sed -nE "s/^[[:space:]]+$1[[:space:]]+//ip" "$2"
}

# links_to CALLER CALLED: what the one needs of fixpid's arithmetic is there.
links_to() {
    declared extern "$1.asm" | sed -n '/^_fixpid/p' >wanted
    declared global "$2.asm" >found
    ! grep -qvxF -f found wanted
}

# links_not CALLER CALLED
links_not() {
    ! links_to "$@" || {
        echo "$1 links with $2"
        return 1
    }
}

# step_and_kernel NOUN PORT FOLDER: the assembly of a step and of the file that has its
# arithmetic, and what of them links: in C a PIC18's AN937 has the same functions.
step_and_kernel() {
    for mode in -DONE_OF_MANY "-DFIXPID_$(upper "$1")_OBJECT=one"; do
        for no in FIXPID_ASSEMBLY FIXPID_NO_ASSEMBLY; do
            assembled "$2" "step_$no" "$fixpid/src/$1/fixpid_$1.c" "$mode" "-D$no"
            assembled "$2" "kernel_$no" "$fixpid/src/$1/fixpid_$1_$3.c" "$mode" "-D$no"
            links_to "step_$no" "kernel_$no"
        done
        case $1 in
        an937) links_to step_FIXPID_ASSEMBLY kernel_FIXPID_NO_ASSEMBLY ;;
        *) links_not step_FIXPID_ASSEMBLY kernel_FIXPID_NO_ASSEMBLY ;;
        esac
    done
}

# --- compilers ---

# old_compile BITS ARGUMENT...: as XC16 (an int of 16 bits) or XC32 would, which
# are GCC 4.5, with -std=c99: clang for such a chip under their names, and
# old_gcc.h. What it makes of the sources is not compared with anything.
old_compile() {
    bits=$1
    shift
    case $bits in
    16) set -- --target=msp430-none-elf -U__MSP430__ -UMSP430 -D__XC16__ \
        -D__C30__ -D__dsPIC30F__ "$@" ;;
    32) set -- --target=mipsel-none-elf -D__XC32__ -D__C32__ -D__PIC32MX__ "$@" ;;
    esac
    strict clang -fgnuc-version=4.5.1 -U__clang__ -U__llvm__ -fgnu89-inline \
        -Wno-builtin-macro-redefined -ffreestanding -Os -fsyntax-only \
        -include "$here/old_gcc.h" "$@"
}

# standards COMPILER: of the language, each that it has.
standards() {
    case $1 in
    *++) echo -std=c++98 -std=c++11 -std=c++14 -std=c++17 -std=c++20 -std=c++2b ;;
    *) echo -std=c99 -std=c11 -std=c17 -std=c2x ;;
    esac
}

# every_warning COMPILER ARGUMENT...: with all that it can warn of, but for what is older
# than C99 or C++11, bytes between a struct's members, `struct` in C++, which C needs, and
# a function's name that is a macro of itself. That 0.5f becomes a double is the user's.
every_warning() {
    compiler=$1 language=c
    shift
    [ "${compiler%++}" = "$compiler" ] || language=c++
    case $compiler in
    clang*) set -- -Weverything -Wno-disabled-macro-expansion -Wno-c++98-compat "$@" ;;
    *)
        echo >empty
        # shellcheck disable=SC2046 # options
        set -- -Wall -Wextra $("$compiler" -x "$language" -Q --help=warnings -c empty -o empty.o |
            sed -nE 's/^  (-W[^ =<]+) .*\[disabled\]/\1/p' |
            grep -vxE -e '-W(abi|traditional|traditional-conversion|unsuffixed-float-constants|redundant-tags|templates|system-headers)') "$@"
        ;;
    esac
    "$compiler" -x "$language" -O2 -ffreestanding -Werror "$@" -Wno-padded -Wno-double-promotion -c -o user.o
}

# newer MESSAGE TEXT: a source that GCC 4.5 refuses, and a new compiler does not.
newer() {
    printf 'int f(int a);\n%b\n' "$2" >newer.c
    quiet clang -std=gnu11 -c newer.c
    refused "$1" old_compile "$CC" -c newer.c
}

# types_of FOLDER: in C++ every type of its headers can be named without `struct`.
types_of() {
    {
        (cd "$1" && printf '#include "%s"\n' *.h)
        sed -nE 's/^(struct|union|enum) (fixpid_\w+) \{$/\2/p' "$1"/*.h |
            awk '{ print "static " $1 " v" NR "; void *p" NR " = &v" NR ";" }'
    } >types.cpp
    [ "$(grep -c '^static' types.cpp)" -ge 24 ]
    for cxx in g++ clang++ 'avr-g++ -mmcu=atmega328p'; do
        # shellcheck disable=SC2086 # a compiler and its option
        $cxx -std=c++11 -Wall -Wextra -Wpedantic -Werror "-I$1" \
            -fsyntax-only types.cpp || return 1
    done
}

# found OPTION...: what cppcheck's addon says of a user's file and of all.h.
found() {
    cppcheck --quiet --std=c99 --addon=misra \
        "--addon-python=${PYTHON:-/usr/bin/python3}" --enable=style -D__GNUC__ \
        --include=all.h "$@" "$I" "$here/user.c" 2>&1
}

# assertions PROGRAM OPTION...
assertions() {
    program=$1
    shift
    # shellcheck disable=SC2086 # a list of files
    quiet strict cc -D_POSIX_C_SOURCE=200809L -DFIXPID_ASSERT=assert -include assert.h \
        "$@" "$I" "-I$here" "$here/assert.c" calls.c $sources -o "$program"
    "./$program"
}

# kept_forms TARGET FOLDER: the sources there, without those of other chips and compilers.
kept_forms() {
    for form in pic14 pic18 avr arm sdcc; do
        case $1-$form in
        pic14-pic14 | pic16-pic18 | avr-gcc-avr | *pic1*-sdcc | sdcc-*-sdcc) ;;
        *) rm -f "$2"/*/*_"$form".[ch] ;;
        esac
    done
}

# sources_of TARGET: every source compiles silently in both modes, and a module needs no
# symbol but those of its own sources, of those that it links, too, and the compiler's
# (`__...`; `_bp` is the frame pointer of sdcc --stack-auto).
sources_of() {
    mkdir object_mode
    for source in $sources; do
        name=$(basename "$source" .c).rel
        quiet compile "$1" "$I" -c "$source" -o "$name"
        # shellcheck disable=SC2046 # a list of definitions
        quiet compile "$1" "$I" $(objects) -c "$source" -o "object_mode/$name"
    done
    case $1 in
    sdcc-*) listed=sdnm ;;
    *) listed=symbols ;;
    esac
    (cd "$root" && ruby -r./tools/lib/modules -e 'Modules::ALL.each_key { |name|
        puts "#{name} #{Modules.linked(name).map { |path| "#{File.basename(path, ".c")}.rel" }.join(" ")}" }') >modules
    while read -r module objects; do
        # shellcheck disable=SC2086 # a list of files
        $listed $objects >names
        grep -q "\<T _*fixpid_$module" names
        same '' "$(awk 'NF > 1 && $(NF - 1) == "U" { needed[$NF] }
            NF > 1 && $(NF - 1) ~ /^[A-TV-Z]$/ { had[$NF] }
            END { for (symbol in needed) if (!(symbol in had)) print symbol }' names | grep -v -e '^__' -e '^_bp$')"
    done <modules
}

# linked_for TARGET: and all link with a program that does not use them.
linked_for() {
    echo 'int main(void) { return 0; }' >empty.c
    quiet compile "$1" -c empty.c -o empty.rel
    case $1 in
    arm-*) # no start-up code without a C library
        quiet compile "$1" -nostdlib -Wl,-e,main ./*.rel -lgcc -o app
        ;;
    sdcc-*) # an HC08's 64 KB do not hold all modules at once
        [ "$1" != sdcc-hc08 ] || rm fixpid_autotune*.rel fixpid_reaction*.rel fixpid_guard*.rel fixpid_link*.rel
        quiet compile "$1" empty.rel fixpid_*.rel -o app.ihx
        ;;
    *) quiet compile "$1" ./*.rel -o app ;;
    esac
}
