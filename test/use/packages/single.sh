# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# shellcheck disable=SC2154 # root: of the runner, which sources this
# One header for each controller, as tools/release makes them.

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

# single TARGET: each compiles silently as its implementation and as its user's.
single() {
    single_headers
    printf '#include "%s"\n' *_single.h >user.c
    echo 'typedef int nothing_else;' >>user.c
    quiet compile "$1" -c user.c -o user.rel
    for source in fixpid_*.c; do
        quiet compile "$1" -c "$source" -o "${source%.c}.rel"
    done
}

# All of them in one source, and no function is missing or new.
single_whole() {
    single_headers
    cat fixpid_*.c >whole.c
    quiet compile gcc -c whole.c -o single.o
    (cd "$root" && find src -name '*.c' -exec cc -r -Iinclude -o "$OLDPWD/library.o" {} +)
    nm library.o | sed -n 's/.* T //p' | sort >library
    nm single.o | sed -n 's/.* T //p' | sort >functions
    [ -s library ]
    diff library functions
}

# The recorded rows, with the library's headers made of these.
single_vectors() {
    single_headers
    mkdir include
    for header in *_single.h; do
        echo "#include \"../$header\"" >"include/${header%_single.h}.h"
    done
    cc -Iinclude "$root/test/support/replay.c" fixpid_*.c -o replay
    for rows in "$root"/test/support/vectors/*.csv; do
        module=$(basename "$rows" .csv | sed 's/_firmware$//; s/_definition$//')
        case $module in
        autotune*) ;; # below
        link) ;; # for its unit test
        *) ./replay "$module" "$rows" ;;
        esac
    done
    autotune=$root/test/model/autotune
    ruby "$autotune/table.rb" "$root/test/support/vectors/autotune.csv" >table.c
    cc -Iinclude "-I$autotune" "$autotune/autotune_plant.c" "$autotune/rows.c" \
        "$autotune/player.c" table.c fixpid_pid.c fixpid_autotune.c -o rows
    ./rows
}

# SDCC has its own folders for PICs.
single_pic() {
    single_headers
    refused 'take the folders' sdcc -D__SDCC_pic16 -mstm8 -c fixpid_pid.c
}
