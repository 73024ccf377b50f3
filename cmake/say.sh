# SPDX-License-Identifier: GPL-3.0-or-later
# Sourced by the two commands, examples/demo.sh and tests/run.sh: how they speak and build.
# Needs `say_name`, the word before every line, and runs in the root of the repository.

say() { printf '\n%s: %s\n' "$say_name" "$*"; }

# run_logged LOG COMMAND...: keeps quiet while all is well, shows the end of the log otherwise.
run_logged() {
  local log=$1
  shift
  mkdir -p "$(dirname "$log")"
  if ! "$@" >"$log" 2>&1; then
    grep -E -m 20 'error|Error|FAILED|undefined reference' "$log" >&2 || true
    echo "--- end of $log:" >&2
    tail -n 25 "$log" >&2
    return 1
  fi
}

# build_preset PRESET TARGETS [cmake options]: configures and builds with two jobs, since memory
# rather than the processor is the limit (a CGAL file needs above 1 GB); ccache when there is one.
build_preset() {
  local preset=$1 targets=$2
  shift 2
  if command -v ccache >/dev/null; then
    export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1 # another clone finds what this one compiled
    set -- -DCMAKE_CXX_COMPILER_LAUNCHER=ccache "$@"
  fi
  run_logged "build/log/$preset-configure.log" cmake --preset "$preset" "$@" || return 1
  # shellcheck disable=SC2086  # several targets
  run_logged "build/log/$preset-build.log" \
    cmake --build --preset "$preset" -j "${ARGIL_JOBS:-2}" --target $targets
}
