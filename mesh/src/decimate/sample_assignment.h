// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "argil/core/triangle_mesh.h"

namespace argil::mesh {

/// Samples of the first surface, its vertices, each assigned to a nearby triangle of the present
/// one, so that no step may leave one of them behind.
///
/// Source   J. Cohen et al., "Simplification envelopes", 1996, and R. Klein et al., "Mesh reduction
///          with error control", 1996, assign samples to faces likewise. Ours differs: a step looks
///          only among the triangles that it makes.
class SampleAssignment {
 public:
  explicit SampleAssignment(const TriangleMesh& surface);

  /// Takes up every sample of `triangles`, which a step replaces.
  void gather(std::span<const std::uint32_t> triangles);

  /// A triangle that a step makes.
  struct NewTriangle {
    std::uint32_t number = 0;
    Vec3 a, b, c;
  };
  /// Finds the nearest of `made` for every sample gathered. False when one is farther than
  /// `reach_mm`.
  bool assign(std::span<const NewTriangle> made, double reach_mm);

  /// Hands what was assigned to its triangles.
  void commit(std::span<const std::uint32_t> replaced);

 private:
  const std::vector<Vec3>& samples_;
  std::vector<std::uint32_t> first_;  ///< of each triangle
  std::vector<std::uint32_t> next_;   ///< of each sample
  std::vector<std::uint32_t> gathered_;
  std::vector<std::uint32_t> assigned_;  ///< triangle of each gathered
};

}  // namespace argil::mesh
