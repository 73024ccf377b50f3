// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "picture/camera.h"

namespace argil::viewer {

/// What one finger on a touch screen did.
struct FingerEvent {
  enum class What { down, move, up };
  What what = What::down;
  unsigned finger = 0;   ///< a number of its own from down to up
  Camera::Pixel screen;  ///< where it is, in pixels of the whole display
};

/// An axis of a touch screen and how many pixels of the display it spans.
struct TouchAxis {
  int number = 0;
  double least = 0.0;
  double most = 1.0;
  double pixels = 0.0;
};

/// The pixel among the values that an event brought, as pressure_in(); nothing where it did not
/// change.
std::optional<double> pixel_in(const TouchAxis& axis, std::span<const unsigned char> mask,
                               const double* values) noexcept;

/// Fingers on touch screens, of which GLFW tells only the first, as a pointer: read beside it
/// through XInput 2.2. Fingers on a touch pad are not heard, since they touch no place of the
/// screen.
///
/// Threads  the window's.
class TouchScreen {
 public:
  /// Null where there is no X server with XInput 2.2.
  static std::unique_ptr<TouchScreen> open();
  ~TouchScreen();
  TouchScreen(const TouchScreen&) = delete;
  TouchScreen& operator=(const TouchScreen&) = delete;

  /// What fingers did since the last call, anywhere on the display.
  std::vector<FingerEvent> poll();
  /// Whether some finger is down, as of the last call.
  bool is_touched() const noexcept;

 private:
  struct Listener;
  explicit TouchScreen(std::unique_ptr<Listener> listener);
  std::unique_ptr<Listener> listener_;
};

}  // namespace argil::viewer
