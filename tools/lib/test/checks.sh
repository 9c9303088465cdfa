# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# shellcheck disable=SC2154 # part, which runs
# Sourced by tools/test: how a part counts what passed and what failed.

folder=build/test
log=$folder/log # what the last command printed

# check NAME COMMAND...: one test, quiet when it passes.
check() {
    name=$1
    shift
    if "$@" >"$log" 2>&1 </dev/null; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED $name; again: tools/test $part, or: $*"
        tail -n 40 "$log"
    fi
}

# check_files NAME FILES COMMAND...: a check for each file, with one command for all of
# them; only where that fails is each judged alone.
check_files() {
    what=$1 files=$2
    shift 2
    # shellcheck disable=SC2086 # a list of files
    if "$@" $files >"$log" 2>&1 </dev/null; then
        # shellcheck disable=SC2086 # a list of files
        passed=$((passed + $(printf '%s\n' $files | wc -l)))
        return
    fi
    for file in $files; do
        check "$what $file" "$@" "$file"
    done
}

# count NAME GOOD BAD COMMAND...: a runner that prints a line for each thing it
# checked, like GOOD or BAD, or `skipped NAME: why`.
count() {
    name=$1 good=$2 bad=$3
    shift 3
    status=0
    "$@" >"$log" 2>&1 </dev/null || status=1
    passes=$(grep -c "$good" "$log") || true
    failures=$(grep -c "$bad" "$log") || true
    skips=$(grep -c '^skipped ' "$log") || true
    [ $status -eq 0 ] || [ "$failures" -ne 0 ] || failures=1
    [ $status -ne 0 ] || [ $((passes + skips)) -ne 0 ] || failures=1
    passed=$((passed + passes))
    failed=$((failed + failures))
    skipped=$((skipped + skips))
    grep '^skipped ' "$log" || true
    if [ "$failures" -ne 0 ]; then
        echo "FAILED $name; again: tools/test $part"
        # The last lines, and of those before what failed.
        grep -v "$good" "$log" | awk -v "bad=$bad" '
            { line[NR] = $0 }
            END { for (at = 1; at <= NR; at++) if (at > NR - 60 || line[at] ~ bad) print line[at] }'
    fi
}

# runner PATH [WORD]...: a runner below test/ (runs.sh, named.rb). Each test that it lists for
# these words must report; only weekly ones there may be none.
runner() {
    listed=$folder/listed started=$1
    shift
    "$started" --list "$@" >"$listed" 2>"$log" </dev/null || {
        failed=$((failed + 1))
        echo "FAILED $started --list $*; again: tools/test $part"
        tail -n 40 "$log"
        return
    }
    [ -s "$listed" ] || [ "$*" != weekly ] || return 0
    count "$started" '^ok ' '^FAILED ' "$started" "$@"
    silent=$(awk 'NR == FNR { sub(/^(ok|FAILED|skipped) /, ""); said[$0]; sub(/[:;].*/, ""); said[$0]; next }
        !($0 in said)' "$log" "$listed")
    [ -z "$silent" ] || {
        failed=$((failed + 1))
        echo "FAILED $started: no word of $(echo "$silent" | paste -sd , -); again: tools/test $part"
    }
}

# run_ceedling NAME TASK TEXT [MIXIN]...: a run with its own build folder, where TEXT is the
# mixin that makes it different. Each unit test counts.
run_ceedling() {
    name=$1 task=$2
    build_root=build/ceedling-$name
    printf ':project:\n  :build_root: %s\n%s\n' "$build_root" "$3" >"$folder/$name.yml"
    shift 3
    set -- "$@" "$folder/$name.yml"
    for mixin; do
        shift
        set -- "$@" "--mixin=$mixin"
    done
    status=0
    tools/lib/test/ceedling "$build_root" "$@" "$task" >"$log" 2>&1 </dev/null || status=1
    tests=$(sed -n 's/^tests //p' "$log" | tail -n 1)
    failures=$(sed -n 's/^failures //p' "$log" | tail -n 1)
    tests=${tests:-0} failures=${failures:-0}
    if [ "$tests" -eq 0 ] || { [ $status -ne 0 ] && [ "$failures" -eq 0 ]; }; then
        failures=$((failures + 1)) # the build, the run or the coverage gate
        tests=$((tests + 1))
    fi
    passed=$((passed + tests - failures))
    failed=$((failed + failures))
    if [ "$failures" -ne 0 ]; then
        echo "FAILED unit tests: $name; again: tools/test $part"
        why=$(sed -n -e '/FAILED TEST SUMMARY/,/OVERALL/p' \
            -e '/EXCEPTION/,$p' -e '/BUILD FAILURE/,$p' "$log")
        printf '%s\n' "${why:-$(tail -n 20 "$log")}" | head -n 60
    fi
}

# without_packages COMMAND...: with all programs of PATH but Debian's package
# tools, as on other systems.
without_packages() {
    bare=$folder/bare
    rm -rf "$bare"
    mkdir -p "$bare"
    for programs in $(printf '%s\n' "$PATH" | tr ':' ' '); do
        # What an earlier folder has stays.
        find -H "$programs" -mindepth 1 -maxdepth 1 ! -name 'apt' ! -name 'apt-*' \
            ! -name dpkg ! -name 'dpkg-*' -exec ln -s -t "$bare" {} + 2>/dev/null || :
    done
    env "PATH=$PWD/$bare" "$@"
}
