// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <thread>

namespace argil::haptics {

/// Gives a thread of ours real-time priority (SCHED_FIFO), and keeps what the program has in memory
/// or will have from being swapped out, for all threads, where no limit bounds that; else nothing
/// is locked, and no later allocation fails for it (ThreadPriority.*). "" or what was refused, why,
/// and the remedy: `ulimit`, and whole lines for limits.conf.
std::string ask_for_priority(std::thread& thread);

}  // namespace argil::haptics
