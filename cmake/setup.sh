#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the Debian packages of the named groups of cmake/packages.txt that are missing.
# Usage: cmake/setup.sh GROUP...      (groups: those of cmake/packages.txt, build and test among them)
# A run that was stopped is made good by the next; what it cannot mend, it names with the remedy.
set -euo pipefail
unset CDPATH
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
lock_wait_s=${ARGIL_APT_WAIT_S:-120} # how long to wait for another program that installs

stop() {
  printf 'setup: %s\n' "$@" >&2
  exit 1
}

groups() { awk '/^[^#]/ { print $1 }' "$here/packages.txt" | sort -u | paste -sd ' '; }
system_name() { sed -n 's/^PRETTY_NAME="\?\([^"]*\)"\?$/\1/p' /etc/os-release; }
first_of() { # TEST NAME|NAME...: the first alternative that passes, or nothing
  local name
  for name in ${2//|/ }; do
    if "$1" "$name"; then
      echo "$name"
      return
    fi
  done
}
# Each once, also of those that are there for two architectures.
declare -A installed=()
read_installed() {
  local status name
  while read -r status name; do
    [ "$status" != installed ] || installed[$name]=1
  done < <(dpkg-query -W -f '${db:Status-Status} ${Package}\n' 2>/dev/null || true)
}
is_installed() { [ -n "${installed[$1]:-}" ]; }
is_known() { apt-cache show --no-all-versions "$1" >/dev/null 2>&1; }

[ $# -gt 0 ] || stop "name a group of cmake/packages.txt: $(groups)"

wanted=() # a package each, or several alternatives with | between them
for group in "$@"; do
  mapfile -t of_group < <(awk -v group="$group" '$1 == group { print $2 }' "$here/packages.txt")
  [ ${#of_group[@]} -gt 0 ] || stop "no group '$group' in cmake/packages.txt; it has: $(groups)"
  wanted+=("${of_group[@]}")
done

command -v apt-get >/dev/null ||
  stop "nothing can be installed on $(system_name), which has no apt" \
    "remedy: use Debian 12 or 13, or install what cmake/packages.txt lists and run cmake yourself"

read_installed
missing=()
for package in "${wanted[@]}"; do
  [ -n "$(first_of is_installed "$package")" ] || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  echo "setup: all ${#wanted[@]} packages ($*) are installed"
  exit 0
fi

as_root=(env DEBIAN_FRONTEND=noninteractive LC_ALL=C)
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null ||
    stop "${#missing[@]} packages are missing, and neither root nor sudo is there to install them" \
      "remedy: as root, $(printf '%q' "$here/setup.sh") $*"
  sudo true || stop "sudo refuses $(id -un), so ${#missing[@]} missing packages cannot be installed" \
    "remedy: as root, $(printf '%q' "$here/setup.sh") $*"
  as_root=(sudo "${as_root[@]}")
fi

log=$(mktemp) || stop "no file can be made in ${TMPDIR:-/tmp}" "remedy: make room there, then run again"
trap 'rm -f "$log"' EXIT

apt_get() { # shows what apt-get says and keeps it in $log, which tells why it failed
  "${as_root[@]}" apt-get -q -o Dpkg::Use-Pty=0 -o Acquire::Retries=3 -o Acquire::http::Timeout=30 \
    -o "DPkg::Lock::Timeout=$lock_wait_s" "$@" 2>&1 | tee "$log"
}
said() { grep -qE "$1" "$log"; }
free_mb() { df --output=avail -BM /usr | tail -n 1 | tr -dc '0-9'; }

# Ends with the cause and the remedy of what apt-get said last.
stop_for_apt() { # WHAT
  if said 'Could not get lock|Unable to (acquire|lock)'; then
    stop "$1: another program is installing packages: $(grep -om1 'held by process [0-9]* ([^)]*)' "$log" || true)" \
      "remedy: wait until it has ended, then run again"
  elif said 'dpkg was interrupted|dpkg --configure -a'; then
    stop "$1: an earlier installation was interrupted, and dpkg cannot end it by itself" \
      "remedy: as root, dpkg --configure -a; answer what it asks, then run again"
  elif said "No space left on device|don't have enough free space" || [ "$(free_mb)" -lt 8 ]; then
    stop "$1: the disk is full" "remedy: make room (as root, apt-get clean makes some), then run again"
  elif said 'NO_PUBKEY|not signed|EXPKEYSIG|Missing key|[Nn]ot live until|not valid (yet|until)|is expired'; then
    stop "$1: a package source is not to be trusted, as the lines above say" \
      "remedy: check the date ($(date +%F)) and the sources' keys in /etc/apt, then run again"
  elif said 'resolving|resolve|[Cc]ould not connect|Unable to connect|unreachable|timed out|Failed to fetch'; then
    stop "$1: packages could not be fetched" \
      "remedy: check the network and the sources in /etc/apt, then run again; what has come is kept"
  elif said 'fix-broken|needs to be reinstalled|held broken packages|unmet dependencies'; then
    stop "$1: packages of this system lack what they depend on" \
      "remedy: as root, apt-get --fix-broken install, and apt-mark showhold for what is held back; then" \
      "run again"
  fi
  stop "$1: see the first error above" \
    "remedy: Argil is tried on Debian 12 and 13, and this is $(system_name)"
}

echo "setup: ${#missing[@]} of ${#wanted[@]} packages ($*) are missing"
apt_get update || stop_for_apt "apt-get update failed"

chosen=()
unknown=()
for package in "${missing[@]}"; do
  name=$(first_of is_known "$package")
  if [ -n "$name" ]; then chosen+=("$name"); else unknown+=("${package//|/ or }"); fi
done
if [ ${#unknown[@]} -gt 0 ]; then
  # Without a network apt-get update only warns.
  ! said 'Failed to fetch' || stop_for_apt "apt-get knows no package ${unknown[0]}"
  stop "$(system_name) has no package $(printf '%s, ' "${unknown[@]}" | sed 's/, $//')" \
    "remedy: use Debian 12 or 13, with the component main in /etc/apt, where this was looked up"
fi

# Asks apt-get what it would do: it says how much it takes, and meets every fault of the system first.
plan() {
  apt_get install --download-only --assume-no --no-install-recommends "${chosen[@]}" >/dev/null ||
    said '^After this operation'
}
needed_mb() {
  awk 'function mb(number, unit) { return number * (unit == "GB" ? 1000 : unit == "MB") }
    /^Need to get/ { sub("/.*", "", $5); sum += mb($4, $5) }
    /^After this operation.*used/ { sum += mb($4, $5) }
    END { print int(sum) }' "$log"
}
if ! plan; then
  if said 'dpkg was interrupted'; then
    echo "setup: an earlier installation was interrupted; dpkg --configure -a ends it"
    "${as_root[@]}" dpkg --configure -a || stop_for_apt "dpkg --configure -a failed"
    plan || stop_for_apt "apt-get install failed"
  else
    cat "$log"
    stop_for_apt "apt-get install failed"
  fi
fi
[ "$(needed_mb)" -lt "$(free_mb)" ] ||
  stop "the missing packages take $(needed_mb) MB, and $(free_mb) MB are free in /usr" \
    "remedy: make room, then run again"

echo "setup: installing: ${chosen[*]}"
apt_get install -y --no-install-recommends "${chosen[@]}" || stop_for_apt "apt-get install failed"
