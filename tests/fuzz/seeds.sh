#!/bin/sh
# seeds.sh SOURCE FOLDER: what the fuzz targets begin with, taken from what is shipped: FOLDER/TARGET/….
set -eu
assets=$1/assets
goldens=$1/tests/golden
rm -rf "$2"
mkdir -p "$2"
cd "$2"
mkdir scene timeline check overrides gltf obj image light tape manifest play world

cp "$assets"/scenes/*.toml scene
# One of each kind, as in the small scene of fuzz.h.
sed_names='s/\b(cloth|rope|block|net|wind|material|collider)\.[a-z*][a-z0-9-]*/\1.a/g'
for file in "$assets"/scenarios/*.toml; do
    name=$(basename "$file" .toml)
    cp "$file" "scene/scenario-$name.toml"
    # The times are those of seconds, and the small scene has half of one.
    awk '/^\[/ { on = /^\[\[at\]\]/ } on' "$file" | sed -E "$sed_names; s/^t = ([0-9])\./t = 0.\1/" >"timeline/$name.toml"
    sed -n 's/^that = "\(.*\)"$/\1/p' "$file" | sed -E "$sed_names" | split -l 1 - "check/$name-"
done
for file in "$assets"/scenes/*.toml; do
    awk '/^\[\[/ { head = "" } /^\[[a-z]/ { head = substr($1, 2, length($1) - 2) } /^[a-z_A-Z]+ = [^\[{]*$/ && head { print head "." $1 "=" $3 }' \
        "$file" | sed -E "$sed_names" | split -l 4 - "overrides/$(basename "$file" .toml)-"
done
cp "$1/tests/support/arm.gltf" gltf
awk 'BEGIN { printf "{\"asset\":{\"version\":\"2.0\"},\"extras\":"; for (i = 0; i < 30000; ++i) printf "["
    for (i = 0; i < 30000; ++i) printf "]"; printf "}" }' >gltf/deep

for file in "$assets"/models/*.obj; do
    name=$(basename "$file" .obj)
    # The first of each kind of line, with faces of the first vertices.
    grep '^v ' "$file" | head -n 24 >"obj/$name"
    { grep '^vt ' "$file" || true; } | head -n 24 >>"obj/$name"
    printf 'o a\ng one two\nf 1 2 3\nf 4/1 5/2 6/3 7\nf -1 -2 -3 -4 -5\ng\nf 8/1/1 9//1 10/2/2\n' >>"obj/$name"
done
# As good as random.
for file in "$assets"/textures/*.png; do tail -c 900 "$file" | head -c 400 >"play/$(basename "$file" .png)"; done
for format in rgb24.png pal8.png yuvj420p.jpg gray.jpg; do
    ffmpeg -nostdin -loglevel error -i "$assets/textures/flag.png" -vf scale=24:16 -pix_fmt "${format%.*}" "image/$format"
done
# A line in planes with runs, and one of pixels that repeat.
printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2.5\n\n-Y 2 +X 9\n\2\2\0\11\211\100\211\0\11\1\2\3\4\5\6\7\10\11\211\201\1\2\3\4\1\1\1\10' >light/runs
printf '#?RGBE\n\n-Y 1 +X 600\n\200\0\40\211\1\1\1\127\1\1\1\2' >light/repeats
for file in "$goldens"/*/state.tape; do cp "$file" "tape/$(basename "$(dirname "$file")")"; done
cp "$goldens/manifest.json" manifest
find . -size 0 -type f -delete
