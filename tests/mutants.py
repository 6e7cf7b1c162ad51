#!/usr/bin/env python3
"""Makes mistakes on purpose in the code of contact, one at a time, and lists those that no test of contact finds.

It works in a copy of the checkout, and changes nothing in that. Run by hand before a release, for it takes an hour or
so; no part of the suite.

    python3 tests/mutants.py --folder /tmp/mutants    # keeps copy and build for the next time
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TESTS = [("unit", "*ontact*:*ouch*"), ("physics", "*Touch*:StiffContact*:Incline*")]  # and those of contact

GROUP, GUARD, LOCATING, PRESSING, DESCENT, RIGID, NEAR = (
    f"engine/taut/contact/{name}.cpp" for name in
    ("group", "guard", "locating", "pressing", "descent", "rigid_side", "near_pairs"))
TOUCHING = "engine/taut/world/touching.cpp"
ISLAND = "engine/taut/island/island_contacts.h"

# name: what is wrong, the file, the text before, which is in it once, and the text after
MUTANTS = {
    "cut-untold": (
        "contact is not told of cuts", TOUCHING,
        "if (severed == damage_[s]) continue;", "if (severed == damage_[s] || s < bodies_.size()) continue;"),
    "held-by-still": (
        "a collider that moves is still to what it holds", TOUCHING,
        "glm::dot(c.normal, c.carried), c.carried, c.friction", "0.0, dvec3(0.0), c.friction"),
    "held-without-speed": (
        "a collider does not come at what it holds", TOUCHING,
        "glm::dot(c.normal, c.carried), c.carried, c.friction", "0.0, c.carried, c.friction"),
    "held-without-drag": (
        "a collider does not carry what it holds along", TOUCHING,
        "c.carried, c.friction});", "dvec3(0.0), c.friction});"),
    "held-without-friction": (
        "what is on top does not press to the ground", TOUCHING,
        "c.carried, c.friction});", "c.carried, 0.0});"),
    "pairs-pass-close": (
        "pairs may pass at a fifth of what they keep", LOCATING,
        "misses(pair, x0, x1, 1.0 - pressShare)", "misses(pair, x0, x1, 0.2 * (1.0 - pressShare))"),
    "patches-pass-close": (
        "patches may pass at a fifth of what they keep", NEAR,
        "if (!(low - high > nearShare * record.most))", "if (!(low - high > 0.2 * nearShare * record.most))"),
    "slides-keep-approach": (
        "what slides apart goes on to approach", GUARD,
        "if (approach > 0) {", "if (approach > 1e300) {"),
    "frozen-has-mass": (
        "a frozen island keeps its mass", TOUCHING,
        "room.island->frozen() == nullptr && isFree(plan, own)", "isFree(plan, own)"),
    "freezing-has-mass": (
        "an island keeps its mass in the tick in which it freezes", TOUCHING,
        "std::fill(inverseMass_.begin() + room.first, inverseMass_.begin() + room.last, 0.0);", "(void)room;"),
    "guard-looks-once": (
        "what was slid apart is not looked at again", GROUP,
        "        give(instant, moved);\n        refind(instant, moved_);\n    }\n",
        "        give(instant, moved);\n        return;\n    }\n"),
    "guard-refinds-not": (
        "what slides lead near is not found", GROUP,
        "        give(instant, moved);\n        refind(instant, moved_);\n    }\n",
        "        give(instant, moved);\n    }\n"),
    "press-refinds-not": (
        "what impulses lead near is not found", GROUP,
        "if (!moved_.empty()) refind(instant, moved_);", ""),
    "held-yields": (
        "what nothing moves may yield", RIGID,
        "return free > leastFree * all;", "return free > leastFree * all || all >= 0;"),
    "friction-of-first": (
        "friction has the factor of the first body alone", LOCATING,
        "* a.friction * b.friction", "* a.friction"),
    "friction-of-second": (
        "friction has the factor of the second body alone", LOCATING,
        "* a.friction * b.friction", "* b.friction"),
    "friction-double": (
        "friction is twice what it is", LOCATING,
        "* a.friction * b.friction", "* 2.0 * a.friction * b.friction"),
    "friction-of-group-on-rigid": (
        "the friction of bodies counts for colliders", LOCATING,
        "(a.isRigid || b.isRigid ? 1.0 : options_.friction)", "options_.friction"),
    "tangled-are-pressed": (
        "pairs of what is crossed are pressed", LOCATING,
        "if (!crossings_.empty() && isTangled(pair)) return;", ""),
    "tangled-are-all": (
        "nothing of what is crossed is pressed", LOCATING,
        "std::max(first, second) == wrongSide", "std::max(first, second) != unmarked"),
    "feature-is-nearest": (
        "points are pressed from edges and corners that are not nearest", LOCATING,
        "if (pair.presses && pair.isPoint && feature >= 0)", "if (pair.presses && pair.isPoint && feature >= 6)"),
    "edges-are-ridges": (
        "edges in a flat sheet are obstacles", LOCATING,
        "if (rise > 0 && rise * rise > valley * valley * glm::dot(inwards, inwards))", "if (rise > 1e300)"),
    "ridge-turned": (
        "a ridge is told from the wrong side", LOCATING,
        "isRidge(first, onFirst, -pair.normal, x0)", "isRidge(first, onFirst, pair.normal, x0)"),
    "normal-turned": (
        "the normal of what touches with no gap is turned", LOCATING,
        "pair.normal = batch.apart(measured.slot) / apart;", "pair.normal = -batch.apart(measured.slot) / apart;"),
    "open-any-sign": (
        "an overlap gives speed", PRESSING,
        "row.open = std::max(pair.gap(), 0.0) / h;", "row.open = pair.gap() / h;"),
    "bounce-always": (
        "what is slower than restSpeed bounces as well", PRESSING,
        "arrival > options.restSpeed ?", "arrival > 0 ?"),
    "bounce-of-mean": (
        "velocities bounce as the mean ones do", PRESSING,
        "pressing.back().bounce = bounceOf(pairs[static_cast<std::size_t>(row.pair)], v);", ""),
    "recover-five-times": (
        "overlaps are taken back five times as fast", PRESSING,
        "std::min(-options.recovery * pair.gap(), fastestOut * h)",
        "std::min(-5 * options.recovery * pair.gap(), fastestOut * h)"),
    "recover-at-once": (
        "overlaps are taken back however fast", PRESSING,
        "std::min(-options.recovery * pair.gap(), fastestOut * h)", "-options.recovery * pair.gap()"),
    "recover-through-held": (
        "what is taken back goes into what holds it", PRESSING,
        "++i) hold(supports[i].held, shift, held[i]);", "++i) if (most < 0) hold(supports[i].held, shift, held[i]);"),
    "clusters-apart": (
        "pairs of one cluster are solved as several", PRESSING,
        "parent_[static_cast<std::size_t>(std::max(first, own))] = low;", ""),
    "clusters-through-held": (
        "points that nothing moves join clusters", PRESSING,
        "            if (isFixed(i)) continue;\n", ""),
    "gains-turned": (
        "weights do not count for what an impulse gives", PRESSING,
        "row.gains[i] = pair.weights[i] * own;",
        "row.gains[i] = (pair.weights[i] < 0 ? -own : own) / pair.firstSide();"),
    "pull": (
        "impulses may pull", DESCENT,
        "std::max(0.0, next.normal - row.mass *", "(next.normal - row.mass *"),
    "support-pulls": (
        "colliders may pull", DESCENT,
        "std::max(0.0, next.normal - support.mass * closing)", "next.normal - support.mass * closing"),
    "support-pushes-more": (
        "colliders hold five times as fast", DESCENT,
        "next.normal - support.mass * closing)", "next.normal - 5.0 * support.mass * closing)"),
    "rub-unbounded": (
        "friction knows no limit", DESCENT,
        "row.mass * (way - closing * pair.normal), pair.friction * next.normal)",
        "row.mass * (way - closing * pair.normal), 1e300)"),
    "rub-with-normal": (
        "friction acts along the normal too", DESCENT,
        "within(next.rub - row.mass * (way - closing * pair.normal),", "within(next.rub - row.mass * way,"),
    "step-on-double": (
        "the step on between sweeps is twice as long", DESCENT,
        "const double share = squareBefore > 0 ? square / squareBefore : 0.0;",
        "const double share = squareBefore > 0 ? 2.0 * square / squareBefore : 0.0;"),
    "sweeps-one": (
        "there is one sweep", DESCENT,
        "if (sweep == sweeps || most < little * little) return sweep;",
        "if (sweep > 0 || most < little * little || sweep == sweeps) return sweep;"),
    "certified-always": (
        "everything has a certificate", GUARD,
        "if (std::sqrt(first) + std::sqrt(second) < pair.apart) return true;",
        "if (std::sqrt(first) + std::sqrt(second) < 1e300) return true;"),
    "certified-never": (
        "a certificate needs what is nearly still", GUARD,
        "return separatesOnTheWay(pair, before, after, 0.0, 2.0);", "return false;"),
    "slides-into-held": (
        "what is slid apart goes into what holds it", GUARD,
        "if (glm::dot(own->normal, way) < into) return 0.0;", "if (glm::dot(own->normal, way) < 4 * into) return 0.0;"),
    "slides-unshared": (
        "both sides of what is slid apart go as far", GUARD,
        "const double shareA = inverseA / inverse, shareB = inverseB / inverse;",
        "const double shareA = inverseA > 0 ? 1.0 : 0.0, shareB = inverseB > 0 ? 1.0 : 0.0;"),
    "zones-without-speed": (
        "zones leave the velocities", GUARD,
        "v[k] += (x - x1[k]) / h;", "v[k] += (h - h) * (x - x1[k]);"),
    "zones-by-number": (
        "heavy points count in zones as light ones", GUARD,
        "zone.way += way / inverseMass[k];\n            zone.mass += 1.0 / inverseMass[k];",
        "zone.way += way;\n            zone.mass += 1.0;"),
    "led-apart-faster": (
        "crossings are led apart five times as fast", GROUP,
        "constexpr double apartSpeed = 0.3;", "constexpr double apartSpeed = 1.5;"),
    "led-apart-by-levers": (
        "points on levers are led apart however fast", GROUP,
        "return std::min(std::clamp(apartSpeed - before, 0.0, apartSpeed) / inverse, apartSpeed / most);",
        "return most > 0 ? std::clamp(apartSpeed - before, 0.0, apartSpeed) / inverse : 0.0;"),
    "marks-stay": (
        "what was crossed once counts as crossed for ever", GROUP,
        "for (int i : crossing.points) marks_[static_cast<std::size_t>(i)] = unmarked;", "(void)crossing;"),
    "jump-unknown": (
        "points that have jumped are where they were", TOUCHING,
        "    if (hasJumped_) group_->drop();\n    hasJumped_ = false;\n    const auto start",
        "    hasJumped_ = false;\n    const auto start"),
    "trial-stands": (
        "a tick in which nothing should meet stands if something does", TOUCHING,
        "(isTrial && meeting_.pressing > 0)", "(isTrial && meeting_.pressing < 0)"),
    "deep-stands": (
        "an instant that went deep stands", TOUCHING,
        "(meeting_.deepest > wayOfKeep || meeting_.slides > 0)", "meeting_.deepest > 1e300"),
    "placed-keeps-speed": (
        "what contact places keeps its velocity", ISLAND,
        "            planar_.set(state_.v, points[own], v[own]);\n", ""),
    "placed-in-collider": (
        "contact may place points in colliders", ISLAND,
        "                if (own.last > own.first)\n", "                if (own.last > own.first && own.last < 0)\n"),
    "yields-to-half-the-friction": (
        "friction under what yields is half of what it is", ISLAND,
        "const dvec3 rub = -slide.friction *", "const dvec3 rub = -0.5 * slide.friction *"),
}


def refuse(message):
    sys.exit("mutants: " + message)


def copy_to(copy):
    """Only what differs is written, so that only that is built again."""
    listed = subprocess.run(["git", "ls-files", "-z", "-co", "--exclude-standard"], cwd=ROOT, check=True,
                            stdout=subprocess.PIPE).stdout.decode().split("\0")
    names = {name for name in listed if name and (ROOT / name).is_file()}
    for name in names:
        source, target = ROOT / name, copy / name
        if target.is_file() and target.read_bytes() == source.read_bytes():
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(source, target)
    for old in copy.rglob("*"):
        name = old.relative_to(copy)
        if name.parts[0] != "build" and old.is_file() and str(name) not in names:
            old.unlink()


def build(copy, jobs):
    """What went wrong, or nothing."""
    environment = dict(os.environ, CCACHE_BASEDIR=str(copy), CCACHE_SLOPPINESS="include_file_mtime,time_macros")
    command = ["cmake", "--build", str(copy / "build"), "-j", str(jobs), "--target"]
    done = subprocess.run(command + [f"taut_{program}" for program, _ in TESTS], env=environment,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return done.stdout[-4000:] if done.returncode else ""


def first_failure(copy, seconds):
    """The first test that fails, or nothing."""
    for program, wanted in TESTS:
        path = next((copy / "build/tests").rglob(f"taut_{program}"))
        try:
            done = subprocess.run([str(path), f"--gtest_filter={wanted}", "--gtest_fail_fast", "--gtest_brief=1"],
                                  cwd=copy / "build", timeout=seconds, stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, text=True, errors="replace")
        except subprocess.TimeoutExpired:
            return f"{program}: time limit of {seconds:.0f} s"
        if done.returncode:
            failed = re.search(r"\[  FAILED  \] (\S+)", done.stdout)
            return failed.group(1).rstrip(",") if failed else f"{program}: ended with {done.returncode}"
    return ""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--list", action="store_true", help="says what mistakes there are, and makes none")
    parser.add_argument("--only", action="append", metavar="NAME", help="that mistake; may be given again")
    parser.add_argument("--folder", type=Path, help="for the copy and its build, which are kept; else they are not")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()
    unknown = [name for name in options.only or [] if name not in MUTANTS]
    if unknown:
        refuse(f"there is no '{unknown[0]}'; --list says what there is")
    for name, (_, file, before, after) in MUTANTS.items():
        count = (ROOT / file).read_text().count(before)
        if count != 1 or before == after:
            refuse(f"'{name}' is out of date: {file} has {count} times, not once:\n{before}")
    if options.list:
        for name, (what, file, _, _) in MUTANTS.items():
            print(f"{name:28} {file:32} {what}")
        return 0

    folder = options.folder or Path(tempfile.mkdtemp(prefix="taut-mutants-"))
    try:
        return run(folder.resolve() / "taut", options)
    finally:
        if not options.folder:
            shutil.rmtree(folder)


def run(copy, options):
    copy.mkdir(parents=True, exist_ok=True)
    copy_to(copy)
    launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
    subprocess.run(["cmake", "-G", "Ninja", "-S", str(copy), "-B", str(copy / "build"), "-DCMAKE_BUILD_TYPE=Release",
                    "-DTAUT_UNITY=24", "-DTAUT_PYTHON=OFF"] + launcher, check=True, stdout=subprocess.DEVNULL)
    broken = build(copy, options.jobs)
    if broken:
        refuse("without a mistake it is not built:\n" + broken)
    start = time.monotonic()
    failed = first_failure(copy, 3600)
    if failed:
        refuse(f"without a mistake a test fails: {failed}")
    seconds = 60 + 5 * (time.monotonic() - start)

    living = []
    for name in options.only or MUTANTS:
        what, file, before, after = MUTANTS[name]
        path, text = copy / file, (ROOT / file).read_text()
        path.write_text(text.replace(before, after))
        try:
            broken = build(copy, options.jobs)
            found = "it is not built:\n" + broken if broken else first_failure(copy, seconds)
        finally:
            path.write_text(text)
        if broken or not found:
            living.append(name)
        print(f"{name}: {what}: {found or 'LIVES'}", flush=True)
    print(f"{len(living)} live" + "".join(f"\n  {name}" for name in living))
    return 1 if living else 0


if __name__ == "__main__":
    sys.exit(main())
