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

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include "clay/clay_access.h"
#include "edit/build_levels.h"
#include "import/import_field.h"
#include "import/machine_memory.h"

namespace argil {
namespace {

/// How far vertices are from the clay; counts and maxima do not depend on their order.
struct VertexDistances {
  double most_mm = 0.0;
  std::int64_t lost = 0;
};

VertexDistances measured_vertices(const TriangleMesh& mesh, const Clay& clay) {
  std::vector<char> used(mesh.positions.size());
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) used[v] = 1;
  }
  constexpr std::size_t kGrain = 4096;
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, used.size(), kGrain), VertexDistances{},
      [&](const tbb::blocked_range<std::size_t>& range, VertexDistances found) {
        for (std::size_t v = range.begin(); v < range.end(); ++v) {
          if (used[v] == 0) continue;
          const double distance = std::abs(clay.distance_at(mesh.positions[v]));
          found.most_mm = std::max(found.most_mm, distance);
          if (distance > clay.options().voxel_mm) ++found.lost;
        }
        return found;
      },
      [](const VertexDistances& a, const VertexDistances& b) {
        return VertexDistances{std::max(a.most_mm, b.most_mm), a.lost + b.lost};
      });
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
  auto levels =
      stack_from_finest(std::exchange(finest.value().grid, nullptr), options, 1,
                        [&](double fraction) { return !progress || progress("levels", fraction); });
  if (levels == nullptr) return Error{ErrorKind::interrupted, "the import was interrupted"};
  Clay clay = clay_of_levels(std::move(levels), options);
  const VertexDistances vertices = measured_vertices(mesh, clay);
  report.lost_vertices = vertices.lost;
  report.max_vertex_distance_mm = vertices.most_mm;
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
