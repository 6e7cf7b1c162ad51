#!/bin/sh
# parallel_test.sh TAUT CHECKOUT: GNU parallel runs the manual's lines for it, with a stand-in for ssh, so that both
# hosts are this one. The second host dies in the middle of its first shard. Frames and video are the bytes of a run on one machine.
set -eu
taut=$1
root=$2
. "$root/tests/farm/manual.sh"
command -v parallel >/dev/null || { echo "skipped: no parallel; tests/run.sh --long installs it"; exit 77; }
D=$(mktemp -d)
trap 'rm -rf "$D"' EXIT
mkdir "$D/farm" "$D/serial" "$D/home"
cat >"$D/ssh" <<END
#!/bin/sh
# ssh [OPTIONS] HOST COMMAND
while [ "\${1#-}" != "\$1" ]; do
    case \$1 in -o|-p|-l|-i) shift 2 ;; *) shift ;; esac
done
host=\$1
shift
if [ "\${1-}" = -- ]; then shift; fi
case "\$host \$*" in
    n2*GNU_Parallel_worker*)
        if [ -e '$D/killed' ]; then exit 255; fi
        setsid sh -c "\$*" &
        process=\$!
        while [ "\$(find '$D/farm/out/show' -name '*.png' | wc -l)" -lt 20 ] && kill -0 \$process; do sleep 0.1; done
        kill -9 -- -\$process
        echo "with \$(find '$D/farm/out/show' -name '*.png' | wc -l) frames" >'$D/killed'
        exit 255 ;;
esac
exec sh -c "\$*"
END
chmod +x "$D/ssh"
export PARALLEL_SSH="$D/ssh" HOME="$D/home" PARALLEL_HOME="$D/home"
PATH="$(dirname "$taut"):$PATH"
export PATH
manual_block 2 >"$D/lines"
[ -s "$D/lines" ] || { echo "no lines for GNU parallel in the manual"; exit 1; }
(cd "$D/farm" && sh -eu "$D/lines")
[ -s "$D/killed" ] || { echo "nothing was killed"; exit 1; }
echo "n2 was killed $(cat "$D/killed")"
serial "$D/serial"
same "$D/serial" "$D/farm"
