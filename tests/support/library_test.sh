#!/bin/sh
# sh library_test.sh BUILD CHECKOUT: the engine, installed in a fresh folder, is found by CMake and by pkg-config, and
# what is built with it works: the samples, and what the README and the manual say to write.
set -eu
build=$1
root=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
quietly() { "$@" >log 2>&1 || { tail -n 40 log; exit 1; }; }
compiler=$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' "$build/CMakeCache.txt")
quietly cmake --install "$build" --component engine --prefix "$folder/prefix"
export CMAKE_PREFIX_PATH="$folder/prefix" PKG_CONFIG_PATH="$folder/prefix/lib/pkgconfig" CXX="$compiler"

quietly cmake -G Ninja -S "$root/game/samples" -B samples
quietly cmake --build samples
sh "$root/tests/support/samples_test.sh" "$folder/samples"

# The README's scene, the manual's CMake lines and program, word for word.
mkdir readme
awk '/^```$/ { to = "" } to { print > to }
    /^```toml/ && !scenes++ { to = "readme/my.toml" } /^```cmake/ { to = "readme/lines.cmake" } /^```cpp/ { to = "readme/main.cpp" }' \
    "$root/README.md" "$root/game/manual/cpp.md"
{
    printf 'cmake_minimum_required(VERSION 3.25)\nproject(game LANGUAGES CXX)\nadd_executable(game main.cpp)\n'
    cat readme/lines.cmake
} >readme/CMakeLists.txt
quietly cmake -G Ninja -S readme -B readme/build
quietly cmake --build readme/build
(cd readme && build/game) >said
grep -q '^2\.000 s: ' said || { cat said; exit 1; }

# Every header that is installed finds the others, without a warning, and pkg-config names what a program needs.
{
    (cd prefix/include && find taut -name '*.h' | sed 's/.*/#include "&"/')
    echo "#include \"$root/game/samples/own_picture.cpp\""
} >all.cpp
# shellcheck disable=SC2046  # one word a flag
quietly "$compiler" -std=c++20 -Wall -Wextra -Werror "-DSHADERS=\"$(pkg-config --variable=shaders taut-render)\"" \
    "-DASSETS=\"$(pkg-config --variable=assets taut)\"" all.cpp $(pkg-config --cflags --libs taut-render) -o all
quietly ./all readme/my.toml
test -s picture.png

# A project that adds the checkout gets the engine and nothing else.
quietly cmake -G Ninja -S "$root/tests/consumer" -B consumer
