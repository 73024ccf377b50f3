// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/engine/clay.h"
#include "argil/mesh/certificate.h"

namespace argil::io {

/// How far `mesh` and the clay lie apart.
///
/// Shapes       surface: the clay's surface as extract_surface gives it, without the components
///              that `mesh` shall not have; left_out: those, where the clay has points that do not
///              count. Neither rounded to floats: what was left out is known by the edges of the
///              lattice that vertices lie on, to a millionth of an edge, and what is rounded counts
///              as kept.
/// Errors       bad_input without triangles; interrupted.
/// Accuracy     within 5 % of dense sampling, also at sharp rims (ErrorCertificate*): points are
///              few where the error is small and dense where it may exceed the greatest found so
///              far.
/// Determinism  same bits for any number of threads.
/// Threads      as Clay; spreads over TBB.
/// Cost         about 5 us for each triangle of `surface`, 0.5 us where `mesh` has the same ones.
Result<mesh::MeshError> measure_error(const TriangleMesh& mesh, const TriangleMesh& surface,
                                      const Clay& clay, const TriangleMesh& left_out = {},
                                      const Progress& progress = {});

}  // namespace argil::io
