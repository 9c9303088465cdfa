# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# shellcheck disable=SC2154 # root: of the runner, which sources this
# tools/release, on a repository of its own that holds what is here.

address=https://fixpid.invalid

# repository FOLDER: with its version released and tagged, and an address.
repository() {
    whole_tree "$1"
    cd "$1" || return 1
    export GIT_AUTHOR_NAME=a GIT_AUTHOR_EMAIL=a GIT_COMMITTER_NAME=a \
        GIT_COMMITTER_EMAIL=a GIT_AUTHOR_DATE='2026-12-01T00:00:00Z' \
        GIT_COMMITTER_DATE='2026-12-01T00:00:00Z' GIT_CONFIG_GLOBAL=/dev/null
    version=$(ruby -r./tools/lib/project -e 'puts Project::VERSION')
    sed -i "s/^## $version, .*/## $version, 2026-12-01/" CHANGELOG.md
    sed -i "s,^  ADDRESS = .*,  ADDRESS = '$address'," tools/lib/project.rb
    ruby tools/lib/manifests.rb --update >manifests
    rm manifests
    git init -q
    echo output >.git/info/exclude # of `refused`
    git add -A
    git commit -qm 'All of it'
    git tag "v$version"
}

# All archives are there, and a program can be made of the small one, and of a
# single header. The bill of materials and the links are right, and a fault of each is seen.
release() {
    repository fixpid
    mkdir -p build/kept
    printf 'commit: %s\nok a\nended with 0\n' "$(git rev-parse HEAD)" >build/kept/long.log
    printf 'commit: %s\nok b\nended with 1\n' "$(git rev-parse HEAD)" >build/kept/failed.log
    tools/release "v$version"
    tools/release --notes >build/notes
    grep -q '^### Added$' build/notes
    if grep '^## ' build/notes; then
        return 1
    fi
    cd build/release || return 1
    sha256sum -c SHA256SUMS
    singles=$(cd "$root/include" && printf '%s\n' fixpid_*.h | sed 's/\.h$/_single.h/')
    # shellcheck disable=SC2086 # a list of names
    same "$(printf '%s\n' SHA256SUMS "fixpid-$version-source.tar.xz" \
        "fixpid-$version.tar.xz" "fixpid-$version.zip" "fixpid-$version.spdx.json" \
        "fixpid-$version-commit.txt" "fixpid-$version-logs.tar.xz" \
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
    same long.log "$(cmake -E tar tf "fixpid-$version-logs.tar.xz")"
    grep -qx "commit: $(git rev-parse HEAD)" "fixpid-$version-commit.txt"
    (
        cd .. # what is judged stays as it is
        # shellcheck disable=SC2317 # quiet and refused call it
        judge() { ruby "$here/release.rb" release release/users/fixpid release/small/fixpid; }
        quiet judge
        refused_once() { # PATTERN FILE TEXT: with this at its end
            cp "release/$2" kept_file
            printf '%s\n' "$3" >>"release/$2"
            refused "$1" judge
            mv kept_file "release/$2"
        }
        refused_once "^fixpid-$version.zip: ./include/fixpid.h is " users/fixpid/include/fixpid.h //
        refused_once "^fixpid-$version.tar.xz: another verification code" small/fixpid/LICENSE x
        refused_once '^archives: fixpid_pid_single.h is ' fixpid_pid_single.h //
        refused_once '^README.md leads to docs/none.md, ' users/fixpid/README.md '[a](docs/none.md)'
        refused_once '^docs/cost.md leads to none.md, ' users/fixpid/docs/cost.md '[a](none.md)'
    )
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
    sed -i 's,^  ADDRESS = .*,  ADDRESS = nil,' tools/lib/project.rb
    ruby tools/lib/manifests.rb --update >output
    retag
    refused 'no release: tools/lib/project.rb has no ADDRESS, ' tools/release "$tag"
    git reset -q --hard HEAD^
    git tag -f "$tag"
    head -c 9000 /dev/urandom | od -An -v -tx1 | sed 's,^,//,' >>src/pid/fixpid_pid.c
    retag
    refused "is not below $(sed -n 's/^most_bytes=\([0-9]*\).*/\1/p' tools/release)" tools/release "$tag"
    git tag -d "$tag"
    git reset -q --hard HEAD^
    refused "no release: there is no tag $tag$" tools/release "$tag"
    rm -rf .git
    refused 'in a clone' tools/release --snapshot
}

# Of a commit that is no release, and says so in one line.
release_snapshot() {
    repository fixpid
    git tag -d "v$version"
    sed -i "s/^## $version, .*/## $version, unreleased/" CHANGELOG.md
    git commit -qam 'Later'
    tools/release --snapshot >output 2>&1
    grep -qx "release: a snapshot; for a release: there is no tag v$version; CHANGELOG.md does not say on which day $version was released" output
    cd build/release || return 1
    sha256sum -c SHA256SUMS
    name=fixpid-$version-snapshot-$(git rev-parse --short=12 HEAD)
    ls "$name.zip" "$name.spdx.json" "$name-commit.txt" fixpid_pid_single.h
}
