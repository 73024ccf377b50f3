// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace argil::cli {

/// Whether there is a program of that name on the PATH.
bool has_program(const std::string& name);

/// Another program while it runs, in a process group of its own, so that it ends with all that it
/// started: when this object goes, and whatever ends our own program or the thread that began it
/// ends it too. Ctrl-C at a terminal reaches us alone. It gets SIGTERM, and SIGKILL where that does
/// not help: what it writes must lie in a folder that goes with it.
///
/// Threads  one thread begins, asks and ends it.
class ChildProgram {
 public:
  /// Descriptors that become its stdout and stderr; both may be one. Its stdin is empty.
  struct Output {
    int out;
    int err;
  };

  /// Starts words[0], found on the PATH, in `folder`. Where that fails it ends with status 127.
  ChildProgram(const std::filesystem::path& folder, std::vector<std::string> words,
               const Output& output);
  ChildProgram(const ChildProgram&) = delete;
  ChildProgram& operator=(const ChildProgram&) = delete;
  ~ChildProgram();

  /// As waitpid gives it, once it has ended; nothing while it runs. -1: it could not be begun.
  std::optional<int> ended();

  /// Waits for its end, and brings that about when the user interrupts us.
  int wait();

  /// Ends its process group, if it still runs, and waits until it is gone: 0.4 s at most, after
  /// which the system is still freeing its memory.
  void kill() noexcept;

 private:
  pid_t process_;
  std::optional<int> status_;
};

}  // namespace argil::cli
