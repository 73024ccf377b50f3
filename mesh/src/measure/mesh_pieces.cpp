// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/mesh_pieces.h"

#include <algorithm>
#include <cassert>

#include "topology/repeated_triangles.h"

namespace argil::mesh {
namespace {

/// Two for each square of a step, or for each step where the triangle is lower than that.
double pieces_of(const Corners& corners, double step_mm) {
  if (!is_longer_than_a_part(corners, step_mm)) return 1.0;
  const double side = longest_side(corners);
  const double height = length(area_normal(corners)) / side;
  return 2.0 * side / step_mm * std::max(1.0, height / step_mm);
}

}  // namespace

double step_for(const TriangleMesh& mesh, double step_mm, double most) {
  assert(step_mm > 0.0 && most > 0.0);
  constexpr double kMore = 1.25;
  for (double step = step_mm;; step *= kMore) {
    double count = 0.0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const double pieces = pieces_of(corners_of(mesh, t), step);
      if (pieces > 1.0) count += pieces;
    }
    if (count <= most) return step;
  }
}

MeshPieces::MeshPieces(const TriangleMesh& mesh, double step_mm, double most) : mesh_(mesh) {
  const double step = step_for(mesh, step_mm, most);
  std::vector<bool> is_repeated(mesh.triangles.size(), false);
  for (const std::uint32_t t : repeated_triangles(mesh)) is_repeated[t] = true;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (is_repeated[t]) continue;
    const Corners corners = corners_of(mesh, t);
    if (!is_longer_than_a_part(corners, step)) {
      whole_.push_back(t);
    } else {
      for_each_part(corners, step, [&](const Corners& part) { pieces_.push_back({t, part}); });
    }
  }
  whole_count_ = whole_.size();
  if (whole_count_ == mesh.triangles.size()) whole_ = {};
}

}  // namespace argil::mesh
