// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/engine/clay.h"
#include "argil/mesh/decimate.h"

namespace argil::io {

/// mesh::decimate of the surface of a clay, held against the clay's field.
///
/// Shapes       surface: as extract_surface gives it, small components left out or not; `left_out`
///              as for measure_error (measure_error.h), both in doubles as extracted: with a bound,
///              components that were rounded to floats count as kept, and since the mesh does not
///              have them the answer is bad_input after all the work.
/// Errors       as mesh::decimate; with a bound bad_input, before anything is removed, where the
///              clay does not tell what was left out from what is beside it within one voxel: it
///              names the place.
/// Accuracy     max_error_mm is kept both ways, proven with 2 % in hand
///              (DecimateScenes.NeverExceedsTheErrorAsked).
/// Threads      as Clay.
Result<mesh::Decimated> decimate(const TriangleMesh& surface, const Clay& clay,
                                 const mesh::DecimateOptions& options,
                                 const TriangleMesh& left_out = {}, const Progress& progress = {});

}  // namespace argil::io
