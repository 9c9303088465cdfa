# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# shellcheck disable=SC2154 # work
# Sourced by the runners that try things out in throw-away folders, each under a
# name: how they judge commands, and how a name is run. They set `work`, the folder
# of these folders, and have a function `names` that prints the names.

# What a user's shell might set and these projects should not see.
unset CDPATH CC CXX CFLAGS CXXFLAGS CPPFLAGS LDFLAGS DESTDIR MAKEFLAGS
unset CMAKE_PREFIX_PATH CMAKE_GENERATOR CMAKE_BUILD_TYPE PKG_CONFIG_PATH
export LC_ALL=C

# quiet COMMAND...: succeeds and prints nothing.
quiet() {
    if ! "$@" >output 2>&1; then
        cat output
        echo "failed: $*"
        return 1
    elif [ -s output ]; then
        cat output
        echo "not silent: $*"
        return 1
    fi
}

# refused PATTERN COMMAND...: fails, and for the reason given.
refused() {
    pattern=$1
    shift
    if "$@" >output 2>&1; then
        echo "should fail: $*"
        return 1
    elif ! grep -q -e "$pattern" output; then
        cat output
        echo "failed, but without '$pattern': $*"
        return 1
    fi
}

# same EXPECTED ACTUAL
same() {
    [ "$1" = "$2" ] && return 0
    printf 'expected:\n%s\nfound:\n%s\n' "$1" "$2"
    return 1
}

# asked SCRIPT [NAME]...: answers --list and --help, whose text is the script's
# first comment, and stops at what is no name.
asked() {
    script=$1
    shift
    case ${1-} in
    --list)
        names | tr ' ' '\n'
        exit 0
        ;;
    -h | --help)
        sed -n '3,/^[^#]/s/^# \{0,1\}//p' "$script"
        exit 0
        ;;
    esac
    for name in "$@"; do
        if ! names | tr ' ' '\n' | grep -qxF -e "$name"; then
            say "no such name: $name; see --list"
            exit 2
        fi
    done
}

failures=0

# try_out NAME COMMAND...: in the folder $work/NAME; prints `ok NAME` or `FAILED
# NAME` and the log.
try_out() {
    name=$1
    shift
    mkdir "$work/$name" || exit 1
    # Not in a condition: that would switch -e off inside.
    (
        set -e
        cd "$work/$name"
        "$@"
    ) >"$work/$name.log" 2>&1 </dev/null
    status=$?
    if [ "$status" -eq 0 ]; then
        echo "ok $name"
    else
        echo "FAILED $name"
        sed 's/^/    /' "$work/$name.log"
        failures=$((failures + 1))
    fi
}
