// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace argil::test {

/// What a thread did since its counters were started: heap calls (malloc, calloc, realloc, free and
/// everything that ends there), mutexes locked, system calls refused by a filter.
struct RealtimeCounts {
  std::int64_t heap = 0;
  std::int64_t locks = 0;
  std::int64_t system_calls = 0;
};

/// Starts counting in this thread. From now on every system call of this thread but those that end
/// it is refused and counted; there is no way back, so call it in a thread made for it. False when
/// the kernel has no seccomp filters.
bool start_counting_this_thread();

/// The counts of this thread so far.
RealtimeCounts counts_of_this_thread();

}  // namespace argil::test
