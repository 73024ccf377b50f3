#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Damaged files, kills, full disks and interrupts: what argil does when nothing goes as it should.
# Usage: tests/torture/run.sh [--mutants N] [--kills N] [--full-disk N] [--interrupts N] [--events N] [--seed S] [--only KIND|COMMAND]...
#   --kills N       kills sculpt, view, bridge --clay, export and import at random moments, N times in all
#   --full-disk N   fills a small disk under the same, N times in all; needs root
#   --interrupts N  interrupts each command that takes a while N times
#   --events N      plays N random inputs into the window
#   --mutants N     runs argil on N mutants of each kind of file that it reads; what fails lies in
#                   build/release/torture/mutants/failed and joins tests/corpus/broken once it is mended
#   --broken PLACE  runs every command on the files of a folder, such as tests/corpus/broken, and on large ones
# Builds what it needs. Exit status 1 when something failed, 77 when something could not be tried here.
set -euo pipefail
unset CDPATH
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
say_name=torture
# shellcheck source=../../cmake/say.sh
. cmake/say.sh
build_preset release "argil torture_zygote" -DARGIL_BUILD_TESTS=ON -DARGIL_ASSERTS=ON # as the tests have it
exec python3 tests/torture/torture.py --build build/release "$@"
