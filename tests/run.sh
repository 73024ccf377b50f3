#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Sets up, builds and runs the tests; docs/testing.md says which check is where and why.
# Usage: ./tests/run.sh [--thorough | --bare | --only PATTERN]
#   (nothing)       every promise in Release; sanitizers on core, haptics and the readers
#   --thorough      that, and what takes longer: every sanitizer test, Debug, clang-tidy, soak tests,
#                   builds without precompiled headers and unity and linked as a whole, packages
#   --bare          the README's commands, all tests and the packages on bare Debian 12 and 13
#   --only PATTERN  builds and runs just the Release tests whose name matches the regular expression
# The last line is "N passed, N failed, N skipped" over everything; each skip is named before it
# with its reason. Exit status 1 when something failed.
set -euo pipefail
unset CDPATH
cd "$(dirname "${BASH_SOURCE[0]}")/.."
say_name=tests
# shellcheck source=../cmake/say.sh
. cmake/say.sh

usage() {
  sed -n '4,10s/^# //p' "${BASH_SOURCE[0]}" >&2
  exit 2
}

mode=usual pattern=''
case ${1:-} in
  '') ;;
  --thorough) mode=thorough ;;
  --bare) mode=bare ;;
  --only)
    [ $# -eq 2 ] && [ -n "$2" ] || usage
    mode=only pattern=$2
    ;;
  *) usage ;;
esac
[ "$mode" = only ] || [ $# -le 1 ] || usage

require_writable build || {
  echo "0 passed, 1 failed, 0 skipped"
  exit 1
}
# A second run would remove the results of the first and compile into its folders.
mkdir -p build
exec 8>build/lock
flock -n 8 || {
  complain "another run of the tests is at work in $PWD" "remedy: wait for its end, or clone Argil again"
  echo "0 passed, 1 failed, 0 skipped"
  exit 1
}

results=$PWD/build/results
checks=$results/checks.tsv # result, name, reason: of everything that is not a CTest test
stages=$results/stages.tsv # seconds, name
with_tests=(-DARGIL_BUILD_TESTS=ON -DARGIL_BUILD_BENCH=ON -DARGIL_ASSERTS=ON)
declare -A beside=()       # processes of what runs beside the rest, by name
stage_name='' stage_begin=$SECONDS
rm -rf "$results"
mkdir -p "$results" build/log
: >"$checks"
: >"$stages"
trap stop_beside EXIT

# Beside the rest, as a group of processes, so that it ends as a whole; bare systems leave nothing mounted
# once they are asked to end.
begin_beside() { # NAME COMMAND...
  set -m
  (
    beside=()
    trap stop_beside EXIT # of what it begins itself
    "${@:2}"
  ) 8>&- </dev/null &
  beside[$1]=$!
  set +m
}
end_beside() { # NAME
  wait "${beside[$1]}" || record failed "$1" "it did not come to its end"
  unset "beside[$1]"
}
stop_beside() {
  local group
  for group in "${beside[@]}"; do
    kill -TERM -- "-$group" 2>/dev/null || true
    wait "$group" 2>/dev/null || true
  done
  beside=()
}

stage() { # NAME: ends the one before
  [ -z "$stage_name" ] || printf '%s\t%s\n' $((SECONDS - stage_begin)) "$stage_name" >>"$stages"
  stage_name=${1:-} stage_begin=$SECONDS
  [ -z "$stage_name" ] || say "$stage_name"
}

record() { printf '%s\t%s\t%s\n' "$1" "$2" "${3:-}" >>"$checks"; }

finish() {
  stage
  python3 tests/summary.py "$results"
}

# A build that fails ends the run: what would come after it tests something else.
need() { # NAME COMMAND...
  local name=$1
  shift
  if ! "$@"; then
    record failed "$name" "the lines above name the cause"
    stop_beside # half of their results count as none
    finish
    exit 1
  fi
}

# A check that cannot be made here ends with status 77, its reason in its last two lines.
check() { # NAME COMMAND...
  local name=$1 log=build/log/$1.log status=0
  shift
  "$@" >"$log" 2>&1 8>&- || status=$?
  cat "$log"
  case $status in
    0) record passed "$name" ;;
    77) record skipped "$name" "$(tail -n 2 "$log" | paste -sd ' ')" ;;
    *) record failed "$name" "see $log" ;;
  esac
}

# Tests that follow a clock run one at a time, whatever they are built with. All others run beside them at
# lower priority, since they need a processor but no clock. One more runs than there are processors, because
# some wait for another program.
run_ctest() { # PRESET "LABELS LEFT OUT" [ctest options]
  begin_clock "$@"
  run_others "$@"
  end_beside "clock of $1"
}

begin_clock() { # as run_ctest
  begin_beside "clock of $1" run_one_by_one "$1" -L '^clock$' ${2:+-LE "$2"} "${@:3}"
}

run_others() { # as run_ctest
  run_by_suites "$1" -LE "^clock\$${2:+|$2}" "${@:3}"
}

# Both groups of a preset have tests; where one has none, their labels or their list is wrong.
require_both() { # PRESET
  local name
  for name in "$1" "$1-clock"; do
    grep -q '<testcase' "$results/$name.xml" || record failed "ctest of $name" "it ran no test"
  done
}

run_one_by_one() { # PRESET [ctest options]
  local name=$1-clock
  flock -o build/clock python3 tests/run_tests.py "build/$1" "$results/$name.xml" 1 apart "${@:2}" \
    >"build/log/$name-test.log" 2>&1 8>&- || true
  end_tests "$name"
}

run_by_suites() { # PRESET [ctest options]
  nice -n 10 python3 tests/run_tests.py "build/$1" "$results/$1.xml" "$((${ARGIL_JOBS:-2} + 1))" together "${@:2}" \
    >"build/log/$1-test.log" 2>&1 8>&- || true
  end_tests "$1"
}

end_tests() { # NAME
  grep -E 'tests (passed|failed)|Total Test time' "build/log/$1-test.log" || true
  # A runner that did not come to its end leaves no result; that must not read as success.
  [ -s "$results/$1.xml" ] || record failed "ctest of $1" "see build/log/$1-test.log"
}

install_packages() {
  ./cmake/setup.sh build package test || {
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
}

# The programs whose sources hold the tests that match. What is between slashes in a test's name is not
# in its source; a pattern that needs it matches none, and all are built.
targets_of() { # PATTERN
  local file folder
  while read -r file; do
    if sed -nE 's/^TEST(_F|_P)?\((\w+), *(\w+).*/\2.\3/p' "$file" | grep -qE -- "$1"; then
      folder=${file#tests/}
      echo "test_${folder%%/*}"
    fi
  done < <(find tests -name '*.cpp') | sort -u
  ! grep -qE -- "$1" <<<Package.ServesAnOutsideProject || echo all
  ! grep -qE -- "$1" <<<Bench.RowsRunAndRepeatTheirBits || echo bench_argil
  ! names_of_python | grep -qE -- "$1" || printf '%s\n' argil argil_python
}

# The programs of the tests that match by their whole names, as far as they are built.
programs_of() { # PATTERN
  ctest --test-dir build/release -N --show-only=json-v1 -R "$1" |
    grep -oE '"[^"]*/tests/test_[a-z_]+"' | sed 's|.*/||; s|"||' | sort -u
}

# test_same_bits.py is Python.SameBits.
names_of_python() {
  basename -s .py tests/python/test_*.py | sed -E 's/^test//; s/_(.)/\u\1/g; s/^/Python./'
}

count_tests() { # [ctest options]
  ctest --test-dir build/release -N "$@" | sed -n 's/^Total Tests: //p'
}

build_only() { # TARGETS
  stage "Release: building $1"
  need "Build.Release" build_preset release "$1" "${with_tests[@]}"
}

run_only() {
  local without=${pattern#*/} targets more
  without=${without%/*}
  targets=$(targets_of "$without" | paste -sd ' ')
  build_only "${targets:-all}"
  more=$(programs_of "$pattern" | grep -vxF "${targets// /$'\n'}" || true)
  [ -z "$targets" ] || [ -z "$more" ] || build_only "${more//$'\n'/ }"
  stage "Release: tests that match $pattern"
  local out='^slow$'
  [[ $pattern != *Slow* ]] || out=''
  run_ctest release "$out" -R "$pattern"
  [ -z "$out" ] || [ "$(count_tests -L "$out" -R "$pattern")" -eq 0 ] ||
    say "left out: $(count_tests -L "$out" -R "$pattern") soak tests; name them with Slow"
  grep -q '<testcase' "$results"/release*.xml ||
    record failed "--only $pattern" "no test has such a name; remedy: ctest --test-dir build/release -N"
  finish
}

# Leaves the processor to the tests that run beside it.
build_giving_way() (
  renice -n 10 "$BASHPID" >/dev/null
  build_preset "$@"
)

# Half of these tests wait for a clock: they run beside what comes next.
begin_threads() { # "LABELS LEFT OUT" [ctest options]
  TSAN_OPTIONS="suppressions=$PWD/tests/tsan.supp" begin_beside threads \
    run_ctest tsan "$1" -E '^Layering' "${@:2}"
}

end_threads() {
  stage "thread sanitizer: waiting for its tests"
  end_beside threads
  require_both tsan
}

# Two thirds of what the sanitizers cost the compiler. The address sanitizer finds what the first two
# find; the processors we know take unaligned addresses.
readonly costly_checks=null,object-size,alignment,pointer-overflow

# Tests in a window take a quarter of an hour under it, and the program takes longer to build.
window_suites() {
  sed -nE 's/^TEST(_F|_P)?\((\w+),.*/\2/p' tests/viewer/app/*.cpp | sort -u | paste -sd '|'
}

sanitize_addresses() { # "TARGETS" "LABELS LEFT OUT" [cmake options]
  stage "address and undefined-behaviour sanitizer: building $1"
  need "Build.AddressSanitizer" build_giving_way asan "$1" "${@:3}"
  stage "address and undefined-behaviour sanitizer: tests"
  LSAN_OPTIONS="suppressions=$PWD/tests/lsan.supp:print_suppressions=0" \
    run_ctest asan "^(slow|client${2:+|$2})\$" -E "^Layering|_NOT_BUILT\$|^([A-Za-z]+/)?($(window_suites))[./]"
  require_both asan
}

# Bare systems while this one compiles: most of their time is unpacking.
try_bare_systems() {
  local release status
  for release in bookworm trixie; do
    status=0
    tests/fresh_system.sh $release configure >"build/log/fresh-$release.log" 2>&1 || status=$?
    echo $status >"$results/fresh-$release"
  done
}

end_bare_systems() {
  local release
  stage "bare systems: waiting for their configuration"
  end_beside systems
  for release in bookworm trixie; do
    check "FreshSystem.Configures_$release" fresh_result $release
  done
}

fresh_result() { # RELEASE: what the run beside left
  grep -F ATTENTION "build/log/fresh-$1.log" || true
  tail -n 12 "build/log/fresh-$1.log"
  return "$(cat "$results/fresh-$1" 2>/dev/null || echo 1)"
}

# As many tests on one system as on the other; what cannot run there is skipped by name.
same_tests() {
  local release counts=()
  for release in bookworm trixie; do
    [ -s "build/fresh/$release/tests/last_line" ] || { echo "no run of the tests on $release" && return 1; }
    echo "$release: $(cat "build/fresh/$release/tests/last_line")"
    counts+=("$(awk '{ print $1 + $5 }' "build/fresh/$release/tests/last_line")")
  done
  [ "${counts[0]}" -eq "${counts[1]}" ] || { echo "that is not as many of both" && return 1; }
}

# Sources are formatted as clang-format 14 does it; other versions differ.
check_format() {
  case $(clang-format --version) in
    *' version 14.'*) tests/lint.sh --format ;;
    *) echo "the format is that of clang-format 14, and this is $(clang-format --version)" && return 77 ;;
  esac
}

check_tidy() {
  case $(clang-tidy --version) in
    *' version 14.'*) tests/lint.sh --tidy build/plain engine/core haptics cli evaluation tests/core tests/haptics \
      tests/falcon tests/support/falcon_emulator viewer tests/viewer ;;
    *) echo "the findings are those of clang-tidy 14; here it is $(clang-tidy --version | xargs)" && return 77 ;;
  esac
}

# Damaged files, kills, full disks and interrupts; they are not Google tests, since what they run may die.
torture() { # NAME PRESET OPTIONS...
  check "Torture.$1" python3 tests/torture/torture.py --build "build/$2" "${@:3}"
}

run_usual() { # "TARGETS" "LABELS LEFT OUT" [ctest options for the thread sanitizer's tests]
  begin_beside systems try_bare_systems
  stage "checks of the scripts and of the format"
  check "Lint.Format" check_format
  check "Structure.ArrowsGoDown" python3 tests/structure.py
  check "Setup.NamesCauseAndRemedy" tests/setup_bad_input.sh
  check "RunTests.NamesWhatHangsAndDies" python3 tests/run_tests_faults.py
  stage "Release: building"
  need "Build.Release" build_preset release "$1" "${with_tests[@]}"
  stage "thread sanitizer: building core and haptics"
  need "Build.ThreadSanitizer" build_preset tsan all
  stage "Release: tests"
  begin_clock release "$2"
  begin_threads "${@:2}"
  run_others release "$2"
  end_beside "clock of release"
  require_both release
  check "Determinism.SameHashForAnyThreadCount" tests/determinism.sh build/release/cli/argil
  stage "torture"
  torture Mutants release --mutants 100
  torture Broken release --broken tests/corpus/broken
  torture Kills release --kills 10
  torture FullDisk release --full-disk 10
  torture Events release --events 400
}

run_thorough() {
  export ARGIL_THOROUGH=1
  run_usual "all benchmarks" ''
  sanitize_addresses "test_core test_haptics test_falcon test_falcon_smoke test_readers test_mesh test_io test_viewer argil_python" '' \
    -DARGIL_SANITIZE_WITHOUT='' -DARGIL_SANITIZE_CGAL=ON
  end_threads
  stage "torture at length"
  torture ManyMutants release --mutants 1000 --seed 2
  torture ManyKills release --kills 50 --seed 2
  torture ManyFullDisks release --full-disk 50 --seed 2
  torture Interrupts release --interrupts 3
  need "Build.TortureSanitized" build_preset asan "argil torture_zygote"
  torture MutantsSanitized asan --mutants 1000 --seed 3 --cpu-s 60
  torture EventsSanitized asan --events 10000 --seed 4
  stage "Debug: building argil"
  need "Build.Debug" build_preset dev argil
  stage "Release without precompiled headers and unity: building"
  need "Build.Plain" build_preset plain all
  stage "one definition of each type: linking the program as a whole"
  need "Build.OneDefinition" build_preset odr argil
  stage "the same bits in every build"
  check "Determinism.SameHashEverywhere" tests/determinism.sh \
    build/release/cli/argil build/dev/cli/argil build/plain/cli/argil
  stage "Debian packages"
  check "Package.Lint" tests/package_lint.sh build/release build/package_lint
  stage "clang-tidy"
  check "Lint.Tidy" check_tidy
  end_bare_systems
  finish
}

run_bare() {
  local name release
  # What is tested there is the same however long it takes to compile.
  export ARGIL_FRESH_WARM=${ARGIL_FRESH_WARM-1}
  for name in demo tests package; do
    for release in bookworm trixie; do
      stage "bare $release: $name"
      check "FreshSystem.${name}_$release" tests/fresh_system.sh $release $name
    done
  done
  check "FreshSystem.same_tests" same_tests
  finish
}

# What a run before installed is there while the list of it is as it was.
if [ "$mode" != only ] || [ ! build/release/build.ninja -nt cmake/packages.txt ]; then
  stage "packages"
  install_packages
fi
case $mode in
  only) run_only ;;
  thorough) run_thorough ;;
  bare) run_bare ;;
  usual)
    run_usual all '^slow$' -L threads # the rest of the thread sanitizer's starts none
    # Programs of a thorough run before, if there are any, are old.
    sanitize_addresses "test_core test_haptics test_falcon test_falcon_smoke test_readers" 'io|viewer|python' \
      -DARGIL_SANITIZE_WITHOUT=$costly_checks -DARGIL_SANITIZE_CGAL=OFF
    end_threads
    end_bare_systems
    finish
    ;;
esac
