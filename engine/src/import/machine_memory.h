// SPDX-License-Identifier: GPL-3.0-or-later
// Linux: /proc, control groups, the limit of the process.
#pragma once

#include <cstdint>

namespace argil {

/// Bytes this process may still take: what /proc/meminfo calls available, or less when a control
/// group or RLIMIT_DATA limits it. The largest number when none can be read.
std::uint64_t available_bytes();

/// All of the machine's memory, or what a control group or RLIMIT_DATA allows of it.
std::uint64_t machine_bytes();

}  // namespace argil
