// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "argil/core/triangle_mesh.h"

namespace argil::evaluation {

/// CGAL's alpha_wrap_3: a closed mesh around the triangles, whatever they are, `offset_mm` away
/// from them, that enters no gap narrower than twice `alpha_mm`. Both above 0. One thread.
TriangleMesh cgal_wrapped(const TriangleMesh& mesh_mm, double alpha_mm, double offset_mm);

/// CGAL's corefinement: the union of two closed meshes that do not cross themselves, exact but for
/// the rounding of new vertices. None where they are not two-manifolds to CGAL or the union is not.
/// One thread.
std::optional<TriangleMesh> cgal_united(const TriangleMesh& a, const TriangleMesh& b);

}  // namespace argil::evaluation
