// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

namespace argil::viewer {

/// Notes what a user cannot see whole: panels that reach beyond the screen, content that is wider
/// than its panel, or higher where that does not scroll, and buttons narrower than their words.
/// What stays so for a few frames counts: a panel that opens finds its size in the first two.
///
/// Not seen are words over other words in a line, cells wider than their column, panels over
/// panels, titles and chosen entries that are cut short, what is drawn into a list, and with Dear
/// ImGui 1.90 a menu bar wider than the screen.
///
/// Threads  the window's.
class CutOff {
 public:
  /// Once a frame, after Gui::end_frame().
  void look();
  /// All that was seen so far, each once, sorted: a title or a button's words, and how.
  std::vector<std::string> found() const { return {found_.begin(), found_.end()}; }
  /// The titles of all panels and dialogs that were on the screen, sorted.
  std::vector<std::string> panels() const { return {panels_.begin(), panels_.end()}; }

 private:
  std::map<std::string, int> frames_;  ///< for how many it has been so, of what is so now
  std::set<std::string> found_;
  std::set<std::string> panels_;
};

}  // namespace argil::viewer
