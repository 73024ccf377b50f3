#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Sums what tests/run.sh left in a folder: CTest's JUnit files and checks.tsv.

Names what failed and what was skipped, with the reason; the last line is the count.
"""
import re
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

LAST_LINES = 60


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


def read_junit(path):
    for case in ElementTree.parse(path).getroot().iter("testcase"):
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


def main():
    folder = Path(sys.argv[1])
    outcomes = []
    for junit in sorted(folder.glob("*.xml")):
        outcomes += read_junit(junit)
    outcomes += read_checks(folder / "checks.tsv")

    for kind in ("skipped", "failed"):
        for result, name, reason in outcomes:
            if result == kind:
                print(f"{kind}: {name}: {reason}")
    count = {kind: sum(o[0] == kind for o in outcomes) for kind in ("passed", "failed", "skipped")}
    print(f"{count['passed']} passed, {count['failed']} failed, {count['skipped']} skipped")
    return 1 if count["failed"] or not count["passed"] else 0


if __name__ == "__main__":
    sys.exit(main())
