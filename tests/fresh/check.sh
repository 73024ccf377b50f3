#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What tests/fresh_system.sh does inside: makes the system, runs the README's command, judges it.
# Usage: tests/fresh/check.sh RELEASE MODE WORK CACHE   (by tests/fresh_system.sh, in its namespaces)
set -euo pipefail
release=$1 mode=$2 work=$3 cache=$4
say_name=fresh
# shellcheck source=../../cmake/say.sh
. cmake/say.sh
# shellcheck source=system.sh
. tests/fresh/system.sh

out=$PWD/build/fresh/$release/$mode
log=$out/log
rm -rf "$out"
mkdir -p "$log"

system=$work/system
clone=/root/argil
[ "$mode" != configure ] || clone='/root/digital clay/argil' # a path with spaces

took=()
step=start
begin=$SECONDS
next_step() { # NAME: ends the step before, whose time it notes
  end_step
  step=$1
  say "$release $mode: $step"
}
end_step() {
  [ "$step" = start ] || took+=("$step $(minutes $((SECONDS - begin)))")
  begin=$SECONDS
}
minutes() { awk -v s="$1" 'BEGIN { printf "%.1f min", s / 60 }'; }

# What apt-get says it fetched, of all that was logged, and the indexes that were read before.
downloaded_mb() {
  { echo "Fetched $(cat "$work"/index/* | wc -c) B"; cat "$log"/*.log; } |
    awk '/^Fetched [0-9]/ { sum += $2 * ($3 == "GB" ? 1e3 : $3 == "MB" ? 1 : $3 == "kB" ? 1e-3 : 1e-6) }
      END { printf "%.1f", sum }'
}

finish() {
  local status=$? list
  [ ! -d "$system$clone/build/log" ] || cp -R "$system$clone/build/log" "$out/build_log"
  [ $status -eq 0 ] || complain "$release $mode FAILED at: $step; logs are in ${out#"$PWD/"}"
  end_step
  list=$(printf '%s, ' "${took[@]}")
  say "$release $mode took $(minutes $SECONDS): ${list%, }; downloaded $(downloaded_mb) MB"
}
trap finish EXIT

fail() {
  complain "$@"
  exit 1
}

run() { in_clone "$system" "$clone" "$1"; }                     # COMMAND, shown
run_quietly() { run_logged "$log/$1.log" run "$2"; }            # LOG COMMAND
run_shown() { run "$2" 2>&1 | tee -a "$log/$1.log"; }            # LOG COMMAND

# The README's command as it stands there, with its options and its comment.
readme_command() { # FIRST WORD
  awk -v first="$1" '/^```/ { code = /^```sh/ } code && $1 == first { print; found = 1; exit }
    END { exit !found }' "$work/argil/README.md" || fail "README.md gives no command $1"
}

bare_system() {
  next_step "bare system"
  make_system "$system" || fail "no bare $release could be made"
  enter_system "$system"
  put_clone "$system" "$clone"
}

# A system that was set up by the same script, from the same list and archive, is kept.
set_up_system() {
  local key kept=yes
  key=$(system_key "$work/argil/cmake/setup.sh" "$work/argil/cmake/packages.txt")
  next_step "system"
  put_in_memory "$system" 4000
  if kept_system set-up "$key" "$system"; then
    say "is one that a run before set up; the archive is the same since"
  else
    kept=no
    make_system "$system" || fail "no bare $release could be made"
  fi
  enter_system "$system"
  put_clone "$system" "$clone"
  next_step "packages"
  run_quietly packages './cmake/setup.sh build'
  if [ "$kept" = no ]; then
    in_clone "$system" / 'apt-get -qq autoclean' # old versions in the cache
    keep_system set-up "$key" "$system"
  fi
}

# Files of each library of ours, which together include each library of Debian's.
readonly compiled='engine/core/src/hash.cpp haptics/src/falcon/falcon_link.cpp engine/src/edit/coarsening_criterion.cpp
  engine/src/raycast/ray_scene.cpp mesh/src/repair/hole_fill.cpp mesh/src/repair/collapse_folded.cpp
  io/src/format/png.cpp io/src/vdb/vdb_tree.cpp
  viewer/src/gui/gui.cpp cli/cmd_check.cpp python/src/clay.cpp'

# A file's object is the path of the file but for the folder CMake puts between; it has one of its own
# without unity builds, and needs nothing else to be compiled without precompiled headers.
configure() {
  local source object objects=()
  set_up_system
  next_step "cmake"
  put_ccache "$system"
  # What is asked is whether it compiles there; optimising would double the time.
  run_quietly configure 'cmake --preset release -DARGIL_UNITY=OFF -DARGIL_PCH=OFF \
    -DCMAKE_CXX_FLAGS_RELEASE="-O0 -DNDEBUG" -DCMAKE_CXX_COMPILER_LAUNCHER=ccache'
  next_step "compiling"
  run 'ninja -C build/release -t targets all' | sed -n 's/^\(.*\.o\): .*/\1/p' >"$work/objects"
  for source in $compiled; do
    object=$(awk -v wanted="$source.o" '{ path = $0; sub("CMakeFiles/[^/]*[.]dir/", "", path) }
      path == wanted { print; exit }' "$work/objects")
    [ -n "$object" ] || fail "$source is not compiled any more; name another file in $0"
    objects+=("$object")
  done
  run_quietly compile "ninja -C build/release -j ${ARGIL_JOBS:-2} ${objects[*]}"
}

require_file() { # FILE SIZE: of the clone, at least so many bytes long
  local size
  size=$(stat -c %s "$system$clone/$1" 2>/dev/null) || fail "the README promises $1, and it is not there"
  [ "$size" -ge "$2" ] || fail "$1 has only $size bytes"
  cp "$system$clone/$1" "$out/"
}

judge_demo() {
  local width height
  require_file demo/piece.3mf 10000
  run './build/release/cli/argil check demo/piece.3mf --json' >"$out/check.json" ||
    fail "argil check of demo/piece.3mf failed: $(cat "$out/check.json")"
  grep -qE '"printable": ?true' "$out/check.json" ||
    fail "demo/piece.3mf is not judged printable; see $out/check.json"
  require_file demo/piece.png 10000
  [ "$(head -c 8 "$out/piece.png" | od -An -tx1 | tr -d ' ')" = 89504e470d0a1a0a ] ||
    fail "demo/piece.png is no PNG"
  read -r width height < <(od -An -tu4 --endian=big -j 16 -N 8 "$out/piece.png")
  ((width >= 200 && height >= 200)) || fail "demo/piece.png is only $width x $height pixels"
  require_file demo/charts/force_accuracy.svg 1000
  grep -q '<svg' "$out/force_accuracy.svg" || fail "demo/charts/force_accuracy.svg is no SVG"
}

files_to_build() { sed -n 's/^demo: built 1 of \([0-9]*\) files.*/\1/p' "$log/$1.log"; } # LOG

# Ctrl-C, as a terminal sends it, when the first file is compiled.
interrupt_the_build() { # COMMAND
  local group status=0
  set -m # a group of processes of its own
  run "$1" >"$log/interrupted.log" 2>&1 &
  group=$!
  set +m
  until [ -n "$(files_to_build interrupted)" ]; do
    kill -0 "$group" 2>/dev/null || fail "it ended before it built anything; see $log/interrupted.log"
    sleep 1
  done
  sleep 10
  kill -INT -- "-$group"
  wait "$group" || status=$?
  [ $status -ne 0 ] || fail "Ctrl-C did not stop it"
}

demo() {
  local command
  command=$(readme_command ./examples/demo.sh)
  bare_system
  [ -z "${ARGIL_FRESH_WARM:-}" ] || put_ccache "$system"
  next_step "the README's command until its build is interrupted: $command"
  interrupt_the_build "$command"
  next_step "the same again, to its end"
  run_shown demo "$command"
  (($(files_to_build demo) < $(files_to_build interrupted))) || fail "the second run compiled all again"
  judge_demo
  next_step "once more"
  run_quietly again "$command"
  ! grep -q 'built .* files' "$log/again.log" || fail "the third run compiled again"
  judge_demo
}

tests() {
  local command last
  command=$(readme_command ./tests/run.sh)
  bare_system
  [ -z "${ARGIL_FRESH_WARM:-}" ] || put_ccache "$system"
  next_step "the README's command: $command"
  run_shown tests "$command" || true # its last line tells
  last=$(tail -n 1 "$log/tests.log")
  [[ $last =~ ^[1-9][0-9]*\ passed,\ 0\ failed,\ [0-9]+\ skipped$ ]] ||
    fail "the last line of the tests is: $last"
  say "$release: $last"
  echo "$last" >"$out/last_line"
}

# Made on one system, installed on another, which has never seen a compiler.
package() {
  local target=$work/target
  bare_system
  put_ccache "$system"
  next_step "packages"
  run_quietly packages "./cmake/setup.sh build"
  run_quietly packages_of_package './cmake/setup.sh package'
  next_step "build"
  run_quietly configure 'cmake --preset release -DCMAKE_CXX_COMPILER_LAUNCHER=ccache'
  run_quietly build "cmake --build --preset release -j ${ARGIL_JOBS:-2}"
  next_step "cpack"
  run_quietly cpack 'cd build/release && cpack -G DEB'
  mkdir "$out/debs"
  find "$system$clone/build/release" -maxdepth 2 -name '*.deb' -exec cp -t "$out/debs" {} +
  compgen -G "$out/debs/*.deb" >/dev/null || fail "cpack made no .deb"
  next_step "wheel"
  # As a user does it, in an environment of its own that sees the system's packages; what CMake compiled
  # for the packages, ccache has.
  run_quietly wheel 'venv=$(mktemp -d) && python3 -m venv --system-site-packages "$venv" &&
    CMAKE_ARGS=-DCMAKE_CXX_COMPILER_LAUNCHER=ccache "$venv/bin/pip" install --no-build-isolation . &&
    cd / && "$venv/bin/python" -c "import argil; print(argil.Clay.ball(5).surface())"'
  next_step "install on a second system"
  make_system "$target" || fail "no second $release could be made"
  enter_system "$target"
  put_clone "$target" "$clone"
  cp -R "$out/debs" "$target/root/debs"
  in_clone "$target" "$clone" 'tests/package_check.sh /root/debs' 2>&1 | tee "$log/package_check.log"
}

"$mode"
