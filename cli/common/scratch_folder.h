// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cassert>
#include <filesystem>
#include <string>
#include <utility>

#include "argil/core/result.h"

namespace argil::cli {

/// A new folder that its user alone can enter (mode 0700), in $TMPDIR or else /tmp: where everybody
/// may write, nobody else can read, replace or plant a file in it. It goes with all that it holds.
class ScratchFolder {
 public:
  /// Errors  disk, naming the folder.
  static Result<ScratchFolder> make();
  ScratchFolder(ScratchFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
  ScratchFolder& operator=(ScratchFolder&&) = delete;
  ~ScratchFolder();

  std::filesystem::path operator/(const std::string& name) const {
    assert(!path_.empty());  // not one that was moved away
    return path_ / name;
  }

 private:
  explicit ScratchFolder(std::filesystem::path path) noexcept : path_(std::move(path)) {}
  std::filesystem::path path_;
};

}  // namespace argil::cli
