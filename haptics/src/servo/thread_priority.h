// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <thread>

namespace argil::haptics {

/// Gives a thread of ours real-time priority (SCHED_FIFO) and locks all memory of the program,
/// present and future, for all its threads, so that none of it is swapped out. Memory is locked
/// only where no limit bounds it: near a limit later allocations would fail (ThreadPriority.*).
///
/// Returns  "", or what was refused, why, and the remedy: `ulimit`, and whole lines for
/// limits.conf.
std::string ask_for_priority(std::thread& thread);

}  // namespace argil::haptics
