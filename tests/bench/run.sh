#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs the benchmarks, keeps them as tests/bench/results/MACHINE.csv and prints the table that README
# quotes. Usage: tests/bench/run.sh [--readme | --check] [BUILD] [-- bench_argil options]
#   --readme  also puts the table into README.md
#   --check   runs every row twice, briefly, and keeps nothing: do they work and repeat their bits?
#             On smaller inputs, one iteration each, unless ARGIL_THOROUGH is set
#   BUILD     a Release build folder; default build/release, built when need be
set -euo pipefail
unset CDPATH
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
say_name=bench
# shellcheck source=../../cmake/say.sh
. cmake/say.sh

results=tests/bench/results
repeat=(--benchmark_repetitions=5)
readme=()
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
case ${1:-} in
  --readme)
    readme=(--readme README.md)
    shift
    ;;
  --check)
    results=$scratch/results
    repeat=(--benchmark_repetitions=2 --benchmark_min_time=0.001)
    if [ -z "${ARGIL_THOROUGH:-}" ]; then
      export ARGIL_BENCH_BRIEF=1
      repeat=(--benchmark_repetitions=2 --benchmark_min_time=0.0000001)
    fi
    shift
    ;;
esac
build=build/release
if [ $# -gt 0 ] && [ "$1" != -- ]; then
  build=$1
  shift
fi
[ "${1:-}" != -- ] || shift

if [ "$build" = build/release ]; then
  ./cmake/setup.sh build test
  say "Release build of bench_argil"
  build_preset release bench_argil -DARGIL_BUILD_TESTS=ON -DARGIL_BUILD_BENCH=ON
fi
say "running; the median of the repetitions counts"
"$build/tests/bench/bench_argil" "${repeat[@]}" --benchmark_out="$scratch/report.json" \
  --benchmark_out_format=json "$@" >&2
python3 tests/bench/table.py "$scratch/report.json" --results "$results" "${readme[@]}"
