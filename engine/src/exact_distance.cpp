// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact_distance.h"

#include <cmath>
#include <limits>

#include "argil/engine/surface.h"

#include "mesh_distance.h"

namespace argil {

void exact_distances(const Clay& clay, double voxel_mm, const NodeBox& box, std::span<float> out) {
  const double trusted = (kHalfWidthVoxels - 1) * clay.options().voxel_mm;
  const TriangleMesh surface = extract_surface(clay);
  const MeshDistance closest(surface.positions, surface.triangles);
  std::uint32_t hint = kNoTriangle;
  float* to = out.data();
  for_each_node(box, [&](const Coord& node) {
    const Vec3 place = voxel_mm * Vec3{static_cast<double>(node.x()), static_cast<double>(node.y()),
                                       static_cast<double>(node.z())};
    double value = clay.distance_at(place);
    if (std::abs(value) >= trusted && !surface.triangles.empty()) {
      const auto found = closest.closest(place, std::numeric_limits<double>::infinity(), hint);
      hint = found.triangle;
      value = std::copysign(static_cast<double>(found.distance), value);
    }
    *to++ = static_cast<float>(value);
  });
}

}  // namespace argil
