#!/bin/sh
# sh install_test.sh BUILD: the installed program works away from the checkout, with its own shaders and assets.
set -eu
build=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cmake --install "$build" --prefix "$folder/prefix" >/dev/null
cd "$folder"
prefix/bin/taut doctor >said
grep -q "^shaders *$folder/prefix/share/taut/shaders" said || { cat said; exit 1; }
grep -q "^assets *$folder/prefix/share/taut/assets" said || { cat said; exit 1; }
prefix/bin/taut render flag -o pictures/frame_######.png --frames 0-1 --size 320x180 --quiet
test -s pictures/frame_000001.png
test -s pictures/run_0-1.json
