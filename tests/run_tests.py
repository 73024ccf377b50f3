#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the tests that CTest lists, those of a suite in one process: starting a program that loads OpenVDB
costs more than most tests do. Writes CTest's JUnit, a case for each test by its own name.

Usage: run_tests.py BUILD OUT.xml JOBS together|apart [ctest's options that choose tests]
  together: the tests of a suite in one process
  apart: each test in a process of its own

What a suite's process takes with it when it dies is one test: that one failed, and those after it run in
another process. A process that ends badly after its last test, as one that lost memory does, makes that one
fail. A test that takes longer than its TIMEOUT (three times that with ARGIL_THOROUGH) is killed with all that
it started.
"""
import collections
import concurrent.futures
import json
import os
import re
import signal
import subprocess
import sys
import threading
import time
import xml.etree.ElementTree as ElementTree

MOST_IN_A_PROCESS = 12
PATIENCE = 3 if os.environ.get("ARGIL_THOROUGH") else 1
HELD_OUTPUT_S = 10.0
MOST_LINES = 400  # of the first and of the last that a test prints
GTEST = "--gtest_filter="
RUN = re.compile(r"\[ RUN      \] (\S+)$")
ENDED = re.compile(r"\[(       OK |  FAILED  |  SKIPPED )\] ([^\s,]+)(?:, where .*)? \((\d+) ms\)$")


class Test:
    def __init__(self, entry):
        properties = {p["name"]: p["value"] for p in entry.get("properties", [])}
        self.name = entry["name"]
        self.command = entry.get("command")
        self.folder = properties.get("WORKING_DIRECTORY")
        self.timeout_s = PATIENCE * float(properties.get("TIMEOUT", 300))
        self.cost = float(properties.get("COST", 0))
        self.environment = dict(line.split("=", 1) for line in properties.get("ENVIRONMENT", []))
        filters = [word[len(GTEST):] for word in self.command or [] if word.startswith(GTEST)]
        self.filter = filters[0] if len(filters) == 1 else None


class Outcome:
    """status: run, fail, skipped or disabled."""

    def __init__(self, test, status, seconds, output):
        self.test, self.status, self.seconds, self.output = test, status, seconds, output


def listed(build, options):
    answer = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1", *options], check=True,
                            stdout=subprocess.PIPE)
    return [Test(entry) for entry in json.loads(answer.stdout)["tests"]]


def groups_of(tests, is_apart):
    """What goes into a process: tests of a suite, some at a time, costly ones alone and first."""
    groups = collections.defaultdict(list)
    for number, test in enumerate(tests):
        alone = is_apart or test.filter is None or test.cost > 0 and "Property" not in test.name
        key = number if alone else (test.command[0], test.filter.split(".", 1)[0])
        groups[key].append(test)
    parts = []
    for group in groups.values():
        parts += [group[at:at + MOST_IN_A_PROCESS] for at in range(0, len(group), MOST_IN_A_PROCESS)]
    return sorted(parts, key=lambda part: -sum(test.cost for test in part))


class Process:
    """A program, with all that it starts: its status (None: a test of it took too long) and what it printed."""

    living, lock = set(), threading.Lock()

    def __init__(self, command, test):
        with self.lock:  # none is begun unseen by kill_all
            self.child = subprocess.Popen(command, cwd=test.folder, env={**os.environ, **test.environment},
                                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                          stderr=subprocess.STDOUT, start_new_session=True)
            self.living.add(self)
        self.lines, self.begun_s = [], time.monotonic()
        self.of_test, self.last_lines = 0, collections.deque(maxlen=MOST_LINES)
        self.reader = threading.Thread(target=self.read, daemon=True)
        self.reader.start()

    def read(self):
        while line := self.child.stdout.readline(4096):
            line = line.decode("utf-8", "replace")
            is_begin = RUN.search(line.rstrip())
            if is_begin or ENDED.search(line.rstrip()):
                self.end_lines()
                self.lines.append(line)
                self.of_test = 0
            elif self.of_test < MOST_LINES:
                self.lines.append(line)
                self.of_test += 1
            else:
                self.last_lines.append(line)
            if is_begin:
                self.begun_s = time.monotonic()  # the time counts for each test
        self.end_lines()

    def end_lines(self):
        if len(self.last_lines) == MOST_LINES:
            self.lines.append("...\n")
        self.lines += self.last_lines
        self.last_lines.clear()

    def kill(self):
        try:
            os.killpg(self.child.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass

    def wait(self, timeout_s):
        status, is_late = None, False
        while status is None and not is_late:
            left_s = self.begun_s + timeout_s - time.monotonic()
            try:
                status = self.child.wait(max(left_s, 0.01))
            except subprocess.TimeoutExpired:
                is_late = time.monotonic() >= self.begun_s + timeout_s
        if is_late:
            self.kill()
            self.child.wait()
        self.reader.join(HELD_OUTPUT_S)
        is_held = self.reader.is_alive()
        self.kill()  # what it started and left behind
        self.reader.join(HELD_OUTPUT_S)
        with self.lock:
            self.living.discard(self)
        held = "what it started still held its output\n" if is_held else ""
        return status, "".join(list(self.lines)) + held

    @classmethod
    def kill_all(cls, number, _frame):
        with cls.lock:
            for process in cls.living:
                process.kill()
            os._exit(128 + number)


def run_alone(test):
    if test.command is None:
        return [Outcome(test, "fail", 0.0, "its program was not built")]
    start = time.monotonic()
    status, output = Process(test.command, test).wait(test.timeout_s)
    seconds = time.monotonic() - start
    if status is None:
        output += f"\nit took longer than {test.timeout_s:g} s"
    return [Outcome(test, "run" if status == 0 else "fail", seconds, output)]


def read_outcomes(by_filter, output):
    """Of the tests that ended, in their order; and the one that did not, with what it printed."""
    ended, running, lines = [], None, []
    for line in output.splitlines():
        if begun := RUN.search(line):
            running, lines = by_filter.get(begun.group(1)), []
        lines.append(line)
        if running is not None and (end := ENDED.search(line)) and end.group(2) == running.filter:
            status = {"       OK ": "run", "  FAILED  ": "fail", "  SKIPPED ": "skipped"}[end.group(1)]
            ended.append(Outcome(running, status, int(end.group(3)) / 1000.0, "\n".join(lines) + "\n"))
            running, lines = None, []
    return ended, running, "\n".join(lines)


def run_suite(tests):
    outcomes = []
    while tests:
        first = tests[0]
        words = [word for word in first.command if not word.startswith(GTEST)]
        words.insert(1, GTEST + ":".join(test.filter for test in tests))
        status, output = Process(words, first).wait(max(test.timeout_s for test in tests))
        ended, running, rest = read_outcomes({test.filter: test for test in tests}, output)
        outcomes += ended
        if running is not None:
            how = "took too long" if status is None else f"ended its process with status {status}"
            outcomes.append(Outcome(running, "fail", 0.0, f"{rest}\nit {how}"))
        elif not ended:
            outcomes.append(Outcome(first, "fail", 0.0, f"{output}\nits program ran no test, status {status}"))
        elif status != 0 and all(outcome.status != "fail" for outcome in ended):
            last = outcomes[-1]
            last.status, last.output = "fail", f"{output}\nthe process ended with status {status} after its tests"
        done = {outcome.test.name for outcome in outcomes}
        tests = [test for test in tests if test.name not in done]
    return outcomes


def run_group(tests):
    return run_alone(tests[0]) if tests[0].filter is None or tests[0].command is None else run_suite(tests)


def write_junit(file, outcomes):
    suite = ElementTree.Element("testsuite", tests=str(len(outcomes)))
    for outcome in outcomes:
        case = ElementTree.SubElement(suite, "testcase", name=outcome.test.name, time=f"{outcome.seconds:.3f}",
                                      status="notrun" if outcome.status == "skipped" else outcome.status)
        if outcome.status == "skipped":
            ElementTree.SubElement(case, "skipped", message="SKIP_REGULAR_EXPRESSION_MATCHED")
        # XML has no room for control characters.
        text = re.sub(r"[^\t\n\r\x20-\ud7ff\ue000-\ufffd]", "?", outcome.output[-65536:])
        ElementTree.SubElement(case, "system-out").text = text
    ElementTree.ElementTree(suite).write(file, encoding="unicode", xml_declaration=True)


def main():
    build, out, jobs, options = sys.argv[1], sys.argv[2], int(sys.argv[3]), sys.argv[5:]
    is_apart = {"apart": True, "together": False}[sys.argv[4]]
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT):
        signal.signal(number, Process.kill_all)
    tests = listed(build, options)
    outcomes, lock, start = [], threading.Lock(), time.monotonic()

    def work(group):
        done = run_group(group)
        with lock:
            outcomes.extend(done)
            for outcome in done:
                word = {"run": "Passed", "skipped": "Skipped"}.get(outcome.status, "***Failed")
                print(f"{len(outcomes)}/{len(tests)} {outcome.test.name}: {word} {outcome.seconds:.2f} sec", flush=True)
                if word == "***Failed":
                    print(outcome.output, flush=True)

    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for future in [pool.submit(work, group) for group in groups_of(tests, is_apart)]:
            future.result()
    order = {test.name: number for number, test in enumerate(tests)}
    outcomes.sort(key=lambda outcome: order[outcome.test.name])
    write_junit(out, outcomes)
    failed = sum(outcome.status == "fail" for outcome in outcomes)
    print(f"{100 * (len(outcomes) - failed) // max(1, len(outcomes))}% tests passed, {failed} tests failed out of "
          f"{len(outcomes)}\nTotal Test time (real) = {time.monotonic() - start:.2f} sec")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
