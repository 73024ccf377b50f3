// SPDX-License-Identifier: GPL-3.0-or-later
#include "servo/thread_priority.h"

#include <cassert>
#include <cerrno>
#include <mutex>
#include <system_error>

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>

namespace argil::haptics {
namespace {

/// Above what desktop sound servers use, below the kernel's own threads.
constexpr int kPriority = 60;

/// All that the program has and will have: stacks, windows and clay that come after the first servo
/// too. Page by page as it is used (ONFAULT), so that nothing is read in for it. 0 or the errno.
///
/// Only where no limit bounds it. Near one FUTURE makes every later allocation fail, and even
/// without it what is locked already, a stack or a block, cannot grow. Whoever may go beyond limits
/// (CAP_IPC_LOCK) can lock at a limit of 0; the capability itself is not looked up, since that of a
/// container may be worth nothing.
int lock_memory() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return 0;  // they map terabytes
#else
  static std::mutex asking;
  const std::lock_guard one_at_a_time(asking);  // another limit is set meanwhile
  rlimit usual{};
  if (::getrlimit(RLIMIT_MEMLOCK, &usual) != 0) return errno;
  const bool is_unlimited = usual.rlim_cur == RLIM_INFINITY;
  const rlimit none{0, usual.rlim_max};
  if (!is_unlimited && ::setrlimit(RLIMIT_MEMLOCK, &none) != 0) return errno;
  const int refused = ::mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) == 0 ? 0 : errno;
  if (!is_unlimited) ::setrlimit(RLIMIT_MEMLOCK, &usual);
  return refused;
#endif
}

/// "" when neither was refused.
std::string refusal_text(int priority, int memory) {
  if (priority == 0 && memory == 0) return "";
  std::string text;
  const auto add = [&](int refused, const char* what, const char* harm) {
    if (refused == 0) return;
    text.append(text.empty() ? "" : "; ").append(what).append(" (");
    text.append(std::generic_category().message(refused)).append("): ").append(harm);
  };
  add(priority, "no real-time priority", "ticks may be late");
  add(memory, "memory is not locked", "a tick may wait for the disk");
  return text +
         "; allow both with 'ulimit -r 60' and 'ulimit -l unlimited', or for good with the lines "
         "'@realtime - rtprio 60' and '@realtime - memlock unlimited' in "
         "/etc/security/limits.d/argil.conf, for members of the group realtime who log in again";
}

}  // namespace

std::string ask_for_priority(std::thread& thread) {
  assert(thread.joinable());
  sched_param wanted{};
  wanted.sched_priority = kPriority;
  const int refused = pthread_setschedparam(thread.native_handle(), SCHED_FIFO, &wanted);
  return refusal_text(refused, lock_memory());
}

}  // namespace argil::haptics
