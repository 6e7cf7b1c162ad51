#!/bin/sh
# sh peers_test.sh BULLET TAUT: what peers.sh tells others is the fabric that it says, and taut reads what it writes.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
sh "$here/peers.sh" "$1" few >"$folder/peers.csv"
# Theory: the heavy elastica; 10 cells are 1 or 2 % off. Springs across two cells have a theory of their own, or two
# programs that share no code: within 5 %.
awk -F, '
    NR > 1 && $5 != 1 { print "not at rest: " $0; bad = 1 }
    /angular,1,/ { angular1 = $4 }
    /angular,10,/ { angular10 = $4 }
    /linear,10,/ { linear = $4 }
    /Bullet/ { bullet = $4 }
    function near(what, value, expected, part) {
        if (value < expected * (1 - part) || value > expected * (1 + part)) {
            print what ": " value ", expected " expected; bad = 1
        }
    }
    END {
        near("angular at 1", angular1, 0.124562, 0.02)
        near("angular at 10", angular10, 1.066802, 0.02)
        near("linear against Bullet at 10", linear, bullet, 0.05)
        exit bad
    }' "$folder/peers.csv"
"$2" reality --only R5 --cells 16 --beside "$folder/peers.csv" --quiet -o "$folder/out" >"$folder/said" || true
grep -q "Blender.* angular" "$folder/out/reality.html"
