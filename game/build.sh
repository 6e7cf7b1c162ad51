# Sourced by the scripts that build. Expects `root` to hold the path of the checkout.

# taut_cmake SOURCE FOLDER TARGETS CMAKE-ARGUMENT...: configures and builds. Ninja's [n/m] counts on one line of a
# terminal. The whole output goes to FOLDER/build.log; its errors are shown if the build fails.
taut_cmake() {
    source=$1 folder=$2 targets=$3 log=$2/build.log
    shift 3
    mkdir -p "$folder"
    echo "Building in $folder"
    # shellcheck disable=SC2086  # one word a target
    status=$({ { cmake -G Ninja -S "$source" -B "$folder" "$@" && cmake --build "$folder" --target $targets; echo $? >&3; } 2>&1 |
        while IFS= read -r line; do
            printf '%s\n' "$line"
            case $line in \[*/*\]*) [ ! -t 2 ] || printf '\r%s] ' "${line%%]*}" >&2 ;; esac
        done >"$log"; } 3>&1)
    [ ! -t 2 ] || printf '\r%20s\r' '' >&2
    [ "$status" = 0 ] && return 0
    { grep -A 12 -E 'error|FAILED' "$log" || tail -n 30 "$log"; } | head -n 60 >&2
    echo "taut: the build failed; its whole output is in $log" >&2
    return 1
}

# taut_build [CMAKE-ARGUMENT...]: installs what is missing and builds the program; `taut` holds its path then. With
# -DTAUT_PYTHON=ON it builds the Python module too.
taut_build() {
    . "$root/game/install.sh"
    taut_install run || return 1
    build=$root/build
    taut_cmake "$root" "$build" "taut $(case " $* " in *" -DTAUT_PYTHON=ON "*) echo taut_python ;; esac)" \
        -DCMAKE_BUILD_TYPE=Release -DTAUT_TESTS=OFF -DTAUT_PYTHON=OFF "$@" || return 1
    taut=$build/game/taut
}
