#!/bin/sh
# Builds taut and renders the show scene: PNG frames and a video. Run again at will; nothing outside the checkout
# changes but packages that were missing.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
. "$root/game/install.sh"
taut_install run

build=$root/build
out=$root/out/show
echo "Building taut in $build"
log=$build/build.log
mkdir -p "$build"
if ! { cmake -G Ninja -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release -DTAUT_TESTS=OFF -DTAUT_UNITY=24 &&
    cmake --build "$build" --target taut; } >"$log" 2>&1; then
    tail -n 30 "$log" >&2
    echo "taut: the build failed; all of it is in $log" >&2
    exit 1
fi

taut=$build/game/taut
mkdir -p "$out"
"$taut" render show -o "$out/frame_######.png" --video "$out/show.mp4" --metrics -y
echo "Frames: $out/frame_000000.png and so on"
echo "Video:  $out/show.mp4"
