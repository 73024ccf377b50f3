// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <utility>

#include "argil/core/end_slot.h"
#include "argil/core/result.h"

namespace argil::io {

/// Keeps two programs from changing one project: an flock on NAME.lock, which says "process PID on
/// HOST". The system lets go of it when its process ends, however that comes; a file left by a kill
/// stops nobody. Given back, and the file removed, when this goes.
class ProjectLock {
 public:
  /// Errors  bad_input naming who holds it; disk when the file cannot be made.
  static Result<ProjectLock> take(const std::filesystem::path& lock_file,
                                  const std::filesystem::path& project);

  ProjectLock(ProjectLock&& other) noexcept
      : file_(std::move(other.file_)),
        end_slot_(std::move(other.end_slot_)),
        handle_(std::exchange(other.handle_, -1)) {}
  ProjectLock& operator=(ProjectLock&&) = delete;
  ~ProjectLock();

 private:
  ProjectLock(std::filesystem::path file, int handle) : file_(std::move(file)), handle_(handle) {}
  std::filesystem::path file_;
  EndSlot end_slot_;
  int handle_ = -1;
};

}  // namespace argil::io
