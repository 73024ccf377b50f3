# SPDX-License-Identifier: GPL-3.0-or-later
"""What tests/torture/run.sh runs."""
import argparse
import pathlib
import shutil
import subprocess
import sys

import broken
import events
import interrupts
import kills
import mutants

SKIPPED = 77  # as tests/run.sh knows it


def emptied(folder):
    """What a run left that was killed may hold small disks."""
    for line in pathlib.Path("/proc/mounts").read_text().splitlines():
        place = line.split()[1]
        if place.startswith(f"{folder.resolve()}/"):
            subprocess.run(["umount", place], check=True)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    return folder


def main():
    parser = argparse.ArgumentParser(prog="tests/torture/run.sh", description=__doc__)
    parser.add_argument("--build", type=pathlib.Path, required=True)
    parser.add_argument("--mutants", type=int, default=0, help="of each kind of file")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", action="append", default=[], help="a kind of file, or a command; again for another")
    # Walls of 1 mm in a body that a number made 1 km long take 6.
    parser.add_argument("--cpu-s", type=int, default=10, help="for each mutant; more where a sanitizer watches")
    parser.add_argument("--broken", type=pathlib.Path, action="append", default=[],
                        help="a folder of files, or a file, for every command; again for another")
    parser.add_argument("--interrupts", type=int, default=0, help="of each command that takes a while")
    parser.add_argument("--kills", type=int, default=0)
    parser.add_argument("--full-disk", type=int, default=0)
    parser.add_argument("--events", type=int, default=0, help="of random input to the window")
    options = parser.parse_args()
    root = pathlib.Path(__file__).resolve().parents[2]
    argil = options.build / "cli" / "argil"
    parts = {
        "broken": lambda folder, places: broken.run(argil, folder, places),
        "mutants": lambda folder, count: mutants.run(root, options.build, folder, count, options.seed, options.only,
                                                     options.cpu_s),
        "kills": lambda folder, count: kills.run_kills(argil, folder, count, options.seed, options.only),
        "full_disk": lambda folder, count: kills.run_full_disk(argil, folder, count, options.seed, options.only),
        "interrupts": lambda folder, count: interrupts.run(argil, folder, count, options.seed, options.only),
        "events": lambda folder, count: events.run(root, argil, folder, count, options.seed),
    }
    results = []
    for name, part in parts.items():
        asked = getattr(options, name)
        if not asked:
            continue
        results.append(part(emptied(options.build / "torture" / name), asked))
    if False in results:
        sys.exit(1)
    sys.exit(SKIPPED if None in results else 0)


if __name__ == "__main__":
    main()
