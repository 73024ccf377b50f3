// SPDX-License-Identifier: GPL-3.0-or-later
#include "repair/crumbs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "argil/mesh/compact.h"
#include "argil/mesh/edges.h"
#include "argil/mesh/triangle_geometry.h"

namespace argil::mesh {
namespace {

using CornerBits = std::array<std::array<double, 3>, 3>;

/// The least corner first, so that equal triangles compare equal.
CornerBits corner_bits(const TriangleMesh& mesh, std::size_t t) {
  CornerBits bits;
  const Corners corners = corners_of(mesh, t);
  for (std::size_t k = 0; k < 3; ++k) bits[k] = {corners[k].x, corners[k].y, corners[k].z};
  std::rotate(bits.begin(), std::min_element(bits.begin(), bits.end()), bits.end());
  return bits;
}

/// So small and flat that a component may be a crumb.
std::vector<bool> small_and_flat(const TriangleMesh& mesh, const MeshParts& parts) {
  constexpr double kMostVolume = 1e-6;     // of all
  constexpr double kMostThickness = 3e-4;  // of the diagonal
  const std::vector<double> volumes = part_volumes(mesh, parts);
  std::vector<double> areas(parts.count, 0.0);
  double volume = 0.0;
  for (const double of : volumes) volume += of;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (parts.of_triangle[t] == kNoPart) continue;
    areas[parts.of_triangle[t]] += triangle_area(corners_of(mesh, t));
  }
  const double thickness = kMostThickness * length(used_bounds(mesh).size());
  std::vector<bool> is_small;
  for (std::size_t n = 0; n < parts.count; ++n) {
    const double own = std::abs(volumes[n]);
    is_small.push_back(own < kMostVolume * volume && own < thickness * 0.5 * areas[n]);
  }
  return is_small;
}

}  // namespace

std::int64_t drop_crumbs(TriangleMesh& mesh, const TriangleMesh& given) {
  const MeshParts parts = mesh_parts(mesh, EdgeTable(mesh), false);
  std::vector<bool> goes = small_and_flat(mesh, parts);
  if (std::find(goes.begin(), goes.end(), true) == goes.end()) return 0;
  std::vector<CornerBits> known;
  for (std::size_t t = 0; t < given.triangles.size(); ++t) known.push_back(corner_bits(given, t));
  std::sort(known.begin(), known.end());
  std::vector<bool> has_new(parts.count, false);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t part = parts.of_triangle[t];
    if (part == kNoPart || !goes[part] || has_new[part]) continue;
    has_new[part] = !std::binary_search(known.begin(), known.end(), corner_bits(mesh, t));
  }
  for (std::size_t n = 0; n < goes.size(); ++n) goes[n] = goes[n] && has_new[n];
  const auto crumbs = std::count(goes.begin(), goes.end(), true);
  if (crumbs == 0) return 0;
  mesh = only_triangles(mesh, [&](std::size_t t) {
    return parts.of_triangle[t] == kNoPart || !goes[parts.of_triangle[t]];
  });
  return crumbs;
}

}  // namespace argil::mesh
