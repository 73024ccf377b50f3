// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>

namespace argil::viewer {

/// Where among a device's values its pressure stands, and what it spans.
struct PressureAxis {
  int number = 0;
  double least = 0.0;
  double most = 1.0;
};

/// The pressure, 0 to 1, among the values that a motion brought: `mask` has a bit for each number,
/// `values` holds one for each bit that is set, in their order. Nothing where it did not change.
std::optional<double> pressure_in(const PressureAxis& axis, std::span<const unsigned char> mask,
                                  const double* values) noexcept;

/// Whether a device is a pen's other end, by its name: "Wacom Intuos Pro M Pen eraser" and the like
/// (xf86-input-wacom), "... Eraser (0)" (libinput).
bool is_eraser_name(std::string_view device) noexcept;

/// What a pen tells, and a mouse does not.
struct PenState {
  double pressure = 1.0;   ///< 0 to 1
  bool is_eraser = false;  ///< its other end
  friend bool operator==(const PenState&, const PenState&) = default;
};

/// How hard a pen is pressed and with which end, which GLFW 3.3 does not tell: read beside it
/// through XInput 2, whose raw motions take nothing from what the window gets.
///
/// Threads  the window's.
class Pen {
 public:
  /// Null where there is no X server with XInput 2.1 (then every pressure is 1).
  static std::unique_ptr<Pen> open();
  ~Pen();
  Pen(const Pen&) = delete;
  Pen& operator=(const Pen&) = delete;

  /// The newest state since the last call, that of a mouse where one moved; nothing when nothing
  /// did.
  std::optional<PenState> poll();

 private:
  struct Listener;
  explicit Pen(std::unique_ptr<Listener> listener);
  std::unique_ptr<Listener> listener_;
};

}  // namespace argil::viewer
