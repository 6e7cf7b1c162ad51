# Sourced by the tests beside it: what they share. Expects `taut`, the program, and `root`, the checkout.
# shellcheck shell=sh disable=SC2154

# manual_block N: the N-th block of commands on the manual's page on many machines, as a reader would copy it.
manual_block() {
    awk -v wanted="$1" '
        /^```$/ { inside = 0 }
        inside && n == wanted
        /^```sh farm$/ { inside = 1; ++n }' "$root/game/manual/many-machines.md"
}

# frames_in FOLDER: how many are there.
frames_in() {
    find "$1" -name 'frame_*.png' 2>/dev/null | wc -l
}

# serial FOLDER: what one machine makes of the same scene: frames in FOLDER/out/show and FOLDER/show.mp4.
serial() {
    (cd "$1" && "$taut" render show -o out/show --video show.mp4 --quiet)
}

# same A B: frames and video of two folders are the same bytes.
same() {
    count=$(frames_in "$1/out/show")
    if [ "$count" -le 100 ] || [ "$(frames_in "$2/out/show")" -ne "$count" ]; then
        echo "not $count frames"
        return 1
    fi
    for frame in "$1"/out/show/*.png; do
        cmp "$frame" "$2/out/show/$(basename "$frame")" || return 1
    done
    cmp "$1/show.mp4" "$2/show.mp4" || return 1
    echo "$count frames and the video: the same bytes"
}
