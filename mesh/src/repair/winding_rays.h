// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "argil/core/triangle_mesh.h"

#include "repair/arrangement.h"

namespace argil::mesh {

/// How often places beside a closed mesh are inside it, exactly: along a ray parallel to an axis.
///
/// Threads      one.
/// Cost         linear once for each axis that is asked along; then some 20 us a ray.
class WindingRays {
 public:
  /// Of a mesh without degenerate triangles in which every edge is run along as often one way as
  /// the other; it must stay.
  explicit WindingRays(const TriangleMesh& mesh)
      : mesh_(mesh), box_(bounds(mesh)), slack_mm_(kRounding * length(box_.size())) {}

  /// The winding number just beyond `from` along the axis, as if what `from` lies on were behind
  /// it. Nothing where the ray meets an edge.
  std::optional<std::int32_t> beyond(const ExactPoint& from, std::size_t axis);

 private:
  /// Triangles by the cells that their boxes meet, seen along one axis.
  struct Grid {
    std::size_t cells = 0;  ///< along each side; 0: not made yet
    std::array<double, 2> low{};
    std::array<double, 2> per_mm{};
    std::vector<std::uint32_t> begin;
    std::vector<std::uint32_t> triangles;

    std::size_t cell(std::size_t side, double at) const noexcept;
  };
  const Grid& grid_along(std::size_t axis);

  /// Of the size: more than the rounding of any point within it to a double.
  static constexpr double kRounding = 1e-9;

  const TriangleMesh& mesh_;
  Box3 box_;
  double slack_mm_;
  std::array<Grid, 3> grids_;
};

}  // namespace argil::mesh
