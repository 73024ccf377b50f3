#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the Debian packages of the named groups of cmake/packages.txt that are missing.
# Usage: cmake/setup.sh GROUP...      (groups: build, test)
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

stop() {
  printf 'setup: %s\n' "$@" >&2
  exit 1
}

[ $# -gt 0 ] || stop "name a group: build or test"

wanted=()
for group in "$@"; do
  mapfile -t of_group < <(awk -v group="$group" '$1 == group { print $2 }' "$here/packages.txt")
  [ ${#of_group[@]} -gt 0 ] || stop "no group '$group' in cmake/packages.txt; use build or test"
  wanted+=("${of_group[@]}")
done

command -v dpkg-query >/dev/null ||
  stop "this is not a Debian system, so nothing can be installed here" \
    "remedy: use Debian 12, or install what cmake/packages.txt lists and run cmake yourself"

missing=()
for package in "${wanted[@]}"; do
  status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  echo "setup: all ${#wanted[@]} packages ($*) are installed"
  exit 0
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null ||
    stop "missing packages, and neither root nor sudo to install them" \
      "remedy: as root, apt-get install ${missing[*]}"
  as_root=(sudo)
fi
echo "setup: installing ${#missing[@]} missing packages: ${missing[*]}"
as_root+=(env DEBIAN_FRONTEND=noninteractive apt-get -q -o Dpkg::Use-Pty=0 -o Acquire::Retries=3)
"${as_root[@]}" update ||
  stop "apt-get update failed" "remedy: check the network and /etc/apt/sources.list, then run again"
"${as_root[@]}" install -y --no-install-recommends "${missing[@]}" ||
  stop "apt-get install failed for: ${missing[*]}" \
    "remedy: Argil needs Debian 12 (bookworm); see the first error above"
