#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Plants each fault that keeps the two commands from installing or building, and checks that what
# they say names the cause and the remedy, and that the next run goes on.
# Usage: tests/setup_bad_input.sh      (seconds; installs and changes nothing on this machine)
# The scripts run on a copy in a path with spaces, with apt-get, dpkg and sudo played by fakes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

work=$(mktemp -d "${TMPDIR:-/tmp}/bad input.XXXXXX")
trap 'rm -rf "$work"' EXIT
chmod 755 "$work"
clone="$work/digital clay" fake="$work/fake"
failures=0

# What the fakes need of this machine; all else, sudo above all, is out of reach.
readonly tools='awk bash cat chmod cut date dd df dirname env find findmnt grep head id mkdir mktemp paste
  realpath rm sed sh sort stat tail tee touch tr true'

fresh_copy() { # of the scripts, and fakes that play a machine where all goes well
  rm -rf "$clone" "$fake"
  mkdir -p "$clone/examples" "$fake/bin"
  cp -R cmake "$clone/"
  cp examples/demo.sh "$clone/examples/"
  printf 'build old-clay|new-clay\nbuild plain-clay # a comment\ntest fired-clay\n' \
    >"$clone/cmake/packages.txt"
  local tool
  for tool in $tools; do ln -s "$(type -P "$tool")" "$fake/bin/$tool"; done
  play id 'if [ "$1" = -u ]; then echo 0; else echo root; fi'
  play df 'printf "Avail\n90000M\n"'
  play apt-cache 'case "$*" in *old-clay) exit 100 ;; esac'
  play dpkg-query 'echo "config-files new-clay"; sed "s/^/installed /" "$FAKE/installed"'
  play dpkg 'touch "$FAKE/configured"'
  play apt-get 'case "$*" in
    *" update"*) step=update ;;
    *--assume-no*) step=plan ;;
    *) step=install ;;
  esac
  echo "$step $*" >>"$FAKE/calls"
  if [ -e "$FAKE/$step" ]; then . "$FAKE/$step"; fi
  case $step in
    plan) printf "Need to get 100 MB/2 GB of archives.\nAfter this operation, 1229 MB of additional disk space will be used.\nAbort.\n"; exit 1 ;;
    install) printf "%s\n" old-clay new-clay plain-clay fired-clay >"$FAKE/installed" ;;
  esac'
  : >"$fake/installed"
  : >"$fake/calls"
}

play() { # PROGRAM BODY
  rm -f "$fake/bin/$1"
  printf '#!/bin/sh\n%s\n' "$2" >"$fake/bin/$1"
  chmod 755 "$fake/bin/$1"
}

apt_fails() { # STEP TEXT [status]: what apt-get says there, and how it ends
  printf "echo '%s' >&2\nexit %s\n" "${2//\'/\'\\\'\'}" "${3:-100}" >"$fake/$1"
}

with_fakes() { env -i PATH="$fake/bin" FAKE="$fake" HOME="$work" "$@"; }
setup() { with_fakes "$clone/cmake/setup.sh" "$@"; }
build() { # build_preset in the copy, as the commands call it
  with_fakes bash -c 'cd "$0" && say_name=demo && . cmake/say.sh && build_preset release argil' "$clone"
}

# expect STATUS PATTERN... -- COMMAND: a pattern is for one line of what it says.
expect() {
  local status=$1 patterns=() got=0 pattern said
  shift
  while [ "$1" != -- ]; do
    patterns+=("$1")
    shift
  done
  shift
  said=$("$@" 2>&1) || got=$?
  [ "$got" -eq "$status" ] || miss "status $got instead of $status" "$said"
  for pattern in "${patterns[@]}"; do
    grep -qE "$pattern" <<<"$said" || miss "nothing like '$pattern'" "$said"
  done
}
miss() { # WHAT SAID
  failures=$((failures + 1))
  printf 'bad input: %s: %s; it said:\n%s\n' "$fault" "$1" "$(sed 's/^/  | /' <<<"$2")"
}
fault() {
  fault=$1
  fresh_copy
}
goes_on() { expect 0 "setup: installing: new-clay plain-clay" -- setup build; }

fault "no group"
expect 1 'name a group .*: build test' -- setup
expect 1 "no group 'clay'.* build test" -- setup clay

fault "all is installed"
printf '%s\n' old-clay plain-clay >"$fake/installed"
expect 0 'all 2 packages \(build\) are installed' -- setup build
[ ! -s "$fake/calls" ] || miss "apt-get was called" "$(cat "$fake/calls")"

fault "a package of two architectures"
printf '%s\n' old-clay plain-clay plain-clay >"$fake/installed"
expect 0 'all 2 packages \(build\) are installed' -- setup build

fault "an alternative"
goes_on
expect 0 'all 2 packages' -- setup build

fault "no apt"
rm "$fake/bin/apt-get"
expect 1 'has no apt' 'remedy: use Debian 12 or 13' -- setup build

fault "a package no source has"
play apt-cache 'exit 100'
expect 1 'has no package old-clay or new-clay, plain-clay' 'remedy: use Debian 12 or 13' -- setup build

fault "neither root nor sudo"
play id 'if [ "$1" = -u ]; then echo 1000; else echo clay; fi'
expect 1 '2 packages are missing, and neither root nor sudo' 'remedy: as root, .*setup.sh build' -- \
  setup build
play sudo 'exit 1'
expect 1 'sudo refuses clay' 'remedy: as root' -- setup build
play sudo 'exec "$@"'
goes_on

fault "no network, and nothing known yet"
apt_fails update "W: Failed to fetch http://x/InRelease  Temporary failure resolving 'x'" 0
play apt-cache 'exit 100'
expect 1 'could not be fetched' 'remedy: check the network' -- setup build
rm "$fake/update"
play apt-cache 'case "$*" in *old-clay) exit 100 ;; esac'
goes_on

fault "no network half way"
apt_fails install 'E: Failed to fetch http://x/clay.deb  Could not connect to x:80 (1.2.3.4).'
expect 1 'could not be fetched' 'what has come is kept' -- setup build
rm "$fake/install"
goes_on

fault "a clock that is wrong"
apt_fails update 'E: Release file for http://x/InRelease is not valid yet (invalid for another 3d).'
expect 1 'not to be trusted' 'remedy: check the date' -- setup build

fault "another program installs"
apt_fails plan 'E: Could not get lock /var/lib/dpkg/lock-frontend. It is held by process 7 (apt)'
expect 1 'another program is installing packages: held by process 7 \(apt\)' 'remedy: wait' -- setup build
rm "$fake/plan"
goes_on

fault "an installation that was interrupted"
interrupted="E: dpkg was interrupted, you must manually run 'dpkg --configure -a' to correct the problem."
printf '[ -e "$FAKE/configured" ] || { echo "%s" >&2; exit 100; }\n' "$interrupted" >"$fake/plan"
expect 0 'dpkg --configure -a ends it' 'installing: new-clay' -- setup build
fault "an installation that was interrupted and cannot end"
apt_fails plan "$interrupted"
play dpkg 'exit 1'
expect 1 'an earlier installation was interrupted' 'remedy: as root, dpkg --configure -a' -- setup build

fault "packages that lack others"
apt_fails plan "E: Unmet dependencies. Try 'apt --fix-broken install' with no packages"
expect 1 'lack what they depend on' 'remedy: as root, apt-get --fix-broken install' -- setup build
rm "$fake/plan"
goes_on

fault "a disk too small for the packages"
play df 'printf "Avail\n1000M\n"'
expect 1 'the missing packages take 1329 MB, and 1000 MB are free' 'remedy: make room' -- setup build
play df 'printf "Avail\n9000M\n"'
goes_on

fault "a disk that fills up while packages are installed"
apt_fails install 'dpkg: error processing archive clay.deb: No space left on device'
expect 1 'the disk is full' 'remedy: make room' -- setup build

fault "a disk too small for the build"
play df 'printf "Avail\n30M\n"'
expect 1 'the build in build/release takes [0-9]+ MB, and 30 MB are free' 'remedy: make room' -- build

fault "a disk that fills up while compiling"
play cmake 'case "$*" in *--build*) echo "[1/9] Building CXX object clay.o"
  echo "fatal error: error writing to clay.s: No space left on device"; exit 1 ;; esac'
expect 1 'built 1 of 9 files' 'the disk is full' 'what is built already is kept' -- build

fault "a disk that is full, so that the log is lost"
play cmake 'case "$*" in *--build*) exit 1 ;; esac'
mkdir -p "$clone/build/release"
play df 'printf "Avail\n0M\n"'
expect 1 'the disk is full: 0 MB are free' -- build

fault "a compiler without memory"
play cmake 'case "$*" in *--build*) echo "fatal error: Killed signal terminated program cc1plus"
  exit 1 ;; esac'
expect 1 'ran out of memory' 'ARGIL_JOBS=1' -- build
play cmake 'case "$*" in *--build*) echo "cc1plus: out of memory allocating 65536 bytes"
  exit 1 ;; esac'
expect 1 'ran out of memory' 'ARGIL_JOBS=1' -- build

# Root can write everywhere but on a read-only file system, so these are played by somebody else: who
# owns the clone, or, where this runs as root, does not.
demo_by_another() {
  local by=()
  [ "$(id -u)" -ne 0 ] || by=(setpriv --reuid 65534 --regid 65534 --clear-groups)
  "${by[@]}" env -i PATH="$fake/bin" FAKE="$fake" "$clone/examples/demo.sh"
}
closed_clone() { # FAULT
  fault "$1"
  rm "$fake/bin/id"
  ln -s "$(type -P id)" "$fake/bin/id"
  mkdir -p "$clone/build/release/cli" "$clone/demo"
}
closed_clone "a clone of one's own that cannot be written"
[ "$(id -u)" -ne 0 ] || chown -R 65534 "$clone"
chmod -R a-w "$clone"
expect 1 'demo: cannot write .*/digital clay: its mode is dr-' 'remedy: chmod -R u\+w' -- \
  demo_by_another
chmod -R u+w "$clone"

if [ "$(id -u)" -eq 0 ]; then
  closed_clone "a build folder of somebody else"
  chmod 777 "$clone" "$clone/build" "$clone/build/release" "$clone/demo"
  expect 1 'demo: cannot write .*/build/release/cli: it belongs to root' 'remedy: sudo chown' -- \
    demo_by_another

  closed_clone "a file that an earlier run left as root"
  chmod -R 777 "$clone"
  touch "$clone/demo/piece.3mf"
  chmod 644 "$clone/demo/piece.3mf"
  expect 1 'demo: cannot write .*/demo/piece.3mf: it belongs to root' 'remedy: sudo chown' -- \
    demo_by_another
else
  echo "not tried, since this is not root: what belongs to somebody else"
fi

[ $failures -eq 0 ] || exit 1
echo "bad input: every fault named with its remedy"
