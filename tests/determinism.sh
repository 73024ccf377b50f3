#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# One stroke script replayed by each program given, with 1, 2 and 7 threads and with every
# instruction set (ARGIL_SIMD; one that the machine lacks is another of these): the hash must be the
# one kept here every time, as `argil sculpt` prints it and as `argil info` reads it back. The same on
# every system; whoever means to change what strokes do puts the new one here.
# Usage: tests/determinism.sh ARGIL... (for example the Release and the Debug build)
set -euo pipefail
unset CDPATH
cd "$(dirname "${BASH_SOURCE[0]}")/.."
script=tests/determinism.strokes.jsonl
readonly kept_hash=b4c82877a85f9db0
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

value_of() { python3 -c 'import json, sys; print(json.load(sys.stdin)[sys.argv[1]])' "$1"; }

declare -A seen=()
for program in "$@"; do
  for way in "1 avx512" "2 avx512" "7 avx512" "2 avx2" "2 baseline"; do
    read -r threads simd <<<"$way"
    ARGIL_SIMD=$simd "$program" sculpt --strokes "$script" -o "$scratch/clay.vdb" \
      --threads "$threads" --json --quiet >"$scratch/sculpt.json"
    replayed=$(value_of hash <"$scratch/sculpt.json")
    stored=$("$program" info "$scratch/clay.vdb" --json --quiet | value_of hash)
    [ "$replayed" != "$(value_of start_hash <"$scratch/sculpt.json")" ] || {
      echo "the strokes changed nothing, so nothing was compared"
      exit 1
    }
    echo "$program, $threads threads, $simd: replayed $replayed, stored $stored"
    seen[$replayed]=1
    seen[$stored]=1
  done
done
[ "${!seen[*]}" = $kept_hash ] || {
  echo "the hashes should all be $kept_hash, and are: ${!seen[*]}"
  exit 1
}
