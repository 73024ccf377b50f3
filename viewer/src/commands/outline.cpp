// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/outline.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "commands/stroke_mode.h"

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

/// The plane through two lines of sight. Its normal points to the right of whoever draws the line.
Operation cut_along(const OutlineDrag& drag) {
  const Ray from = unplaced(drag.piece, drag.part.ray_at(drag.points[0]));
  const Ray to = unplaced(drag.piece, drag.part.ray_at(drag.points[1]));
  const Vec3 ahead = to.origin_mm + to.direction - from.origin_mm;
  Cut cut;
  cut.point_mm = from.origin_mm;
  cut.normal = normalized(cross(from.direction, ahead));
  cut.keeps_front = drag.is_inverse;
  return cut;
}

/// A ring around a picture.
struct WindowRing {
  Pixel middle;
  double radius = 0.0;

  /// Where a ray from within leaves it, as an angle, and the point there.
  double angle_of(const Pixel& from, const Pixel& toward) const {
    const double dx = toward.x - from.x;
    const double dy = toward.y - from.y;
    const double far = std::hypot(dx, dy);
    const Pixel way{dx / far, dy / far};
    const Pixel off{from.x - middle.x, from.y - middle.y};
    const double along = off.x * way.x + off.y * way.y;
    const double beside2 = off.x * off.x + off.y * off.y - along * along;
    const double t = std::sqrt(std::max(0.0, radius * radius - beside2)) - along;
    return std::atan2(off.y + t * way.y, off.x + t * way.x);
  }
  Pixel at(double angle) const {
    return {middle.x + radius * std::cos(angle), middle.y + radius * std::sin(angle)};
  }
};

/// All to the right of a curve. With y down that is the side to which angles grow.
Loop beside_curve(const WindowPart& part, const Loop& points) {
  constexpr double kStep = std::numbers::pi / 16.0;
  Loop loop = curve_through(points);
  if (loop.size() < 2) return loop;
  WindowRing ring;
  ring.middle = {part.left + 0.5 * part.camera.width(), 0.5 * part.camera.height()};
  for (const Pixel& point : loop) {
    ring.radius = std::max(ring.radius, distance_of(ring.middle, point));
  }
  const double corner = 0.5 * std::hypot(part.camera.width(), part.camera.height());
  ring.radius = 1.1 * std::max(ring.radius, corner);
  const double begin =
      ring.angle_of(loop[0], {2.0 * loop[0].x - loop[1].x, 2.0 * loop[0].y - loop[1].y});
  const Pixel& last = loop.back();
  const Pixel& before = loop[loop.size() - 2];
  double from = ring.angle_of(last, {2.0 * last.x - before.x, 2.0 * last.y - before.y});
  const double to = begin > from ? begin : begin + 2.0 * std::numbers::pi;
  while (from < to) {
    loop.push_back(ring.at(from));
    from += kStep;
  }
  loop.push_back(ring.at(to));
  return loop;
}

}  // namespace

void extend(OutlineDrag& drag, const Pixel& to) {
  assert(!drag.points.empty() && drag.form != DragForm::brush && drag.form != DragForm::curve);
  if (drag.form == DragForm::lasso) {
    if (distance_of(drag.points.back(), to) >= kStepPixels) drag.points.push_back(to);
    return;
  }
  drag.points.resize(2);
  drag.points[1] = to;
}

std::vector<Pixel> outline_of(const OutlineDrag& drag) {
  if (drag.form == DragForm::curve) return beside_curve(drag.part, drag.points);
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

std::optional<Request> request_of(const OutlineDrag& drag, bool front_only) {
  constexpr double kLeastLinePixels = 4.0;
  if (drag.points.size() < 2) return std::nullopt;
  if (drag.form == DragForm::line) {
    if (distance_of(drag.points[0], drag.points[1]) < kLeastLinePixels) return std::nullopt;
    return DoStep{cut_along(drag), drag.key};
  }
  const Lens lens = unplaced(drag.piece, drag.part.camera.lens({}));
  MaskOutline outline{view_of(lens), {}, drag.is_inverse, front_only};
  for (const Loop& pixels : simple_loops(outline_of(drag))) {
    auto& loop = outline.loops.emplace_back();
    for (const Pixel& pixel : pixels) loop.push_back(picture_point(drag.part, lens, pixel));
  }
  if (outline.loops.empty()) return std::nullopt;
  if (!drag.is_trim) return DoStep{std::move(outline), drag.key};
  return TrimPiece{{outline.view, std::move(outline.loops), drag.is_inverse}, drag.key};
}

}  // namespace argil::viewer
