# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# shellcheck disable=SC2034,SC2154 # for and from test/matrix.txt, whose rows these are steps of

venv=$work/venv
python_test=$root/python/test
export MPLCONFIGDIR="$work/matplotlib" PIP_NO_INDEX=1 PIP_DISABLE_PIP_VERSION_CHECK=1

# Of what was installed last.
python() {
    [ -x "$venv/bin/pip" ] || installed >pip.log 2>&1
    PYTHONDONTWRITEBYTECODE=1 "$venv/bin/python" "$@"
}

# installed: as python/README.md says, and nothing is left in the sources.
installed() {
    [ -x "$venv/bin/pip" ] ||
        "${PYTHON:-/usr/bin/python3}" -m venv --system-site-packages "$venv"
    (cd "$root" && "$venv/bin/python" -m pip install --no-build-isolation --no-deps ./python)
    sources_are_clean "$root/python"
}

# sources_are_clean FOLDER
sources_are_clean() {
    same '' "$(find "$1" -name '*.egg-info' -o -name '*.so' -o -name build -o -name '*.[ch]')"
}
