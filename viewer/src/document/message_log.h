// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <deque>
#include <string>

#include "document/document_thread.h"

namespace argil::viewer {

struct Message {
  Notice notice;
  std::string clock;     ///< when it came, "14:03:59"
  double until_s = 0.0;  ///< of the window's clock: shown until then; errors until dismissed
  bool is_shown = true;
};

/// What the window was told, newest last: the newest things are shown over the picture, the rest is
/// kept to be looked up.
class MessageLog {
 public:
  static constexpr double kShownS = 6.0;
  static constexpr std::size_t kMost = 500;

  /// An error replaces the one of its kind that is still shown; any message replaces one of the
  /// same words.
  void add(Notice notice, double now_s, std::string clock);

  /// Hides what was shown long enough.
  void tick(double now_s);
  /// When the next of them is to be hidden; infinite where none is.
  double next_s() const noexcept;
  void dismiss(std::size_t index) { messages_.at(index).is_shown = false; }
  void clear() { messages_.clear(); }

  const std::deque<Message>& messages() const noexcept { return messages_; }

 private:
  std::deque<Message> messages_;
};

}  // namespace argil::viewer
