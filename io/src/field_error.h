// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "argil/core/triangle_mesh.h"
#include "argil/engine/clay.h"
#include "argil/io/certificate.h"

#include "pace.h"

namespace argil::io {

/// A place where mesh and clay lie farther apart than they may, and how wide what is wrong there
/// may reach.
struct FarPlace {
  Vec3 at_mm;
  double size_mm = 0.0;
};

/// What measure_error says; with `bound_mm` > 0 also appends the places found beyond it to `far`:
/// all kinds of them, but not each one. Throws Interrupted.
MeshError field_error(const TriangleMesh& mesh, const TriangleMesh& surface, const Clay& clay,
                      const TriangleMesh& left_out, double bound_mm, std::vector<FarPlace>& far,
                      const Pace& pace);

}  // namespace argil::io
