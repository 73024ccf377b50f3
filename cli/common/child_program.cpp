// SPDX-License-Identifier: GPL-3.0-or-later
// Starts other programs so that none of them outlives us.
#include "common/child_program.h"

#include <cassert>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <sstream>
#include <thread>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "argil/io/safe_file.h"

namespace argil::cli {
namespace {

/// How often it is looked whether a child has ended, and whether it shall.
constexpr std::chrono::milliseconds kChildLook{5};
/// How many looks each signal has to end it: we ourselves have a second.
constexpr int kChildPatience = 40;

/// In the child, where after a fork of a program with threads only system calls are safe.
[[noreturn]] void become(const char* folder, const ChildProgram::Output& output, pid_t parent,
                         char* const* words) {
  const int nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  const bool goes_with_parent =
      ::prctl(PR_SET_PDEATHSIG, SIGTERM) == 0 && ::getppid() == parent;  // or it ended before
  if (goes_with_parent && ::setpgid(0, 0) == 0 && ::chdir(folder) == 0 &&
      ::dup2(nothing, STDIN_FILENO) >= 0 && ::dup2(output.out, STDOUT_FILENO) >= 0 &&
      ::dup2(output.err, STDERR_FILENO) >= 0) {
    // Returns only where it failed.
    ::execvp(words[0], words);
  }
  ::_exit(127);
}

}  // namespace

bool has_program(const std::string& name) {
  assert(!name.empty());
  const char* path = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe): read only
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (::access(folder.append("/").append(name).c_str(), X_OK) == 0) return true;
  }
  return false;
}

ChildProgram::ChildProgram(const std::filesystem::path& folder, std::vector<std::string> words,
                           const Output& output) {
  assert(!words.empty() && output.out >= 0 && output.err >= 0);
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const pid_t parent = ::getpid();
  process_ = ::fork();
  if (process_ == 0) become(folder.c_str(), output, parent, pointers.data());
  if (process_ < 0) status_ = -1;
  // Here as well, so that the group is there whoever of the two comes first.
  if (process_ > 0) ::setpgid(process_, process_);
}

ChildProgram::~ChildProgram() { kill(); }

std::optional<int> ChildProgram::ended() {
  int status = -1;
  if (!status_ && ::waitpid(process_, &status, WNOHANG) == process_) status_ = status;
  return status_;
}

int ChildProgram::wait() {
  while (!ended()) {
    if (io::interrupted()) kill();
    std::this_thread::sleep_for(kChildLook);
  }
  return *status_;
}

void ChildProgram::kill() noexcept {
  const auto is_gone_soon = [this] {
    for (int look = 0; look < kChildPatience && !ended(); ++look) {
      std::this_thread::sleep_for(kChildLook);
    }
    return ended().has_value();
  };
  if (ended()) return;
  ::kill(-process_, SIGTERM);
  if (is_gone_soon()) return;
  ::kill(-process_, SIGKILL);
  // The system may take longer to free the gigabytes that it had; it does nothing any more.
  if (!is_gone_soon()) status_ = SIGKILL;
}

}  // namespace argil::cli
