# Sourced by game/demo.sh, game/film.sh and game/package.sh. Expects `root` to hold the path of the checkout.

# taut_build [CMAKE-ARGUMENT...]: installs what is missing and builds the program; `taut` holds its path then. With
# -DTAUT_PYTHON=ON it builds the Python module too.
taut_build() {
    . "$root/game/install.sh"
    taut_install run || return 1
    build=$root/build
    log=$build/build.log
    echo "Building taut in $build"
    mkdir -p "$build"
    if ! { cmake -G Ninja -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release -DTAUT_TESTS=OFF -DTAUT_UNITY=24 "$@" &&
        cmake --build "$build" --target taut $(case " $* " in *" -DTAUT_PYTHON=ON "*) echo taut_python ;; esac); } >"$log" 2>&1; then
        tail -n 30 "$log" >&2
        echo "taut: the build failed; all of it is in $log" >&2
        return 1
    fi
    taut=$build/game/taut
}
