#!/usr/bin/python3
"""syntax.py FOLDER JOBS: compiles every file of the engine and the program by itself, without output.

FOLDER is configured with TAUT_UNITY=1, so that a file sees its own includes alone and fmt checks format strings. Of the
kernels one instruction set is enough.
"""
import concurrent.futures
import json
import pathlib
import shlex
import subprocess
import sys

folder, jobs = pathlib.Path(sys.argv[1]), int(sys.argv[2])
commands = {}
for entry in json.loads((folder / "compile_commands.json").read_text()):
    if "/tests/" not in entry["file"] and entry["file"].endswith(".cpp"):
        commands.setdefault(entry["file"], entry)


def errors(entry):
    words = shlex.split(entry["command"])
    words[words.index("-o") + 1] = "/dev/null"
    ran = subprocess.run(words + ["-fsyntax-only"], cwd=entry["directory"], text=True, stderr=subprocess.PIPE)
    return ran.stderr if ran.returncode else ""


with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
    found = [text for text in pool.map(errors, commands.values()) if text]
sys.stderr.write("".join(found))
print(f"{len(commands)} files compiled one by one, {len(found)} with errors")
sys.exit(1 if found or not commands else 0)
