// SPDX-License-Identifier: GPL-3.0-or-later
// What is cut away within a lasso is a prism, or with a perspective a frustum, which is closed at
// either end by a flat cone: whatever the outline, a cone over it does not cross itself, and it
// lies in the air before or behind the clay.
#include "picture/outline_trim.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

namespace argil::viewer {
namespace {

/// How a box looks in a view.
struct SeenBox {
  double near_mm = 0.0;
  double far_mm = 0.0;
  PicturePoint low{1e6, 1e6};
  PicturePoint high{-1e6, -1e6};
};

/// Where part of it lies beside or behind the eye it is seen everywhere.
SeenBox seen_box(const ViewFrame& view, const Box3& box) {
  SeenBox seen{1e30, -1e30, {1e6, 1e6}, {-1e6, -1e6}};
  const Quat to_view = conjugate(normalized(view.orientation));
  for (unsigned n = 0; n < 8; ++n) {
    const Vec3 corner{(n & 1U) != 0 ? box.max.x : box.min.x, (n & 2U) != 0 ? box.max.y : box.min.y,
                      (n & 4U) != 0 ? box.max.z : box.min.z};
    const Vec3 p = rotate(to_view, corner - view.eye_mm);
    seen.near_mm = std::min(seen.near_mm, -p.z);
    seen.far_mm = std::max(seen.far_mm, -p.z);
    const double over = view.is_parallel ? 1.0 : std::max(-p.z, 1e-6 * length(p));
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double at = std::clamp(p[axis] / over, -1e6, 1e6);
      seen.low[axis] = std::min(seen.low[axis], at);
      seen.high[axis] = std::max(seen.high[axis], at);
    }
  }
  return seen;
}

/// What of a loop lies on one side of a line along an axis (Sutherland and Hodgman).
std::vector<PicturePoint> clipped(const std::vector<PicturePoint>& loop, std::size_t axis,
                                  double limit, double sign) {
  std::vector<PicturePoint> kept;
  for (std::size_t n = 0; n < loop.size(); ++n) {
    const PicturePoint& a = loop[n];
    const PicturePoint& b = loop[(n + 1) % loop.size()];
    const double da = sign * (limit - a[axis]);
    const double db = sign * (limit - b[axis]);
    if (da >= 0.0) kept.push_back(a);
    if ((da >= 0.0) == (db >= 0.0)) continue;
    const double t = da / (da - db);
    kept.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
  }
  return kept;
}

void append_solid(const TriangleMesh& part, TriangleMesh& all) {
  const auto first = static_cast<std::uint32_t>(all.positions.size());
  all.positions.insert(all.positions.end(), part.positions.begin(), part.positions.end());
  for (const auto& [a, b, c] : part.triangles) {
    all.triangles.push_back({first + a, first + b, first + c});
  }
}

/// What a view shows within a loop, as a closed mesh from before the box until behind it; empty
/// where it shows nothing of the box there.
TriangleMesh solid_behind(const ViewFrame& view, const std::vector<PicturePoint>& loop,
                          const Box3& bounds_mm) {
  TriangleMesh mesh;
  if (bounds_mm.empty()) return mesh;
  // Some air around, in which the ends lie.
  Box3 box = bounds_mm;
  const double margin = 0.05 * length(box.size());
  box.min -= Vec3{margin, margin, margin};
  box.max += Vec3{margin, margin, margin};
  const SeenBox seen = seen_box(view, box);
  std::vector<PicturePoint> outline = loop;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    outline = clipped(outline, axis, seen.high[axis], 1.0);
    outline = clipped(outline, axis, seen.low[axis], -1.0);
  }
  const double least = view.is_parallel ? -1e30 : 1e-3 * std::abs(seen.far_mm);
  const double near = std::max(seen.near_mm, least);
  if (outline.size() < 3 || seen.far_mm <= near) return mesh;
  const Quat to_clay = normalized(view.orientation);
  const auto at = [&](double x, double y, double depth) {
    const double over = view.is_parallel ? 1.0 : depth;
    return view.eye_mm + rotate(to_clay, Vec3{over * x, over * y, -depth});
  };
  PicturePoint middle{0.0, 0.0};
  for (const PicturePoint& p : outline) {
    mesh.positions.push_back(at(p[0], p[1], near));
    mesh.positions.push_back(at(p[0], p[1], seen.far_mm));
    for (std::size_t axis = 0; axis < 2; ++axis) {
      middle[axis] += p[axis] / static_cast<double>(outline.size());
    }
  }
  const auto apex = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.push_back(at(middle[0], middle[1], view.is_parallel ? near - margin : 0.5 * near));
  mesh.positions.push_back(at(middle[0], middle[1], seen.far_mm + margin));
  for (std::uint32_t n = 0; n < apex; n += 2) {
    const std::uint32_t next = (n + 2) % apex;
    mesh.triangles.push_back({n, next, apex});
    mesh.triangles.push_back({n, n + 1, next + 1});
    mesh.triangles.push_back({n, next + 1, next});
    mesh.triangles.push_back({n + 1, apex + 1, next + 1});
  }
  return mesh;
}

}  // namespace

std::optional<Combine> combine_of(const OutlineTrim& trim, const Box3& bounds_mm) {
  auto solid = std::make_shared<TriangleMesh>();
  for (const auto& loop : trim.loops)
    append_solid(solid_behind(trim.view, loop, bounds_mm), *solid);
  if (solid->triangles.empty()) return std::nullopt;
  Combine with;
  with.kind = trim.keeps_within ? CombineKind::intersect : CombineKind::subtract;
  with.mesh = std::move(solid);
  return with;
}

}  // namespace argil::viewer
