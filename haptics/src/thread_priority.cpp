// SPDX-License-Identifier: GPL-3.0-or-later
#include "thread_priority.h"

#include <system_error>

#include <pthread.h>
#include <sched.h>

namespace argil::haptics {
namespace {

/// Above what desktop sound servers use, below the kernel's own threads.
constexpr int kPriority = 60;

}  // namespace

std::string ask_for_priority(std::thread& thread) {
  sched_param wanted{};
  wanted.sched_priority = kPriority;
  const int refused = pthread_setschedparam(thread.native_handle(), SCHED_FIFO, &wanted);
  if (refused == 0) return "";
  return std::string("no real-time priority (") + std::generic_category().message(refused) +
         "): ticks may be late; allow it with 'ulimit -r 60' or a line 'rtprio 60' in "
         "/etc/security/limits.d";
}

}  // namespace argil::haptics
