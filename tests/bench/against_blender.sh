#!/bin/sh
# What a cloth costs in taut and in Blender, one thread each, no pictures: user processor time, of Blender of stepping
# through the frames alone, of taut of all of the program. Each line has the least of three runs of both, in turn, and
# the median of the three ratios.
#
#   sh tests/bench/against_blender.sh [TAUT [drape|fold]]     (apt-get install --no-install-recommends blender)
#
# drape: 71 × 71 points fall on a ball and do not touch themselves, in Blender with its damping by air (1) and without.
# fold: a sheet falls on its edge and folds on a ball, 40 × 40 and 64 × 64 cells, layers 8 mm apart; in Blender as it is
# set (5 steps a frame, 2 rounds of collision) and with the rounds that it takes to cross nothing, without damping by
# air. What is crossed is counted in the meshes of all frames by one program for both, which stands beside TAUT in a
# build with -DTAUT_BENCH=ON (target taut_mesh_crossings).
set -eu
here=$(cd "$(dirname "$0")" && pwd)
taut=${1:-$here/../../build-bench/game/taut}
what=${2:-drape fold}
crossings=$(dirname "$taut")/../tests/bench/taut_mesh_crossings
if ! command -v blender >/dev/null; then
    echo "against_blender: Blender is not installed; apt-get install --no-install-recommends blender" >&2
    exit 1
fi
for program in "$taut" "$crossings"; do
    if ! [ -x "$program" ]; then
        echo "against_blender: there is no program $program; build it, or name another" >&2
        exit 1
    fi
done
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# Seconds of user time of what was started, from the second line of `times`: 0m1.910s.
run_taut() { # SCENE CELLS
    (
        "$taut" render "$here/$1" --set "cloth.sheet.cells=[$2,$2]" --no-pictures --quiet --threads 1 -y \
            -o "$folder/f_#.png" >&2
        times
    ) | awk 'NR == 2 { split($1, t, /[ms]/); print 60 * t[1] + t[2] }'
}

# Waiting threads of OpenMP burn time, so it has one.
run_blender() ( # SCENE CELLS SETTING…
    scene=$1 cells=$2
    shift 2
    OMP_NUM_THREADS=1 blender -b -t 1 --factory-startup -noaudio --python-exit-code 1 -P "$here/against_blender.py" \
        -- "$here/$scene" "cells=$cells" "$@" | awk '/^cloth: / { print $2 }'
)

compare() { # SCENE CELLS SETTING
    : >"$folder/times"
    for turn in 1 2 3; do
        ours=$(run_taut "$1" "$2")
        theirs=$(run_blender "$@")
        echo "$ours $theirs" >>"$folder/times"
    done
    printf '%s × %s cells, Blender with %s: ' "$2" "$2" "$3"
    awk '
        NF < 2 { bad = 1; exit }
        NR == 1 || $1 < ours { ours = $1 }
        NR == 1 || $2 < theirs { theirs = $2 }
        { ratio[NR] = $1 / $2 }
        END {
            if (bad || NR < 3) { print "against_blender: a run failed" > "/dev/stderr"; exit 1 }
            low = high = ratio[1]
            for (i in ratio) { sum += ratio[i]; if (ratio[i] < low) low = ratio[i]; if (ratio[i] > high) high = ratio[i] }
            printf "taut %.2f s, Blender %.2f s, ratio %.2f\n", ours, theirs, sum - low - high
        }' "$folder/times"
}

# Of the meshes in the folder, which are removed.
count() { # NAME
    "$crossings" count "$folder"/meshes/*.obj |
        awk -v name="$1" '
            { printf "%s: crossings in %d of %d frames, at most %d\n", name, $1, $2, $3 }
            END { exit NR != 1 }'
    rm -r "$folder/meshes"
}

fold() { # CELLS ROUNDS…
    scene=contact_against_blender.toml cells=$1
    shift
    mkdir "$folder/meshes"
    "$crossings" play "$here/$scene" "$folder/meshes" "cloth.sheet.cells=[$cells,$cells]"
    count "$cells × $cells cells, taut"
    for rounds in "$@"; do
        compare $scene "$cells" "collision_quality=$rounds"
        mkdir "$folder/meshes"
        run_blender $scene "$cells" "collision_quality=$rounds" "meshes=$folder/meshes" >"$folder/unused"
        count "$cells × $cells cells, Blender with collision_quality=$rounds"
    done
}

blender --version | head -n 1
for scene in $what; do
    case $scene in
    drape)
        compare against_blender.toml 70 air=0
        compare against_blender.toml 70 air=1
        ;;
    fold)
        fold 40 2 4
        fold 64 2 10
        ;;
    *)
        echo "against_blender: $scene is neither drape nor fold" >&2
        exit 2
        ;;
    esac
done
