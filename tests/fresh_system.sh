#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Does what the README says on a Debian made for it: essential packages, apt and a clone of HEAD.
# Usage: tests/fresh_system.sh [bookworm|trixie] [configure|demo|tests|package]
#   configure  (default) installs, configures and compiles files of each library, in a path with spaces
#   demo       the README's first command; then its piece, picture and chart are judged
#   tests      the README's second command; its last line is judged
#   package    makes the Debian packages and installs them on a second such system
# Logs and what was made are left in build/fresh/RELEASE/MODE. Exit status 1 when something promised
# is not there, 77 where no such system can be made.
#   ARGIL_DEBIAN_MIRROR  where packages come from by http (default: this system's, or deb.debian.org)
#   ARGIL_FRESH_CACHE    keeps packages and systems between runs (default: ~/.cache/argil-fresh)
#   ARGIL_FRESH_WARM=1   demo and tests find what ccache kept of a run before; else they compile all
set -euo pipefail
unset CDPATH
cd "$(dirname "${BASH_SOURCE[0]}")/.."
say_name=fresh
# shellcheck source=../cmake/say.sh
. cmake/say.sh

unable() { # CAUSE REMEDY
  complain "cannot run here: $1" "remedy: $2"
  exit 77
}

release=${1:-bookworm} mode=${2:-configure}
case $release/$mode in
  bookworm/configure | trixie/configure) needed_mb=5000 ;;
  bookworm/demo | trixie/demo | bookworm/package | trixie/package) needed_mb=8000 ;;
  bookworm/tests | trixie/tests) needed_mb=20000 ;;
  *)
    sed -n '3,14s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2
    exit 2
    ;;
esac

namespaces=(unshare --mount --pid --fork --kill-child --mount-proc)
as_owner=() # removes what a system's users own, which are not ours without root
if [ "$(id -u)" -ne 0 ]; then
  as_owner=(unshare --user --map-auto --map-root-user)
  namespaces+=(--user --map-auto --map-root-user)
fi
require_tools() {
  [ -z "${ARGIL_FRESH_INSIDE:-}" ] ||
    unable "this is such a system already" "run it on the machine that made this one"
  command -v mmdebstrap >/dev/null || unable "no mmdebstrap" "as root, apt-get install mmdebstrap"
  [ -e .git ] || unable "this is not a git clone" "git clone Argil, and run it there"
  "${namespaces[@]}" true 2>/dev/null ||
    unable "neither root nor namespaces for users (unshare --map-auto)" \
      "run as root, or as root, apt-get install uidmap, with this user in /etc/subuid and /etc/subgid"
}

# The address of an archive as apt on this system knows it, if it is a Debian.
archive_here() { # LABEL
  # shellcheck disable=SC2016  # apt's own variable
  apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' "Label: $1" |
    sed -n '/^http:/{s,/$,,p;q}'
}

fetch_index() { # ARCHIVE SUITE: its signed list of contents, to $work/index/SUITE
  /usr/lib/apt/apt-helper -o Acquire::Retries=2 -o Acquire::http::Timeout=20 \
    download-file "$1/dists/$2/InRelease" "$work/index/$2" >"$work/fetch.log" 2>&1
}

# Writes $work/sources.list as a usual installation has it: the release and, as far as the mirror has
# them, its updates and its security updates.
find_sources() {
  local mirror=${ARGIL_DEBIAN_MIRROR:-$(archive_here Debian)} security archive suite
  security=${ARGIL_DEBIAN_MIRROR:+$mirror-security}
  security=${security:-$(archive_here Debian-Security)}
  mirror=${mirror:-http://deb.debian.org/debian}
  [[ $mirror != https:* ]] ||
    unable "a bare system has no certificates, which $mirror asks for" "name an http mirror"
  mkdir "$work/index"
  fetch_index "$mirror" "$release" ||
    unable "$mirror does not give $release: $(grep -m 1 '^[EW]:' "$work/fetch.log")" \
      "check the network, or name another mirror with ARGIL_DEBIAN_MIRROR"
  echo "deb $mirror $release main" >"$work/sources.list"
  while read -r archive suite; do
    if fetch_index "$archive" "$suite"; then
      echo "deb $archive $suite main" >>"$work/sources.list"
    else
      say "goes without $suite, which $archive does not give"
    fi
  done <<EOF
$mirror $release-updates
${security:-http://deb.debian.org/debian-security} $release-security
EOF
}

# A clean clone, as a user gets it. The clone may belong to somebody else where this runs as root.
clone_head() {
  local changed
  printf '[safe]\n\tdirectory = *\n' >"$work/gitconfig"
  export GIT_CONFIG_GLOBAL=$work/gitconfig
  changed=$(git status --porcelain | wc -l)
  [ "$changed" -eq 0 ] || say "ATTENTION: $changed changed or new files are NOT in what is tried, commit" \
    "$(git rev-parse --short HEAD)"
  git clone --quiet --no-hardlinks "$PWD" "$work/argil"
  local shared=${ARGIL_SHARED:-../shared}
  [ ! -d "$shared" ] || cp -RL "$shared" "$work/shared"
}

# The first process of the namespaces dies with unshare; once it is gone, all others are: nothing is
# mounted there any more, and nothing writes into what is removed here.
# shellcheck disable=SC2317  # called by the trap
clean_up() {
  local first
  trap '' INT TERM HUP
  if [ -n "${inside:-}" ] && kill -0 "$inside" 2>/dev/null; then
    first=$(cat "/proc/$inside/task/$inside/children" 2>/dev/null || true)
    kill -KILL "$inside" 2>/dev/null || true
    wait "$inside" 2>/dev/null || true
    while [ -n "$first" ] && kill -0 "${first% }" 2>/dev/null; do sleep 0.1; done
  fi
  remove_work "$work"
}
remove_work() { # FOLDER
  "${as_owner[@]}" rm -rf --one-file-system "$1"
  rm -f "$cache/work"
}

require_tools
require_writable build || exit 1
cache=${ARGIL_FRESH_CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/argil-fresh}/$release
mkdir -p "$cache/archives/partial" "$cache/ccache" ||
  unable "no folder can be made in $cache" "name another with ARGIL_FRESH_CACHE"
exec 9>"$cache/lock"
flock -n 9 || {
  say "waits for another run on $release to end"
  flock 9
}
# What a run left that was killed so hard that it could not remove it.
[ ! -s "$cache/work" ] || remove_work "$(cat "$cache/work")"

work=$(mktemp -d "${TMPDIR:-/var/tmp}/argil-fresh-$release.XXXXXX")
echo "$work" >"$cache/work"
trap clean_up EXIT
trap 'exit 129' HUP
trap 'exit 130' INT
trap 'exit 143' TERM
chmod 755 "$work"
[ "$(free_mb "$work")" -ge "$needed_mb" ] ||
  unable "$release $mode takes $needed_mb MB, and $(free_mb "$work") MB are free in $work" \
    "make room, or name another folder with TMPDIR"
find_sources
clone_head

# In a session of its own, so that Ctrl-C reaches this script alone, which then ends it as a whole;
# it ends as well when this script is killed without a word.
env --default-signal=INT,QUIT setsid setpriv --pdeathsig KILL "${namespaces[@]}" \
  tests/fresh/check.sh "$release" "$mode" "$work" "$cache" </dev/null 9>&- &
inside=$!
status=0
wait "$inside" || status=$?
exit "$status"
