// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/project_lock.h"

#include <array>
#include <cerrno>
#include <string>
#include <string_view>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "file/file_bytes.h"
#include "project/session_files.h"

namespace argil::io {
namespace {

namespace fs = std::filesystem;

/// Whether `handle` still is the file of that name: its owner may have removed it meanwhile.
bool is_named(int handle, const fs::path& file) {
  struct stat held {};
  struct stat named {};
  return ::fstat(handle, &held) == 0 && ::stat(file.c_str(), &named) == 0 &&
         held.st_dev == named.st_dev && held.st_ino == named.st_ino;
}

/// What `sign` wrote.
std::string holder_of(int handle) {
  std::array<char, 256> text{};
  const ssize_t got = ::pread(handle, text.data(), text.size() - 1, 0);
  if (got <= 0) return "another program";
  const std::string_view line(text.data(), static_cast<std::size_t>(got));
  return std::string(line.substr(0, line.find('\n')));
}

/// Who we are is for people only, so failing to say it is no reason not to work.
void sign(int handle) {
  std::array<char, 128> host{};
  if (::gethostname(host.data(), host.size() - 1) != 0) host[0] = '?';
  std::string text = "process ";
  text.append(std::to_string(::getpid())).append(" on ").append(host.data()).append("\n");
  if (::ftruncate(handle, 0) != 0) return;
  static_cast<void>(::pwrite(handle, text.data(), text.size(), 0) < 0);
}

}  // namespace

Result<ProjectLock> ProjectLock::take(const fs::path& lock_file, const fs::path& project) {
  for (;;) {
    const int handle = ::open(lock_file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666);
    if (handle < 0) return disk_error("lock", project, errno);
    ProjectLock lock(lock_file, handle);
    if (::flock(handle, LOCK_EX | LOCK_NB) != 0) {
      const int failed_with = errno;
      const std::string holder = holder_of(handle);
      ::close(std::exchange(lock.handle_, -1));
      if (failed_with != EWOULDBLOCK) return disk_error("lock", project, failed_with);
      return Error{ErrorKind::bad_input,
                   quoted_name(project).append(" is being sculpted by " + holder +
                                               "; close it there or write to another file")};
    }
    // Else its owner removed it between open and flock: what is locked has no name, and the next
    // program would lock another file.
    if (is_named(handle, lock_file)) {
      sign(handle);
      lock.end_slot_ = EndSlot(lock_file);
      return lock;
    }
    ::close(std::exchange(lock.handle_, -1));
  }
}

ProjectLock::~ProjectLock() {
  if (handle_ < 0) return;
  // Removed while it is held: who has opened it meanwhile finds that it has no name any more.
  ::unlink(file_.c_str());
  ::close(handle_);
}

}  // namespace argil::io
