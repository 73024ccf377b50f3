// SPDX-License-Identifier: GPL-3.0-or-later
// Few figures for each kind of action, all of triangles alone.
#include "gallery/figures.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <numbers>
#include <unordered_map>

#include "measure/crease_shape.h"
#include "measure/rim_measure.h"
#include "measure/ripple.h"

namespace argil::evaluation {
namespace {

/// What an action reaches, in tool radii from where its dabs were.
constexpr double kZone = 1.3;
/// Ripples are what is smaller than this.
constexpr double kRippleReachMm = 2.0 * kGalleryVoxel;
/// In radii about the middle: what is to be flat, what bumps are left of, what a mask held.
constexpr double kFlatZone = 0.4;
constexpr double kBumpZone = 0.6;
constexpr double kHeldMm = 1.0;

/// Signed, in mm; exact on a ball.
double moved_mm(Body body, const Vec3& p) {
  constexpr double kAside = 1e-3;
  const double value = body_distance(body, p);
  Vec3 slope;
  slope.x = body_distance(body, p + Vec3{kAside, 0, 0}) - value;
  slope.y = body_distance(body, p + Vec3{0, kAside, 0}) - value;
  slope.z = body_distance(body, p + Vec3{0, 0, kAside}) - value;
  return value * kAside / length(slope);
}

bool is_within(const std::vector<StrokeSample>& samples, const Vec3& p, double mm) {
  return std::any_of(samples.begin(), samples.end(), [&](const StrokeSample& sample) {
    const Vec3 off = p - sample.position_mm;
    return dot(off, off) < mm * mm;
  });
}

/// The angle between the two triangles at an edge in degrees: 95 % of all edges that begin in the
/// zone have less.
double facets_deg(const TriangleMesh& mesh, const std::function<bool(const Vec3&)>& is_in) {
  std::unordered_map<std::uint64_t, Vec3> normal_at;  // of the triangle left of an edge
  std::vector<double> angles;
  for (const Triangle& t : mesh.triangles) {
    const Vec3& a = mesh.positions[t[0]];
    const Vec3 twice = cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a);
    if (!is_in(a) || !(length(twice) > 0.0)) continue;
    const Vec3 normal = normalized(twice);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint64_t from = t[i];
      const std::uint64_t to = t[(i + 1) % 3];
      normal_at[from << 32U | to] = normal;
      const auto other = normal_at.find(to << 32U | from);
      if (other == normal_at.end()) continue;
      angles.push_back(std::acos(std::clamp(dot(normal, other->second), -1.0, 1.0)));
    }
  }
  if (angles.empty()) return 0.0;
  const auto place = angles.begin() + static_cast<std::ptrdiff_t>(angles.size() * 95 / 100);
  std::nth_element(angles.begin(), place, angles.end());
  return *place * 180.0 / std::numbers::pi;
}

/// Sum of a function of the triangles' middles, weighted by their areas, over the area.
template <class Value>
double mean_over(const TriangleMesh& mesh, const std::function<bool(const Vec3&)>& is_in,
                 const Value& value) {
  double sum = 0.0;
  double area = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3& a = mesh.positions[t[0]];
    const Vec3& b = mesh.positions[t[1]];
    const Vec3& c = mesh.positions[t[2]];
    const Vec3 middle = (a + b + c) / 3.0;
    if (!is_in(middle)) continue;
    const double weight = length(cross(b - a, c - a));
    sum += weight * value(middle);
    area += weight;
  }
  return area > 0.0 ? sum / area : 0.0;
}

/// rms of a height less its mean.
template <class Height>
double spread_rms(const TriangleMesh& mesh, const std::function<bool(const Vec3&)>& is_in,
                  const Height& height) {
  const double mean = mean_over(mesh, is_in, height);
  return std::sqrt(mean_over(mesh, is_in, [&](const Vec3& p) {
    const double off = height(p) - mean;
    return off * off;
  }));
}

/// rms of the distance from the plane that fits best: heights along `out` less what is linear in
/// the other two directions.
double plane_rms(const TriangleMesh& mesh, const std::function<bool(const Vec3&)>& is_in) {
  const WorkPlace& w = work_place();
  const auto mean = [&](const auto& value) { return mean_over(mesh, is_in, value); };
  const Vec3 middle{mean([&](const Vec3& p) { return dot(p, w.east); }),
                    mean([&](const Vec3& p) { return dot(p, w.north); }),
                    mean([&](const Vec3& p) { return dot(p, w.out); })};
  const auto local = [&](const Vec3& p) {
    return Vec3{dot(p, w.east), dot(p, w.north), dot(p, w.out)} - middle;
  };
  const auto moment = [&](std::size_t i, std::size_t j) {
    return mean([&](const Vec3& p) { return local(p)[i] * local(p)[j]; });
  };
  const double xx = moment(0, 0);
  const double xy = moment(0, 1);
  const double yy = moment(1, 1);
  const double xz = moment(0, 2);
  const double yz = moment(1, 2);
  const double det = xx * yy - xy * xy;
  if (!(det > 0.0)) return 0.0;
  const double along_x = (xz * yy - yz * xy) / det;
  const double along_y = (yz * xx - xz * xy) / det;
  const double tilt = std::sqrt(1.0 + along_x * along_x + along_y * along_y);
  return std::sqrt(mean([&](const Vec3& p) {
    const Vec3 q = local(p);
    const double off = (q.z - along_x * q.x - along_y * q.y) / tilt;
    return off * off;
  }));
}

std::vector<Figure> rim_figures(const Plate& plate, const TriangleMesh& mesh) {
  const Stroke& stroke = plate.strokes[0].stroke;
  const RimCase rim{kGalleryBall, stroke.samples[0].position_mm, smallest_radius(stroke.tool),
                    plate.action == Action::carve};
  const RimMeasure measured = measure_rim(mesh, rim, kGalleryVoxel);
  return {{"saw of the rim, rms", "h", measured.serration_rms() / kGalleryVoxel},
          {"rim off its circle", "h", std::abs(measured.mean()) / kGalleryVoxel},
          {"surface near it, rms", "h", measured.surface_rms / kGalleryVoxel}};
}

std::vector<Figure> profile_figures(const Plate& plate, const TriangleMesh& mesh) {
  const WorkPlace& w = work_place();
  const Stroke& stroke = plate.strokes[0].stroke;
  const Vec3 end = normalized(stroke.samples.front().position_mm);
  const double tool = smallest_radius(stroke.tool);
  const double half_angle = std::acos(dot(end, w.out)) - tool / kGalleryBall - 0.05;
  assert(half_angle > 0.0);
  const double side = plate.action == Action::ridge ? -1.0 : 1.0;
  const CreaseShape shape =
      crease_shape(mesh, {kGalleryBall, w.north, w.out, half_angle, tool, side});
  return {{plate.action == Action::ridge ? "height" : "depth", "mm", shape.depth_mm},
          {"that over width", "", shape.depth_mm / shape.width_mm},
          {"sharpness (V: 1)", "", shape.sharpness},
          {"along the line, rms", "h", shape.bottom_rms_mm / kGalleryVoxel}};
}

}  // namespace

Reach reach_of(Body body, const TriangleMesh& mesh) {
  Reach reach;
  for (const Vec3& p : mesh.positions) {
    const double moved = moved_mm(body, p);
    reach.out_mm = std::max(reach.out_mm, moved);
    reach.in_mm = std::max(reach.in_mm, -moved);
  }
  return reach;
}

std::vector<Figure> figures_of(const Plate& plate, const TriangleMesh& start,
                               const TriangleMesh& mesh) {
  if (plate.figures == Figures::rim) return rim_figures(plate, mesh);
  if (plate.figures == Figures::profile) return profile_figures(plate, mesh);
  const Reach reach = reach_of(plate.body, mesh);
  std::vector<Figure> figures{{"out", "mm", reach.out_mm}, {"in", "mm", reach.in_mm}};
  const std::vector<StrokeSample>& samples = plate.strokes.back().stroke.samples;
  const auto near_middle = [](double mm) {
    return [mm](const Vec3& p) { return length(p - place_on_ball(0.0, 0.0)) < mm; };
  };
  if (plate.figures == Figures::flat) {
    const auto zone = near_middle(kFlatZone * kGalleryTool);
    figures.push_back({"from a plane, before", "mm", plane_rms(start, zone)});
    figures.push_back({"from a plane, rms", "mm", plane_rms(mesh, zone)});
    return figures;
  }
  if (plate.figures == Figures::bumps) {
    const auto zone = near_middle(kBumpZone * kGalleryTool);
    const auto height = [](const Vec3& p) { return length(p); };
    figures.push_back({"bumps before, rms", "mm", spread_rms(start, zone, height)});
    figures.push_back({"bumps, rms", "mm", spread_rms(mesh, zone, height)});
  }
  if (plate.figures == Figures::held) {
    double moved = 0.0;
    for (const Vec3& p : mesh.positions) {
      if (!is_within(plate.strokes[0].stroke.samples, p, kHeldMm)) continue;
      moved = std::max(moved, std::abs(moved_mm(plate.body, p)));
    }
    figures.push_back({"masked moved", "mm", moved});
  }
  const auto zone = [&](const Vec3& p) { return is_within(samples, p, kZone * kGalleryTool); };
  figures.push_back({"ripples, rms", "h", ripple_rms(mesh, kRippleReachMm, zone) / kGalleryVoxel});
  figures.push_back({"facets, 95 %", "\u00b0", facets_deg(mesh, zone)});
  if (plate.figures == Figures::moved) {
    figures.push_back({"volume", "mm\u00b3", signed_volume(mesh) - signed_volume(start)});
  }
  return figures;
}

std::string figure_text(const Figure& figure) {
  const double size = std::abs(figure.value);
  const bool is_small = figure.unit == "h" ? size < 1.0 : figure.unit == "mm" && size < 0.1;
  const int digits = is_small ? 3 : (size < 10.0 ? 2 : 1);
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, figure.value);
  const bool is_apart = !figure.unit.empty() && figure.unit != "\u00b0";
  return text + (is_apart ? " " + figure.unit : figure.unit);
}

}  // namespace argil::evaluation
