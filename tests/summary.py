#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Sums what tests/run.sh left in a folder: CTest's JUnit files, checks.tsv and stages.tsv.

Tells where the time went, names what failed and what was skipped, with the reason; the last line is
the count.
"""
import re
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

LAST_LINES = 60
SLOWEST = 10


def is_skip(case):
    """A program that is missing is 'skipped' to CTest as well, but a failure to us."""
    skipped = case.find("skipped")
    return skipped is not None and skipped.get("message").startswith("SKIP_")


def skip_reason(case):
    """GoogleTest prints 'FILE:LINE: Skipped' and then what the test gave as its reason."""
    output = case.findtext("system-out") or ""
    found = re.search(r": Skipped\n(.+?)\n\s*(?:\n|\[)", output, re.DOTALL)
    if found:
        return " ".join(found.group(1).split())
    return case.find("skipped").get("message") or "no reason given"


def last_words(case):
    """What a failed test printed at its end: the log is gone where only the output is kept."""
    lines = (case.findtext("system-out") or "").strip().splitlines() or ["without a word"]
    return "".join(f"\n    {line}" for line in lines[-LAST_LINES:])


def cases_of(path):
    """The cases of a whole file; of one that its runner did not finish, None."""
    try:
        return list(ElementTree.parse(path).getroot().iter("testcase"))
    except ElementTree.ParseError:
        return None


def read_junit(path):
    cases = cases_of(path)
    if cases is None:
        yield "failed", f"ctest of {path.stem}", f"{path} is cut short"
    for case in cases or ():
        name = f"{path.stem}: {case.get('name')}"
        if case.get("status") == "run":
            yield "passed", name, ""
        elif case.get("status") == "disabled":
            yield "skipped", name, "disabled in its source"
        elif is_skip(case):
            yield "skipped", name, skip_reason(case)
        else:
            yield "failed", name, f"see build/log/{path.stem}-test.log, which ends{last_words(case)}"


def read_checks(path):
    for line in path.read_text().splitlines():
        result, name, reason = line.split("\t")
        yield result, name, reason


def print_times(folder, junits):
    tests = [(float(case.get("time") or 0), f"{path.stem}: {case.get('name')}")
             for path in junits for case in cases_of(path) or ()]
    if tests:
        print(f"the slowest of {len(tests)} tests:")
    for seconds, name in sorted(tests, reverse=True)[:SLOWEST]:
        print(f"  {seconds:7.1f} s  {name}")
    print("stages:")
    total = 0
    for line in (folder / "stages.tsv").read_text().splitlines():
        seconds, name = line.split("\t")
        total += int(seconds)
        print(f"  {int(seconds):5d} s  {name}")
    print(f"  {total:5d} s  in all, {total // 60} min {total % 60} s")


def main():
    folder = Path(sys.argv[1])
    junits = sorted(folder.glob("*.xml"))
    outcomes = []
    for junit in junits:
        outcomes += read_junit(junit)
    outcomes += read_checks(folder / "checks.tsv")

    print_times(folder, junits)
    for kind in ("skipped", "failed"):
        for result, name, reason in outcomes:
            if result == kind:
                print(f"{kind}: {name}: {reason}")
    count = {kind: sum(o[0] == kind for o in outcomes) for kind in ("passed", "failed", "skipped")}
    print(f"{count['passed']} passed, {count['failed']} failed, {count['skipped']} skipped")
    return 1 if count["failed"] or not count["passed"] else 0


if __name__ == "__main__":
    sys.exit(main())
