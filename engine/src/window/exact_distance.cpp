// SPDX-License-Identifier: GPL-3.0-or-later
// The reference: every node asks the triangles of the whole surface.
#include "window/exact_distance.h"

#include <cassert>
#include <cmath>
#include <limits>

#include "argil/engine/mesh_distance.h"
#include "argil/engine/surface.h"

namespace argil {

void exact_distances(const Clay& clay, double voxel_mm, const NodeBox& box, std::span<float> out) {
  assert(voxel_mm > 0.0);
  const double trusted = (kHalfWidthVoxels - 1) * clay.options().voxel_mm;
  const TriangleMesh surface = extract_surface(clay);
  const MeshDistance closest(surface.positions, surface.triangles);
  std::uint32_t hint = kNoTriangle;
  float* to = out.data();
  for_each_node(box, [&](const Coord& node) {
    const Vec3 point = voxel_mm * Vec3{static_cast<double>(node.x()), static_cast<double>(node.y()),
                                       static_cast<double>(node.z())};
    double value = clay.distance_at(point);
    if (std::abs(value) >= trusted && !surface.triangles.empty()) {
      const auto found = closest.closest(point, std::numeric_limits<double>::infinity(), hint);
      hint = found.triangle;
      value = std::copysign(static_cast<double>(found.distance), value);
    }
    *to++ = static_cast<float>(value);
  });
  assert(to == out.data() + out.size());
}

}  // namespace argil
