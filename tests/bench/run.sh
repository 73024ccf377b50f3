#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs the benchmarks, keeps them as tests/bench/results/MACHINE.csv and prints the table that README
# quotes. Usage: tests/bench/run.sh [--readme] [BUILD] [-- bench_argil options]
#   --readme  also puts the table into README.md
#   BUILD     a Release build folder; default build/release, built when need be
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
say_name=bench
# shellcheck source=../../cmake/say.sh
. cmake/say.sh

readme=()
if [ "${1:-}" = --readme ]; then
  readme=(--readme README.md)
  shift
fi
build=build/release
if [ $# -gt 0 ] && [ "$1" != -- ]; then
  build=$1
  shift
fi
[ "${1:-}" != -- ] || shift

if [ "$build" = build/release ]; then
  ./cmake/setup.sh build test
  say "Release build of bench_argil"
  build_preset release bench_argil
fi
out=$(mktemp)
trap 'rm -f "$out"' EXIT
say "running; the median of five repetitions counts"
"$build/tests/bench/bench_argil" --benchmark_repetitions=5 --benchmark_out="$out" \
  --benchmark_out_format=json "$@" >&2
python3 tests/bench/table.py "$out" --results tests/bench/results "${readme[@]}"
