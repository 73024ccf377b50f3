# SPDX-License-Identifier: GPL-3.0-or-later
"""Interrupts every long command at random moments: it must answer within a second, a second signal at once, and
leave nothing."""
import random
import shutil
import signal
import subprocess
import time

import work

WITHIN_S = 1.0
SECOND_AFTER_S = 0.1
AT_ONCE_S = 0.3  # after the second


class Command:
    def __init__(self, argil, inputs, made, name, words, told_after_s=None):
        self.words = [str(word) for word in (argil, *words, "--quiet")]
        self.inputs, self.made, self.name, self.takes_s = inputs, made, name, told_after_s
        self.ends_when_told = told_after_s is not None  # so that status 0 is its usual end

    def environment(self):
        environment = work.environment(self.made)
        if self.name == "view":
            environment.update(DISPLAY=self.inputs.display(), LP_NUM_THREADS="0")
        return environment

    def clear(self):
        shutil.rmtree(self.made, ignore_errors=True)
        self.made.mkdir(parents=True)

    def measure(self):
        """How long it takes; once."""
        if self.takes_s is not None:
            return
        self.clear()
        start = time.monotonic()
        ended = subprocess.run(self.words, env=self.environment(), check=False, stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE)
        if ended.returncode not in (0, 1):
            raise RuntimeError(f"{self.name} ends in {ended.returncode}: {ended.stderr.decode()}")
        self.takes_s = time.monotonic() - start

    def interrupted(self, after_s, number, is_told_twice):
        """Status, seconds to the answer, and what is left."""
        self.clear()
        environment = self.environment()
        before = self.left()
        child = subprocess.Popen(self.words, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(after_s)
        start = time.monotonic()
        child.send_signal(number)
        if is_told_twice:
            time.sleep(SECOND_AFTER_S)
            child.send_signal(number)
        status = child.wait()
        return status, time.monotonic() - start, self.left() - before

    def left(self):
        """Settings of the window are no leftovers."""
        return {name for name in work.names_in(self.made) if not name.startswith("home")}


def run(argil, folder, count, seed, only):
    good = True
    print(f"{'command':18}{'takes':>8}{'tried':>7}{'told':>6}{'in time':>9}{'slowest':>9}{'leftovers':>11}  statuses")
    with work.Inputs(argil, folder / "inputs") as inputs:
        inputs.prepare_large()
        commands = work.long_commands(inputs, folder / "made")
        if unknown := set(only) - {words[0] for words in commands}:
            raise SystemExit(f"no such command: {', '.join(sorted(unknown))}; there are "
                             + "; ".join(words[0] for words in commands))
        for words in commands:
            if only and words[0] not in only:
                continue
            good = interrupt(Command(argil, inputs, folder / "made", *words), count, seed) and good
        if not inputs.can_show():
            print("view: skipped, since there is no Xvfb")
            good = None if good else False
    return good


def interrupt(command, count, seed):
    rng = random.Random(f"{seed} {command.name}")
    command.measure()
    slowest, told, late, left, statuses = 0.0, 0, 0, set(), {}
    for n in range(count):
        number, is_told_twice = (signal.SIGINT, signal.SIGTERM)[n % 2], n % 3 == 2
        moment = rng.uniform(0.02, 0.98) * command.takes_s
        status, answer_s, more = command.interrupted(moment, number, is_told_twice)
        statuses[status] = statuses.get(status, 0) + 1
        if status in (0, 1) and not command.ends_when_told and moment > 0.5 * command.takes_s:  # it had ended
            continue
        told += 1
        slowest = max(slowest, answer_s)
        within_s = SECOND_AFTER_S + AT_ONCE_S if is_told_twice else WITHIN_S
        is_usual_end = status == 0 and command.ends_when_told
        late += answer_s > within_s or status != 128 + number and not is_usual_end
        left |= more
    print(f"{command.name:18}{command.takes_s:7.1f}s{count:7}{told:6}{told - late:9}{slowest:8.2f}s{len(left):11}  "
          + ", ".join(f"{key}: {statuses[key]}" for key in sorted(statuses)), flush=True)
    if left:
        print("  left: " + ", ".join(sorted(left)[:5]))
    if told == 0:
        print("  it had always ended before it was told")
    return told > 0 and late == 0 and not left
