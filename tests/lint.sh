#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Checks how the code is written: clang-format on every source, clang-tidy on those asked for.
# Usage: tests/lint.sh [--format | --tidy BUILD [FOLDER|FILE...]]
#   --format              only the format of all sources
#   --tidy BUILD PLACE... clang-tidy with the compile commands of the build folder, on the places
#                         (default: what differs from origin/main, or everything without it); the
#                         folder is that of a preset without unity builds, as build/plain
# Prints a line for each place that fails; exit status 1 when there was one.
set -euo pipefail
unset CDPATH
cd "$(dirname "${BASH_SOURCE[0]}")/.."

check_format() {
  local bad
  bad=$(git ls-files -co --exclude-standard '*.h' '*.cpp' |
    xargs clang-format --dry-run -Werror 2>&1 | sed -n 's/: error: .*//p' | sort -u || true)
  if [ -n "$bad" ]; then
    echo "$bad" | awk -F: '{ n[$1]++ } END { for (f in n) print "lint: " f ": " n[f] " places" }'
    echo "lint: remedy: clang-format -i on these files"
    return 1
  fi
  echo "lint: format as .clang-format"
}

changed_sources() {
  local base
  base=$(git merge-base HEAD origin/main 2>/dev/null) || { echo .; return; }
  git diff --name-only --diff-filter=d "$base" -- '*.cpp'
}

check_tidy() { # BUILD PLACE...
  local build=$1
  shift
  [ -f "$build/compile_commands.json" ] || {
    echo "lint: no $build/compile_commands.json; remedy: cmake --preset ${build##*/}" >&2
    return 1
  }
  local places=("$@") files=() file unknown=()
  [ ${#places[@]} -gt 0 ] || mapfile -t places < <(changed_sources)
  [ ${#places[@]} -gt 0 ] || { echo "lint: no source changed"; return 0; }
  while read -r file; do
    if grep -qF "/$file\"" "$build/compile_commands.json"; then files+=("$file"); else unknown+=("$file"); fi
  done < <(git ls-files -co --exclude-standard -- "${places[@]}" | grep '\.cpp$' || true)
  [ ${#unknown[@]} -eq 0 ] || echo "lint: not looked at, since $build does not compile them: ${unknown[*]}"
  [ ${#files[@]} -gt 0 ] || {
    echo "lint: nothing was looked at in ${places[*]}; remedy: cmake --preset plain" >&2
    return 1
  }
  echo "lint: clang-tidy on ${#files[@]} files"
  python3 tests/tidy.py "$build" "${files[@]}"
}

case ${1:-} in
  --format) check_format ;;
  --tidy)
    shift
    [ $# -gt 0 ] || { echo "lint: name a build folder" >&2; exit 2; }
    check_tidy "$@"
    ;;
  '')
    check_format
    check_tidy build/plain
    ;;
  *)
    sed -n '3,9s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2
    exit 2
    ;;
esac
