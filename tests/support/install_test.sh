#!/bin/sh
# sh install_test.sh BUILD: the installed program, and the Python module if there is one, work away from the checkout, with its own shaders and assets.
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
prefix/bin/taut manual contact | cmp - prefix/share/taut/manual/contact.md

# As `import taut` finds it with the prefix's folder in PYTHONPATH.
module=$(ls -d prefix/lib/python3*/dist-packages 2>/dev/null || true)
test -n "$module" || exit 0
PYTHONPATH=$module PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 - "$folder" <<'END'
import sys

import taut

assert taut.__file__.startswith(sys.argv[1]), taut.__file__
world = taut.load("flag")
world.step(2)
picture = world.render((160, 90), samples=1)
assert picture.shape == (90, 160, 3) and picture.std() > 5, picture.shape
END
