// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <span>

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

/// How hard a pen is pressed, which GLFW 3.3 does not tell: read beside it through XInput 2, whose
/// raw motions take nothing from what the window gets.
///
/// Threads  the window's.
class Pen {
 public:
  /// Null where there is no X server with XInput 2.1 (then every pressure is 1).
  static std::unique_ptr<Pen> open();
  ~Pen();
  Pen(const Pen&) = delete;
  Pen& operator=(const Pen&) = delete;

  /// The newest pressure since the last call, 1 where it was a mouse that moved; nothing when
  /// nothing did.
  std::optional<double> poll();

 private:
  struct Listener;
  explicit Pen(std::unique_ptr<Listener> listener);
  std::unique_ptr<Listener> listener_;
};

}  // namespace argil::viewer
