// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "argil/core/vec3.h"

namespace argil::haptics {

/// How a path is felt.
///
/// Source  section 4.3 of the Falcon report (docs/equations.md), after L. Profumo, L. Pollini,
///         D. A. Abbink, "Direct and indirect haptic aiding for curve negotiation", IEEE SMC 2013.
enum class GuidanceKind {
  none,
  /// Direct haptic assistance: pulls to the path; a hand that yields follows it.
  dha,
  /// Indirect haptic assistance: pushes off the path; a hand that resists is on its guard, and
  /// follows it.
  iha,
};

struct GuidanceOptions {
  static constexpr std::size_t kMostPoints = 1000;

  GuidanceKind kind = GuidanceKind::none;
  /// Straight from point to point; at least one, up to kMostPoints; in the device's frame.
  std::vector<Vec3> path_mm;
  /// Of the pull, or of the push; usual 60, > 0. A push stiffer than the hand (100 N/m when light)
  /// cannot be resisted.
  double stiffness_n_per_m = 60.0;
  /// Where it saturates, so that a hand can always override it; usual 1.5, > 0.
  double most_force_n = 1.5;
};

/// The point of a path, straight between its points, that is nearest to a position; the position
/// itself when the path is empty.
///
/// Threads  Realtime; pure.
/// Cost     10 ns for each point of the path.
Vec3 nearest_on_path(const std::vector<Vec3>& path_mm, const Vec3& place_mm) noexcept;

/// The force on a handle; zero on the path, where `kind` is none, and without a path.
///
/// Threads  Realtime; pure.
/// Cost     10 ns for each point of the path.
Vec3 guidance_force(const GuidanceOptions& options, const Vec3& position_mm) noexcept;

}  // namespace argil::haptics
