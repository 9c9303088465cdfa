# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# shellcheck disable=SC2154 # root, work
# Sourced by the runners below test/, after setup.sh: what each is asked for in the same
# words (`asked`), and how it judges commands. They set `root`, the project's folder, and
# `work`, a folder of their own. In Ruby it is named.rb.

# What a user's shell might set and these projects should not see.
unset CDPATH CC CXX CFLAGS CXXFLAGS CPPFLAGS LDFLAGS DESTDIR MAKEFLAGS
unset CMAKE_PREFIX_PATH CMAKE_GENERATOR CMAKE_BUILD_TYPE PKG_CONFIG_PATH
export LC_ALL=C

# --- which tests ---

# asked SCRIPT [ARGUMENT]...: answers --help with the script's first comment, and sets
# `chosen`, a line for each test to run: those that are named, with --failed what failed
# when it ran last, and with no argument all. The runner has a function `names`, which
# prints all; or it calls `wanted` before each test. It may have a function `weekly_names`,
# which prints those that run once a week: the word `weekly` names these, and `daily` the
# others. --list prints what would run.
asked() {
    script=$1
    record=$root/build/failed/$(echo "$script" | tr / _)
    listing=no
    chosen=
    left_out=
    shift
    all=$(names 2>/dev/null) || all=
    weekly=$(weekly_names 2>/dev/null) || weekly=
    case ${1-} in
    --list)
        listing=yes
        shift
        ;;
    -h | --help)
        sed -n '3,/^[^#]/{/shellcheck/d;s/^# \{0,1\}//p;}' "$root/$script"
        exit 0
        ;;
    --failed)
        [ -s "$record" ] || {
            echo 'nothing failed last time'
            exit 0
        }
        chosen=$(cat "$record")
        return
        ;;
    esac
    [ $# -ne 0 ] || chosen=$all
    for name in "$@"; do
        named=$name
        case $name in
        -*) wrong_name "$name" ;;
        weekly)
            named=$weekly
            [ -n "$weekly" ] || left_out=every
            ;;
        daily)
            named=$(printf '%s\n' "$all" | grep -vxF -e "$weekly") || named=
            [ -n "$all" ] || left_out=$weekly
            ;;
        *)
            [ -z "$all" ] || printf '%s\n' "$all" | grep -qxF -e "$name" ||
                wrong_name "$name"
            ;;
        esac
        chosen="$chosen${chosen:+
}$named"
    done
    [ "$listing" = no ] || [ -z "$all" ] || {
        [ -z "$chosen" ] || printf '%s\n' "$chosen"
        exit 0
    }
}

wrong_name() {
    say "no such test: $1; see --list"
    exit 2
}

# wanted NAME: whether to run this test; for --list it says the name.
seen=
wanted() {
    [ "$left_out" != every ] || return 1
    ! printf '%s\n' "$left_out" | grep -qxF -e "$1" || return 1
    picked=yes
    [ -z "$chosen" ] || printf '%s\n' "$chosen" | grep -qxF -e "$1" || picked=no
    printf '%s\n' "$seen" | grep -qxF -e "$1" || {
        [ "$listing$picked" != yesyes ] || echo "$1"
        seen="$seen
$1"
    }
    [ "$listing$picked" = noyes ]
}

# each COMMAND...: with the name of each chosen test as its last arguments, one for each
# word; and the runner ends.
each() {
    while read -r name <&3; do
        # shellcheck disable=SC2086 # its words
        [ -z "$name" ] || "$@" "$name" $name
    done 3<<END
$chosen
END
    finish
}

# The end of a runner. What was named is a test.
finish() {
    [ -z "$seen" ] || printf '%s\n' "$chosen" | while read -r name; do
        printf '%s\n' "$seen" | grep -qxF -e "$name" || wrong_name "$name"
    done || exit 2
    [ "$failures" -eq 0 ]
    exit
}

# --- what they print ---

failures=0

# passed NAME [WORDS], or failed NAME [LOG].
passed() {
    remember "$1"
    echo "ok $1${2:+: $2}"
}

failed() {
    remember "$1" failed
    failures=$((failures + 1))
    echo "FAILED $1; again: $(again "$1")"
    [ -z "${2-}" ] || tail -n 40 "$2" | sed 's/^/    /'
}

again() {
    case $1 in
    *[!A-Za-z0-9_.-]*) echo "$script '$1'" ;;
    *) echo "$script $1" ;;
    esac
}

# attempt NAME COMMAND...: passed with the last line that it prints, or failed.
attempt() {
    attempted=$1
    shift
    if "$@" >"$work/log" 2>&1 </dev/null; then
        passed "$attempted" "$(tail -n 1 "$work/log")"
    else
        failed "$attempted" "$work/log"
    fi
}

# runner NAME COMMAND...: one that prints its own lines for what it checks.
runner() {
    attempted=$1
    shift
    if "$@" >"$work/log" 2>&1 </dev/null; then
        remember "$attempted"
        grep '^ok ' "$work/log"
        echo "ok $attempted"
    elif grep -q '^FAILED ' "$work/log"; then
        remember "$attempted" failed
        failures=$((failures + 1))
        grep '^ok ' "$work/log"
        grep -v '^ok ' "$work/log" | tail -n 60
        echo "again: $(again "$attempted")"
    else
        failed "$attempted" "$work/log"
    fi
}

# try_out NAME COMMAND...: in a folder of its own, $work/NAME.
try_out() {
    tried=$1
    shift
    mkdir "$work/$tried" || exit 1
    # Not in a condition: that would switch -e off inside.
    (
        set -e
        cd "$work/$tried"
        "$@"
    ) >"$work/$tried.log" 2>&1 </dev/null
    status=$?
    if [ "$status" -eq 0 ]; then
        passed "$tried"
    else
        failed "$tried" "$work/$tried.log"
    fi
}

# --- what they take ---

# user_files FOLDER: what users get.
user_files() {
    (cd "$root" && ruby -r./tools/lib/project -e 'puts Project::USER_FILES') |
        while read -r path; do
            mkdir -p "$1/$(dirname "$path")"
            cp -R "$root/$path" "$1/$path"
        done
}

# --- how they judge ---

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
