#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the three Debian packages on this system with apt and uses them as somebody would who has
# nothing else of Argil: a mesh through import, export, check and the window, the examples of Python, and a
# program built against libargil-dev. Then removes them. For a bare system that is thrown away after (tests/fresh_system.sh).
# Usage, as root: tests/package_check.sh DEB_FOLDER
# A line for each step; exit status 1 after the first that failed, which is named.
set -euo pipefail
unset CDPATH
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

stop() {
  printf 'package: %s\n' "$@" >&2
  exit 1
}

[ $# -eq 1 ] || stop "name the folder that cpack left the packages in"
[ "$(id -u)" -eq 0 ] || stop "installing packages needs root" "remedy: run it as root on a bare system"
command -v apt-get >/dev/null || stop "this is not a Debian system: there is no apt-get"

the_package() { # NAME
  local found=("$folder/$1"_*_"$(dpkg --print-architecture)".deb)
  if [ ${#found[@]} -ne 1 ] || [ ! -f "${found[0]}" ]; then
    stop "$folder has not exactly one $1_*.deb for this machine" \
      "remedy: remove old packages there and run cpack again"
  fi
  echo "${found[0]}"
}
folder=$(realpath "$1")
program=$(the_package argil)
library=$(the_package libargil-dev)
python=$(the_package python3-argil)

user=nobody # is there on any Debian; a bare Debian 13 has no useradd
logs=$(mktemp -d)
home=$(mktemp -d)
trap 'rm -rf "$logs" "$home"' EXIT
cp -r "$here/consumer" "$home/"
chown -R "$user:" "$home"

step() { # NAME COMMAND...
  local name=$1 begin=$SECONDS
  shift
  if ! "$@" >"$logs/log" 2>&1; then
    tail -n 30 "$logs/log" >&2
    stop "FAILED: $name"
  fi
  echo "package: $name ($((SECONDS - begin)) s)"
}

# Only what the packages depend on, so that a missing dependency shows.
install() {
  DEBIAN_FRONTEND=noninteractive apt-get -q -o Dpkg::Use-Pty=0 -o Acquire::Retries=3 \
    install -y --no-install-recommends "$@"
}

# As an ordinary user, in an own folder, in a fresh environment.
as_user() { # SHELL_COMMAND
  runuser -u "$user" -- env -i HOME="$home" USER="$user" PATH=/usr/local/bin:/usr/bin:/bin \
    LANG=C.UTF-8 bash -euo pipefail -c "cd; $1"
}

has_all_files() {
  local file listed
  listed=$(dpkg-query --listfiles argil)
  for file in /usr/share/applications/argil.desktop /usr/share/mime/packages/argil.xml \
    /usr/share/icons/hicolor/scalable/apps/argil.svg /usr/lib/udev/rules.d/70-argil-falcon.rules \
    /usr/share/bash-completion/completions/argil /usr/share/zsh/vendor-completions/_argil \
    /usr/share/blender/scripts/addons/argil_blender/__init__.py /usr/share/argil/printers/resin.json \
    /usr/share/doc/argil/copyright /usr/share/doc/argil/changelog.Debian.gz \
    /usr/share/doc/argil/examples/owl.strokes.jsonl /usr/share/doc/argil/examples/pebble.ply; do
    grep -qxF "$file" <<<"$listed" || { echo "$file is missing"; return 1; }
  done
  as_user 'mkdir -p pages && argil man -o pages --quiet'
  for file in "$home"/pages/*; do
    file=/usr/share/man/man1/$(basename "$file").gz
    grep -qxF "$file" <<<"$listed" || { echo "$file is missing"; return 1; }
  done
}

sees_a_window() {
  as_user 'xvfb-run -a -s "-screen 0 1280x800x24" argil view clay.vdb --width 800 --height 600 \
    --frames 10 --screenshot window.png --check-gl --json'
  # A picture of a window with nothing in it is smaller.
  [ "$(stat -c %s "$home/window.png")" -gt 20000 ] ||
    { echo "window.png holds $(stat -c %s "$home/window.png") bytes"; return 1; }
}

# Each by itself, in an empty folder; all draw with what python3-argil suggests.
runs_examples() {
  local example
  for example in /usr/share/doc/argil/examples/python/*.py; do
    as_user "mkdir -p pictures && python3 $example -o pictures"
  done
  [ "$(find "$home/pictures" -name '*.png' -size +4k | wc -l)" -ge 8 ] ||
    { ls -l "$home/pictures"; return 1; }
}

leaves_nothing() {
  apt-get -q -y purge argil libargil-dev python3-argil
  [ -z "$(find /usr -name '*argil*' -not -path '/usr/local/*')" ]
}

step "apt-get update" apt-get -q update
step "apt installs $(basename "$program")" install "$program"
step "the package holds all it promises" has_all_files
step "argil import pebble.ply" as_user \
  'argil import /usr/share/doc/argil/examples/pebble.ply --size-mm 60 --voxel-mm 0.5 -o clay.vdb'
step "argil export clay.3mf" as_user 'argil export clay.vdb -o clay.3mf'
step "argil check clay.3mf" as_user \
  'argil check clay.3mf --printer /usr/share/argil/printers/filament.json'
step "apt installs a display" install xvfb xauth libgl1 libgl1-mesa-dri
step "argil view draws 10 frames" sees_a_window
step "apt installs $(basename "$python")" install "$python"
step "python3 sculpts and exports" as_user 'python3 -W error -c "
import argil
clay = argil.Clay.from_mesh(argil.Mesh.load(\"/usr/share/doc/argil/examples/pebble.ply\"))
clay.offset(0.5)
assert clay.export(\"pebble.3mf\")[\"printable\"]"'
step "apt installs what the examples draw with" install python3-matplotlib python3-pil
step "python3 runs the examples" runs_examples
step "apt installs $(basename "$library")" install "$library"
step "apt installs a compiler" install g++ cmake ninja-build pkg-config
step "a program builds with find_package(Argil) and with pkg-config" as_user \
  'consumer/build.sh scratch'
step "apt removes all and leaves nothing" leaves_nothing
echo "package: all steps passed"
