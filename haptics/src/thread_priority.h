// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <thread>

namespace argil::haptics {

/// Gives a thread of ours real-time priority (SCHED_FIFO), and keeps what the program has in memory
/// from being swapped out, once and for all threads. "" or what was refused, why, and the remedy.
std::string ask_for_priority(std::thread& thread);

}  // namespace argil::haptics
