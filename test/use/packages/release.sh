# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# shellcheck disable=SC2154 # root: of the runner, which sources this
# tools/release, on a repository of its own that holds what is here.

# repository FOLDER: with version 0.1.0 released and tagged, if it is the version.
repository() {
    mkdir "$1"
    for entry in "$root"/* "$root"/.[a-z]*; do
        case ${entry##*/} in
        build | .git) ;;
        *) cp -R "$entry" "$1" ;;
        esac
    done
    cd "$1" || return 1
    export GIT_AUTHOR_NAME=a GIT_AUTHOR_EMAIL=a GIT_COMMITTER_NAME=a \
        GIT_COMMITTER_EMAIL=a GIT_AUTHOR_DATE='2026-12-01T00:00:00Z' \
        GIT_COMMITTER_DATE='2026-12-01T00:00:00Z' GIT_CONFIG_GLOBAL=/dev/null
    version=$(ruby -r./tools/lib/project -e 'puts Project::VERSION')
    sed -i "s/^## $version, .*/## $version, 2026-12-01/" CHANGELOG.md
    git init -q
    echo output >.git/info/exclude # of `refused`
    git add -A
    git commit -qm 'All of it'
    git tag "v$version"
}

# All archives are there, and a program can be made of the small one, and of a
# single header.
release() {
    repository fixpid
    tools/release "v$version"
    cd build/release || return 1
    sha256sum -c SHA256SUMS
    singles=$(cd "$root/include" && printf '%s\n' fixpid_*.h | sed 's/\.h$/_single.h/')
    # shellcheck disable=SC2086 # a list of names
    same "$(printf '%s\n' SHA256SUMS "fixpid-$version-source.tar.xz" \
        "fixpid-$version.tar.xz" "fixpid-$version.zip" \
        "fixpid.fixpid.$version.pack" $singles | sort)" \
        "$(printf '%s\n' * | sort)"
    mkdir small whole users pack single
    (cd small && cmake -E tar xf "../fixpid-$version.tar.xz")
    (cd users && cmake -E tar xf "../fixpid-$version.zip")
    (cd pack && cmake -E tar xf "../fixpid.fixpid.$version.pack")
    (cd whole && cmake -E tar xf "../fixpid-$version-source.tar.xz")
    same "$(cd "$OLDPWD" && git ls-files | sort)" \
        "$(cd whole/fixpid && find . -type f | sed 's/^..//' | sort)"
    same "$(cd users/fixpid && find . | sort)" "$(cd pack && find . | sort)"
    for folder in small whole users; do
        find $folder/fixpid/src -name '*.c' -exec \
            cc -I$folder/fixpid/include "$root/examples/quick_start.c" -o quick_start {} +
        ./quick_start >printed
        quick_start_printed printed
    done
    printf '%s\n' '#define FIXPID_PID_IMPLEMENTATION' \
        '#include "../fixpid_pid_single.h"' >single/fixpid_pid.h
    cc -Isingle "$root/examples/quick_start.c" -o quick_start
    ./quick_start >printed
    quick_start_printed printed
}

# Elsewhere, at another time, for another user: the same bytes.
release_again() {
    (repository one && tools/release "v$version")
    find one/src -exec touch -d '2001-01-01' {} +
    (
        umask 077
        export TZ=Asia/Tokyo
        repository two && tools/release "v$version"
    )
    diff one/build/release/SHA256SUMS two/build/release/SHA256SUMS
}

release_refuses() {
    repository fixpid
    tag=v$version
    refused "its tag is $tag, not v9.9.9" tools/release v9.9.9
    refused "its tag is $tag, not $version" tools/release "$version"
    echo >>README.md
    refused 'not committed: .*README.md' tools/release "$tag"
    git commit -qam 'Later'
    refused 'another commit' tools/release "$tag"
    retag() {
        git add -A
        git commit -qm 'A fault'
        git tag -f "$tag" >/dev/null
    }
    sed -i "s/^## $version, .*/## $version, unreleased/" CHANGELOG.md
    retag
    refused 'CHANGELOG.md does not say' tools/release "$tag"
    git reset -q --hard HEAD^
    git tag -f "$tag"
    sed -i 's/^version=.*/version=0.0.9/' library.properties
    retag
    refused 'FAILED library.properties: - version=0.0.9' tools/release "$tag"
    git reset -q --hard HEAD^
    head -c 9000 /dev/urandom | od -An -v -tx1 | sed 's,^,//,' >>src/pid/fixpid_pid.c
    retag
    refused "is not below $(sed -n 's/^most_bytes=\([0-9]*\).*/\1/p' tools/release)" tools/release "$tag"
    git tag -d "$tag"
    refused "there is no tag $tag" tools/release "$tag"
}
