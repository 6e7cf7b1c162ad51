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

GROUP, CERTIFICATE, NARROW, SOLVER, BOUNCE, GAUSS_SEIDEL, RIGID, BROAD = (
    f"engine/taut/contact/{name}.cpp" for name in
    ("contact_group", "certificate", "narrow_phase", "solver", "solver_bounce", "gauss_seidel_kernel", "rigid_side", "broad_phase"))
STAGE, SURFACES = ("engine/taut/world/contact_stage.cpp", "engine/taut/world/contact_stage_surfaces.cpp")
ISLAND = "engine/taut/island/private/island_contacts.h"

# name: what is wrong, the file, the text before, which is in it once, and the text after
MUTANTS = {
    "cut-untold": (
        "contact is not told of cuts", SURFACES,
        "if (severed == damage_[s] ||", "if (severed == damage_[s] || s < bodies_.size() ||"),
    "held-by-still": (
        "a collider that moves is still to what it holds", STAGE,
        ".speed = glm::dot(c.normal, c.carried),\n                                  .carried = c.carried,",
        ".speed = 0.0,\n                                  .carried = dvec3(0.0),"),
    "held-without-speed": (
        "a collider does not come at what it holds", STAGE,
        ".speed = glm::dot(c.normal, c.carried),", ".speed = 0.0,"),
    "held-without-drag": (
        "a collider does not carry what it holds along", STAGE,
        ".carried = c.carried,", ".carried = dvec3(0.0),"),
    "held-without-friction": (
        "what is on top does not press to the ground", STAGE,
        ".friction = c.friction});", ".friction = 0.0});"),
    "pairs-pass-close": (
        "pairs may pass at a fifth of their thickness", NARROW,
        "misses(pair, x0, x1, 1.0 - activeShare)", "misses(pair, x0, x1, 0.2 * (1.0 - activeShare))"),
    "boxes-without-reach": (
        "boxes of elements reach a fifth as far", BROAD,
        "query.find(nearShare * thickness(pair), a.edges", "query.find(0.2 * nearShare * thickness(pair), a.edges"),
    "slides-keep-approach": (
        "what slides apart goes on to approach", CERTIFICATE,
        "if (approach > 0) {", "if (approach > 1e300) {"),
    "frozen-has-mass": (
        "a frozen island keeps its mass", SURFACES,
        "!part.island->isStill() && isFree(plan, own)", "isFree(plan, own)"),
    "freezing-has-mass": (
        "an island keeps its mass in the tick in which it freezes", STAGE,
        "std::fill(inverseMass_.begin() + part.first, inverseMass_.begin() + part.last, 0.0);", "(void)part;"),
    "certificate-once": (
        "what was slid apart is not certified again", GROUP,
        "        handOver(whole, moved);\n    }", "        handOver(whole, moved);\n        break;\n    }"),
    "slides-undetected": (
        "pairs that slides bring into reach are not detected", GROUP,
        "        detectAgain(x);", "        if (round == 0) detectAgain(x);"),
    "impulses-undetected": (
        "pairs that impulses bring into reach are not detected", GROUP,
        "        detectAgain(x);", "        if (round > 0) detectAgain(x);"),
    "held-yields": (
        "what nothing moves may yield", RIGID,
        "return free > leastFree * all;", "return free > leastFree * all || all >= 0;"),
    "friction-of-first": (
        "friction has the factor of the first body alone", NARROW,
        "* a.friction * b.friction", "* a.friction"),
    "friction-of-second": (
        "friction has the factor of the second body alone", NARROW,
        "* a.friction * b.friction", "* b.friction"),
    "friction-double": (
        "friction is twice what it is", NARROW,
        "* a.friction * b.friction", "* 2.0 * a.friction * b.friction"),
    "friction-of-group-on-rigid": (
        "the friction of bodies counts for colliders", NARROW,
        "(a.isOfCollider() || b.isOfCollider() ? 1.0 : options_.friction)", "options_.friction"),
    "tangled-are-solved": (
        "pairs of what is crossed get impulses", NARROW,
        "if (!crossings_.empty() && isTangled(pair)) return;", ""),
    "tangled-are-all": (
        "no pair of what is crossed gets an impulse", NARROW,
        "std::max(first, second) == wrongSide", "std::max(first, second) != unmarked"),
    "feature-is-nearest": (
        "points are pressed from edges and corners that are not nearest", NARROW,
        "if (feature >= 0 && !isFeatureNearest(pair, feature, x))", "if (feature >= 6)"),
    "edges-are-ridges": (
        "edges in a flat sheet are obstacles", RIGID,
        "if (rise > steepest * length(inwards))", "if (rise > 1e300)"),
    "ridge-turned": (
        "a ridge is told from the wrong side", NARROW,
        "convexityOf(elements_, first, onFirst, -pair.normal, x)", "convexityOf(elements_, first, onFirst, pair.normal, x)"),
    "normal-turned": (
        "the normal of what touches with no gap is turned", NARROW,
        "pair.normal = measured.separation / pair.distance;",
        "pair.normal = -measured.separation / pair.distance;"),
    "open-any-sign": (
        "an overlap gives speed", SOLVER,
        "return std::max(gapNow(row) - slop, 0.0);", "return gapNow(row) - slop;"),
    "bounce-always": (
        "what is slower than restSpeed bounces as well", BOUNCE,
        "own.closing > block_.options.restSpeed &&", "own.closing > 0 &&"),
    "recover-five-times": (
        "overlaps are taken back five times as fast", SOLVER,
        "target = std::min(block_.options.recovery * (1 - restitution)",
        "target = std::min(5 * block_.options.recovery * (1 - restitution)"),
    "recover-at-once": (
        "overlaps are taken back however fast", SOLVER,
        "fastestOut * block_.seconds());", "1e300);"),
    "recover-through-held": (
        "what is taken back goes into what holds it", SOLVER,
        "        Row& own = rows.emplace_back(row);\n        own.impulse = {};",
        "        if (static_cast<std::size_t>(row.source) >= problem.pairs.size()) continue;\n        Row& own = rows.emplace_back(row);\n        own.impulse = {};"),
    "gains-turned": (
        "weights do not count for what an impulse gives", SOLVER,
        "const double gain = term.weight * term.inverseMass;",
        "const double gain = (term.weight < 0 ? -0.5 : 0.5) * term.inverseMass;"),
    "pull": (
        "impulses may pull", GAUSS_SEIDEL,
        "pressing = wanted > least ? wanted : least;", "pressing = wanted;"),
    "rub-unbounded": (
        "friction knows no limit", GAUSS_SEIDEL,
        "isBeyond = square > limit * limit",
        "isBeyond = square > none + 1e300"),
    "rub-with-normal": (
        "friction acts along the normal too", GAUSS_SEIDEL,
        "(velocity.x - parting * normal.x)",
        "velocity.x"),
    "step-on-double": (
        "the step on between sweeps is twice as long", GAUSS_SEIDEL,
        "share = squareBefore > 0 ? square / squareBefore : 0.0;",
        "share = squareBefore > 0 ? 2.0 * square / squareBefore : 0.0;"),
    "sweeps-one": (
        "there is one sweep", GAUSS_SEIDEL,
        "if (sweep == batch.most ||",
        "if (sweep > 0 || sweep == batch.most ||"),
    "certified-always": (
        "everything has a certificate", CERTIFICATE,
        "if (std::sqrt(first) + std::sqrt(second) < pair.distance) return true;",
        "if (std::sqrt(first) + std::sqrt(second) < 1e300) return true;"),
    "certified-never": (
        "a certificate needs what is nearly still", CERTIFICATE,
        "return separatesOnTheWay(pair, before, after, 0.0, 2.0);", "return false;"),
    "slides-into-held": (
        "what is slid apart goes into what holds it", CERTIFICATE,
        "glm::dot(own->normal, way) < into) return 0.0;", "glm::dot(own->normal, way) < 4 * into) return 0.0;"),
    "slides-unshared": (
        "both sides of what is slid apart go as far", CERTIFICATE,
        "const double shareA = inverseA / inverse, shareB = inverseB / inverse;",
        "const double shareA = inverseA > 0 ? 1.0 : 0.0, shareB = inverseB > 0 ? 1.0 : 0.0;"),
    "zones-without-speed": (
        "zones leave the velocities", CERTIFICATE,
        "v[k] += (x - x1[k]) / h;", "v[k] += (h - h) * (x - x1[k]);"),
    "zones-by-number": (
        "heavy points count in zones as light ones", CERTIFICATE,
        "zone.way += way / inverseMass[k];\n            zone.mass += 1.0 / inverseMass[k];",
        "zone.way += way;\n            zone.mass += 1.0;"),
    "untangled-faster": (
        "crossings come apart five times as fast", GROUP,
        "constexpr double apartSpeed = 0.3;", "constexpr double apartSpeed = 1.5;"),
    "untangled-by-levers": (
        "points on levers are untangled however fast", GROUP,
        "return std::min(std::clamp(apartSpeed - before, 0.0, apartSpeed) / inverse, apartSpeed / most);",
        "return most > 0 ? std::clamp(apartSpeed - before, 0.0, apartSpeed) / inverse : 0.0;"),
    "marks-stay": (
        "what was crossed once counts as crossed for ever", GROUP,
        "for (int i : crossing.points) marks_[static_cast<std::size_t>(i)] = unmarked;", "(void)crossing;"),
    "jump-unknown": (
        "points that have jumped are where they were", STAGE,
        "colliders_.place(0.0, x1_);\n    if (hasJumped_) group_->drop();\n    hasJumped_ = false;\n}\n\nstd::optional",
        "colliders_.place(0.0, x1_);\n    hasJumped_ = false;\n}\n\nstd::optional"),
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
    stale = [name for name, (_, file, before, after) in MUTANTS.items()
             if (ROOT / file).read_text().count(before) != 1 or before == after]
    if stale:
        refuse("out of date, for their files do not have the text before once: " + ", ".join(stale))
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
                    "-DTAUT_PYTHON=OFF"] + launcher, check=True, stdout=subprocess.DEVNULL)
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
