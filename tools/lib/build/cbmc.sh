# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# Sourced after setup.sh: finds CBMC, the model checker.

# need_cbmc: exports CBMC, a folder with cbmc, goto-cc and goto-instrument of
# version 6: the caller's, that of PATH, or a private one, which it fetches when
# there is none. From the project's folder, or with `root` set to it.
need_cbmc() {
    if [ -n "${CBMC-}" ]; then
        cbmc_works "$CBMC" || die "CBMC=$CBMC has no cbmc of version 6"
        return 0
    fi
    cbmc_home=${XDG_CACHE_HOME:-${HOME:?}/.cache}/fixpid/cbmc-6
    if cbmc_found=$(command -v cbmc); then
        ! cbmc_works "$(dirname -- "$cbmc_found")" || return 0
    fi
    ! sealed "$cbmc_home" || ! cbmc_works "$cbmc_home" || return 0
    say "no cbmc of version 6: fetching a private one, once, to $cbmc_home"
    "${root:-.}/tools/lib/build/fetch_cbmc" "$cbmc_home" || exit 1
    cbmc_works "$cbmc_home" || die "the private cbmc in $cbmc_home does not work"
}

# cbmc_works FOLDER: whether all three programs run; then exports CBMC.
cbmc_works() {
    for cbmc_program in cbmc goto-cc goto-instrument; do
        [ -x "$1/$cbmc_program" ] || return 1
    done
    case $("$1/cbmc" --version 2>/dev/null) in
    6.*) ;;
    *) return 1 ;;
    esac
    CBMC=$(CDPATH='' cd -- "$1" && pwd)
    export CBMC
}
