// SPDX-License-Identifier: GPL-3.0-or-later
#include "repair/loose_sheets.h"

#include <algorithm>
#include <cstddef>

#include "argil/core/winding_number.h"
#include "argil/mesh/compact.h"
#include "argil/mesh/edges.h"

#include "repair/thicken.h"
#include "topology/point_grid.h"

namespace argil::mesh {
namespace {

constexpr double kMostOpen = 0.6;

struct OpenPart {
  double area = 0.0;
  double open_area = 0.0;
  double rim_mm = 0.0;  ///< length
  std::vector<std::uint32_t> rim;

  bool is_sheet() const noexcept { return open_area > kMostOpen * area; }
};

double area_of(const std::vector<Vec3>& positions, const Triangle& t) {
  const Vec3& p = positions[t[0]];
  return 0.5 * length(cross(positions[t[1]] - p, positions[t[2]] - p));
}

std::vector<OpenPart> open_parts(const TriangleMesh& mesh, const MeshParts& parts,
                                 const std::vector<Vec3>& positions,
                                 const std::vector<Triangle>& cones) {
  std::vector<OpenPart> found(parts.count);
  std::vector<std::uint32_t> part_of(mesh.positions.size(), kNoPart);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t part = parts.of_triangle[t];
    if (part == kNoPart) continue;
    found[part].area += area_of(mesh.positions, mesh.triangles[t]);
    for (const std::uint32_t v : mesh.triangles[t]) part_of[v] = part;
  }
  for (const Triangle& cone : cones) {
    OpenPart& part = found[part_of[cone[0]]];
    part.open_area += area_of(positions, cone);
    part.rim_mm += length(positions[cone[1]] - positions[cone[0]]);
    part.rim.push_back(cone[0]);
  }
  return found;
}

/// Whether a vertex of another part is near half of the rim.
bool is_beside_others(const TriangleMesh& mesh, const MeshParts& parts, std::uint32_t number,
                      const OpenPart& part) {
  constexpr double kRimEdges = 2.0;
  constexpr double kMostOfRim = 0.03;  // where its edges are few and long
  const double near =
      part.rim_mm * std::min(kMostOfRim, kRimEdges / static_cast<double>(part.rim.size()));
  std::vector<std::uint32_t> others;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (parts.of_triangle[t] == number) continue;
    others.insert(others.end(), mesh.triangles[t].begin(), mesh.triangles[t].end());
  }
  std::sort(others.begin(), others.end());
  others.erase(std::unique(others.begin(), others.end()), others.end());
  const PointGrid grid(mesh, others, near);
  const Vec3 around{near, near, near};
  const auto beside = std::count_if(part.rim.begin(), part.rim.end(), [&](std::uint32_t v) {
    const Vec3& p = mesh.positions[v];
    bool is_near = false;
    grid.for_box(p - around, p + around, [&](std::uint32_t other) {
      is_near = is_near || length(mesh.positions[other] - p) <= near;
    });
    return is_near;
  });
  return 2 * beside > std::ssize(part.rim);
}

}  // namespace

bool has_sheets(const TriangleMesh& mesh, const std::vector<Vec3>& positions,
                const std::vector<Triangle>& cones) {
  const MeshParts parts = mesh_parts(mesh, EdgeTable(mesh), false);
  const std::vector<OpenPart> open = open_parts(mesh, parts, positions, cones);
  return std::any_of(open.begin(), open.end(), [](const OpenPart& p) { return p.is_sheet(); });
}

bool is_open_sheets(const TriangleMesh& mesh) {
  constexpr std::size_t kFew = 16;  // more may be patches of a body
  std::vector<Vec3> positions = mesh.positions;
  const std::vector<Triangle> cones = boundary_cones(positions, mesh.triangles);
  const EdgeTable edges(mesh);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (edges.uses(e).size() > 2) return false;
  }
  const MeshParts parts = mesh_parts(mesh, edges, false);
  const std::vector<OpenPart> open = open_parts(mesh, parts, positions, cones);
  if (open.empty() || open.size() > kFew) return false;
  for (std::uint32_t n = 0; n < open.size(); ++n) {
    // Of many small holes too the edges are long, but cones over them are small.
    const bool is_one = open[n].is_sheet() && is_sheet_by_rim(open[n].rim_mm, open[n].area);
    if (!is_one || is_beside_others(mesh, parts, n, open[n])) return false;
  }
  return true;
}

std::int64_t drop_loose_sheets(TriangleMesh& mesh) {
  constexpr std::int64_t kMostSheets = 64;  // more are a soup of triangles
  std::vector<Vec3> positions = mesh.positions;
  const std::vector<Triangle> cones = boundary_cones(positions, mesh.triangles);
  const MeshParts parts = mesh_parts(mesh, EdgeTable(mesh), false);
  const std::vector<OpenPart> open = open_parts(mesh, parts, positions, cones);
  const auto is_sheet = [](const OpenPart& part) { return part.is_sheet(); };
  const std::int64_t sheets = std::count_if(open.begin(), open.end(), is_sheet);
  if (sheets == 0 || sheets > kMostSheets || sheets == std::ssize(open)) return 0;
  std::vector<bool> goes(parts.count, false);
  for (std::uint32_t n = 0; n < parts.count; ++n) {
    goes[n] = open[n].is_sheet() && !is_beside_others(mesh, parts, n, open[n]);
  }
  mesh = only_triangles(mesh, [&](std::size_t t) {
    return parts.of_triangle[t] == kNoPart || !goes[parts.of_triangle[t]];
  });
  return std::count(goes.begin(), goes.end(), true);
}

}  // namespace argil::mesh
