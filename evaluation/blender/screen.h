// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "argil/core/progress.h"
#include "argil/core/result.h"

#include "common/child_program.h"
#include "common/scratch_folder.h"

namespace argil::evaluation {

/// What keeps Blender from being run in a window here, as "Blender: ... is not installed"; "" when
/// nothing does. It wants a window for its brushes, so Xvfb must be there as well.
std::string screen_obstacle();

/// A screen that nobody sees (Xvfb). It ends with this.
class Screen {
 public:
  /// Errors  interrupted; internal where Xvfb gives no display within 20 s, with what it said.
  static Result<Screen> open(const cli::ScratchFolder& scratch, const Progress& progress);
  /// The number of its display.
  const std::string& display() const noexcept { return display_; }

 private:
  Screen(std::unique_ptr<cli::ChildProgram> program, std::string display)
      : program_(std::move(program)), display_(std::move(display)) {}
  std::unique_ptr<cli::ChildProgram> program_;
  std::string display_;
};

}  // namespace argil::evaluation
