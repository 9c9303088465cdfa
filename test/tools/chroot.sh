# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# shellcheck disable=SC2154 # root, work: of the runner, which sources this
# A Debian of its own in $work/chroot, for the runners that want a bare one or a newer one
# than this machine's. Nothing stays mounted, and the chroot is removed at the end. They
# have a function `skip`, for a machine on which that cannot be.
chroot=$work/chroot
unfinished= # a file of theirs elsewhere that must not stay

# need_chroot SUITE NAME: sets `mirror` to what has this Debian, and empties $work.
need_chroot() {
    [ "$(id -u)" -eq 0 ] || skip 'not root'
    command -v apt-get >/dev/null || skip 'no apt'
    need debootstrap ruby git
    chroot / true 2>/dev/null || skip 'no chroot is allowed here'
    mirror=$(apt-get update --print-uris 2>/dev/null |
        sed -n "s,^'\(.*\)/dists/bookworm/InRelease'.*,\1,p" | head -n 1)
    [ -n "$mirror" ] || skip 'apt has no mirror of Debian 12'
    trap clean_up EXIT
    trap 'say interrupted; exit 130' INT TERM HUP
    clean_up
    work_folder "$work" 1500
    /usr/lib/apt/apt-helper download-file "$mirror/dists/$1/InRelease" \
        "$work/InRelease" >"$work/log" 2>&1 || skip "the mirror of $2 does not answer"
}

# debootstrap mounts /proc and /sys, and leaves them so where it is killed.
clean_up() {
    awk -v "chroot=$chroot/" 'index($2, chroot) == 1 { print $2 }' /proc/mounts |
        sort -r | while read -r mounted; do
        umount "$mounted"
    done
    rm -rf --one-file-system "$work" ${unfinished:+"$unfinished"}
}

# bootstrap SUITE: what every Debian has.
bootstrap() {
    debootstrap --variant=minbase "$1" "$chroot" "$mirror" >"$work/log" 2>&1 || {
        tail -n 5 "$work/log" >&2
        die 'debootstrap failed'
    }
}

# The last commit is in /fixpid there, or of an archive without a history all of it, with
# what reaches the mirror from here: names, apt's settings and certificates.
furnish() {
    for file in resolv.conf hosts apt/auth.conf apt/auth.conf.d ssl/certs/ca-certificates.crt; do
        [ ! -e "/etc/$file" ] || {
            mkdir -p "$chroot/etc/$(dirname "$file")"
            cp -RL "/etc/$file" "$chroot/etc/$(dirname "$file")/"
        }
    done
    apt-config dump Acquire >"$chroot/etc/apt/apt.conf.d/machine"
    printf '[safe]\n\tdirectory = *\n' >"$work/gitconfig" # in CI it may be another user's
    if [ -e "$root/.git" ]; then
        GIT_CONFIG_GLOBAL=$work/gitconfig git clone -q --no-hardlinks "$root" "$chroot/fixpid" ||
            die "cannot clone $root"
    else
        mkdir "$chroot/fixpid"
        tar -C "$root" --exclude=./build -cf - . | tar -C "$chroot/fixpid" -xf - ||
            die "cannot copy $root"
    fi
}

# inside COMMAND...: there, with nothing of this machine's environment.
inside() {
    env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root \
        ${http_proxy:+"http_proxy=$http_proxy"} ${https_proxy:+"https_proxy=$https_proxy"} \
        chroot "$chroot" "$@"
}
