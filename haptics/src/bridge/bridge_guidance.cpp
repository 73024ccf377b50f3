// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/bridge/bridge_guidance.h"

#include <algorithm>
#include <cassert>

#include "math/units.h"

namespace argil::haptics {
namespace {

Vec3 nearest_on_segment(const Vec3& a, const Vec3& b, const Vec3& position) noexcept {
  const Vec3 along = b - a;
  const double square = dot(along, along);
  if (!(square > 0.0)) return a;
  return a + std::clamp(dot(position - a, along) / square, 0.0, 1.0) * along;
}

}  // namespace

Vec3 nearest_on_path(const std::vector<Vec3>& path_mm, const Vec3& place_mm) noexcept {
  if (path_mm.empty()) return place_mm;
  Vec3 best = path_mm.front();
  for (std::size_t n = 1; n < path_mm.size(); ++n) {
    const Vec3 near = nearest_on_segment(path_mm[n - 1], path_mm[n], place_mm);
    if (length(near - place_mm) < length(best - place_mm)) best = near;
  }
  return best;
}

Vec3 guidance_force(const GuidanceOptions& options, const Vec3& position_mm) noexcept {
  if (options.kind == GuidanceKind::none) return {};
  assert(options.stiffness_n_per_m > 0.0 && options.most_force_n > 0.0);
  const Vec3 back_mm = nearest_on_path(options.path_mm, position_mm) - position_mm;
  const double size_n =
      std::min(options.stiffness_n_per_m * length(back_mm) / kMmPerM, options.most_force_n);
  const Vec3 pull = size_n * normalized(back_mm);
  return options.kind == GuidanceKind::dha ? pull : -pull;
}

}  // namespace argil::haptics
