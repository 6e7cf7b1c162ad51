#!/bin/sh
# What a cloth costs in taut and beside it, one thread each, no pictures. Prints a table as Markdown.
#
#   sh tests/bench/beside.sh [TAUT [ball|fold]]
#
# TAUT: the program of a build with -DTAUT_BENCH=ON (targets taut, taut_mesh_crossings, taut_beside_bullet); that of
# build-bench if not given.
# ball: a cloth falls on a ball of 1280 triangles, in taut, Blender, Jolt and Bullet. It takes ten minutes.
# fold: a sheet falls on its edge and folds on a ball, in taut and Blender; layers are 8 mm apart.
#
# User time [s] is the least of three runs: of taut all of the program, of the others stepping alone. What a cloth
# does is read from its meshes by the same two programs for all: taut_mesh_crossings counts edges through triangles,
# and beside_shape.awk takes strains and heights of the last frame.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
taut=${1:-$here/../../build-bench/game/taut}
what=${2:-ball fold}
crossings=$(dirname "$taut")/../tests/bench/taut_mesh_crossings
bullet=$(dirname "$taut")/../tests/bench/taut_beside_bullet
jolt=jolt-physics@1.1.0
missing() { # WHAT COMMAND
    echo "beside: $1; $2" >&2
    exit 1
}
command -v blender >/dev/null || missing "Blender is not installed" "apt-get install --no-install-recommends blender"
command -v python3 >/dev/null || missing "Python is not installed" "apt-get install python3"
for program in "$taut" "$crossings" "$bullet"; do
    [ -x "$program" ] || missing "there is no program $program" \
        "cmake -S . -B build-bench -DTAUT_BENCH=ON && cmake --build build-bench --target $(basename "$program")"
done
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# Each of these plays the scene, writes its frames to $folder/meshes and prints the seconds.

run_taut() { # KEY=VALUE…
    "$crossings" play "$here/$scene" "$folder/meshes" "$@"
    for setting in "$@"; do
        shift
        set -- "$@" --set "$setting"
    done
    # The second line of `times`, of what was started: 0m1.910s.
    (
        "$taut" render "$here/$scene" "$@" --no-pictures --quiet --threads 1 -y -o "$folder/f_#.png" >&2
        times
    ) | awk 'NR == 2 { split($1, t, /[ms]/); print 60 * t[1] + t[2] }'
}

# Waiting threads of OpenMP burn time, so it has one.
run_blender() { # SETTING…
    OMP_NUM_THREADS=1 blender -b -t 1 --factory-startup -noaudio --python-exit-code 1 -P "$here/beside_blender.py" \
        -- "$here/$scene" "meshes=$folder/meshes" "$@" | awk '/^spent: / { print $2 }'
}

run_jolt() { # ROUNDS RATE STIFFER
    node "$here/beside_jolt.mjs" "$folder" "$folder/scene.json" "$folder/meshes" "$@"
}

run_bullet() { # SHAPE ROUNDS RATE
    "$bullet" "$folder/scene.json" "$folder/meshes" "$@"
}

row() { # NAME RUN ARGUMENT…
    name=$1
    shift
    : >"$folder/times"
    for turn in 1 2 3; do
        rm -rf "$folder/meshes"
        mkdir "$folder/meshes"
        "$@" >>"$folder/times"
    done
    crossed=$("$crossings" count "$folder"/meshes/*.obj)
    shape=$(for last in "$folder"/meshes/*.obj; do :; done && awk -v side="$side" -f "$here/beside_shape.awk" "$last")
    awk -v name="$name" -v crossed="$crossed" -v shape="$shape" '
        NF != 1 { bad = 1; exit }
        NR == 1 || $1 < least { least = $1 }
        END {
            if (bad || NR != 3) { print "beside: a run failed: " name > "/dev/stderr"; exit 1 }
            split(crossed, c)
            printf "| %s | %.2f s | %s | %d of %d, at most %d |\n", name, least, shape, c[1], c[2], c[3]
        }' "$folder/times"
}

head_of_table() {
    echo
    echo "| $1 | user time | strain, mean and largest | lowest and middle point | frames with crossings |"
    echo "|---|---|---|---|---|"
}

ball() {
    scene=beside_ball.toml side=1.8
    command -v npm >/dev/null || missing "npm is not installed" "apt-get install --no-install-recommends nodejs npm"
    npm install --silent --no-save --prefix "$folder" $jolt >&2 ||
        missing "Jolt cannot be had; is there a network?" "npm install --prefix FOLDER $jolt"
    # What has no reader of TOML gets JSON, with the path of the model from here.
    python3 -c 'import json, os, sys, tomllib
with open(sys.argv[1], "rb") as file:
    told = tomllib.load(file)
ball = told["collider"]["ball"]
ball["mesh"] = os.path.join(os.path.dirname(sys.argv[1]), ball["mesh"])
json.dump(told, sys.stdout)' "$here/$scene" >"$folder/scene.json"
    head_of_table "a cloth of 71 × 71 points falls on a ball"
    row "taut" run_taut
    row "Blender, quality 1" run_blender quality=1
    row "Blender, quality 5, as it is set" run_blender quality=5
    # Quality is the number of steps a frame. Of 5, 10, 11, 15, 20 and 40 this is the one that comes nearest.
    row "Blender, strain as taut: quality 11" run_blender quality=11
    # As it is set it has 5 rounds a step, and 60 steps a second are those of its documents.
    row "Jolt, 5 rounds at 60 Hz, as it is set" run_jolt 5 60 1
    # With the springs of taut 150 rounds a frame are a fifth off its strain still. Springs 4 times as stiff reach it
    # with the fewest rounds of those tried: 1 to 8 times as stiff, 30 to 150 rounds a frame in 1 to 3 steps.
    row "Jolt, strain as taut: springs 4 times as stiff, 105 rounds at 24 Hz" run_jolt 105 24 4
    # With 1 or 2 rounds at such steps it does not stay on the ball.
    row "Bullet, 10 rounds at 72 Hz" run_bullet hull 10 72
    # The least time to the strain of taut of those tried: 1 to 20 rounds at 192 to 3456 Hz.
    row "Bullet, strain as taut: 2 rounds at 1248 Hz" run_bullet hull 2 1248
    row "Bullet, the same on triangles" run_bullet mesh 2 1248
    row "taut, \`touch = \"all\"\`" run_taut 'cloth.sheet.touch="all"'
    row "Blender, quality 1, self collision" run_blender quality=1 touch=all
    row "Blender, quality 5, self collision" run_blender quality=5 touch=all
}

fold() {
    scene=beside_fold.toml side=1.0
    head_of_table "a sheet of 40 × 40 cells folds on itself, 2.5 s"
    row "taut, 60 fps" run_taut
    # Blender takes 5 steps a frame. 2 rounds of collision are as it is set, with 4 it crosses nothing.
    row "Blender, 60 fps, as it is set" run_blender collision_quality=2
    row "Blender, 60 fps, 4 rounds of collision" run_blender collision_quality=4
    row "taut, 24 fps" run_taut run.fps=24
    row "Blender, 24 fps, as it is set" run_blender collision_quality=2 fps=24
}

processor=$(sed -n '/^model name/ { s/.*: //; p; q }' /proc/cpuinfo)
echo "$processor, $(blender --version | head -n 1), $jolt, $("$bullet" version)"
for part in $what; do
    case $part in
    ball | fold) "$part" ;;
    *)
        echo "beside: $part is neither ball nor fold" >&2
        exit 2
        ;;
    esac
done
