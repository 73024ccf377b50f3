// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "input/input_event.h"

namespace argil::viewer {

/// A 3D mouse, through the daemon spacenavd (https://spacenav.sourceforge.net) and its libspnav,
/// which finds it at SPNAV_SOCKET or its usual place.
///
/// Threads  the window's. libspnav knows one device a process: one SpaceMouse at a time.
class SpaceMouse {
 public:
  /// Null when no daemon runs.
  static std::unique_ptr<SpaceMouse> open();
  ~SpaceMouse();
  SpaceMouse(const SpaceMouse&) = delete;
  SpaceMouse& operator=(const SpaceMouse&) = delete;

  /// What came since the last call: events `puck` and, for its first button, the key Home.
  std::vector<InputEvent> poll();

 private:
  SpaceMouse() = default;
};

}  // namespace argil::viewer
