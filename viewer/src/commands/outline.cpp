// SPDX-License-Identifier: GPL-3.0-or-later
// What is cut away within a lasso is a prism, or with a perspective a frustum, which is closed at
// either end by a flat cone: whatever the outline, a cone over it does not cross itself, and it
// lies in the air before or behind the clay.
#include "commands/outline.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <memory>
#include <tuple>
#include <utility>

namespace argil::viewer {
namespace {

using Pixel = Camera::Pixel;
using Loop = std::vector<Pixel>;

constexpr double kStepPixels = 2.0;    // between the points of a lasso
constexpr double kOffPixels = 0.5;     // that a point may be off the line without it
constexpr double kLeastPixels2 = 1.0;  // of a loop

double turn_of(const Pixel& a, const Pixel& b, const Pixel& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double distance_of(const Pixel& a, const Pixel& b) { return std::hypot(b.x - a.x, b.y - a.y); }

/// Positive where it runs counter-clockwise with y down, as pixels have it.
double area_of(const Loop& loop) {
  double twice = 0.0;
  for (std::size_t n = 0; n < loop.size(); ++n) {
    const Pixel& a = loop[n];
    const Pixel& b = loop[(n + 1) % loop.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return 0.5 * twice;
}

/// Where two pieces cross, both ends left out of neither.
std::optional<Pixel> crossing(const Pixel& a, const Pixel& b, const Pixel& c, const Pixel& d) {
  const double from = turn_of(c, d, a);
  const double to = turn_of(c, d, b);
  const double one = turn_of(a, b, c);
  const double other = turn_of(a, b, d);
  if ((from > 0.0) == (to > 0.0) || (one > 0.0) == (other > 0.0)) return std::nullopt;
  const double t = from / (from - to);
  return Pixel{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

/// Leaves out points that the line does not need (Ramer, Douglas and Peucker).
void thin(const Loop& points, std::size_t first, std::size_t last, std::vector<char>& kept) {
  double most = kOffPixels;
  std::size_t farthest = first;
  const double length = distance_of(points[first], points[last]);
  for (std::size_t n = first + 1; n < last; ++n) {
    const double off = length > 0.0
                           ? std::abs(turn_of(points[first], points[last], points[n])) / length
                           : distance_of(points[first], points[n]);
    if (off <= most) continue;
    most = off;
    farthest = n;
  }
  if (farthest == first) return;
  kept[farthest] = 1;
  thin(points, first, farthest, kept);
  thin(points, farthest, last, kept);
}

Loop thinned(Loop points) {
  if (points.size() < 3) return points;
  std::vector<char> kept(points.size(), 0);
  kept.front() = kept.back() = 1;
  thin(points, 0, points.size() - 1, kept);
  Loop result;
  for (std::size_t n = 0; n < points.size(); ++n) {
    if (kept[n] != 0) result.push_back(points[n]);
  }
  return result;
}

/// The first piece of a path that a new one crosses, counted from its end, and where.
struct PathCrossing {
  std::size_t piece = 0;
  Pixel at;
};
std::optional<PathCrossing> last_crossing(const Loop& path, const Pixel& to) {
  std::optional<PathCrossing> nearest;
  double least = 0.0;
  for (std::size_t n = 0; n + 2 < path.size(); ++n) {
    const auto at = crossing(path.back(), to, path[n], path[n + 1]);
    if (!at) continue;
    const double far = distance_of(path.back(), *at);
    if (!nearest || far < least) {
      nearest = PathCrossing{n, *at};
      least = far;
    }
  }
  return nearest;
}

// ---- from pixels to the clay -------------------------------------------------------------------

/// The rotation that takes x, y and z to these axes.
Quat rotation_to(const Vec3& x, const Vec3& y, const Vec3& z) {
  const double w2 = 1.0 + x.x + y.y + z.z;
  const double x2 = 1.0 + x.x - y.y - z.z;
  const double y2 = 1.0 - x.x + y.y - z.z;
  const double z2 = 1.0 - x.x - y.y + z.z;
  // By the largest, so that nothing is divided by little.
  const double most = std::max({w2, x2, y2, z2});
  if (most == w2) return normalized(Quat{w2, y.z - z.y, z.x - x.z, x.y - y.x});
  if (most == x2) return normalized(Quat{y.z - z.y, x2, x.y + y.x, z.x + x.z});
  if (most == y2) return normalized(Quat{z.x - x.z, x.y + y.x, y2, y.z + z.y});
  return normalized(Quat{x.y - y.x, z.x + x.z, y.z + z.y, z2});
}

ViewFrame view_of(const Lens& lens) {
  return {lens.eye_mm, rotation_to(lens.right, lens.up, lens.back), lens.is_parallel};
}

PicturePoint picture_point(const WindowPart& part, const Lens& lens, const Pixel& pixel) {
  const Pixel inside = part.inside(pixel);
  return {(2.0 * inside.x / part.camera.width() - 1.0) * lens.tan_x,
          (1.0 - 2.0 * inside.y / part.camera.height()) * lens.tan_y};
}

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

/// The plane through two lines of sight. Its normal points to the right of whoever draws the line.
io::ScriptStep cut_along(const OutlineDrag& drag) {
  const Ray from = unplaced(drag.piece, drag.part.ray_at(drag.points[0]));
  const Ray to = unplaced(drag.piece, drag.part.ray_at(drag.points[1]));
  const Vec3 ahead = to.origin_mm + to.direction - from.origin_mm;
  Cut cut;
  cut.point_mm = from.origin_mm;
  cut.normal = normalized(cross(from.direction, ahead));
  cut.keeps_front = drag.is_inverse;
  return Operation(cut);
}

}  // namespace

void extend(OutlineDrag& drag, const Pixel& to) {
  assert(!drag.points.empty() && drag.form != DragForm::brush);
  if (drag.form == DragForm::lasso) {
    if (distance_of(drag.points.back(), to) >= kStepPixels) drag.points.push_back(to);
    return;
  }
  drag.points.resize(2);
  drag.points[1] = to;
}

std::vector<Pixel> outline_of(const OutlineDrag& drag) {
  if (drag.form != DragForm::box || drag.points.size() < 2) return drag.points;
  const auto& [a, b] = std::tie(drag.points[0], drag.points[1]);
  return {a, {b.x, a.y}, b, {a.x, b.y}};
}

std::vector<std::vector<Pixel>> simple_loops(std::vector<Pixel> points) {
  points = thinned(std::move(points));
  std::vector<Loop> loops;
  const auto keep = [&](Loop loop) {
    const double area = area_of(loop);
    if (loop.size() < 3 || std::abs(area) < kLeastPixels2) return;
    if (area > 0.0) std::reverse(loop.begin(), loop.end());
    loops.push_back(std::move(loop));
  };
  if (points.size() < 3) return loops;
  Loop path{points.front()};
  points.push_back(points.front());  // back to where it began
  for (std::size_t n = 1; n < points.size(); ++n) {
    // Each crossing on the way cuts off what was gone around since.
    while (const auto met = last_crossing(path, points[n])) {
      Loop around{met->at};
      around.insert(around.end(), path.begin() + static_cast<std::ptrdiff_t>(met->piece) + 1,
                    path.end());
      path.resize(met->piece + 1);
      path.push_back(met->at);
      keep(std::move(around));
    }
    path.push_back(points[n]);
  }
  path.pop_back();  // the first point once more
  keep(std::move(path));
  return loops;
}

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

namespace {

void append(const TriangleMesh& part, TriangleMesh& all) {
  const auto first = static_cast<std::uint32_t>(all.positions.size());
  all.positions.insert(all.positions.end(), part.positions.begin(), part.positions.end());
  for (const auto& [a, b, c] : part.triangles) {
    all.triangles.push_back({first + a, first + b, first + c});
  }
}

}  // namespace

std::optional<io::ScriptStep> step_of(const OutlineDrag& drag, const Box3& bounds_mm,
                                      bool front_only) {
  constexpr double kLeastLinePixels = 4.0;
  if (drag.points.size() < 2) return std::nullopt;
  if (drag.form == DragForm::line) {
    if (distance_of(drag.points[0], drag.points[1]) < kLeastLinePixels) return std::nullopt;
    return cut_along(drag);
  }
  const Lens lens = unplaced(drag.piece, drag.part.camera.lens({}));
  const ViewFrame view = view_of(lens);
  MaskOutline outline{view, {}, drag.is_inverse, front_only};
  for (const Loop& pixels : simple_loops(outline_of(drag))) {
    auto& loop = outline.loops.emplace_back();
    for (const Pixel& pixel : pixels) loop.push_back(picture_point(drag.part, lens, pixel));
  }
  if (outline.loops.empty()) return std::nullopt;
  if (!drag.is_trim) return io::ScriptStep(std::move(outline));
  auto solid = std::make_shared<TriangleMesh>();
  for (const auto& loop : outline.loops) append(solid_behind(view, loop, bounds_mm), *solid);
  if (solid->triangles.empty()) return std::nullopt;
  Combine with;
  with.kind = drag.is_inverse ? CombineKind::intersect : CombineKind::subtract;
  with.mesh = std::move(solid);
  return io::ScriptStep(Operation(std::move(with)));
}

}  // namespace argil::viewer
