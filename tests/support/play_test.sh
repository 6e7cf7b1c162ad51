#!/bin/sh
# Plays a scene in a window on a display of its own: pulls a cloth with the mouse, records that twice, and plays the files
# again without a window to the same state. Waits for what happens, never for a time. Called with the path of taut.
set -eu
taut=$1
work=$(mktemp -d)
started=
trap 'for p in $started; do kill "$p" 2>/dev/null || :; done; rm -rf "$work"' EXIT
cd "$work"
fail() { echo "$1"; cat said heard 2>/dev/null; exit 1; }
# until COMMAND...: tries it again and again, for two minutes at most.
until_true() {
    tries=0
    while ! "$@" >/dev/null 2>&1; do
        tries=$((tries + 1))
        [ $tries -lt 1200 ] || fail "never true: $*"
        sleep 0.1
    done
}
said_times() { [ "$(grep -c -e "$1" said)" -ge "$2" ]; }

cat >sheet.toml <<'END'
schema = 1
run = { fps = 30, seconds = 2.0 }
material.linen = { stretch_N_per_m = 300.0 }
[cloth.sheet]
cells = [12, 12]
origin = [-0.5, 1.5, 0.0]
material = "linen"
hold = ["top"]
[[at]]
t = 0.1
do = "push"
target = "cloth.sheet@bottom"
impulse_Ns = [0.0, 0.0, 0.05]
[[check]]
that = "max_strain(cloth.sheet) < 0.5"
[camera.main]
eye = [0.0, 1.0, 3.5]
target = [0.0, 1.0, 0.0]
END

# Without a display: exit 7, and how to do without a window.
code=0
env -u DISPLAY -u WAYLAND_DISPLAY -u SDL_VIDEODRIVER "$taut" play sheet.toml >heard 2>said || code=$?
[ $code -eq 7 ] || fail "exit $code without a display"
grep -q 'taut render sheet.toml -o' said || fail "it does not say how to do without a window"

# Without -noreset the display forgets all when its last window closes, also a window that opens at that moment.
Xvfb -displayfd 1 -screen 0 640x480x24 -nolisten tcp -noreset >display 2>/dev/null &
started="$!"
until_true test -s display
DISPLAY=:$(cat display)
export DISPLAY

"$taut" play sheet.toml --size 320x240 --quality draft --verbose >heard 2>said &
player=$!
started="$started $player"
until_true xdotool search --onlyvisible --name 'taut play'
window=$(xdotool search --onlyvisible --name 'taut play' | head -n 1)

# The window shows pictures: over nine tenths of what is seen is not black.
is_lit() {
    eval "$(xdotool getwindowgeometry --shell "$window")"
    ffmpeg -v error -f x11grab -video_size 320x240 -i "$DISPLAY+$X,$Y" -frames:v 1 -pix_fmt gray -f rawvideo -y shot &&
        [ "$(tr -d '\000-\020' <shot | wc -c)" -gt 69000 ]
}
until_true is_lit

# pull N: the N-th drag, of at least three moves.
pull() {
    xdotool mousemove --window "$window" 160 130
    xdotool mousedown 1
    until_true said_times 'do = "grab"' "$1"
    x=160
    while ! said_times 'do = "move"' $((3 * $1)); do
        x=$((x < 240 ? x + 8 : 168))
        xdotool mousemove --window "$window" $x $((250 - x))
        sleep 0.1
    done
    xdotool mouseup 1
    until_true said_times 'do = "release"' "$1"
}
press() { xdotool key --window "$window" "$1"; }
# The window may be gone before the key is let go; a display repeats a key that stays down, to the next window.
leave() {
    press q 2>/dev/null || :
    xdotool keyup q
    wait $player || fail "exit $? of the window"
}

# Recording is asked for afterwards: everything since the start is in it.
pull 1
press r
until_true said_times '^recording' 1
press r
until_true said_times '^wrote sheet-played.toml' 1

# Another method and half the step, from the start; what is there is not overwritten.
press m
until_true said_times '^from the start with' 1
press plus
until_true said_times '^from the start with h' 1
press r
until_true said_times '^recording' 2
pull 2
# What begins anew keeps first what was recorded.
press BackSpace
until_true said_times '^wrote sheet-played-1.toml; from the start' 1
leave
grep -q 'pictures a second' heard || fail "it does not tell the pictures a second"

# Watched: what is written is played from the moment that is shown, what is wrong is said and the scene goes on.
"$taut" play sheet.toml --watch --size 320x240 --quality draft >/dev/null 2>said &
player=$!
started="$started $player"
until_true xdotool search --onlyvisible --name 'taut play'
window=$(xdotool search --onlyvisible --name 'taut play' | head -n 1)
cp sheet.toml before.toml
sed 's/300\.0/400.0/' before.toml >new.toml
mv new.toml sheet.toml
until_true said_times '^reloaded; simulated from the start to' 1
echo 'nonsense = 1' >>sheet.toml
until_true said_times '^sheet.toml:[0-9]*:1: error: ' 1
sed 's/eye = .*/eye = [1.0, 1.0, 3.5]/; s/300\.0/400.0/' before.toml >sheet.toml
until_true said_times '^reloaded; continues at' 1
xdotool mousemove --window "$window" 160 130
press n
until_true sh -c "xdotool key --window $window y; grep -q '^copied cloth.sheet@#' said"
leave
mv before.toml sheet.toml

# Played again without a window: the same state at the same tick.
for file in sheet-played sheet-played-1; do
    told=$(sed -n "s/^$file.toml: .* state hash \([0-9a-f]*\) at tick \([0-9]*\)/\2 \1/p" heard)
    [ -n "$told" ] || fail "$file.toml was not recorded"
    "$taut" render $file.toml --no-pictures --hash-every tick --quiet >hashes 2>said || fail "$file.toml does not play"
    [ "$(tail -n 1 hashes)" = "$told" ] || fail "$file.toml: told $told, played $(tail -n 1 hashes)"
done
grep -q 'do = "push"' sheet-played.toml || fail "the scene's own timeline is lost"
grep -q '^solver.integrator' sheet-played-1.toml || fail "the method is lost"
grep -q '^ *# { that = "max_strain(cloth.sheet) < ' sheet-played.toml || fail "no check is proposed"
