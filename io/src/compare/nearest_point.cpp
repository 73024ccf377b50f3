// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/nearest_point.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "argil/engine/mesh_distance.h"

namespace argil::io {

double farthest_from(const TriangleMesh& mesh, const std::vector<Vec3>& points) {
  if (mesh.triangles.empty() || points.empty()) return 0.0;
  const MeshDistance surface(mesh.positions, mesh.triangles);
  std::vector<double> distances(points.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size()), [&](const auto& range) {
    std::uint32_t near = kNoTriangle;  // of the point before, which is likely a neighbour
    for (std::size_t n = range.begin(); n != range.end(); ++n) {
      const MeshDistance::Closest closest =
          surface.closest(points[n], std::numeric_limits<double>::infinity(), near);
      near = closest.triangle;
      distances[n] = closest.distance;
    }
  });
  assert(*std::min_element(distances.begin(), distances.end()) >= 0.0);
  return *std::max_element(distances.begin(), distances.end());
}

}  // namespace argil::io
