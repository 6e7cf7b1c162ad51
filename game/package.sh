#!/bin/sh
# Builds the Debian packages taut, libtaut-dev and python3-taut: out/packages/*.deb.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
. "$root/game/build.sh"
. "$root/game/install.sh"
taut_install python package
taut_build -DTAUT_PYTHON=ON

mkdir -p "$root/out/packages"
cd "$build"
cpack -B "$root/out/packages" >>"$log" 2>&1 || { tail -n 30 "$log" >&2; exit 1; }
rm -rf "$root/out/packages/_CPack_Packages"
ls "$root"/out/packages/*.deb
