// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "argil/core/triangle_mesh.h"

namespace argil::io {

/// The vertices of the first surface, each in the care of a triangle of the present one that is
/// near: so that no step may leave one of them behind.
class Followers {
 public:
  explicit Followers(const TriangleMesh& surface);

  /// Everything in the care of `triangles`, which a step replaces.
  void gather(std::span<const std::uint32_t> triangles);

  /// A triangle that a step makes.
  struct Corners {
    std::uint32_t number = 0;
    Vec3 a, b, c;
  };
  /// Finds the nearest of `made` for everything gathered. False when one is farther than
  /// `reach_mm`.
  bool place(std::span<const Corners> made, double reach_mm);

  /// Hands what was placed to its triangles.
  void commit(std::span<const std::uint32_t> replaced);

 private:
  const std::vector<Vec3>& points_;
  std::vector<std::uint32_t> first_;  ///< of each triangle
  std::vector<std::uint32_t> next_;   ///< of each point
  std::vector<std::uint32_t> gathered_;
  std::vector<std::uint32_t> home_;  ///< of each gathered
};

}  // namespace argil::io
