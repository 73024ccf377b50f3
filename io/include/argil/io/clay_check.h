// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/engine/clay.h"
#include "argil/mesh/check.h"
#include "argil/mesh/printer.h"

namespace argil::io {

struct ClayVerdict {
  TriangleMesh mesh;  ///< what was judged: the whole surface as an export would write it
  mesh::MeshVerdict verdict;
  std::int64_t removed_components = 0;  ///< as in ExportReport
};

/// Judges clay as check_print judges the mesh that export_mesh would write of its whole surface,
/// without a file. Walls are measured in the field, not between triangles: from each triangle's
/// middle along the inward gradient to the next change of sign.
///
/// Errors   bad_input when there is no clay; interrupted; memory.
/// Threads  as Clay; spreads over TBB. Same figures for any number of threads.
/// Cost     about 3 us for each triangle of the surface; walls 3 to 11 us more, thick ones most.
Result<ClayVerdict> check_clay(const Clay& clay, const mesh::Printer& printer,
                               const Progress& progress = {});

}  // namespace argil::io
