#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Turns the JSON of bench_argil into a CSV named after the machine and a markdown table.

Each row is the median over repetitions, with the size it worked on and the hash of its result.
"""
import argparse
import csv
import json
import platform
import re
import statistics
import sys
from pathlib import Path

BEGIN = "<!-- bench:begin"
END = "<!-- bench:end -->"


def machine():
    """The processor's name and how many of it, as in the table's heading."""
    text = Path("/proc/cpuinfo").read_text()
    model = re.search(r"^model name\s*: (.+)$", text, re.MULTILINE)
    cores = len(re.findall(r"^processor\s*:", text, re.MULTILINE))
    name = " ".join(model.group(1).split()) if model else platform.machine()
    return f"{name}, {cores} cores"


def rows_of(report):
    """One row a benchmark: (name, size, hash, median seconds); stops when a benchmark failed."""
    scale = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}
    runs = {}
    for run in report["benchmarks"]:
        if run.get("error_occurred"):
            sys.exit(f"bench: {run['name']} failed: {run['error_message']}")
        if run["run_type"] == "iteration":
            runs.setdefault(run["run_name"], []).append(run)
    for name, repeated in runs.items():
        labels = {run["label"] for run in repeated}
        if len(labels) != 1:
            sys.exit(f"bench: {name} gave different results: {sorted(labels)}")
        size, result = labels.pop().split("|")
        seconds = statistics.median(run["real_time"] * scale[run["time_unit"]] for run in repeated)
        how = r"(/iterations:\d+)?(/real_time|/manual_time)?$"  # it was measured, not what
        yield re.sub(how, "", name), size, result, seconds


def readable(seconds):
    for unit, scale in (("s", 1.0), ("ms", 1e-3), ("µs", 1e-6)):
        if seconds >= scale:
            return f"{seconds / scale:.3g} {unit}"
    return f"{seconds / 1e-9:.3g} ns"


def table_of(rows, where):
    lines = [f"Median of five runs on {where} (hash: of the result; a new hash is a new answer).", ""]
    lines += ["| row | size | time | hash |", "|---|---|---|---|"]
    for name, size, result, seconds in rows:
        row = re.sub(r"/\d+$", "", name)  # the number is in the size
        lines.append(f"| {row} | {size} | {readable(seconds)} | `{result}` |")
    return "\n".join(lines)


def quote_in(readme, table):
    text = readme.read_text()
    begin = text.index("\n", text.index(BEGIN)) + 1
    readme.write_text(text[:begin] + table + "\n" + text[text.index(END):])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("report", type=Path)
    parser.add_argument("--results", type=Path, required=True)
    parser.add_argument("--readme", type=Path)
    options = parser.parse_args()

    rows = list(rows_of(json.loads(options.report.read_text())))
    where = machine()
    options.results.mkdir(parents=True, exist_ok=True)
    slug = re.sub(r"[^a-z0-9]+", "-", where.lower()).strip("-")
    with (options.results / f"{slug}.csv").open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["row", "size", "hash", "median_seconds"])
        writer.writerows((*row[:3], f"{row[3]:.4g}") for row in rows)
    table = table_of(rows, where)
    if options.readme:
        quote_in(options.readme, table)
    print(table)


if __name__ == "__main__":
    main()
