// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "argil/core/field_window.h"
#include "argil/haptics/force/tool_force.h"

#include "force/reference.h"
#include "scene/distance.h"

namespace argil::evaluation {

/// A competitor of the chart: eq. 2 at points that are fixed to the tool, the distance between the
/// finest nodes trilinear and its gradient that of the trilinear.
struct StencilPoint {
  Vec3 q;  ///< in supports, at most 1 long, along the tool's axes
  double weight;
};

/// 96: 3 shells of 32 icosahedral directions; 288 and 768: Gauss products of 4 x 6 x 12 and 6 x 8 x
/// 16 shells, heights and turns. Shells are those of Gauss for the kernel's own weight; all weights
/// sum to 1.
/// Source  J. Albrecht, L. Collatz, "Zur numerischen Auswertung mehrdimensionaler Integrale", ZAMM
///         38 (1958), for the 32 directions; what such rules are worth: docs/theory.md, C.3.
std::vector<StencilPoint> stencil_points(int count);

/// The force with nodes out of a window. Places outside it count as free.
Wrench stencil_force(const std::vector<StencilPoint>& points, const FieldWindowView& window,
                     const haptics::ForceTool& tool, const haptics::ForceMaterial& material);

/// The same with the nodes at multiples of `voxel_mm`, each worked out when it is asked for.
Wrench stencil_force(const std::vector<StencilPoint>& points, const Distance& distance,
                     double voxel_mm, const haptics::ForceTool& tool,
                     const haptics::ForceMaterial& material);

}  // namespace argil::evaluation
