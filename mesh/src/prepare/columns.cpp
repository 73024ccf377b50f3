// SPDX-License-Identifier: GPL-3.0-or-later
// Vertical lines through a mesh: its triangles drawn onto the grid from above, as a screen draws
// them, but keeping every depth.
#include "prepare/columns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "argil/mesh/triangle_geometry.h"

namespace argil::mesh {
namespace {

/// Twice the area of a, b, p from above. Taken from the lower vertex to the higher, so that both
/// triangles at an edge get the same bits.
struct DrawnEdge {
  Vec3 a, b;
  double inner = 1.0;  ///< 1: the triangle lies to the left of a -> b

  DrawnEdge(const TriangleMesh& mesh, std::uint32_t from, std::uint32_t to, double turn)
      : a(mesh.positions[std::min(from, to)]),
        b(mesh.positions[std::max(from, to)]),
        inner(from < to ? turn : -turn) {}
  double at(double x, double y) const noexcept {
    return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
  }
  /// A line through the edge itself belongs to what lies to the left of it.
  static bool has(double value, double side) noexcept {
    return side > 0.0 ? value >= 0.0 : value < 0.0;
  }
};

}  // namespace

Columns::Columns(const TriangleMesh& mesh, double pitch_mm)
    : pitch_(pitch_mm), per_mm_(1.0 / pitch_mm) {
  assert(pitch_mm > 0.0);
  const Box3 box = bounds(mesh);
  // Off the round numbers on which flat sides of things lie.
  constexpr double kOffX = 0.318;
  constexpr double kOffY = 0.427;
  origin_ = box.min - Vec3{kOffX + 1.0, kOffY + 1.0, 0.0} * pitch_;
  columns_ = static_cast<int>(std::ceil(box.size().x / pitch_)) + 4;
  rows_ = static_cast<int>(std::ceil(box.size().y / pitch_)) + 4;
  std::vector<Crossing> found;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) cross(mesh, t, found);
  fill(found);
}

void Columns::cross(const TriangleMesh& mesh, std::uint32_t t, std::vector<Crossing>& found) const {
  const Corners c = corners_of(mesh, t);
  const auto [x_low, x_high] = std::minmax({c[0].x, c[1].x, c[2].x});
  const auto [y_low, y_high] = std::minmax({c[0].y, c[1].y, c[2].y});
  const int first_column = static_cast<int>(std::ceil((x_low - origin_.x) * per_mm_));
  const int last_column = static_cast<int>(std::floor((x_high - origin_.x) * per_mm_));
  const int first_row = static_cast<int>(std::ceil((y_low - origin_.y) * per_mm_));
  const int last_row = static_cast<int>(std::floor((y_high - origin_.y) * per_mm_));
  if (first_column > last_column || first_row > last_row) return;
  const double area = area_normal(c).z;
  if (area == 0.0) return;
  const double turn = area > 0.0 ? 1.0 : -1.0;
  const auto& [v0, v1, v2] = mesh.triangles[t];
  const std::array<DrawnEdge, 3> edges{DrawnEdge{mesh, v1, v2, turn}, DrawnEdge{mesh, v2, v0, turn},
                                       DrawnEdge{mesh, v0, v1, turn}};
  for (int row = first_row; row <= last_row; ++row) {
    for (int column = first_column; column <= last_column; ++column) {
      std::array<double, 3> weight{};
      bool is_inside = true;
      for (std::size_t e = 0; e < 3; ++e) {
        const double value = edges[e].at(x_of(column), y_of(row));
        is_inside = is_inside && DrawnEdge::has(value, edges[e].inner);
        weight[e] = std::abs(value);
      }
      const double sum = weight[0] + weight[1] + weight[2];
      if (!is_inside || sum == 0.0) continue;
      const double z = (weight[0] * c[0].z + weight[1] * c[1].z + weight[2] * c[2].z) / sum;
      found.push_back({number(column, row), z, t, area < 0.0});
    }
  }
}

void Columns::fill(std::vector<Crossing>& found) {
  std::sort(found.begin(), found.end(), [](const Crossing& a, const Crossing& b) {
    // At one height solid ends before it begins: parts that touch stay two.
    return std::tie(a.column, a.z, a.enters, a.triangle) <
           std::tie(b.column, b.z, b.enters, b.triangle);
  });
  const std::size_t count = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  first_.reserve(count + 1);
  std::size_t next = 0;
  for (std::size_t column = 0; column < count; ++column) {
    first_.push_back(spans_.size());
    int depth = 0;
    SolidSpan open;
    for (; next < found.size() && found[next].column == column; ++next) {
      const Crossing& at = found[next];
      depth += at.enters ? 1 : -1;
      if (at.enters && depth == 1) open = {at.z, at.z, at.triangle, at.triangle};
      if (at.enters || depth != 0) continue;
      open.high = at.z;
      open.high_triangle = at.triangle;
      if (open.high > open.low) spans_.push_back(open);
    }
  }
  first_.push_back(spans_.size());
}

std::size_t Columns::nearest(const Vec3& p) const noexcept {
  const double x = std::round((p.x - origin_.x) * per_mm_);
  const double y = std::round((p.y - origin_.y) * per_mm_);
  return number(static_cast<int>(std::clamp(x, 0.0, columns_ - 1.0)),
                static_cast<int>(std::clamp(y, 0.0, rows_ - 1.0)));
}

}  // namespace argil::mesh
