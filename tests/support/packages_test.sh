#!/bin/sh
# sh packages_test.sh BUILD CHECKOUT: the Debian packages, unpacked into a folder of their own, hold a program that works
# there, an engine that others build on and a module for Python, and ask for what they need.
set -eu
build=$1
root=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
quietly() { "$@" >log 2>&1 || { tail -n 40 log; exit 1; }; }
fail() { echo "$1"; exit 1; }
compiler=$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' "$build/CMakeCache.txt")
quietly cpack --config "$build/CPackConfig.cmake" -B "$folder/packages"
version=$(dpkg-parsechangelog -l "$root/game/changelog" -S Version)
for package in taut libtaut-dev python3-taut; do
    deb=$(ls packages/${package}_"${version}"_*.deb)
    dpkg-deb -x "$deb" installed
    dpkg-deb -c "$deb" | awk '$1 !~ /^d/ { print $6 }' >"$package.files"
    dpkg-deb -f "$deb" Depends | tr ',' '\n' | awk '{ print $1 }' >"$package.depends"
done
sort ./*.files | uniq -d >twice
test ! -s twice || fail "in two packages: $(cat twice)"

# The program, with its own assets and shaders, page and completion; the packages of what it loads.
taut=$folder/installed/usr/bin/taut
"$taut" doctor >said
grep -q "^shaders *$folder/installed/usr/share/taut/shaders" said || fail "$(cat said)"
grep -q "^program *taut $version, commit " said || fail "$(cat said)"
osmesa=
if grep -q '^osmesa *ok' said; then osmesa=libosmesa6; fi
quietly "$taut" check flag torn-banner
"$taut" manual contact | cmp - "$root/game/manual/contact.md"
quietly "$taut" render flag -o pictures/frame_######.png --frames 0-1 --size 320x180
test -s pictures/frame_000001.png
gzip -dc installed/usr/share/man/man1/taut.1.gz | grep -q '^\.SS render$' || fail "no manual page"
bash -n installed/usr/share/bash-completion/completions/taut
gzip -dc installed/usr/share/doc/taut/changelog.gz | cmp - "$root/game/changelog"
for package in $osmesa libegl1 libsdl2-2.0-0 libtbb12; do
    grep -qx "$package" taut.depends || fail "taut does not depend on $package"
done

# The engine, by CMake and by pkg-config, whose packages it depends on.
mkdir use
cat >use/main.cpp <<'END'
#include <cstdio>
#include "taut/scene/load.h"
#include "taut/world/world.h"

int main(int, char** arguments) {
    taut::world::World world(taut::scene::loadScene(arguments[1], {.assetFolders = {ASSETS}}).spec);
    while (world.time() < 0.1 && !world.advance()) {}
    std::printf("%.3f s\n", world.time());
}
END
cat >use/CMakeLists.txt <<'END'
cmake_minimum_required(VERSION 3.25)
project(use LANGUAGES CXX)
find_package(taut CONFIG REQUIRED)
add_executable(use main.cpp)
target_link_libraries(use PRIVATE taut::engine)
target_compile_definitions(use PRIVATE ASSETS="${taut_ASSETS}")
END
quietly cmake -G Ninja -S use -B use/build -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_PREFIX_PATH="$folder/installed/usr"
quietly cmake --build use/build
said=$(use/build/use installed/usr/share/taut/assets/scenes/drape.toml)
test "$said" = "0.100 s" || fail "$said"
grep -qx taut libtaut-dev.depends || fail "libtaut-dev does not depend on taut"
export PKG_CONFIG_PATH="$folder/installed/usr/lib/pkgconfig"
test -d "$(pkg-config --variable=shaders taut-render)"
for module in $(pkg-config --print-requires taut taut-render); do
    test "$module" != taut || continue
    file=$(pkg-config --variable=pcfiledir "$module")/$module.pc
    package=$(dpkg -S "$(realpath "$file")" | sed 's/:.*//')
    grep -qx "$package" libtaut-dev.depends || fail "libtaut-dev does not depend on $package, which has $module.pc"
done

# The module for Python, with its stubs, and of the program its shaders and assets.
PYTHONPATH=$folder/installed/usr/lib/python3/dist-packages /usr/bin/python3 -B -c '
import taut
world = taut.load("flag")
world.step()
assert world.render((160, 90), samples=1).std() > 5
print(taut.__file__, taut.__version__)' >said
grep -qx "$folder/installed/usr/lib/python3/dist-packages/taut/__init__.py $version" said || fail "$(cat said)"
for file in __init__.pyi py.typed; do test -e "installed/usr/lib/python3/dist-packages/taut/$file" || fail "no $file"; done
for package in taut python3 python3-numpy $osmesa libtbb12; do
    grep -qx "$package" python3-taut.depends || fail "python3-taut does not depend on $package"
done

# What lintian has to say where it is installed; a licence is not there yet.
if command -v lintian >/dev/null; then
    lintian --suppress-tags no-copyright-file --fail-on error packages/*.deb
fi
