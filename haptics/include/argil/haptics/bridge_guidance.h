// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "argil/core/vec3.h"

namespace argil::haptics {

/// How a path is felt (section 4.3 of the report, after Profumo et al. 2013).
enum class GuidanceKind {
  none,
  dha,  ///< direct haptic assistance: drawn to the path; a hand that yields follows it
  iha,  ///< indirect: pushed off the path; a hand that resists is on its guard, and follows it
};

struct GuidanceOptions {
  static constexpr std::size_t kMostPoints = 1000;

  GuidanceKind kind = GuidanceKind::none;
  std::vector<Vec3> path_mm;        ///< at least one point, up to kMostPoints; device's frame
  double stiffness_n_per_m = 60.0;  ///< of the pull, or of the push; > 0. A push stiffer than the
                                    ///< hand (100 N/m when light) cannot be resisted
  double most_force_n = 1.5;        ///< where it ends, so that a hand can always override it; > 0
};

/// The point of a path (straight between its points) that is nearest to a place.
Vec3 nearest_on_path(const std::vector<Vec3>& path_mm, const Vec3& place_mm) noexcept;

/// On a handle at a place; zero on the path, without `kind`, and without a path.
///
/// Threads  Realtime; pure.
/// Cost     10 ns for each point of the path.
Vec3 guidance_force(const GuidanceOptions& options, const Vec3& position_mm) noexcept;

}  // namespace argil::haptics
