// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <csignal>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <sys/types.h>

namespace argil::test {

/// How a run of the program ended.
struct Ended {
  int status = -1;  ///< exit status; -1 when a signal ended it
  int signal = 0;   ///< that signal, or 0
  std::string out;  ///< stdout
  std::string err;  ///< stderr

  /// stdout as the one JSON object that --json promises; a test failure when it is not.
  nlohmann::json json() const;
};

struct RunOptions {
  long largest_file_bytes = 0;           ///< > 0: longer writes fail, as on a full disk
  int interrupt_after_ms = -1;           ///< >= 0: SIGINT then
  std::function<bool()> interrupt_when;  ///< asked each millisecond, for at most a minute
  int signal = SIGINT;                   ///< of interrupt_when
};

/// Runs the built `argil` with these arguments and waits for it.
Ended run_argil(const std::vector<std::string>& arguments, const RunOptions& options = {});

}  // namespace argil::test
