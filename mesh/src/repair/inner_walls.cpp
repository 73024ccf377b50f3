// SPDX-License-Identifier: GPL-3.0-or-later
#include "repair/inner_walls.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "argil/core/winding_number.h"
#include "argil/mesh/compact.h"
#include "argil/mesh/edges.h"
#include "argil/mesh/triangle_geometry.h"

namespace argil::mesh {
namespace {

/// A part of the surface, cut where three or more triangles meet.
struct WallSheet {
  bool is_candidate = true;  ///< closed but for edges where two others meet
  bool has_rim = false;
  std::uint32_t largest = 0;  ///< triangle
  double area = -1.0;
};

std::vector<WallSheet> wall_sheets(const TriangleMesh& mesh, const EdgeTable& edges,
                                   const MeshParts& parts) {
  std::vector<WallSheet> sheets(parts.count);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (parts.of_triangle[t] == kNoPart) continue;
    WallSheet& sheet = sheets[parts.of_triangle[t]];
    const double area = length(area_normal(corners_of(mesh, t)));
    if (area > sheet.area) {
      sheet.largest = t;
      sheet.area = area;
    }
  }
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto uses = edges.uses(e);
    if (uses.size() == 2) continue;
    std::vector<std::uint32_t> here;
    for (const HalfEdge h : uses) here.push_back(parts.of_triangle[triangle_of(h)]);
    for (const std::uint32_t part : here) {
      sheets[part].has_rim = true;
      const auto own = std::count(here.begin(), here.end(), part);
      if (uses.size() != 3 || own != 1) sheets[part].is_candidate = false;
    }
  }
  return sheets;
}

/// How often what hangs together with a sheet winds around the middle of it. Of three sheets at a
/// rim the wall is the one that the other two enclose, whether that is matter or a cavity.
double winding_of_the_rest(const TriangleMesh& mesh, const MeshParts& parts, const MeshParts& whole,
                           std::uint32_t part, std::uint32_t largest) {
  std::vector<Triangle> rest;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const bool hangs_together = whole.of_triangle[t] == whole.of_triangle[largest];
    if (hangs_together && parts.of_triangle[t] != part) rest.push_back(mesh.triangles[t]);
  }
  const WindingNumber winding(mesh.positions, rest);
  return std::abs(winding.at(middle(corners_of(mesh, largest))));
}

/// The sheet that the others enclose most, which is dropped first; kNoPart where they enclose none.
std::uint32_t innermost(const TriangleMesh& mesh, const EdgeTable& edges, const MeshParts& parts,
                        const Pace& pace) {
  constexpr std::size_t kMostAsked = 2'000'000;  // triangles, a second or two
  const std::vector<WallSheet> sheets = wall_sheets(mesh, edges, parts);
  const MeshParts whole = mesh_parts(mesh, edges, false);
  std::vector<std::uint32_t> candidates;
  for (std::uint32_t n = 0; n < sheets.size(); ++n) {
    if (sheets[n].is_candidate && sheets[n].has_rim) candidates.push_back(n);
  }
  if (candidates.size() * candidates.size() * mesh.triangles.size() > kMostAsked) return kNoPart;
  double most = 0.5;
  std::uint32_t found = kNoPart;
  for (const std::uint32_t n : candidates) {
    pace.at(0.0);
    const double winding = winding_of_the_rest(mesh, parts, whole, n, sheets[n].largest);
    if (winding <= most) continue;
    most = winding;
    found = n;
  }
  return found;
}

}  // namespace

std::int64_t drop_inner_walls(TriangleMesh& mesh, const Pace& pace) {
  const std::size_t before = mesh.triangles.size();
  while (true) {
    const EdgeTable edges(mesh);
    const MeshParts parts = mesh_parts(mesh, edges, true);
    const std::uint32_t wall = innermost(mesh, edges, parts, pace);
    if (wall == kNoPart) break;
    mesh = only_triangles(mesh, [&](std::size_t t) { return parts.of_triangle[t] != wall; });
  }
  return static_cast<std::int64_t>(before - mesh.triangles.size());
}

}  // namespace argil::mesh
