#!/bin/sh
# Builds taut and renders the show scene: PNG frames and a video. Run again at will; nothing outside the checkout
# changes but packages that were missing.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
. "$root/game/build.sh"
taut_build

out=$root/out/show
mkdir -p "$out"
"$taut" render show -o "$out/frame_######.png" --video "$out/show.mp4" --metrics -y
echo "Frames: $out/frame_000000.png and so on"
echo "Video:  $out/show.mp4"
