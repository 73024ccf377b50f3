// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "argil/core/triangle_mesh.h"
#include "argil/mesh/check.h"
#include "argil/mesh/edges.h"
#include "argil/mesh/printer.h"
#include "argil/mesh/wall_thickness.h"

namespace argil::mesh {

/// What a printer asks of a mesh beyond being sound.
struct PrintFindings {
  bool prints = true;
  std::int64_t cavities = 0;
  std::int64_t small_components = 0;
  double overhang_mm2 = 0.0;
  double min_wall_mm = -1.0;
  double min_gap_mm = -1.0;
  std::vector<MeshProblem> problems;
  std::vector<std::pair<std::uint32_t, Mark>> marks;  ///< triangles
};

/// mesh_parts over all edges, and part_volumes.
struct PartsAndVolumes {
  MeshParts parts;
  std::vector<double> volumes;
};
PrintFindings print_findings(const TriangleMesh& mesh, const EdgeTable& edges,
                             const PartsAndVolumes& parts, const Printer& printer,
                             std::int64_t file_bytes, const WallMeasure& walls, const Pace& pace);

}  // namespace argil::mesh
