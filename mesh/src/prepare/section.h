// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>

#include "argil/core/vec3.h"
#include "argil/mesh/triangle_geometry.h"

namespace argil::mesh {

/// Where a triangle meets a horizontal plane, with the solid to the left.
struct SectionSegment {
  Vec3 from;
  Vec3 to;
};

/// Nothing where the triangle lies on one side; a corner on the plane counts as above it, so that
/// the segments of a closed mesh are closed loops.
inline std::optional<SectionSegment> section_of(const Corners& c, double z) noexcept {
  const auto crossing = [z](const Vec3& a, const Vec3& b) {
    // From below, so that both triangles at an edge get the same point.
    const Vec3& low = a.z < b.z ? a : b;
    const Vec3& high = a.z < b.z ? b : a;
    return low + (z - low.z) / (high.z - low.z) * (high - low);
  };
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3& one = c[k];
    const Vec3& next = c[(k + 1) % 3];
    const Vec3& last = c[(k + 2) % 3];
    // The corner that is alone on its side.
    if ((one.z < z) == (next.z < z) || (next.z < z) != (last.z < z)) continue;
    const Vec3 after = crossing(one, next);
    const Vec3 before = crossing(last, one);
    return one.z < z ? SectionSegment{before, after} : SectionSegment{after, before};
  }
  return std::nullopt;
}

}  // namespace argil::mesh
