# Sourced by the tests beside it: what they share. Expects `taut`, the program, and `root`, the checkout.

# readme_block N: the N-th block of commands in the README's section on many machines, as a reader would copy it.
readme_block() {
    awk -v wanted="$1" '
        /^## / { inside = ($0 == "## Many machines"); next }
        !inside { next }
        /^    / { if (!block) { block = 1; ++n } if (n == wanted) print substr($0, 5); next }
        { block = 0 }' "$root/README.md"
}

# serial FOLDER: what one machine makes of the README's scene: frames in FOLDER/out/show and FOLDER/show.mp4.
serial() {
    (cd "$1" && "$taut" render show -o out/show --video show.mp4 --quiet)
}

# same A B: frames and video of two folders are the same bytes.
same() {
    count=$(ls "$1"/out/show/*.png | wc -l)
    [ "$count" -gt 100 ] && [ "$(ls "$2"/out/show/*.png | wc -l)" -eq "$count" ] || { echo "not $count frames"; return 1; }
    for frame in "$1"/out/show/*.png; do
        cmp "$frame" "$2/out/show/$(basename "$frame")" || return 1
    done
    cmp "$1/show.mp4" "$2/show.mp4" || return 1
    echo "$count frames and the video: the same bytes"
}
