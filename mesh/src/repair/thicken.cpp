// SPDX-License-Identifier: GPL-3.0-or-later
#include "repair/thicken.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "argil/mesh/bodies.h"
#include "argil/mesh/compact.h"
#include "argil/mesh/edges.h"
#include "argil/mesh/triangle_geometry.h"

#include "repair/orient.h"

namespace argil::mesh {
namespace {

/// Whether a mesh of one part has so much rim that it is a sheet.
bool is_sheet(const TriangleMesh& part, const EdgeTable& edges) {
  double rim = 0.0;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto uses = edges.uses(e);
    if (uses.size() != 1) continue;
    rim += length(part.positions[edges.to(uses[0])] - part.positions[edges.from(uses[0])]);
  }
  return is_sheet_by_rim(rim, surface_area(part));
}

/// The sums over the triangles at a vertex that its offset is told by.
struct AroundVertex {
  Vec3 normal;                                    ///< by angle
  std::array<std::array<double, 3>, 3> square{};  ///< normals times themselves, by angle
  Vec3 beyond;                                    ///< away from the sheet, of its open edges

  void add(const Vec3& n, double angle) {
    normal += angle * n;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) square[i][j] += angle * n[i] * n[j];
    }
  }
  Vec3 offset() const;
};

Vec3 times(const std::array<std::array<double, 3>, 3>& m, const Vec3& v) {
  Vec3 product;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) product[i] += m[i][j] * v[j];
  }
  return product;
}

/// Cramer's rule; the matrix is symmetric and positive definite.
Vec3 solved(const std::array<std::array<double, 3>, 3>& m, const Vec3& right) {
  const Vec3 x{m[0][0], m[1][0], m[2][0]};
  const Vec3 y{m[0][1], m[1][1], m[2][1]};
  const Vec3 z{m[0][2], m[1][2], m[2][2]};
  const double whole = dot(x, cross(y, z));
  return Vec3{dot(right, cross(y, z)), dot(x, cross(right, z)), dot(x, cross(y, right))} / whole;
}

/// By which a step of 1 leaves all its triangles 1 behind, as nearly as one step can; the mean
/// normal where they do not tell a direction.
Vec3 AroundVertex::offset() const {
  constexpr double kFarthest = 3.0;
  constexpr double kUndecided = 1e-3;  // of the angles
  const Vec3 mean = normalized(normal);
  if (mean == Vec3{}) return mean;
  std::array<std::array<double, 3>, 3> regular = square;
  const double trace = square[0][0] + square[1][1] + square[2][2];
  for (std::size_t i = 0; i < 3; ++i) regular[i][i] += kUndecided * trace;
  const Vec3 found = mean + solved(regular, normal - times(square, mean));
  const double far = length(found);
  return far > kFarthest ? found * (kFarthest / far) : found;
}

/// One sheet, oriented alike, becoming a solid.
class ThickenedSheet {
 public:
  ThickenedSheet(const TriangleMesh& part, const EdgeTable& edges, const Thickening& how);

  TriangleMesh solid() &&;

 private:
  void add_sides();
  void add_rim(HalfEdge h);
  /// Vertices from one side to the other at a vertex of the rim, both ends included.
  const std::vector<std::uint32_t>& across(std::uint32_t v);
  std::uint32_t top(std::uint32_t v) const noexcept { return v; }
  std::uint32_t bottom(std::uint32_t v) const noexcept {
    return v + static_cast<std::uint32_t>(part_.positions.size());
  }

  const TriangleMesh& part_;
  const EdgeTable& edges_;
  const Thickening& how_;
  std::vector<AroundVertex> around_;
  std::vector<std::vector<std::uint32_t>> across_;
  TriangleMesh solid_;
};

ThickenedSheet::ThickenedSheet(const TriangleMesh& part, const EdgeTable& edges,
                               const Thickening& how)
    : part_(part),
      edges_(edges),
      how_(how),
      around_(part.positions.size()),
      across_(part.positions.size()) {
  for (std::size_t t = 0; t < part.triangles.size(); ++t) {
    const Corners corners = corners_of(part, t);
    const Vec3 normal = normalized(area_normal(corners));
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 on = corners[(k + 1) % 3] - corners[k];
      const Vec3 back = corners[(k + 2) % 3] - corners[k];
      const double angle = std::atan2(length(cross(on, back)), dot(on, back));
      around_[part.triangles[t][k]].add(normal, angle);
    }
    for (HalfEdge h = static_cast<HalfEdge>(3 * t); h < 3 * t + 3; ++h) {
      if (edges.uses(edges.edge_of(h)).size() != 1) continue;
      const Vec3 along = part.positions[edges.to(h)] - part.positions[edges.from(h)];
      const Vec3 beyond = normalized(cross(along, normal));
      around_[edges.from(h)].beyond += beyond;
      around_[edges.to(h)].beyond += beyond;
    }
  }
}

void ThickenedSheet::add_sides() {
  const double up = how_.inward ? 0.0 : 0.5 * how_.thickness_mm;
  const double down = up - how_.thickness_mm;
  const std::size_t count = part_.positions.size();
  solid_.positions.resize(2 * count);
  for (std::size_t v = 0; v < count; ++v) {
    const Vec3 offset = around_[v].offset();
    solid_.positions[v] = part_.positions[v] + up * offset;
    solid_.positions[v + count] = part_.positions[v] + down * offset;
  }
  for (const auto& [a, b, c] : part_.triangles) {
    solid_.triangles.push_back({top(a), top(b), top(c)});
    solid_.triangles.push_back({bottom(a), bottom(c), bottom(b)});
  }
}

const std::vector<std::uint32_t>& ThickenedSheet::across(std::uint32_t v) {
  constexpr int kSteps = 8;
  std::vector<std::uint32_t>& line = across_[v];
  if (!line.empty()) return line;
  line.push_back(top(v));
  if (how_.rim == SheetRim::round) {
    const Vec3 upper = solid_.positions[top(v)];
    const Vec3 lower = solid_.positions[bottom(v)];
    const Vec3 middle = 0.5 * (upper + lower);
    const Vec3 beyond = normalized(around_[v].beyond) * (0.5 * length(upper - lower));
    for (int n = 1; n < kSteps; ++n) {
      const double angle = std::numbers::pi * n / kSteps;
      line.push_back(static_cast<std::uint32_t>(solid_.positions.size()));
      solid_.positions.push_back(middle + std::cos(angle) * (upper - middle) +
                                 std::sin(angle) * beyond);
    }
  }
  line.push_back(bottom(v));
  return line;
}

/// Seen from beyond the rim the upper side is left by the open edge from its begin to its end.
void ThickenedSheet::add_rim(HalfEdge h) {
  const std::vector<std::uint32_t> from = across(edges_.from(h));
  const std::vector<std::uint32_t> to = across(edges_.to(h));
  for (std::size_t n = 0; n + 1 < from.size(); ++n) {
    solid_.triangles.push_back({to[n], from[n], from[n + 1]});
    solid_.triangles.push_back({to[n], from[n + 1], to[n + 1]});
  }
}

TriangleMesh ThickenedSheet::solid() && {
  add_sides();
  for (HalfEdge h = 0; h < 3 * part_.triangles.size(); ++h) {
    if (edges_.uses(edges_.edge_of(h)).size() == 1) add_rim(h);
  }
  return std::move(solid_);
}

void append_mesh(const TriangleMesh& from, TriangleMesh& to) {
  const auto base = static_cast<std::uint32_t>(to.positions.size());
  to.positions.insert(to.positions.end(), from.positions.begin(), from.positions.end());
  for (const auto& [a, b, c] : from.triangles)
    to.triangles.push_back({a + base, b + base, c + base});
}

}  // namespace

bool is_sheet_by_rim(double rim_mm, double area_mm2) {
  constexpr double kLeast = 0.25;
  return rim_mm > 0.0 && rim_mm * rim_mm >= kLeast * 4.0 * std::numbers::pi * area_mm2;
}

std::int64_t thicken_sheets(TriangleMesh& mesh, const Thickening& how) {
  assert(how.thickness_mm > 0.0);
  const EdgeTable all(mesh);
  const MeshParts parts = mesh_parts(mesh, all, true);
  orient_alike(mesh, all, parts);
  const auto is_whole = [&](std::size_t t) { return parts.of_triangle[t] != kNoPart; };
  std::vector<std::uint32_t> of_triangle = parts.of_triangle;
  of_triangle.erase(std::remove(of_triangle.begin(), of_triangle.end(), kNoPart),
                    of_triangle.end());
  std::int64_t thickened = 0;
  TriangleMesh made;
  for (const TriangleMesh& part : split_mesh(only_triangles(mesh, is_whole), of_triangle)) {
    const EdgeTable edges(part);
    const bool is_thin = is_sheet(part, edges);
    append_mesh(is_thin ? ThickenedSheet(part, edges, how).solid() : part, made);
    thickened += is_thin ? 1 : 0;
  }
  if (thickened > 0) mesh = std::move(made);
  return thickened;
}

}  // namespace argil::mesh
