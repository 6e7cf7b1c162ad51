#!/bin/sh
# What others have for a strip of cloth that droops under its weight, as CSV for `taut reality --beside peers.csv`:
# Blender's cloth and Bullet's soft body, each told the fabric as its own force law has it. It takes some minutes.
#
#   sh tests/bench/peers.sh [BULLET [few]] >peers.csv
#
# BULLET: the program taut_peers_bullet of a build with -DTAUT_BENCH=ON; that of build-bench if not given. few: three
# strips each, for the test.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
bullet=${1:-$root/build-bench/tests/bench/taut_peers_bullet}
. "$root/game/install.sh"
taut_install peers >&2
if ! [ -x "$bullet" ]; then
    echo "peers: there is no program $bullet; build the target taut_peers_bullet, or name another" >&2
    exit 1
fi

# Waiting threads of OpenMP burn time, so it has one.
blender_strips() { # TELLING CELLS GAMMAS
    OMP_NUM_THREADS=1 blender -b -t 1 --factory-startup -noaudio --python-exit-code 1 -P "$here/peers_blender.py" -- "$@" |
        sed -n 's/^csv://p'
}

echo "peer,gamma,cells,height_over_width,is_at_rest,simulated_s,processor_s,told"
case ${2:-all} in
few)
    "$bullet" told 10 10
    blender_strips angular 10 1,10
    blender_strips linear 10 10
    ;;
all)
    many=0.1,0.2,0.5,1,2,5,10,20,50,100,200,500,1000
    "$bullet" told 10,20 $many
    "$bullet" as-set 10,20 $many
    blender_strips angular 10,20 $many
    blender_strips kept 20 $many
    blender_strips linear 10 $many
    ;;
*)
    echo "peers: $2 is neither few nor all" >&2
    exit 2
    ;;
esac
