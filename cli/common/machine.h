// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

namespace argil::cli {

/// "AMD EPYC, 2 cores" as /proc/cpuinfo says it.
std::string machine_name();

double thread_cpu_us();
/// Of all threads of the process together, those that ended included.
double process_cpu_us();

/// Bytes per microsecond (MB/s) at which one core sums floats from a block of this size that was
/// read before: the best of several passes.
double read_bandwidth(std::size_t bytes);

}  // namespace argil::cli
