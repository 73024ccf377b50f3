// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bitset>
#include <cstddef>
#include <deque>

#include "input/input_event.h"

struct ImGuiIO;

namespace argil::viewer {

/// Tells Dear ImGui which numbers our keys have: GLFW's, as events have them (input_event.h).
void name_keys(ImGuiIO& io);

/// Events on their way to Dear ImGui, which looks at the state of mouse and keys once a frame. What
/// would overwrite a change that it has not seen yet waits for the next frame, with all behind it:
/// a key that was pressed and let go between two frames is pressed in one and let go in the next.
///
/// Source   Dear ImGui 1.87 queues events by these rules (ImGui::UpdateInputEvents); 1.86 has no
///          queue. Ours differs: it waits also for what changes Ctrl, Shift or Alt after a key, and
///          a letter's key does not wait for the letter.
/// Threads  the window's.
class InputQueue {
 public:
  void add(const InputEvent& event) { waiting_.push_back(event); }
  /// Before ImGui::NewFrame: hands on what this frame can show.
  void apply(ImGuiIO& io);
  bool has_waiting() const noexcept { return !waiting_.empty(); }

 private:
  /// What this frame has taken so far.
  struct Taken {
    std::bitset<512> keys;
    std::bitset<3> buttons;
    bool has_named_key = false;  ///< one that is no letter or digit, or is one with Ctrl
    bool has_text = false;
    bool has_moved = false;
    bool has_scrolled = false;
  };
  static bool fits(const InputEvent& event, const ImGuiIO& io, const Taken& taken);
  static void take(const InputEvent& event, ImGuiIO& io, Taken& taken);

  std::deque<InputEvent> waiting_;
};

}  // namespace argil::viewer
