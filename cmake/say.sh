# SPDX-License-Identifier: GPL-3.0-or-later
# Sourced by the two commands, examples/demo.sh and tests/run.sh: how they speak and build.
# Needs `say_name`, the word before every line, and runs in the root of the repository.
set -o pipefail

say() { printf '\n%s: %s\n' "$say_name" "$*"; }

complain() { printf '%s\n' "$@" | sed "s/^/$say_name: /" >&2; }

# require_writable FOLDER...: here and in each, as far as it exists. Whoever ran one command as root
# and the next as themselves is told at once, and not by a compiler.
require_writable() {
  local closed existing=() folder
  for folder in "$@"; do
    [ ! -e "$folder" ] || existing+=("$folder")
  done
  closed=$([ -w . ] || echo .)
  [ -n "$closed" ] || [ ${#existing[@]} -eq 0 ] ||
    closed=$(find "${existing[@]}" \( -type d -o -type f ! -user "$(id -u)" \) ! -writable \
      -print -quit)
  [ -n "$closed" ] || return 0
  closed=$(realpath "$closed")
  if findmnt --noheadings --output OPTIONS --target "$closed" | grep -qE '(^|,)ro(,|$)'; then
    complain "cannot write $closed: its file system is read-only" \
      "remedy: clone Argil onto a disk that can be written"
  elif [ "$(stat -c %u "$closed")" -eq "$(id -u)" ]; then
    complain "cannot write $closed: its mode is $(stat -c %A "$closed")" \
      "remedy: chmod -R u+w $(printf '%q' "$PWD")"
  else
    complain "cannot write $closed: it belongs to $(stat -c %U "$closed"), not to $(id -un)" \
      "remedy: sudo chown -R $(id -un) $(printf '%q' "$PWD"), or clone Argil into a folder of your own"
  fi
  return 1
}

free_mb() { df --output=avail -BM "$1" | tail -n 1 | tr -dc '0-9'; }

# require_space MB WHAT: asked before it begins, since a disk that fills up later wastes the minutes.
require_space() {
  local free
  free=$(free_mb .)
  [ "$free" -lt "$1" ] || return 0
  complain "$2 takes $1 MB, and $free MB are free in $PWD" \
    "remedy: make room, or clone Argil onto another disk"
  return 1
}

# run_logged LOG COMMAND...: keeps quiet while all is well, shows the end of the log otherwise.
run_logged() {
  local log=$1
  shift
  mkdir -p "$(dirname "$log")"
  "$@" >"$log" 2>&1 || { show_failure "$log" && return 1; }
}

show_failure() { # LOG
  grep -E -m 20 'error|Error|FAILED|undefined reference' "$1" >&2 || true
  echo "--- end of $1:" >&2
  tail -n 25 "$1" >&2
  explain_failure "$1"
}

# What the machine did to a build, which no change of the source mends. On a full disk the log may
# lack the very line that says so.
explain_failure() { # LOG
  local temporary=${TMPDIR:-/tmp}
  if grep -qE 'No space left on device|[Qq]uota exceeded' "$1" || [ "$(free_mb .)" -lt 16 ]; then
    complain "the disk is full: $(free_mb .) MB are free in $PWD," \
      "$(free_mb "$temporary") MB in $temporary, where the compiler works" \
      "remedy: make room and run again; what is built already is kept"
  elif grep -qiE 'killed signal|out of memory|memory exhausted|cannot allocate memory' "$1"; then
    complain "the compiler ran out of memory" \
      "remedy: ARGIL_JOBS=1 compiles one file at a time; the largest takes above 1 GB"
  fi
}

# Reads what ninja says and tells how far it is: on one line of a terminal, or else a line a minute.
show_progress() {
  local line text='' begin=$SECONDS next=$SECONDS
  while IFS= read -r line; do
    [[ $line =~ ^\[([1-9][0-9]*)/([0-9]+)\]\  ]] || continue
    text="built ${BASH_REMATCH[1]} of ${BASH_REMATCH[2]} files, $(((SECONDS - begin) / 60)) min"
    if [ -t 1 ]; then
      printf '\r%s: %s' "$say_name" "$text"
    elif [ $SECONDS -ge $next ]; then
      printf '%s: %s\n' "$say_name" "$text"
      next=$((SECONDS + 60))
    fi
  done
  if [ -n "$text" ] && [ -t 1 ]; then
    printf '\n'
  elif [ -n "$text" ]; then
    printf '%s: %s\n' "$say_name" "$text"
  fi
}

# build_preset PRESET TARGETS [cmake options]: configures and builds with two jobs, since memory
# rather than the processor is the limit (a CGAL file needs above 1 GB); ccache when there is one.
build_preset() {
  local preset=$1 targets=$2 log=build/log/$1-build.log
  local needed_mb=1500 # below it the first build would stop half way
  [ "$targets" != argil ] || needed_mb=600
  shift 2
  if command -v ccache >/dev/null; then
    export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1 # another clone finds what this one compiled
    # What a precompiled header wants; no source uses __TIME__.
    export CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
    set -- -DCMAKE_CXX_COMPILER_LAUNCHER=ccache "$@"
  fi
  [ -e "build/$preset" ] || require_space "$needed_mb" "the build in build/$preset" || return 1
  run_logged "build/log/$preset-configure.log" cmake --preset "$preset" "$@" || return 1
  # shellcheck disable=SC2086  # several targets
  LC_ALL=C.UTF-8 NINJA_STATUS='[%f/%t] ' \
    cmake --build --preset "$preset" -j "${ARGIL_JOBS:-2}" --target $targets 2>&1 |
    tee "$log" | show_progress || { show_failure "$log" && return 1; }
}
