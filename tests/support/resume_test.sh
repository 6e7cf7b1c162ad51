#!/bin/sh
# resume_test.sh TAUT KILLS: kills a run at so many moments, goes on from its last checkpoint each time, and compares
# every picture and every state hash with those of a run that was left alone.
set -eu
taut=$1
kills=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Everything that a state can hold: contacts, a moving collider, a hand, a cut, a change of stiffness, a body that comes
# later.
cat >"$work/scene.toml" <<'END'
schema = 1
run = { fps = 30, seconds = 2.0 }
picture = { size = [160, 90], samples = 1, shadow_size = 256 }
at = [
  { t = 0.2, do = "grab", id = "hand", target = "cloth.sheet@bottom-left", radius = 0.1 },
  { t = 0.3, do = "move", id = "hand", to = [-0.2, 0.7, 0.5], over_s = 0.8 },
  { t = 0.5, do = "spawn", target = "block.crate" },
  { t = 0.7, do = "cut", target = "cloth.sheet", segment = [[0.55, 1.0], [0.55, 0.4]] },
  { t = 0.9, do = "ramp", key = "material.linen.stretch_N_per_m", to = 500.0, over_s = 0.5 },
  { t = 1.2, do = "release", id = "hand" },
]
[material.linen]
stretch_N_per_m = 300.0
[cloth.sheet]
size = [1.0, 1.0]
cells = [12, 12]
origin = [-0.5, 1.5, 0.0]
material = "linen"
hold = ["top-left", "top-right"]
[block.crate]
size = [0.3, 0.3, 0.3]
cells = [2, 2, 2]
position = [0.0, 1.9, 0.1]
[collider.ground]
shape = "plane"
[collider.ball]
shape = "sphere"
radius = 0.2
keys = [{ t = 0.0, position = [0.2, 1.0, -0.6] }, { t = 1.5, position = [0.2, 1.0, 0.4] }]
[wind.breeze]
velocity = [0.0, 0.0, 2.0]
gust = { amplitude = 1.0 }
END

render() {
    folder=$1
    shift
    "$taut" render "$work/scene.toml" -o "$folder" --quiet --metrics "$@"
}
hashes() { sed -n "/state_hash/,/]/p" "$1/run.json"; }

render "$work/whole" --checkpoint-every 5
[ "$(hashes "$work/whole" | wc -l)" -gt 60 ] || { echo "run.json has no hashes"; exit 1; }

killed=0
round=0
while [ "$round" -lt "$kills" ]; do
    round=$((round + 1))
    folder=$work/run$round
    # When so many of its 60 pictures are there, spread by the golden ratio; how far into the next is left to chance.
    pictures=$((60 * (618 * round % 1000) / 1000))
    "$taut" render "$work/scene.toml" -o "$folder" --quiet --metrics --checkpoint-every 5 &
    run=$!
    while kill -0 "$run" 2>/dev/null && [ "$(find "$folder" -name "*.png" 2>/dev/null | wc -l)" -lt "$pictures" ]; do
        sleep 0.01
    done
    if kill -9 "$run" 2>/dev/null; then killed=$((killed + 1)); fi
    wait "$run" 2>/dev/null || true
    render "$folder" --checkpoint-every 5 --resume
    for picture in "$work"/whole/*.png; do
        cmp "$picture" "$folder/$(basename "$picture")" || { echo "after a kill at $pictures pictures"; exit 1; }
    done
    [ "$(ls "$folder"/*.png | wc -l)" -eq 60 ] || { echo "$folder has not 60 pictures"; exit 1; }
    [ "$(hashes "$folder")" = "$(hashes "$work/whole")" ] || { echo "other hashes after a kill at $pictures pictures"; exit 1; }
    cmp "$work/whole/metrics.csv" "$folder/metrics.csv" || { echo "other metrics after a kill at $pictures pictures"; exit 1; }
    rm -rf "$folder"
done
echo "killed $killed of $kills runs"
[ $((killed * 5)) -ge $((kills * 3)) ] || { echo "too few runs were killed before their end"; exit 1; }
