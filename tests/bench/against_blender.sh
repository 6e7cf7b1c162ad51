#!/bin/sh
# What a cloth that falls on a ball costs in taut and in Blender: 71 × 71 points, 1.8 m, 0.15 kg/m², 300 N/m, 2 s, one
# thread each, no pictures. Prints the user processor time of both and their ratio; the least of three runs each, in
# turn. Of Blender only the stepping through the frames counts, of taut all of the program.
#
#   sh tests/bench/against_blender.sh [TAUT]        (apt-get install --no-install-recommends blender)
#
# Blender's damping by air does not know the mass: as Blender sets it (1) a cloth this light sinks 5 mm in 2 s and never
# touches the ball. So there is none in either (0); the line with 1 is shown for completeness.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
taut=${1:-$here/../../build-bench/game/taut}
if ! command -v blender >/dev/null; then
    echo "against_blender: Blender is not installed; apt-get install --no-install-recommends blender" >&2
    exit 1
fi
if ! [ -x "$taut" ]; then
    echo "against_blender: there is no program $taut; build it, or name another" >&2
    exit 1
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# Seconds of user time of what was started, from the second line of `times`: 0m1.910s.
run_taut() {
    (
        "$taut" render "$here/against_blender.toml" --no-pictures --quiet --threads 1 -y -o "$folder/f_#.png" >&2
        times
    ) | awk 'NR == 2 { split($1, t, /[ms]/); print 60 * t[1] + t[2] }'
}

# Waiting threads of OpenMP burn time, so it has one.
run_blender() {
    OMP_NUM_THREADS=1 blender -b -t 1 --factory-startup -noaudio --python-exit-code 1 -P "$here/against_blender.py" \
        -- "$1" | awk '/^cloth: / { print $2 }'
}

compare() {
    : >"$folder/times"
    for turn in 1 2 3; do
        ours=$(run_taut)
        theirs=$(run_blender "$1")
        echo "$ours $theirs" >>"$folder/times"
    done
    awk -v air="$1" '
        NF < 2 { bad = 1 }
        NR == 1 || $1 < ours { ours = $1 }
        NR == 1 || $2 < theirs { theirs = $2 }
        END {
            if (bad) { print "against_blender: a run failed" > "/dev/stderr"; exit 1 }
            printf "air damping %s in Blender: taut %.2f s, Blender %.2f s, ratio %.2f\n", air, ours, theirs, ours / theirs
        }' "$folder/times"
}

blender --version | head -n 1
compare 0
compare 1
