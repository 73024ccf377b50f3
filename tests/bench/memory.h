// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fstream>
#include <string>

#include <malloc.h>

namespace argil::bench {

/// A line of /proc/self/status, such as VmHWM; 0 where there is none.
inline double status_mb(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double kb = 0.0;
    if (word == name + ":" && status >> kb) return kb / 1024.0;
  }
  return 0.0;
}

/// What the process has, and its peak from now on: free memory is given back first.
inline double begin_peak() {
  ::malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << 5;
  return status_mb("VmRSS");
}

}  // namespace argil::bench
