#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# One stroke script replayed by each program given, with 1, 2 and 4 threads: the hash must be the
# same every time, as `argil sculpt` prints it and as `argil info` reads it back.
# Usage: tests/determinism.sh ARGIL... (for example the Release and the Debug build)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
script=tests/determinism.strokes.jsonl
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

value_of() { python3 -c 'import json, sys; print(json.load(sys.stdin)[sys.argv[1]])' "$1"; }

declare -A seen=()
for program in "$@"; do
  for threads in 1 2 4; do
    "$program" sculpt --strokes "$script" -o "$scratch/clay.vdb" --threads "$threads" \
      --json --quiet >"$scratch/sculpt.json"
    replayed=$(value_of hash <"$scratch/sculpt.json")
    stored=$("$program" info "$scratch/clay.vdb" --json --quiet | value_of hash)
    [ "$replayed" != "$(value_of start_hash <"$scratch/sculpt.json")" ] || {
      echo "the strokes changed nothing, so nothing was compared"
      exit 1
    }
    echo "$program, $threads threads: replayed $replayed, stored $stored"
    seen[$replayed]=1
    seen[$stored]=1
  done
done
[ ${#seen[@]} -eq 1 ] || {
  echo "the hashes differ: ${!seen[*]}"
  exit 1
}
