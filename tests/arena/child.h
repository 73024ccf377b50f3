// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace argil::arena {

/// How a program ended.
struct ChildEnd {
  int status = -1;       ///< exit status; -1 when a signal ended it
  int signal = 0;        ///< that signal
  bool is_late = false;  ///< it was killed for taking too long
  double wall_s = 0.0;
  double cpu_s = 0.0;  ///< of all its threads
  std::string out;
  std::string err;
};

/// Runs words[0], found on the PATH, in `folder`, and ends it after `patience_s` of CPU time.
/// `memory_mb` of address space at most; 0: as much as it takes.
ChildEnd run_child(const std::filesystem::path& folder, const std::vector<std::string>& words,
                   double patience_s, int memory_mb = 0);

}  // namespace argil::arena
