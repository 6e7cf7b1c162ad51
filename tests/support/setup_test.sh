#!/bin/sh
# sh setup_test.sh CHECKOUT: what the set-up says when it cannot install, without touching the machine. The commands
# that it asks are replaced by ones that answer as such a machine would.
set -eu
root=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
answer() { printf '#!/bin/sh\n%s\n' "$2" >"$folder/$1"; chmod +x "$folder/$1"; }
for tool in awk cat mktemp rm tail env sh; do ln -s "$(command -v $tool)" "$folder/$tool"; done
setup() { (PATH=$folder; root=$root; . "$root/game/install.sh"; taut_install run) >"$folder/said" 2>&1; }
expect() { grep -q "$1" "$folder/said" || { echo "expected: $1"; cat "$folder/said"; exit 1; }; }

# Everything is there: silent.
answer dpkg-query 'echo "install ok installed"'
answer apt-get 'exit 1'
answer id 'echo 1000'
setup
test ! -s "$folder/said"

# A release that lacks a package and has another in its place: silent, too.
answer dpkg-query 'test "$4" != libosmesa6-dev && echo "install ok installed"'
answer apt-cache 'test "$2" != libosmesa6-dev'
setup
test ! -s "$folder/said"

# Packages are missing, no root, no sudo: they are named, of several the first that the release has.
answer dpkg-query 'exit 1'
if setup; then echo "a user without rights cannot have succeeded"; exit 1; fi
expect 'apt-get install .*pkg-config .*libegl-dev'
if grep -q libosmesa6-dev "$folder/said"; then echo "a package that the release lacks is named"; exit 1; fi
answer apt-cache 'exit 0'
if setup; then echo "a user without rights cannot have succeeded"; exit 1; fi
expect 'apt-get install .*libosmesa6-dev'

# Root, but no network: apt's own words, and the packages.
answer id 'echo 0'
answer apt-get 'echo "Temporary failure resolving"; exit 100'
if setup; then echo "an installation that failed cannot have succeeded"; exit 1; fi
expect 'Temporary failure resolving'
expect 'could not install:.*libbullet-dev'

# Another distribution: the packages are named and the build goes on.
rm "$folder/dpkg-query"
setup
expect 'not Debian'
expect 'libtomlplusplus-dev'
