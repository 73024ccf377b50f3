// SPDX-License-Identifier: GPL-3.0-or-later
#include "repair/loose_sheets.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "argil/core/winding_number.h"
#include "argil/mesh/compact.h"
#include "argil/mesh/edges.h"
#include "argil/mesh/triangle_geometry.h"

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

std::vector<OpenPart> open_parts(const TriangleMesh& mesh, const MeshParts& parts,
                                 const std::vector<Vec3>& positions,
                                 const std::vector<Triangle>& cones) {
  std::vector<OpenPart> found(parts.count);
  std::vector<std::uint32_t> part_of(mesh.positions.size(), kNoPart);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t part = parts.of_triangle[t];
    if (part == kNoPart) continue;
    found[part].area += triangle_area(corners_of(mesh, t));
    for (const std::uint32_t v : mesh.triangles[t]) part_of[v] = part;
  }
  for (const Triangle& cone : cones) {
    OpenPart& part = found[part_of[cone[0]]];
    part.open_area += triangle_area({positions[cone[0]], positions[cone[1]], positions[cone[2]]});
    part.rim_mm += length(positions[cone[1]] - positions[cone[0]]);
    part.rim.push_back(cone[0]);
  }
  return found;
}

/// Finds the vertices of other parts around a part.
class OtherParts {
 public:
  OtherParts(const TriangleMesh& mesh, const MeshParts& parts)
      : mesh_(mesh), part_of_(mesh.positions.size(), kNoPart), grid_(note(parts)) {}

  /// Whether one is near half of the rim.
  bool are_beside(std::uint32_t number, const OpenPart& part) const;

 private:
  static constexpr std::uint32_t kSeveral = kNoPart - 1;
  PointGrid note(const MeshParts& parts);

  const TriangleMesh& mesh_;
  std::vector<std::uint32_t> part_of_;  ///< of each vertex; kSeveral where they touch
  PointGrid grid_;
};

PointGrid OtherParts::note(const MeshParts& parts) {
  std::vector<std::uint32_t> named;
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh_.triangles[t]) {
      if (part_of_[v] == kNoPart) named.push_back(v);
      const bool is_first = part_of_[v] == kNoPart || part_of_[v] == parts.of_triangle[t];
      part_of_[v] = is_first ? parts.of_triangle[t] : kSeveral;
    }
  }
  std::sort(named.begin(), named.end());
  named.erase(std::unique(named.begin(), named.end()), named.end());
  const double diagonal = length(used_bounds(mesh_).size());
  return {mesh_, named, diagonal / std::cbrt(static_cast<double>(named.size() + 1))};
}

bool OtherParts::are_beside(std::uint32_t number, const OpenPart& part) const {
  constexpr double kRimEdges = 2.0;
  constexpr double kMostOfRim = 0.03;  // where its edges are few and long
  const double near =
      part.rim_mm * std::min(kMostOfRim, kRimEdges / static_cast<double>(part.rim.size()));
  const Vec3 around{near, near, near};
  const auto beside = std::count_if(part.rim.begin(), part.rim.end(), [&](std::uint32_t v) {
    const Vec3& p = mesh_.positions[v];
    bool is_near = false;
    grid_.for_box(p - around, p + around, [&](std::uint32_t other) {
      is_near =
          is_near || (part_of_[other] != number && length(mesh_.positions[other] - p) <= near);
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
  const OtherParts others(mesh, parts);
  for (std::uint32_t n = 0; n < open.size(); ++n) {
    // Of many small holes too the edges are long, but cones over them are small.
    const bool is_one = open[n].is_sheet() && is_sheet_by_rim(open[n].rim_mm, open[n].area);
    if (!is_one || others.are_beside(n, open[n])) return false;
  }
  return true;
}

std::int64_t drop_loose_sheets(TriangleMesh& mesh, const Pace& pace) {
  constexpr std::int64_t kFewSheets = 64;
  // More of all area in many sheets is a soup of triangles, beside a sound body and an open one.
  constexpr double kMostBesideClosed = 0.9;
  constexpr double kMostBesideOpen = 0.5;
  constexpr std::uint32_t kAtATime = 256;
  std::vector<Vec3> positions = mesh.positions;
  const std::vector<Triangle> cones = boundary_cones(positions, mesh.triangles);
  const MeshParts parts = mesh_parts(mesh, EdgeTable(mesh), false);
  const std::vector<OpenPart> open = open_parts(mesh, parts, positions, cones);
  double all_area = 0.0;
  double sheet_area = 0.0;
  for (const OpenPart& part : open) {
    all_area += part.area;
    sheet_area += part.is_sheet() ? part.area : 0.0;
  }
  const auto is_sheet = [](const OpenPart& part) { return part.is_sheet(); };
  const std::int64_t sheets = std::count_if(open.begin(), open.end(), is_sheet);
  const bool has_open_body = std::any_of(open.begin(), open.end(), [](const OpenPart& part) {
    return !part.is_sheet() && !part.rim.empty();
  });
  const double most_of_area = has_open_body ? kMostBesideOpen : kMostBesideClosed;
  const bool is_soup = sheets > kFewSheets && sheet_area > most_of_area * all_area;
  if (sheets == 0 || sheets == std::ssize(open) || is_soup) return 0;
  const OtherParts others(mesh, parts);
  std::vector<bool> goes(parts.count, false);
  for (std::uint32_t n = 0; n < parts.count; ++n) {
    if (n % kAtATime == 0) pace.at(0.0);
    goes[n] = open[n].is_sheet() && !others.are_beside(n, open[n]);
  }
  mesh = only_triangles(mesh, [&](std::size_t t) {
    return parts.of_triangle[t] == kNoPart || !goes[parts.of_triangle[t]];
  });
  return std::count(goes.begin(), goes.end(), true);
}

}  // namespace argil::mesh
