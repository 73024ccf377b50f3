// SPDX-License-Identifier: GPL-3.0-or-later
// A library for LD_PRELOAD that makes the disk fail, and the program die, at chosen calls. Every
// call that changes a file counts, in order; terminal, stderr and the test's own pipe do not.
//   ARGIL_FAULT_KILL_AT N    SIGKILL at the N-th call, half way through when it writes
//   ARGIL_FAULT_PERCENT P    so many of 100 runs of 16 calls fail with ENOSPC; the first 32 do not
//   ARGIL_FAULT_SEED S       which
//   ARGIL_FAULT_PIPE FD      the pipe
//   ARGIL_FAULT_WARNS 1      says so on stdout at each call that is no write, as libraries do
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string_view>

#include <dlfcn.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

namespace {

long setting(const char* name) {
  const char* text = std::getenv(name);
  return text == nullptr ? 0 : std::strtol(text, nullptr, 10);
}

const long g_kill_at = setting("ARGIL_FAULT_KILL_AT");
const long g_percent = setting("ARGIL_FAULT_PERCENT");
const long g_seed = setting("ARGIL_FAULT_SEED");
const long g_pipe = setting("ARGIL_FAULT_PIPE");
const bool g_warns = setting("ARGIL_FAULT_WARNS") != 0;
std::atomic<long> g_calls{0};

std::uint64_t mixed(std::uint64_t a) {
  a = (a ^ (a >> 31)) * 0x9e3779b97f4a7c15ULL;
  a = (a ^ (a >> 27)) * 0xbf58476d1ce4e5b9ULL;
  return a ^ (a >> 33);
}

enum class Fate { go, fail, shorten, die };

Fate next_fate() {
  const long call = ++g_calls;
  if (call == g_kill_at) return Fate::die;
  if (call <= 32) return Fate::go;
  const auto block = static_cast<std::uint64_t>(g_seed * 100003 + call / 16 + 1);
  if (static_cast<long>(mixed(block) % 100) < g_percent) return Fate::fail;
  const auto one = static_cast<std::uint64_t>(g_seed * 7919 + call + 1);
  return g_percent > 0 && mixed(one) % 8 == 0 ? Fate::shorten : Fate::go;
}

[[noreturn]] void die() {
  ::kill(::getpid(), SIGKILL);
  for (;;) ::pause();
}

template <class Function>
Function real(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

/// By each of the ways to stdout.
void warn() {
  constexpr std::string_view kByCall = "a warning by a call\n";
  [[maybe_unused]] const ssize_t written = ::write(STDOUT_FILENO, kByCall.data(), kByCall.size());
  std::printf("a warning by stdio\n");
  std::cout << "a warning by a stream\n";
}

/// Of a call without a length: done, or failed, or the end.
template <class Call>
int all_or_nothing(const Call& call) {
  if (g_warns) warn();
  const Fate fate = next_fate();
  if (fate == Fate::die) die();
  if (fate == Fate::fail) {
    errno = ENOSPC;
    return -1;
  }
  return call();
}

/// Of a call that writes `size` bytes: `call(n)` writes the first n of them.
template <class Call>
ssize_t some_of(std::size_t size, const Call& call) {
  const Fate fate = next_fate();
  if (fate == Fate::go || size < 2) return call(size);
  if (fate == Fate::fail) {
    errno = ENOSPC;
    return -1;
  }
  const ssize_t written = call(size / 2);
  if (fate == Fate::die) die();
  return written;
}

bool is_ours(int handle) { return handle > STDERR_FILENO && handle != g_pipe; }

}  // namespace

extern "C" {

ssize_t write(int handle, const void* data, size_t size) {
  static const auto next = real<ssize_t (*)(int, const void*, size_t)>("write");
  if (!is_ours(handle)) return next(handle, data, size);
  return some_of(size, [&](size_t part) { return next(handle, data, part); });
}

ssize_t writev(int handle, const iovec* parts, int count) {
  static const auto next = real<ssize_t (*)(int, const iovec*, int)>("writev");
  if (!is_ours(handle)) return next(handle, parts, count);
  return some_of(2, [&](size_t) { return next(handle, parts, count); });
}

ssize_t pwrite(int handle, const void* data, size_t size, off_t offset) {
  static const auto next = real<ssize_t (*)(int, const void*, size_t, off_t)>("pwrite");
  return some_of(size, [&](size_t part) { return next(handle, data, part, offset); });
}

ssize_t pwrite64(int handle, const void* data, size_t size, off64_t offset) {
  return pwrite(handle, data, size, offset);
}

int fdatasync(int handle) {
  static const auto next = real<int (*)(int)>("fdatasync");
  return all_or_nothing([&] { return next(handle); });
}

int fsync(int handle) {
  static const auto next = real<int (*)(int)>("fsync");
  return all_or_nothing([&] { return next(handle); });
}

int rename(const char* from, const char* to) noexcept {
  static const auto next = real<int (*)(const char*, const char*)>("rename");
  return all_or_nothing([&] { return next(from, to); });
}

int link(const char* from, const char* to) noexcept {
  static const auto next = real<int (*)(const char*, const char*)>("link");
  return all_or_nothing([&] { return next(from, to); });
}

int unlink(const char* file) noexcept {
  static const auto next = real<int (*)(const char*)>("unlink");
  return all_or_nothing([&] { return next(file); });
}

int truncate(const char* file, off_t size) noexcept {
  static const auto next = real<int (*)(const char*, off_t)>("truncate");
  return all_or_nothing([&] { return next(file, size); });
}

}  // extern "C"
