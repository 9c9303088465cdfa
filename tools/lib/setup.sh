# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# Sourced by the tools: says what is missing and installs it.

say() {
    printf '%s: %s\n' "${0##*/}" "$*" >&2
}

die() {
    say "$@"
    exit 1
}

# need ITEM...: each is `command`, `command:package` or `:package`, in Debian's
# names. Installs what is missing, or says what is and stops.
need() {
    missing=
    for item in "$@"; do
        command=${item%%:*}
        package=${item##*:}
        if [ -n "$command" ]; then
            command -v "$command" >/dev/null 2>&1 && continue
        else
            dpkg-query -W -f '${Status}' "$package" 2>/dev/null |
                grep -q '^install ok installed' && continue
        fi
        missing="$missing $package"
    done
    [ -n "$missing" ] || return 0
    how="sudo apt-get install --no-install-recommends$missing"
    if ! command -v apt-get >/dev/null 2>&1; then
        die "missing (names of Debian packages):$missing"
    elif [ "$(id -u)" -ne 0 ]; then
        die "missing:$missing; not root, so please run: $how"
    fi
    say "installing$missing (Debian packages)"
    install_log=$(mktemp)
    # shellcheck disable=SC2086 # a list of package names
    if ! { apt-get update -qq &&
        DEBIAN_FRONTEND=noninteractive apt-get install -y -qq \
            --no-install-recommends $missing; } >"$install_log" 2>&1 </dev/null; then
        tail -n 5 "$install_log" >&2
        rm -f "$install_log"
        die "could not install$missing; is there a network? By hand: $how"
    fi
    rm -f "$install_log"
}

# The Ceedling gem, in the system's or in the user's own gem folder.
need_ceedling() {
    need ruby
    PATH=$PATH:$(ruby -e 'print Gem.bindir, ":", Gem.user_dir, "/bin"')
    command -v ceedling >/dev/null 2>&1 && return 0
    where=
    [ "$(id -u)" -eq 0 ] || where=--user-install
    gem="gem install --no-document --conservative $where ceedling -v '>= 1.0.1, < 2'"
    say "installing ceedling (Ruby gem)"
    if ! printed=$(eval "$gem" 2>&1 </dev/null); then
        printf '%s\n' "$printed" | tail -n 5 >&2
        die "could not install ceedling; is there a network? By hand: $gem"
    fi
    command -v ceedling >/dev/null 2>&1 ||
        die "ceedling was installed, but it is in no folder of PATH"
}
