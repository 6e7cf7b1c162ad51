#!/bin/sh
# Builds with g++ and passes the tests that decide whether taut works: unit, physics, determinism, goldens, documents,
# Python. tests/README.md says what runs where.
#   --all    also clang's determinism tests (in a project that has taut as a subproject; its hashes against those of
#            g++), the unit tests under AddressSanitizer and UndefinedBehaviorSanitizer, and the tests labelled `all`:
#            every golden, installation, what other programs read, a browser
#   --long   also the physics tests under sanitizers, every file compiled by itself, the fuzzer for ten seconds a reader,
#            the engine as WebAssembly, and the tests labelled `long`, which take minutes and rarely break
#   --peers  also what Blender and Bullet make of strips of cloth
# --all and --long do not repeat tests that have passed since the last change.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
case ${1-} in
    '') packages= labels= ;;
    --all) packages=all labels=all ;;
    --long) packages='all farm web' labels='all|long' ;;
    --peers) packages=peers labels=peers ;;
    *) echo "usage: sh tests/run.sh [--all | --long | --peers]" >&2 && exit 2 ;;
esac
. "$root/game/build.sh"
. "$root/game/install.sh"
# shellcheck disable=SC2086  # words
taut_install run python test $packages
mkdir -p "$root/out"
jobs=$(nproc 2>/dev/null || echo 2)
gcc=$root/build-gcc

# build FOLDER SOURCE TARGETS COMPILER CMAKE-ARGUMENT...
build() {
    folder=$1 source=$2 targets=$3 compiler=$4
    shift 4
    taut_cmake "$source" "$folder" "$targets" -DCMAKE_CXX_COMPILER="${compiler%,*}" -DCMAKE_C_COMPILER="${compiler#*,}" \
        -DTAUT_WERROR=ON "$@"
}
# pass FOLDER CTEST-ARGUMENT...
pass() {
    folder=$1
    shift
    ctest --test-dir "$folder" --output-on-failure -j "$jobs" "$@"
}

build "$gcc" "$root" all g++,gcc -DCMAKE_BUILD_TYPE=Release -DTAUT_PYTHON=ON -DTAUT_BENCH=$([ "$labels" ] && echo ON || echo OFF)
passed=$gcc/passed
if [ ! "$labels" ] || [ ! -e "$passed" ] || [ "$(cd "$root" && find .ci CMakeLists.txt README.md assets engine game shaders tests -newer "$passed")" ]; then
    : >"$passed.begun"
    pass "$gcc" -LE 'all|long|peers'
    mv "$passed.begun" "$passed"
fi
[ "$labels" ] || exit 0

if [ "$labels" != peers ]; then
    asan=unit
    [ "$labels" = all ] || asan='unit|physics'
    build "$root/build-clang" "$root/tests/consumer" "taut_determinism consumer_all" clang++,clang -DCMAKE_BUILD_TYPE=Release \
        -DTAUT_PROGRAM=ON -DTAUT_TESTS=ON
    pass "$root/build-clang" -L determinism
    build "$root/build-asan" "$root" "taut taut_$(echo $asan | sed 's/|/ taut_/')" clang++,clang -DCMAKE_BUILD_TYPE=Asan -DTAUT_PYTHON=OFF
    pass "$root/build-asan" -L "$asan" -LE 'all|long'
fi
if [ "$labels" = 'all|long' ]; then
    # Units hide missing includes.
    build "$root/build-files" "$root" "taut_commit taut_glad" g++,gcc -DTAUT_UNITY=1 -DTAUT_PYTHON=ON -DTAUT_TESTS=OFF
    python3 "$root/tests/support/syntax.py" "$root/build-files" "$jobs"
    sh "$root/game/web.sh"
    build "$root/build-fuzz" "$root" taut_fuzz clang++,clang -DCMAKE_BUILD_TYPE=Asan -DTAUT_FUZZ=ON -DTAUT_PROGRAM=OFF -DTAUT_TESTS=OFF
    pass "$root/build-fuzz" -L fuzz
fi
# Last, so that the closing lines are those of the longest list.
pass "$gcc" -L "$labels"
