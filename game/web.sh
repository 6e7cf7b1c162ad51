#!/bin/sh
# Builds the engine as WebAssembly, for browsers and node: build-web/game/web/taut is a folder that npm installs.
# It installs what is missing of group `web` in game/packages.txt, and unpacks the sources of two of Debian's packages
# into build-web.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
. "$root/game/build.sh"
. "$root/game/install.sh"
taut_install run web
build=$root/build-web
sources=$build/sources
mkdir -p "$sources"

# source_of PACKAGE: the folder of a Debian package's sources. apt reads a list of sources of this folder's own, so that
# none has to be added to the system's.
source_of() {
    if [ ! -d "$sources/$1" ]; then
        mkdir -p "$sources/apt/lists/partial" "$sources/apt/archives/partial"
        mirror=$(apt-get indextargets --format '$(REPO_URI) $(CODENAME) $(COMPONENT)' 'Created-By: Packages' |
            grep -E '/debian/? [a-z]+ main$' | head -n 1)
        line="deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror"
        echo "$line" >"$sources/apt/sources.list"
        apt="apt-get -o Dir::Etc::SourceList=$sources/apt/sources.list -o Dir::Etc::SourceParts=-
            -o Dir::State::Lists=$sources/apt/lists -o Dir::Cache=$sources/apt -o APT::Sandbox::User=$(id -un)"
        # shellcheck disable=SC2086  # words
        (cd "$sources" && $apt update && $apt source --download-only "$1") >"$build/apt.log" 2>&1 || {
            tail -n 5 "$build/apt.log" >&2
            echo "taut: no sources of $1. Is there a network? This line of apt's sources was tried:" >&2
            echo "  $line" >&2
            echo "Without one, unpack $1's sources into $sources/$1 and run this again." >&2
            exit 1
        }
        mkdir "$sources/$1.part"
        tar -xf "$sources/$1"_*.orig.tar.* --strip-components 1 -C "$sources/$1.part"
        mv "$sources/$1.part" "$sources/$1"
    fi
    echo "$sources/$1"
}
bullet=$(source_of bullet)
deflate=$(source_of libdeflate)

# emscripten's own scripts need packages of Debian's node, which another node does not look for.
NODE_PATH=/usr/share/nodejs${NODE_PATH:+:$NODE_PATH}
export NODE_PATH
taut_cmake "$root" "$build" all -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_TOOLCHAIN_FILE=/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake \
    -DTAUT_RENDER=OFF -DTAUT_PROGRAM=OFF -DTAUT_TESTS=OFF -DTAUT_PYTHON=OFF -DTAUT_INSTALL=OFF -DTAUT_THREADS=OFF \
    -DTAUT_BULLET_SOURCE="$bullet/src" -DTAUT_DEFLATE_SOURCE="$deflate"
echo "$build/game/web/taut: $(wc -c <"$build/game/web/taut/taut.wasm.gz") bytes of WebAssembly, compressed"
