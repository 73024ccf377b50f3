// SPDX-License-Identifier: GPL-3.0-or-later
#include "arena/child.h"

#include <chrono>
#include <cmath>
#include <csignal>
#include <thread>

#include <sys/resource.h>
#include <sys/wait.h>

#include "support/scratch.h"
#include "support/spawn.h"

namespace argil::arena {
namespace {

/// Runs the words after it in a folder, outputs to files there.
constexpr const char* kShell =
    "cd \"$0\" && ulimit -t \"$1\" && { [ \"$2\" = 0 ] || ulimit -v \"$2\"; } && shift 2 && "
    "exec \"$@\" >out 2>err </dev/null";

/// What waits, and does not compute, has so many times its patience.
constexpr double kMostWaits = 10.0;

double seconds_of(const timeval& t) {
  return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

}  // namespace

ChildEnd run_child(const std::filesystem::path& folder, const std::vector<std::string>& words,
                   double patience_s, int memory_mb) {
  using Clock = std::chrono::steady_clock;
  std::vector<std::string> arguments{"-c", kShell, folder.string(),
                                     std::to_string(std::lround(patience_s)),
                                     std::to_string(1024LL * memory_mb)};
  arguments.insert(arguments.end(), words.begin(), words.end());
  const auto begin = Clock::now();
  const auto waited = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  const pid_t child = test::spawn("/bin/sh", arguments);
  ChildEnd end;
  int state = 0;
  rusage used{};
  while (::wait4(child, &state, WNOHANG, &used) == 0) {
    if (waited() > kMostWaits * patience_s) {
      end.is_late = true;
      ::kill(child, SIGKILL);
      ::wait4(child, &state, 0, &used);
      break;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  end.wall_s = waited();
  end.cpu_s = seconds_of(used.ru_utime) + seconds_of(used.ru_stime);
  if (WIFEXITED(state)) end.status = WEXITSTATUS(state);
  if (WIFSIGNALED(state)) end.signal = WTERMSIG(state);
  // At its limit of CPU time the system kills it.
  if (end.signal != 0 && end.cpu_s > patience_s - 1.0) end.is_late = true;
  end.out = test::content_of(folder / "out");
  end.err = test::content_of(folder / "err");
  return end;
}

}  // namespace argil::arena
