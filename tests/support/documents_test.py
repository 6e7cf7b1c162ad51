#!/usr/bin/python3
"""documents_test.py TAUT CHECKOUT [--long]: what the documents (*.md) say holds.

Links and anchors lead somewhere, files, commands and flags that are named exist, and the code in the documents works:

    ```toml NAME.toml    a whole scene: kept under that name beside the page's commands, then `taut check`
    ```toml scene=NAME   a part of one, merged over a shipped scene, then `taut check`
    ```sh                commands, run from the top in a folder of the page
    ```sh long           likewise, with --long only
    ```python            run where the module can be imported

What others test is marked by who does: `sh farm` tests/farm, `sh build` tests/run.sh and library_test.sh, `sh display`
play_test.sh, `sh peers` peers_test.sh, `cmake` and `cpp` library_test.sh, `sh web` and `js` tests/web.
It prints all that it ran.
"""
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

TAUT, ROOT = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve()
LONG = "--long" in sys.argv[3:]
ELSEWHERE = {"sh farm", "sh build", "sh display", "sh peers", "cmake", "cpp", "sh web", "js"}
MOST_LINES = {"README.md": 150, "engine/README.md": 132}  # of other README.md: 40
ENV = os.environ | {"PATH": f"{os.path.dirname(TAUT)}:{os.environ['PATH']}"}


def files():
    for folder, folders, names in os.walk(ROOT):
        folders[:] = [name for name in folders if not re.match(r"\.|build|out$", name)]
        yield from (os.path.relpath(os.path.join(folder, name), ROOT) for name in names)


FILES = sorted(files())
RUN = (ROOT / "tests/run.sh").read_text()  # its flags stand in documents too
PAGES = {name: (ROOT / name).read_text() for name in FILES if name.endswith(".md")}
FENCE = re.compile(r"^```([^\n]*)\n(.*?)^```$", re.M | re.S)


def words(text):
    """All but blocks of code."""
    return FENCE.sub("", text)


def spans(text):
    return [" ".join(span.split()) for span in re.findall(r"`([^`]+)`", words(text))]


def anchors(text):
    heads = re.findall(r"^#+ (.*)$", words(text), re.M)
    return {re.sub(r"[^\w\- ]", "", head.lower()).replace(" ", "-") for head in heads}


def wrong_links(name):
    for target in re.findall(r"\]\(([^)\s]+)\)", re.sub(r"`[^`]*`", "", words(PAGES[name]))):
        if re.match(r"[a-z]+:", target):
            continue
        file, _, anchor = target.partition("#")
        path = os.path.normpath(os.path.join(os.path.dirname(name), file)) if file else name
        if not (ROOT / path).exists():
            yield f"{name}: no {path}"
        elif anchor and anchor not in anchors(PAGES.get(path, "")):
            yield f"{name}: {path} has no heading #{anchor}"


def run(*command, folder=None):
    return subprocess.run(command, cwd=folder, env=ENV, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


def wrong_names(name, help_of):
    for span in spans(PAGES[name]):
        if re.fullmatch(r"[\w./-]+\.(cpp|h|py|sh|cmake|md)", span) and not any(
                file == span or file.endswith("/" + span) for file in FILES):
            yield f"{name}: there is no file {span}"
        command = re.match(r"taut ([a-z]+)", span)
        if command and command[1] not in help_of:
            yield f"{name}: there is no command: {span}"
        elif command or re.match("--[a-z]", span):
            known = help_of[command[1]] if command else " ".join([*help_of.values(), RUN])
            for flag in re.findall(r"(?<!\S)--[a-z][a-z-]+", span):
                if not re.search(rf"{flag}\b", known):
                    yield f"{name}: there is no flag {flag}: {span}"


def play(name):
    """Runs the blocks of a page; what it ran, and what was wrong."""
    ran, wrong = [], []
    with tempfile.TemporaryDirectory() as folder:
        for number, (info, text) in enumerate(FENCE.findall(PAGES[name])):
            scene = re.fullmatch(r"toml (?:scene=(\w+)|([\w-]+\.toml))", info)
            start = time.monotonic()
            if scene:
                file = scene[2] or f"part{number}.toml"
                base = f'schema = 1\nscene = "{scene[1]}"\n' if scene[1] else ""
                pathlib.Path(folder, file).write_text(base + text)
                shown, done = f"check {info}", run(TAUT, "check", file, folder=folder)
            elif info == "sh" or (info == "sh long" and LONG):
                shown, done = text.strip(), run("sh", "-eu", "-c", text, folder=folder)
            elif info == "python":
                if run(sys.executable, "-c", "import taut").returncode != 0:
                    ran.append(f"{name}: not run, no module: python")
                    continue
                shown, done = info, run(sys.executable, "-B", "-c", text, folder=folder)
            elif info in ELSEWHERE or info == "sh long":
                continue
            else:
                wrong.append(f"{name}: a block of nobody's: ```{info}")
                continue
            ran.append(f"{name}, {time.monotonic() - start:.1f} s: {shown}")
            if done.returncode != 0 or (scene and "warning" in done.stdout):
                wrong.append(f"{name}: {shown}\nexit code {done.returncode}\n{done.stdout}")
    return ran, wrong


def main():
    wrong = []
    for name, text in PAGES.items():
        wrong += wrong_links(name)
        lines = text.count("\n")
        if os.path.basename(name) == "README.md" and lines > MOST_LINES.get(name, 40):
            wrong.append(f"{name} has {lines} lines, more than {MOST_LINES.get(name, 40)}")
        if re.search(r"^    taut ", words(text), re.M):
            wrong.append(f"{name}: commands belong in ```sh, where they are run")

    commands = re.findall(r"^  ([a-z]+) ", run(TAUT, "--help").stdout.partition("Subcommands:")[2], re.M)
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        help_of = dict(zip(commands, pool.map(lambda command: run(TAUT, command, "--help").stdout, commands)))
        for name in PAGES:
            wrong += wrong_names(name, help_of)
        for ran, failed in pool.map(play, PAGES):
            print("\n".join(ran), end="\n" if ran else "")
            wrong += failed

    pages = [name for name in PAGES if name.startswith("game/manual/")]
    unknown = run(TAUT, "manual", "nothing")
    for name in pages:
        page = pathlib.Path(name).stem
        if run(TAUT, "manual", page).stdout != PAGES[name]:
            wrong.append(f"taut manual {page} does not print {name}")
        if page not in unknown.stdout or f"({name})" not in PAGES["README.md"]:
            wrong.append(f"{name} is not named by `taut manual nothing` or by README.md")
    if unknown.returncode != 2:
        wrong.append(f"taut manual nothing ends with {unknown.returncode}, not 2")

    print(f"{len(PAGES)} documents")
    sys.exit("\n".join(wrong) if wrong else 0)


main()
