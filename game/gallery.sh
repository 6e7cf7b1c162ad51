#!/bin/sh
# Writes out/gallery, static files for any web server: an index with a picture and a line of each shipped scene, its live
# page, its text and its film, the charts, and the table against reality. TAUT_SIZE=1280x720 makes the films larger. What
# is there already stays: remove out/gallery for another one.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
. "$root/game/build.sh"
taut_build
taut_install all # three.js
sh "$root/game/web.sh"

out=$root/out/gallery
size=${TAUT_SIZE:-640x360}
mkdir -p "$out"
cp "$root/assets/viewer/gallery.css" "$out/"

escaped() { sed 's/&/\&amp;/g; s/</\&lt;/g; s/>/\&gt;/g; s/"/\&quot;/g'; }

# make FILE COMMAND...: unless the file is there, under another name until it is whole.
make() {
    file=$1
    shift
    [ -e "$out/$file" ] || { "$@" "$out/part-$file" && mv "$out/part-$file" "$out/$file"; }
    rm -f "$out/part-${file%.*}.run.json"
}

cards=
for text in "$root"/assets/scenes/*.toml; do
    scene=$(basename "$text" .toml)
    echo "Scene $scene"
    cp "$text" "$out/$scene.toml"
    make "$scene.html" "$taut" export "$scene" --quiet -y --live
    make "$scene.mp4" "$taut" render "$scene" --size "$size" --quiet -y -o
    # A third of the way in, most of them are at their best.
    if [ ! -e "$out/$scene.jpg" ]; then
        seconds=$(ffprobe -v error -show_entries format=duration -of csv=p=0 "$out/$scene.mp4" | awk '{ print $1 / 3 }')
        ffmpeg -v error -y -ss "$seconds" -i "$out/$scene.mp4" -frames:v 1 -q:v 3 "$out/$scene.jpg"
    fi
    title=$(sed -n 's/^title = "\(.*\)"$/\1/p' "$text" | head -n 1 | escaped)
    # The first sentence of its first comment.
    line=$(awk '/^#/ { sub(/^# */, ""); all = all $0 " "; next } { exit } END { print substr(all, 1, index(all, ". ")) }' \
        "$text" | escaped)
    cards="$cards
<article>
  <a href=\"$scene.html\"><img src=\"$scene.jpg\" alt=\"$title\" width=\"640\" height=\"360\" loading=\"lazy\"></a>
  <h2><a href=\"$scene.html\">$title</a></h2>
  <p>$line</p>
  <p class=\"links\"><a href=\"$scene.html\">Play</a> <a href=\"$scene.mp4\">Film</a> <a href=\"$scene.toml\">Text</a></p>
</article>"
done

charts=
for chart in cloth-corners-time:"Error against time of every method" stability-map:"Where each method becomes unstable" \
    cantilever:"A strip of fabric that droops, against theory"; do
    cp "$root/assets/charts/${chart%%:*}.png" "$out/"
    charts="$charts
<figure><a href=\"${chart%%:*}.png\"><img src=\"${chart%%:*}.png\" alt=\"\" loading=\"lazy\"></a><figcaption>${chart#*:}</figcaption></figure>"
done
[ -e "$out/reality/reality.html" ] || "$taut" reality --quiet -o "$out/reality"

cat >"$out/index.html" <<END
<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>taut: scenes to play with</title>
<link rel="stylesheet" href="gallery.css">
</head>
<body>
<header>
  <h1>taut</h1>
  <p>Ropes, cloth and soft bodies. Every page computes its scene while you pull at it, with the same bits as the program.</p>
</header>
<main>$cards
</main>
<section>
  <h1>Measured</h1>
  <p><a href="reality/reality.html">The table against theory and measurement</a></p>
  <div class="charts">$charts
  </div>
</section>
</body>
</html>
END
echo "Gallery: $out/index.html"
