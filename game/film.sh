#!/bin/sh
# Builds taut and cuts a film of 20 s with titles from the shipped scenes: out/film/taut.mp4. `film.sh stills` makes the
# pictures of scenes in the README and that of the fabrics in the manual instead. TAUT_SIZE=1280x720 makes film and
# pictures smaller.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
case ${1-film} in
    film | stills) ;;
    *) echo "Usage: sh game/film.sh [film | stills]" >&2; exit 2 ;;
esac
. "$root/game/build.sh"
taut_build

out=$root/out/film
size=${TAUT_SIZE:-1920x1080}
mkdir -p "$out"

if [ "${1-film}" = stills ]; then
    # Scene and frame.
    for still in show:75 laundry:300 flag:166 dance:312; do
        scene=${still%:*} frame=${still#*:}
        "$taut" render "$scene" -o "$out/$scene-######.png" --frames "$frame" --size "$size" --samples 16 -y --quiet
        number=$(printf %06d "$frame")
        ffmpeg -v error -y -i "$out/$scene-$number.png" -q:v 2 "$root/assets/pictures/$scene-still.jpg"
    done
    "$taut" render "$root/assets/pictures/fabrics.toml" -o "$out/fabrics.png" --at 2.5 --size 1400x680 --samples 16 \
        -y --quiet
    ffmpeg -v error -y -i "$out/fabrics.png" -q:v 3 "$root/assets/pictures/fabrics.jpg"
    # Scene and moment, eight of them side by side; the last one as its springs.
    inputs= n=0
    for still in bridge:2 cradle:1 curtain:1.5 twist:3.8 jelly:1 poncho:1.2 drape:1.7 drape:1.7:--debug; do
        scene=${still%%:*} rest=${still#*:}
        moment=${rest%%:*} flag=${rest#"$moment"}
        # shellcheck disable=SC2086  # a word or none
        "$taut" render "$scene" -o "$out/tile-$n.png" --at "$moment" --size 480x270 --samples 16 -y --quiet ${flag#:}
        inputs="$inputs -i $out/tile-$n.png"
        n=$((n + 1))
    done
    # shellcheck disable=SC2086  # many words
    ffmpeg -v error -y $inputs -filter_complex \
        "xstack=inputs=8:layout=0_0|w0_0|w0+w0_0|w0+w0+w0_0|0_h0|w0_h0|w0+w0_h0|w0+w0+w0_h0" -q:v 3 \
        "$root/assets/pictures/scenes.jpg"
    echo "Stills: $root/assets/pictures/*-still.jpg, fabrics.jpg, scenes.jpg"
    exit 0
fi

# At 60 frames a second: scene, first and last frame, title. 1200 frames in all.
shots='show 10 177 taut: ropes, cloth and soft bodies
flag 120 239 Wind on every triangle
laundry 186 305 Cloth on cloth
dress 12 131 Sewn on who then dances
twist 216 323 Wrung four turns, and let go
knot 120 215 A rope through its own loop
tower 76 189 Soft blocks, stiff and stiffer
hammock 72 191 A guest in the hammock
assets/scenarios/torn-banner.toml 66 179 Torn by a storm
methods 150 269 Ten integrators, one step'

# Of a picture's height: the size of the letters and how far they are from the edge.
text="fontfile=/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf:fontcolor=white:fontsize=h/22:x=h/16:y=h-h/16-th"
shade="shadowcolor=black@0.6:shadowx=2:shadowy=2"
cd "$out"
inputs= graph= joined= n=0
while read -r scene first last title; do
    echo "Shot $n: $title"
    case $scene in *.toml) scene=$root/$scene ;; esac
    "$taut" render "$scene" -o "shot-$n.mp4" --frames "$first-$last" --size "$size" -y --quiet </dev/null
    end=$(((last - first + 1) * 100 / 60)) # hundredths of a second
    fade="alpha='min(1,min(t/0.3,($end/100-t)/0.3))'"
    printf '%s' "$title" >"title-$n.txt"
    inputs="$inputs -i shot-$n.mp4"
    graph="$graph[$n]drawtext=textfile=title-$n.txt:$text:$shade:$fade[v$n];"
    joined="$joined[v$n]"
    n=$((n + 1))
done <<END
$shots
END
ffmpeg -v error -y $inputs -filter_complex "$graph${joined}concat=n=$n[v]" -map "[v]" -c:v libx264 -preset slow -crf 18 \
    -pix_fmt yuv420p -movflags +faststart taut.mp4
echo "Film: $out/taut.mp4"
