#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Sets up, builds and runs every test. Usage: ./tests/run.sh [--quick]
#   --quick  only the Release build and its tests: no sanitizers, no Debug build, no clang-tidy
# The last line is "N passed, N failed, N skipped" over everything; each skip is named before it
# with its reason. Exit status 1 when something failed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
say_name=tests
# shellcheck source=../cmake/say.sh
. cmake/say.sh

quick=no
case ${1:-} in
  '') ;;
  --quick) quick=yes ;;
  *)
    sed -n '3,6s/^# //p' "${BASH_SOURCE[0]}"
    exit 2
    ;;
esac

results=$PWD/build/results
rm -rf "$results"
mkdir -p "$results"
checks=$results/checks.tsv # result, name, reason: of everything that is not a CTest test
: >"$checks"
begin=$SECONDS

record() { printf '%s\t%s\t%s\n' "$1" "$2" "${3:-}" >>"$checks"; }

finish() {
  say "took $(((SECONDS - begin) / 60)) min $(((SECONDS - begin) % 60)) s"
  python3 tests/summary.py "$results"
}

# A build that fails ends the run: what would come after it tests something else.
need() { # NAME REMEDY COMMAND...
  local name=$1 remedy=$2
  shift 2
  if ! "$@"; then
    record failed "$name" "$remedy"
    finish
    exit 1
  fi
}

check() { # NAME COMMAND...
  local name=$1
  shift
  if "$@"; then record passed "$name"; else record failed "$name" "see above"; fi
}

run_ctest() { # PRESET [ctest options]
  local preset=$1
  shift
  ctest --test-dir "build/$preset" -j "${ARGIL_JOBS:-2}" --output-on-failure --no-tests=error \
    --test-output-size-passed 65536 --test-output-size-failed 65536 \
    --output-junit "$results/$preset.xml" "$@" >"build/log/$preset-test.log" 2>&1 || true
  grep -E 'tests (passed|failed)|Total Test time' "build/log/$preset-test.log" || true
  # A runner that did not come to its end leaves no result; that must not read as success.
  [ -s "$results/$preset.xml" ] || record failed "ctest of $preset" "see build/log/$preset-test.log"
}

say "packages"
./cmake/setup.sh build test || {
  echo "0 passed, 1 failed, 0 skipped"
  exit 1
}
# What npm brings; without it the tests that want it are skipped by name.
if command -v npm >/dev/null; then
  mkdir -p build/npm
  cp tests/npm/package.json build/npm/
  npm install --prefix build/npm --no-audit --no-fund --silent >/dev/null ||
    say "npm installed nothing; its tests are skipped"
fi

say "format"
check "Lint.Format" tests/lint.sh --format

say "Release: building everything"
need "Build.Release" "mend what the compiler says" build_preset release all
say "Release: every test"
run_ctest release

if [ "$quick" = yes ]; then
  for name in Determinism.SameHashEverywhere Sanitizer.Thread Sanitizer.AddressAndUndefined Lint.Tidy; do
    record skipped "$name" "--quick was asked for"
  done
else
  say "Debug: building argil, to compare what both builds compute"
  need "Build.Debug" "mend what the compiler says" build_preset dev argil
  check "Determinism.SameHashEverywhere" \
    tests/determinism.sh build/release/cli/argil build/dev/cli/argil

  say "thread sanitizer: core and haptics"
  need "Build.ThreadSanitizer" "mend what the compiler says" build_preset tsan all
  export TSAN_OPTIONS="suppressions=$PWD/tests/tsan.supp"
  run_ctest tsan -E '^Layering'

  say "address and undefined-behaviour sanitizer: core, haptics, the readers and the viewer"
  need "Build.AddressSanitizer" "mend what the compiler says" \
    build_preset asan "test_core test_haptics test_falcon test_falcon_smoke test_io test_viewer"
  export LSAN_OPTIONS="suppressions=$PWD/tests/lsan.supp:print_suppressions=0"
  # Tests in a window take a quarter of an hour there, and the program takes longer to build.
  run_ctest asan -E '^Layering|_NOT_BUILT$|^View|^FirstSculptureGl' -LE 'slow|client'

  say "clang-tidy"
  check "Lint.Tidy" tests/lint.sh --tidy build/release engine/core haptics cli tests/core tests/haptics \
    tests/falcon tests/support/falcon_emulator viewer tests/viewer
fi

finish
