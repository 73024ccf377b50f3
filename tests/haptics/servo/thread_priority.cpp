// SPDX-License-Identifier: GPL-3.0-or-later
// What a servo's thread is given, each time in a process of its own: a limit that was lowered stays
// so, and so does memory that was locked.
#include "servo/thread_priority.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <future>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace argil::haptics {
namespace {

constexpr std::size_t kLaterBytes = std::size_t{64} << 20U;
constexpr rlim_t kLittle = rlim_t{1} << 20U;
constexpr int kNotAllowed = 77;  ///< a status: the machine does not let the test have what it needs

int status_in_a_child(const std::function<int()>& work) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(work());
  int state = 0;
  ::waitpid(child, &state, 0);
  return WIFEXITED(state) ? WEXITSTATUS(state) : -1;
}

/// Whoever may not have real-time priority, nor lock more than a little.
bool become_ordinary() {
  rlimit memory{};
  if (::getrlimit(RLIMIT_MEMLOCK, &memory) != 0) return false;
  memory.rlim_cur = memory.rlim_max = std::min(memory.rlim_max, kLittle);
  constexpr rlimit kNone{0, 0};
  constexpr uid_t kNobody = 65534;
  return ::setrlimit(RLIMIT_MEMLOCK, &memory) == 0 && ::setrlimit(RLIMIT_RTPRIO, &kNone) == 0 &&
         (::geteuid() != 0 || ::setuid(kNobody) == 0);
}

std::string refusal_of_a_thread() {
  std::promise<void> end;
  std::thread thread([ended = end.get_future()] { ended.wait(); });
  std::string refusal = ask_for_priority(thread);
  end.set_value();
  thread.join();
  return refusal;
}

bool is_locking_refused() {
  return refusal_of_a_thread().find("memory is not locked") != std::string::npos;
}

/// kLaterBytes that no compiler leaves out; false where there are none.
bool map_more() {
  return ::mmap(nullptr, kLaterBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) !=
         MAP_FAILED;
}

/// VmLck of /proc/self/status.
std::size_t locked_bytes() {
  std::ifstream status("/proc/self/status");
  std::size_t kilobytes = 0;
  for (std::string word; status >> word;) {
    if (word == "VmLck:") status >> kilobytes;
  }
  return kilobytes << 10U;
}

TEST(ThreadPriority, LocksWhatTheProgramHasAndWillHaveWhereThatIsUnlimited) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "nothing is locked in a sanitizer's terabytes";
#endif
  const int status = status_in_a_child([] {
    const std::size_t first = locked_bytes();
    if (is_locking_refused()) return kNotAllowed;
    const std::size_t begun = locked_bytes();
    if (begun <= first) return 1;
    // The heap gives back what reading that file took, as it happens to lie.
    constexpr std::size_t kHeapBytes = std::size_t{1} << 20U;
    return map_more() && locked_bytes() + kHeapBytes >= begun + kLaterBytes ? 0 : 2;
  });
  if (status == kNotAllowed) {
    GTEST_SKIP() << "RLIMIT_MEMLOCK is too low to lock memory; docs/lab.md says how to raise it";
  }
  EXPECT_EQ(status, 0);
}

TEST(ThreadPriority, MakesNoLaterAllocationFailWhereMemoryIsLimited) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "nothing is locked in a sanitizer's terabytes";
#endif
  const int status = status_in_a_child([] {
    if (!become_ordinary()) return 1;
    if (!is_locking_refused()) return 2;
    return map_more() && locked_bytes() == 0 ? 0 : 3;
  });
  EXPECT_EQ(status, 0);
}

TEST(ThreadPriority, WhatIsRefusedIsToldWithWholeLinesThatAllowIt) {
  const int status = status_in_a_child([] {
    if (!become_ordinary()) return 1;
    const std::string refusal = refusal_of_a_thread();
    int missed = 2;
    for (const char* part :
         {"no real-time priority", "ulimit -r 60", "ulimit -l unlimited", "@realtime - rtprio 60",
          "@realtime - memlock unlimited", "/etc/security/limits.d"}) {
      if (refusal.find(part) == std::string::npos) return missed;
      ++missed;
    }
    return 0;
  });
  EXPECT_EQ(status, 0) << "1: it has rights that cannot be given up; else the part that is missing";
}

}  // namespace
}  // namespace argil::haptics
