// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "panels/gui.h"

namespace argil::viewer {

/// Notes what a user cannot see whole: panels that reach beyond the screen, content that is wider
/// than its panel, or higher where that does not scroll, and buttons narrower than their words.
/// What stays so for a few frames counts: a panel that opens finds its size in the first two.
///
/// Threads  the window's.
class CutOff {
 public:
  /// Once a frame, after Gui::end_frame().
  void look();
  /// All that was seen so far, each once, sorted: a title or a label, and how.
  std::vector<std::string> found() const { return {found_.begin(), found_.end()}; }

 private:
  std::map<std::string, int> frames_;  ///< for how many it has been so, of what is so now
  std::set<std::string> found_;
};

}  // namespace argil::viewer
