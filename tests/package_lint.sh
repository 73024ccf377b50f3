#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Packs a build with cpack and has Debian's own checks look at what came out.
# Usage: tests/package_lint.sh BUILD_FOLDER SCRATCH_FOLDER
set -euo pipefail
build=$(realpath "$1") scratch=$(realpath -m "$2")
cpack=${CPACK:-cpack}

stop() {
  echo "FAILED: $1"
  exit 1
}

rm -rf "$scratch"
mkdir -p "$scratch"
(cd "$build" && "$cpack" -B "$scratch") >"$scratch/cpack.log" 2>&1 || {
  tail -n 30 "$scratch/cpack.log"
  stop "cpack; see $scratch/cpack.log"
}
packages=("$scratch"/argil_*.deb "$scratch"/libargil-dev_*.deb "$scratch"/python3-argil_*.deb)
for package in "${packages[@]}"; do
  [ -f "$package" ] || stop "cpack made no ${package##*/}"
  dpkg-deb --field "$package" Depends | tr -d '\n' | sed "s|^|${package##*/} depends on: |; s|$|\n|"
done

lintian --allow-root --fail-on error,warning --info "${packages[@]}" || stop "lintian has complaints"

dpkg-deb --extract "${packages[0]}" "$scratch/root"
desktop-file-validate "$scratch/root/usr/share/applications/argil.desktop" ||
  stop "the desktop entry is not as the standard wants it"
said=$(find "$scratch/root/usr/share/man" -name '*.gz' \
  -exec env MANWIDTH=80 man --warnings -E UTF-8 -l {} \; 2>&1 >/dev/null)
[ -z "$said" ] || stop "man warns: $said"
echo "package: lintian, desktop-file-validate and man have no complaint"
