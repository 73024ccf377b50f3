// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <thread>

namespace argil::haptics {

/// Gives a thread of ours real-time priority (SCHED_FIFO). "" or why it has none, and the remedy.
std::string ask_for_priority(std::thread& thread);

}  // namespace argil::haptics
