// SPDX-License-Identifier: GPL-3.0-or-later
// A file is replaced as a whole or not at all: written beside its target, synced, renamed
// over it (which POSIX makes atomic), and the folder synced. A signal, or a second one,
// leaves no piece behind.
#include "argil/io/safe_file.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "argil/core/end_slot.h"
#include "argil/core/no_throw.h"

#include "file/file_bytes.h"
#include "file/temporary_name.h"

namespace argil::io {
namespace {

namespace fs = std::filesystem;

std::atomic<bool> g_interrupted{false};
std::atomic<bool> g_told_to_end{false};  // by a person or a service manager
static_assert(std::atomic<bool>::is_always_lock_free);

// Of end_within; set before g_has_deadline is.
struct Deadline {
  timer_t timer{};
  itimerspec from_now{};
  int descriptor = -1;
  std::array<char, 1000> words{};
  std::size_t length = 0;
};
Deadline g_deadline;
std::atomic<bool> g_has_deadline{false};
std::atomic<int> g_first_signal{0};

void on_signal(int signal_number) {
  g_interrupted = true;
  // A closing terminal hangs up twice, a closed pipe tells at each write: neither is impatience.
  if (signal_number == SIGHUP || signal_number == SIGPIPE) return;
  if (g_told_to_end.exchange(true)) end_forced(signal_number);
  g_first_signal = signal_number;
  if (g_has_deadline) ::timer_settime(g_deadline.timer, 0, &g_deadline.from_now, nullptr);
}

void on_deadline(int) {
  // Nobody can be told where that fails.
  if (::write(g_deadline.descriptor, g_deadline.words.data(), g_deadline.length) < 0) errno = 0;
  end_forced(g_first_signal);
}

/// A temporary file beside its target: removed when this goes out of scope, or by a forced end.
class Temporary {
 public:
  explicit Temporary(fs::path path) : path_(std::move(path)), end_slot_(path_) {}
  ~Temporary() {
    if (!renamed_) ::unlink(path_.c_str());
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  const fs::path& path() const noexcept { return path_; }
  bool rename_over(const fs::path& target) noexcept {
    renamed_ = ::rename(path_.c_str(), target.c_str()) == 0;
    return renamed_;
  }

 private:
  fs::path path_;
  EndSlot end_slot_;
  bool renamed_ = false;
};

/// Creates the empty file with the mode of the file it will replace. 0 or the error.
int create_like(const fs::path& path, const fs::path& target) {
  constexpr mode_t kAsUmaskAllows = 0666;
  if (is_end_forced()) return EINTR;  // nobody would take it back any more
  // O_EXCL: never into what another program, or a link, has put under that name.
  const int handle = ::open(path.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, kAsUmaskAllows);
  if (handle < 0) return errno;
  struct stat info {};
  // Failing to copy the mode is no reason not to save: the file then has the usual mode.
  if (::stat(target.c_str(), &info) == 0) static_cast<void>(::fchmod(handle, info.st_mode & 07777));
  ::close(handle);
  return 0;
}

/// fsync of a file or folder. 0 or the error.
int sync_path(const fs::path& path, int flags) {
  const int handle = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | flags);
  if (handle < 0) return errno;
  const int failed_with = ::fsync(handle) == 0 ? 0 : errno;
  ::close(handle);
  return failed_with;
}

/// The file to replace: absolute, with a symbolic link followed, so that the link stays a link.
Result<fs::path> resolve_target(const fs::path& file) {
  std::error_code error;
  fs::path target = fs::weakly_canonical(fs::absolute(file, error), error);
  if (error) return disk_error("write", file, error.value());
  const fs::file_status status = fs::status(target, error);
  if (fs::is_directory(status)) return disk_error("write", file, EISDIR);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    return Error{ErrorKind::disk, "cannot write '" + file.string() +
                                      "': it is not a regular file; name a file in a folder"};
  }
  return target;
}

Result<void> put_in_place(Temporary& temporary, const fs::path& file, const fs::path& target) {
  // Before the rename: otherwise a crash may leave the new name with an empty file.
  if (const int failed_with = sync_path(temporary.path(), 0)) {
    return disk_error("write", file, failed_with);
  }
  if (interrupted()) {
    return Error{ErrorKind::interrupted,
                 "interrupted while writing '" + file.string() + "'; it is as it was before"};
  }
  if (is_end_forced()) return disk_error("write", file, EINTR);
  if (!temporary.rename_over(target)) return disk_error("write", file, errno);
  // Some network file systems cannot sync folders; the rename itself has happened.
  const int failed_with = sync_path(target.parent_path(), O_DIRECTORY);
  if (failed_with != 0 && failed_with != EINVAL) return disk_error("sync", file, failed_with);
  return {};
}

}  // namespace

Result<void> replace_file(const fs::path& file,
                          const std::function<Result<void>(const fs::path&)>& write) {
  return no_throw(file.string(), [&]() -> Result<void> {
    const Result<fs::path> target = resolve_target(file);
    if (!target) return target.error();
    Temporary temporary(temporary_name(target.value()));
    if (const int failed_with = create_like(temporary.path(), target.value())) {
      return disk_error("write", file, failed_with);
    }
    if (Result<void> written = write(temporary.path()); !written) return written;
    return put_in_place(temporary, file, target.value());
  });
}

Result<void> replace_text(const fs::path& file, std::string_view text) {
  return replace_file(file, [&](const fs::path& temporary) {
    OutputFile out(temporary);
    out.write(text.data(), text.size());
    return out.close();
  });
}

void install_interrupt_cleanup() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  // Reads and writes under way go on; the work asks interrupted() in its own time. All signals are
  // blocked meanwhile, so that no handler interrupts another.
  action.sa_flags = SA_RESTART;
  ::sigfillset(&action.sa_mask);
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
  ::sigaction(SIGPIPE, &action, nullptr);
  struct sigaction hang_up {};
  ::sigaction(SIGHUP, nullptr, &hang_up);
  // Whoever was started to survive its terminal does.
  if (hang_up.sa_handler != SIG_IGN) ::sigaction(SIGHUP, &action, nullptr);
}

bool interrupted() noexcept { return g_interrupted.load(); }

int ending_signal() noexcept { return g_first_signal.load(); }

void end_within(double seconds, int descriptor, const std::string& words) {
  assert(!g_has_deadline && words.size() <= g_deadline.words.size());
  struct sigaction action {};
  action.sa_handler = on_deadline;
  ::sigfillset(&action.sa_mask);
  sigevent event{};
  // A timer of POSIX and not alarm(): it can be started in a signal handler with a
  // fraction of a second.
  event.sigev_notify = SIGEV_SIGNAL;
  event.sigev_signo = SIGALRM;
  if (::sigaction(SIGALRM, &action, nullptr) != 0) return;
  if (::timer_create(CLOCK_MONOTONIC, &event, &g_deadline.timer) != 0) return;
  g_deadline.from_now.it_value.tv_sec = static_cast<time_t>(seconds);
  g_deadline.from_now.it_value.tv_nsec = static_cast<long>((seconds - std::floor(seconds)) * 1e9);
  g_deadline.descriptor = descriptor;
  g_deadline.length = words.copy(g_deadline.words.data(), g_deadline.words.size());
  g_has_deadline = true;
  // Told before; a signal between these two lines winds the clock up twice.
  if (g_told_to_end) ::timer_settime(g_deadline.timer, 0, &g_deadline.from_now, nullptr);
}

void forget_interrupt() noexcept {
  const itimerspec never{};
  if (g_has_deadline) ::timer_settime(g_deadline.timer, 0, &never, nullptr);
  g_interrupted = false;
}

}  // namespace argil::io
