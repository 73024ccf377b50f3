#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What tests/run_tests.py makes of programs that hang, die or leave processes behind. Exit status 0 when each
fault is told of the right test, and nothing that was started is left."""
import os
import pathlib
import subprocess
import sys
import tempfile
import time

import run_tests

run_tests.HELD_OUTPUT_S = 1.0
BEGIN, END = "[ RUN      ] S.{}", "[       OK ] S.{} (1 ms)"


def outcomes_of(script, count=3, timeout_s=1.6):
    """Of tests S.0, S.1, ... in a program that is this script of the shell; its $1 says which are wanted."""
    with tempfile.TemporaryDirectory() as folder:
        program = pathlib.Path(folder) / "program"
        program.write_text(f"#!/bin/sh\n{script}\n")
        program.chmod(0o700)
        tests = [run_tests.Test({"name": f"S.{n}", "command": [str(program), f"--gtest_filter=S.{n}"],
                                 "properties": [{"name": "TIMEOUT", "value": timeout_s / run_tests.PATIENCE}]})
                 for n in range(count)]
        return {o.test.name: (o.status, o.output) for o in run_tests.run_suite(tests)}


def said(*lines):
    return "".join(f'echo "{line}"; ' for line in lines)


def passed(n):
    return said(BEGIN.format(n), END.format(n))


def check(what, is_so):
    print(f"{'ok' if is_so else 'WRONG'}: {what}")
    return is_so


def main():
    first = 'case $1 in *S.0*) '
    rest = ';; *) ' + passed(2) + ';; esac'
    sleep = f"sleep 1000.{os.getpid()}"  # of this run alone
    hangs = outcomes_of(first + passed(0) + said(BEGIN.format(1)) + f"{sleep} & {sleep}" + rest)
    dies = outcomes_of(first + passed(0) + said(BEGIN.format(1)) + "kill -9 $$" + rest)
    leaves = outcomes_of(passed(0) + f"{sleep} & exit 0", count=1)
    hides = outcomes_of(passed(0) + f"{sleep} >/dev/null 2>&1 & exit 0", count=1)
    prints = outcomes_of(said(BEGIN.format(0)) + "seq 1000000; " + said(END.format(0)), count=1,
                         timeout_s=60)  # it is as long as it takes
    slow = outcomes_of("".join(said(BEGIN.format(n)) + "sleep 0.7; " + said(END.format(n)) for n in range(3)))
    time.sleep(0.1)
    left = subprocess.run(["pgrep", "-f", sleep], stdout=subprocess.DEVNULL, check=False).returncode == 0
    good = [
        check("a test that hangs fails, those beside it pass",
              [hangs[f"S.{n}"][0] for n in range(3)] == ["run", "fail", "run"] and "took too long" in hangs["S.1"][1]),
        check("a test that dies fails, those beside it pass",
              [dies[f"S.{n}"][0] for n in range(3)] == ["run", "fail", "run"] and "status -9" in dies["S.1"][1]),
        check("a process that is left behind does not hold up the run",
              leaves["S.0"][0] == "run" and hides["S.0"][0] == "run"),
        check("of much output the first and the last is kept",
              len(prints["S.0"][1]) < 10000 and all(f"\n{n}\n" in prints["S.0"][1] for n in (1, 1000000))),
        check("the time counts for each test", all(status == "run" for status, _ in slow.values())),
        check("nothing that was started is left", not left),
    ]
    return 0 if all(good) else 1


if __name__ == "__main__":
    sys.exit(main())
