// SPDX-License-Identifier: GPL-3.0-or-later
#include "thread_priority.h"

#include <cerrno>
#include <system_error>

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>

namespace argil::haptics {
namespace {

/// Above what desktop sound servers use, below the kernel's own threads.
constexpr int kPriority = 60;

/// Page by page as they are used, so that nothing is read in for it. What comes later is not
/// locked: that would make every later allocation fail at the user's limit.
std::string lock_memory() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return "";  // they map terabytes
#else
  if (::mlockall(MCL_CURRENT | MCL_ONFAULT) == 0) return "";
  return std::string("memory is not locked (") + std::generic_category().message(errno) +
         "): a tick may wait for the disk; allow it with 'ulimit -l unlimited' or a line "
         "'memlock unlimited' in /etc/security/limits.d";
#endif
}

}  // namespace

std::string ask_for_priority(std::thread& thread) {
  sched_param wanted{};
  wanted.sched_priority = kPriority;
  const int refused = pthread_setschedparam(thread.native_handle(), SCHED_FIFO, &wanted);
  static const std::string unlocked = lock_memory();
  if (refused == 0) return unlocked;
  return std::string("no real-time priority (") + std::generic_category().message(refused) +
         "): ticks may be late; allow it with 'ulimit -r 60' or a line 'rtprio 60' in "
         "/etc/security/limits.d" +
         (unlocked.empty() ? "" : "; ") + unlocked;
}

}  // namespace argil::haptics
