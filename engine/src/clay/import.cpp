// SPDX-License-Identifier: GPL-3.0-or-later
// Import measures the mesh at the nodes of the finest level and builds the coarser ones from it.
#include "argil/engine/import.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <exception>
#include <new>
#include <string>
#include <utility>

#include "clay/clay_access.h"
#include "edit/build_levels.h"
#include "import/import_field.h"
#include "import/machine_memory.h"

namespace argil {
namespace {

/// How far the input's vertices are from the clay, in index order.
void measure_vertices(const TriangleMesh& mesh, const Clay& clay, ImportReport& report) {
  std::vector<char> used(mesh.positions.size());
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) used[v] = 1;
  }
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (used[v] == 0) continue;
    const double distance = std::abs(clay.distance_at(mesh.positions[v]));
    report.max_vertex_distance_mm = std::max(report.max_vertex_distance_mm, distance);
    if (distance > clay.options().voxel_mm) ++report.lost_vertices;
  }
}

Result<ImportResult> import_checked(const TriangleMesh& mesh, const ClayOptions& options,
                                    const Progress& progress, std::uint64_t memory_limit_bytes) {
  auto input = prepare_import(mesh, options);
  if (!input) return input.error();
  assert(is_in_reach(input.value().center));
  if (auto ok = check_memory(input.value(), memory_limit_bytes); !ok) return ok.error();
  const std::uint64_t limit = memory_limit_bytes != 0 ? memory_limit_bytes : available_bytes();
  auto finest = build_finest_level(input.value(), progress, limit);
  if (!finest) return finest.error();
  ImportReport report;
  report.winding_bridged = !input.value().closed;
  report.bridged_nodes = finest.value().bridged_nodes;
  if (progress && !progress("levels", 0.0)) {
    return Error{ErrorKind::interrupted, "the import was interrupted"};
  }
  Clay clay = clay_of_levels(stack_from_finest(finest.value().grid, options), options);
  measure_vertices(mesh, clay, report);
  return ImportResult{std::move(clay), report};
}

}  // namespace

Result<ImportResult> import_mesh(const TriangleMesh& mesh_mm, const ClayOptions& options,
                                 const Progress& progress, std::uint64_t memory_limit_bytes) {
  try {
    return import_checked(mesh_mm, options, progress, memory_limit_bytes);
  } catch (const std::bad_alloc&) {
    return Error{ErrorKind::memory,
                 "the memory ran out while the mesh was imported; choose larger voxels"};
  } catch (const std::exception& fault) {
    return Error{ErrorKind::internal, std::string("importing the mesh failed inside a library: ") +
                                          fault.what() + "; please report it with the mesh"};
  }
}

}  // namespace argil
