# Sourced by game/demo.sh and tests/run.sh: installs the packages of game/packages.txt that are missing.
# Silent and quick when nothing is missing. Expects `root` to hold the path of the checkout.

# taut_packages GROUP: the packages of one group, one a line.
taut_packages() {
    awk -v group="[$1]" '/^#/ || /^$/ { next } /^\[/ { inside = ($0 == group); next } inside { print $1 }' \
        "$root/game/packages.txt"
}

# taut_install GROUP...: makes sure that the packages of these groups are there, or says what to do.
taut_install() {
    wanted=$(for group in "$@"; do taut_packages "$group"; done)
    if ! command -v dpkg-query >/dev/null 2>&1 || ! command -v apt-get >/dev/null 2>&1; then
        # Another distribution: its packages have other names; the build will name what it does not find.
        echo "taut: this is not Debian; install what these Debian packages hold, then run this again if the build fails:" >&2
        echo "  $(echo $wanted)" >&2
        return 0
    fi
    missing=
    for package in $wanted; do
        status=$(dpkg-query -W -f '${Status}' "$package" 2>/dev/null) || status=
        case $status in
            "install ok installed") ;;
            *) missing="$missing $package" ;;
        esac
    done
    [ -n "$missing" ] || return 0

    if [ "$(id -u)" -eq 0 ]; then
        as_root=
    elif command -v sudo >/dev/null 2>&1; then
        as_root=sudo
    else
        echo "taut: these packages are missing and this user may not install them:" >&2
        echo "  apt-get install$missing" >&2
        echo "Have an administrator run that line, then run this again." >&2
        return 1
    fi
    echo "Installing:$missing"
    log=$(mktemp) || return 1
    if $as_root apt-get update >"$log" 2>&1 &&
        $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends $missing >"$log" 2>&1; then
        rm -f "$log"
        return 0
    fi
    tail -n 5 "$log" >&2
    rm -f "$log"
    echo "taut: could not install:$missing" >&2
    echo "Is there a network? Once there is, run: apt-get install$missing" >&2
    return 1
}
