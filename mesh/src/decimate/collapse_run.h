// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "argil/core/pace.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/mesh/decimate.h"

namespace argil::mesh {

struct CollapseGoal {
  std::int64_t triangles = 0;  ///< to so many or one fewer
  double reach_mm = 0.0;       ///< no step goes farther from the field or the surface; 0: no bound
};

struct Collapsed {
  TriangleMesh mesh;
  std::vector<std::uint32_t> kept;  ///< which vertex of the surface each one was
  std::int64_t steps = 0;
};

/// One run of edge collapses from the surface toward the goal. Vertices in `locked` neither go nor
/// move.
/// Errors  bad_input when the surface is not closed and two-manifold. Throws Interrupted.
Result<Collapsed> collapse_edges(const TriangleMesh& surface, const DecimationTarget& target,
                                 const CollapseGoal& goal, const std::vector<bool>& locked,
                                 const Pace& pace);

}  // namespace argil::mesh
