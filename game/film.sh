#!/bin/sh
# Builds taut and cuts a minute of film with titles from the shipped scenes: out/film/taut.mp4. `film.sh demo` cuts its
# first 15 s, out/demo/taut.mp4, and keeps the frames of every shot. `film.sh stills` makes pictures for the README and
# the manual. TAUT_SIZE=1280x720 makes film and pictures smaller.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
case ${1-film} in
    film | demo | stills) ;;
    *) echo "Usage: sh game/film.sh [film | demo | stills]" >&2; exit 2 ;;
esac
. "$root/game/build.sh"
start=$(date +%s)
taut_build
built=$(date +%s)

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
    "$taut" render dress -o "$out/dress-#.png" --at 0,0.6,1.5,4 --set camera.main.fov_deg=15 --size 480x600 \
        --samples 16 -y --quiet
    ffmpeg -v error -y -i "$out/dress-%d.png" -vf tile=4x1 -frames:v 1 -q:v 3 "$root/assets/pictures/dress.jpg"
    # Small ones: scene and moment.
    for still in bear:3.5 domino:1.45 balloon:1.35 bridge:2; do
        scene=${still%:*} moment=${still#*:}
        "$taut" render "$scene" -o "$out/$scene.png" --at "$moment" --size 480x270 --samples 16 -y --quiet
        ffmpeg -v error -y -i "$out/$scene.png" -q:v 2 "$root/assets/pictures/$scene.jpg"
    done
    echo "Stills: $root/assets/pictures"
    exit 0
fi

# At 60 frames a second: scene, first and last frame, title. 3600 frames in all, 900 of them up to the line.
shots='show 10 249 taut: ropes, cloth, soft and rigid bodies
bear 10 279 A soft body of any mesh
domino 30 239 Rigid bodies
balloon 0 179 Air inside
---
dress 12 131 Panels are sewn on
dress 400 639 Who wears them dances
flag 120 359 Wind on every triangle
laundry 180 359 Cloth on cloth
dance 240 449 Wool, as measured
twist 216 359 Wrung four turns, and let go
cape 90 269 Held at the neck
knot 120 275 A rope through its own loop
tower 76 225 Soft blocks, stiff and stiffer
jelly 90 239 Down the stairs
drape 30 209 A tablecloth
curtain 40 219 A ball through a curtain
hammock 72 191 A guest in the hammock
net 60 209 A net catches a ball
assets/scenarios/torn-banner.toml 66 215 Torn by a storm
methods 150 299 Ten integrators, one step'
if [ "${1-film}" = demo ]; then
    shots=${shots%%---*}
    out=$root/out/demo
    size=${TAUT_SIZE:-1280x720}
    mkdir -p "$out"
fi

# Of a picture's height: the size of the letters and how far they are from the edge.
text="fontfile=/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf:fontcolor=white:fontsize=h/22:x=h/16:y=h-h/16-th"
shade="shadowcolor=black@0.6:shadowx=2:shadowy=2"
cd "$out"
inputs= graph= joined= n=0
while read -r scene first last title; do
    [ "$title" ] || continue # the line
    echo "Shot $n: $title"
    case $scene in *.toml) scene=$root/$scene ;; esac
    to="-o shot-$n.mp4"
    [ "${1-film}" != demo ] || to="-o $n-$scene/frame_######.png --video shot-$n.mp4 --metrics"
    # shellcheck disable=SC2086  # many words
    "$taut" render "$scene" $to --frames "$first-$last" --size "$size" -y --quiet </dev/null
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
drawn=$(date +%s)
ffmpeg -v error -y $inputs -filter_complex "$graph${joined}concat=n=$n[v]" -map "[v]" \
    -c:v libx264 -preset veryfast -crf 18 -pix_fmt yuv420p -movflags +faststart taut.mp4
echo "Film:     $out/taut.mp4"
[ "${1-film}" = demo ] || exit 0
end=$(date +%s)
cat <<END
Frames:   $out/0-show/frame_000010.png and so on
Took:     packages and build $((built - start)) s, pictures $((drawn - built)) s, titles $((end - drawn)) s
Try next: $taut render flag -o flag.mp4
On PATH:  export PATH="$build/game:\$PATH"
END
