# Sourced by game/demo.sh and tests/run.sh: installs the packages of game/packages.txt that are missing.
# Silent and quick when nothing is missing. Expects `root` to hold the path of the checkout.

# taut_packages GROUP: the lines of one group: a package each, or `one | another`.
taut_packages() {
    awk -v group="[$1]" '/^#/ || /^$/ { next } /^\[/ { inside = ($0 == group); next } inside' \
        "$root/game/packages.txt"
}

taut_is_installed() {
    [ "$(dpkg-query -W -f '${Status}' "$1" 2>/dev/null)" = "install ok installed" ]
}

# taut_one_of PACKAGE [| PACKAGE]...: the first that is installed or that apt knows, else the last.
taut_one_of() {
    while [ $# -gt 1 ] && ! taut_is_installed "$1" && ! apt-cache show "$1" >/dev/null 2>&1; do shift 2; done
    echo "$1"
}

# taut_missing GROUP...: the packages that are not installed, one a line.
taut_missing() {
    for group in "$@"; do taut_packages "$group"; done | while read -r line; do
        # shellcheck disable=SC2086  # words
        package=$(taut_one_of $line)
        taut_is_installed "$package" || echo "$package"
    done
}

# taut_install GROUP...: makes sure that the packages of these groups are there, or says what to do.
taut_install() {
    if ! command -v dpkg-query >/dev/null 2>&1 || ! command -v apt-get >/dev/null 2>&1; then
        # Another distribution: its packages have other names; the build will name what it does not find.
        echo "taut: this is not Debian; install what these Debian packages hold, then run this again if the build fails:" >&2
        # shellcheck disable=SC2046  # words
        echo "  $(echo $(for group in "$@"; do taut_packages "$group"; done))" >&2
        return 0
    fi
    # shellcheck disable=SC2046  # words
    missing=$(echo $(taut_missing "$@"))
    [ -n "$missing" ] || return 0

    if [ "$(id -u)" -eq 0 ]; then
        as_root=
    elif command -v sudo >/dev/null 2>&1; then
        as_root=sudo
    else
        echo "taut: these packages are missing and this user may not install them:" >&2
        echo "  apt-get install $missing" >&2
        echo "Have an administrator run that line, then run this again." >&2
        return 1
    fi
    echo "Installing: $missing"
    log=$(mktemp) || return 1
    # Before the update apt may know no packages, and so choose the wrong one of several.
    # shellcheck disable=SC2046,SC2086  # words
    if $as_root apt-get update >"$log" 2>&1 && missing=$(echo $(taut_missing "$@")) &&
        $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends $missing >"$log" 2>&1; then
        rm -f "$log"
        return 0
    fi
    tail -n 5 "$log" >&2
    rm -f "$log"
    echo "taut: could not install: $missing" >&2
    echo "Is there a network? Once there is, run: apt-get install $missing" >&2
    return 1
}
