#!/bin/sh
# sh samples_test.sh FOLDER: the samples of the library, built there, give the numbers that theory gives.
set -eu
samples=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
# holds WHAT AWK-PROGRAM: the program, over the output in `said`, must end with ok = 1.
holds() { awk "$2"' END { exit !ok }' said || { echo "does not hold: $1"; cat said; exit 1; }; }

# Undamped leap-frog in single precision at half of the largest step.
"$samples/hello" >said
holds "13 lines whose energies sum to m g h = 0.1 × 9.81 × 2 J, to 1e-4 of it" '
    /^ *[0-9]/ { ++n; off = $8 / 1.962 - 1; if (off < -1e-4 || off > 1e-4) ++far } { ok = n == 13 && !far }'

# A rope of 1 kg and 1 m that turns with 6/s about its middle, 0.5 m from the centre of a well of 9 N/m a kg, has
# (6²/12 + 9 (1/12 + 0.5²))/2 = 3 J; 40 links make 1/12 larger by 1/800, which is 0.00234375 J. That it stays shows that
# force and energy belong together; order two that half the step brings it four times as near.
for h in 1e-3 5e-4; do "$samples/own_force" $h; done >said
holds "3.002344 J, kept four times as well at half the step, to 2 %" '
    $1 == "3.002344" { strays[NR] = $6 } { ok = NR == 2 && strays[1] / strays[2] > 3.92 && strays[1] / strays[2] < 4.08 }'

# Between two ticks of 0.01 s a chord leaves the parabola by g tick²/8 = 1.22625e-4 m in the middle, which a picture
# nearly meets.
"$samples/fixed_tick" >said
holds "at most g tick²/8 off the parabola" '/parabola/ { ok = $5 > 1.2e-4 && $5 < 1.22626e-4 }'
holds "the restored state has the hash of the other" '/^tick/ { ok = length($4) == 17 && $4 == $6 "," }'

# The header of a PNG file: its signature, then the width and height of the picture.
"$samples/own_picture" >said
od -A n -t x1 -N 24 picture.png | tr -d ' \n' >said
holds "a picture of 640 × 360" '{ ok = $0 == "89504e470d0a1a0a0000000d494844520000028000000168" }'
