#!/bin/sh
# Builds everything and passes every test: g++ all of them, clang the determinism tests (its hashes against those of
# g++) in a project that has taut as a subproject, and under AddressSanitizer and UndefinedBehaviorSanitizer the unit
# tests. With --peers also what other programs make of strips of cloth, Blender among them. With --long also the physics
# tests under sanitizers, the fuzzer for ten seconds a reader, the engine as WebAssembly, and those labelled long, which
# take minutes and rarely break.
set -eu
case ${1-} in
    '') without='-LE long|peers' sanitized=unit fuzzed= more= ;;
    --peers) without='-LE long' sanitized=unit fuzzed= more=peers ;;
    --long) without='-LE peers' sanitized='unit|physics' fuzzed=yes more='farm web' ;;
    *) echo "usage: sh tests/run.sh [--long|--peers]" >&2 && exit 2 ;;
esac
root=$(cd "$(dirname "$0")/.." && pwd)
. "$root/game/install.sh"
# shellcheck disable=SC2086  # a word or none
taut_install run package test $more

# build NAME SOURCE "TARGETS" CMAKE-ARGUMENTS...: configures and builds into an ignored folder.
build() {
    folder=$root/build-$1
    source=$2
    targets=$3
    shift 3
    cmake -G Ninja -S "$source" -B "$folder" -DTAUT_UNITY=24 "$@" >"$folder.log" 2>&1 || { tail -n 30 "$folder.log" >&2; exit 1; }
    echo "Building $folder"
    # shellcheck disable=SC2086  # one word a target
    cmake --build "$folder" --target $targets >>"$folder.log" 2>&1 || { grep -A 12 -E 'error|FAILED' "$folder.log" | head -n 60 >&2; exit 1; }
}
mkdir -p "$root/out"
jobs=$(nproc 2>/dev/null || echo 2)

build gcc "$root" all -DCMAKE_CXX_COMPILER=g++ -DCMAKE_C_COMPILER=gcc -DCMAKE_BUILD_TYPE=Release -DTAUT_BENCH=ON -DTAUT_PYTHON=ON
build clang "$root/tests/consumer" "taut_determinism consumer_all" -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_C_COMPILER=clang \
    -DCMAKE_BUILD_TYPE=Release -DTAUT_PROGRAM=ON -DTAUT_TESTS=ON -DTAUT_WERROR=ON
build asan "$root" "taut taut_$(echo "$sanitized" | sed 's/|/ taut_/')" -DCMAKE_CXX_COMPILER=g++ -DCMAKE_C_COMPILER=gcc -DCMAKE_BUILD_TYPE=Asan \
    -DTAUT_PYTHON=OFF
if [ "$fuzzed" ]; then
    sh "$root/game/web.sh"
    build fuzz "$root" taut_fuzz -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_C_COMPILER=clang -DCMAKE_BUILD_TYPE=Asan \
        -DTAUT_FUZZ=ON -DTAUT_PROGRAM=OFF -DTAUT_TESTS=OFF
    ctest --test-dir "$root/build-fuzz" --output-on-failure -j "$jobs" -L fuzz
fi

ctest --test-dir "$root/build-clang" --output-on-failure -j "$jobs" -L determinism
ctest --test-dir "$root/build-asan" --output-on-failure -j "$jobs" -L "$sanitized"
# Last, so that the closing lines are those of the whole suite.
# shellcheck disable=SC2086  # two words
ctest --test-dir "$root/build-gcc" --output-on-failure -j "$jobs" $without
