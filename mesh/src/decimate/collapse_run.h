// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "argil/core/pace.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/mesh/decimate.h"

namespace argil::mesh {

struct Collapsed {
  TriangleMesh mesh;
  std::vector<std::uint32_t> kept;  ///< which vertex of the surface each one was
  std::int64_t steps = 0;
};

/// Collapses edges of the surface until so many triangles are left, or one fewer, or no edge can be
/// collapsed. Vertices in `locked` neither go nor move.
/// Errors  bad_input when the surface is not closed and two-manifold. Throws Interrupted.
Result<Collapsed> collapse_edges(const TriangleMesh& surface, const DecimationTarget& target,
                                 std::int64_t triangles, const std::vector<bool>& locked,
                                 const Pace& pace);

struct CollapsedWithin {
  Collapsed collapsed;
  int tries = 1;           ///< of the place that was tried most often
  bool is_proven = false;  ///< every part of it and of the field lies within the bound
  bool has_folds = false;  ///< it has some that the surface, rounded to floats, had
};

/// As collapse_edges, and fits what is left, within the bound that `options` give and to a count
/// where they give one. Positions are floats.
Result<CollapsedWithin> collapse_within(const TriangleMesh& surface, const DecimationTarget& target,
                                        const DecimateOptions& options, const Pace& pace);

}  // namespace argil::mesh
