// SPDX-License-Identifier: GPL-3.0-or-later
// Stands between the program and libc's heap and mutexes, so that a test can count what a thread
// does. Lives beside the tests that use it: the interposed functions are those of this program
// only.
#include "support/realtime_counters.h"

#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdlib>

#include <dlfcn.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <pthread.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <ucontext.h>

namespace {

// Plain thread-locals of this program: touching them needs neither heap nor lock.
thread_local bool counting = false;
thread_local argil::test::RealtimeCounts counts;

void count(std::int64_t& what) noexcept {
  if (counting) ++what;
}

/// The refused call fails as one that the kernel does not have.
void count_refused_call(int, siginfo_t*, void* context) {
  count(counts.system_calls);
  static_cast<ucontext_t*>(context)->uc_mcontext.gregs[REG_RAX] = -ENOSYS;
}

}  // namespace

extern "C" {
void* __libc_malloc(std::size_t size);                      // NOLINT: glibc's own name
void* __libc_calloc(std::size_t number, std::size_t size);  // NOLINT
void* __libc_realloc(void* block, std::size_t size);        // NOLINT
void __libc_free(void* block);                              // NOLINT

void* malloc(std::size_t size) {
  count(counts.heap);
  return __libc_malloc(size);
}
void* calloc(std::size_t number, std::size_t size) {
  count(counts.heap);
  return __libc_calloc(number, size);
}
void* realloc(void* block, std::size_t size) {
  count(counts.heap);
  return __libc_realloc(block, size);
}
void free(void* block) {
  count(counts.heap);
  __libc_free(block);
}
int pthread_mutex_lock(pthread_mutex_t* mutex) {
  using Lock = int (*)(pthread_mutex_t*);
  static const Lock lock = reinterpret_cast<Lock>(dlsym(RTLD_NEXT, "pthread_mutex_lock"));
  count(counts.locks);
  return lock(mutex);
}
}

namespace argil::test {

bool start_counting_this_thread() {
  struct sigaction action {};
  action.sa_sigaction = count_refused_call;
  action.sa_flags = SA_SIGINFO;
  if (sigaction(SIGSYS, &action, nullptr) != 0) return false;

  // What a thread needs to end, and to come back from the signal.
  constexpr unsigned kAllowed[] = {SYS_exit, SYS_madvise, SYS_munmap, SYS_rt_sigprocmask,
                                   SYS_rt_sigreturn};
  constexpr std::size_t kAllowedCount = sizeof kAllowed / sizeof kAllowed[0];
  sock_filter program[kAllowedCount + 3];
  program[0] = BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr));
  for (std::size_t n = 0; n < kAllowedCount; ++n) {
    program[n + 1] = BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, kAllowed[n],
                              static_cast<unsigned char>(kAllowedCount - n), 0);
  }
  program[kAllowedCount + 1] = BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_TRAP);
  program[kAllowedCount + 2] = BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
  sock_fprog filter{static_cast<unsigned short>(kAllowedCount + 3), program};
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return false;
  if (prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) != 0) return false;
  counts = {};
  counting = true;
  return true;
}

RealtimeCounts counts_of_this_thread() { return counts; }

}  // namespace argil::test
