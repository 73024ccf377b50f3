// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "argil/core/triangle_mesh.h"

namespace argil::test {

/// The distance from a point to a triangle: from the plane where the foot lies within, else from
/// the nearest side.
double distance_to(const Vec3& p, const std::array<Vec3, 3>& triangle);

/// How far points are from a mesh, by another way than ours: triangles by the boxes of a grid that
/// they touch, which are searched in ever wider rings.
class TriangleBuckets {
 public:
  /// Refers to the mesh, which must stay, and have a triangle. `side` of a box.
  TriangleBuckets(const TriangleMesh& mesh, double side);

  /// The least distance of all triangles.
  double distance(const Vec3& p) const;

 private:
  using Key = std::array<int, 3>;
  struct KeyHash {
    std::size_t operator()(const Key& k) const noexcept {
      return static_cast<std::size_t>((static_cast<unsigned>(k[0]) * 73856093U) ^
                                      (static_cast<unsigned>(k[1]) * 19349663U) ^
                                      (static_cast<unsigned>(k[2]) * 83492791U));
    }
  };
  Key key(const Vec3& p) const;
  void look_in_box(const Vec3& p, const Key& box, double& nearest) const;
  void look_in_ring(const Vec3& p, int ring, double& nearest) const;

  const TriangleMesh& mesh_;
  double side_;
  std::unordered_map<Key, std::vector<std::uint32_t>, KeyHash> boxes_;
};

}  // namespace argil::test
