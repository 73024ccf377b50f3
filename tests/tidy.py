#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs clang-tidy on sources, ARGIL_JOBS (default 2) at a time.

Usage: tests/tidy.py BUILD FILE...
A source that was found clean is not looked at again, in any clone, while all that clang-tidy goes by is
the same: its version, the checks, and the source with everything it includes. What was clean is kept in
$XDG_CACHE_HOME/argil-tidy (default ~/.cache) for 30 days. Prints what is found; exit status 1 if anything.
"""
import hashlib
import json
import os
import shlex
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

KEPT = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "argil-tidy"
KEPT_S = 30 * 24 * 3600.0


def commands_of(build):
    entries = json.loads((build / "compile_commands.json").read_text())
    return {os.path.realpath(Path(e["directory"]) / e["file"]): e for e in entries}


def preprocessed(entry):
    """The source as the compiler sees it, with its comments, since NOLINT is one."""
    words = shlex.split(entry["command"])
    if Path(words[0]).name == "ccache":
        words = words[1:]
    words = words[:words.index("-o")] + ["-E", "-P", "-C", entry["file"]]
    return subprocess.run(words, cwd=entry["directory"], capture_output=True, check=True).stdout


def checks_of(file):
    """The .clang-tidy files that count for the source, from the root down."""
    folders = reversed(Path(file).parents)
    return b"".join((f / ".clang-tidy").read_bytes() for f in folders if (f / ".clang-tidy").exists())


def key_of(file, entry, version):
    return hashlib.sha256(version + checks_of(file) + preprocessed(entry)).hexdigest()[:32]


def is_clean(build, file, entry, version):
    mark = KEPT / key_of(file, entry, version)
    if mark.exists():
        mark.touch()
        return True
    run = subprocess.run(["clang-tidy", "--quiet", "-p", str(build),
                          "--extra-arg=-Wno-unknown-warning-option", file],
                         capture_output=True, text=True)
    print(run.stdout, end="", flush=True)
    if run.returncode == 0:
        mark.touch()
    elif not run.stdout:
        print(f"{file}: clang-tidy failed: {run.stderr.strip()[-500:]}", flush=True)
    return run.returncode == 0


def main():
    build, files = Path(sys.argv[1]), sys.argv[2:]
    KEPT.mkdir(parents=True, exist_ok=True)
    for mark in KEPT.iterdir():
        if time.time() - mark.stat().st_mtime > KEPT_S:
            mark.unlink()
    version = subprocess.run(["clang-tidy", "--version"], capture_output=True, check=True).stdout
    commands = commands_of(build)
    with ThreadPoolExecutor(int(os.environ.get("ARGIL_JOBS", "2"))) as pool:
        found = pool.map(lambda f: is_clean(build, f, commands[os.path.realpath(f)], version), files)
        return 0 if all(list(found)) else 1


if __name__ == "__main__":
    sys.exit(main())
