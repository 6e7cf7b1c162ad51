#!/bin/sh
# sh other_debian.sh SUITE FOLDER [COMMAND...]: runs a command, by default the demo and the tests, in a clone of this
# checkout's HEAD on another release of Debian. FOLDER receives the root of the release and the clone, FOLDER/taut; later
# runs reuse both. Run it as root. It needs debootstrap, git, a network and 8 GB. MIRROR replaces debootstrap's mirror.
set -eu
if [ $# -lt 2 ]; then echo "usage: sh other_debian.sh SUITE FOLDER [COMMAND...]" >&2; exit 2; fi
if [ "$(id -u)" -ne 0 ]; then echo "other_debian.sh: only root can make and enter a root folder; use sudo" >&2; exit 1; fi
for tool in debootstrap git; do
    command -v $tool >/dev/null || { echo "other_debian.sh: install the package $tool" >&2; exit 1; }
done
checkout=$(cd "$(dirname "$0")/../.." && pwd)
suite=$1
mkdir -p "$2"
folder=$(cd "$2" && pwd)
shift 2

# This file is written last, so that an incomplete root is made again.
made=$folder/var/lib/taut-$suite
if [ ! -e "$made" ]; then
    [ -z "$(ls -A "$folder")" ] || [ -d "$folder/debootstrap" ] ||
        { echo "other_debian.sh: $folder holds something else than a root of $suite" >&2; exit 1; }
    echo "Making a root of $suite in $folder"
    debootstrap --variant=minbase "$suite" "$folder" ${MIRROR:+"$MIRROR"} >"$folder.log" 2>&1 ||
        { tail -n 5 "$folder.log" >&2; exit 1; }
    touch "$made"
fi
cp -L /etc/resolv.conf "$folder/etc/resolv.conf"
[ -d "$folder/taut/.git" ] || git clone --quiet "$checkout" "$folder/taut"
git -C "$folder/taut" fetch --quiet "$checkout" HEAD
git -C "$folder/taut" checkout --quiet --force --detach FETCH_HEAD

leave() { umount "$folder/dev/shm" "$folder/proc"; }
trap leave EXIT
trap 'exit 130' INT TERM
mount -t proc proc "$folder/proc"
mkdir -p "$folder/dev/shm"
mount -t tmpfs tmpfs "$folder/dev/shm"
[ $# -gt 0 ] || set -- sh -c 'sh game/demo.sh && sh tests/run.sh'
chroot "$folder" env -u TMPDIR HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 \
    sh -c 'cd /taut && exec "$@"' sh "$@"
