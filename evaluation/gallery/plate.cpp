// SPDX-License-Identifier: GPL-3.0-or-later
// The works of the gallery: each shows what its action is for, and leaves a shape that can be
// measured.
#include "gallery/plate.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "argil/engine/alpha_image.h"

#include "common/output.h"
#include "edits/shape.h"

namespace argil::evaluation {
namespace {

constexpr double kWeltMm = 0.9;      ///< height
constexpr double kWeltHalfMm = 2.5;  ///< half its width
constexpr double kBumpMm = 0.5;      ///< of BumpyBall: up to half a mm high, 5 mm apart
constexpr double kStep = 0.25 * kGalleryTool;

/// The point of a body above that of the ball.
Vec3 place_on(Body body, double east_mm, double north_mm) {
  Vec3 point = place_on_ball(east_mm, north_mm);
  const Vec3 up = normalized(point);
  // Along the ray the distance's slope is 1 but for the half that welt or bumps take: each step
  // halves what is left at least.
  for (int i = 0; i < 30; ++i) point -= body_distance(body, point) * up;
  return point;
}

/// Points a quarter radius apart along great circles from corner to corner (east and north in mm).
std::vector<Vec3> path_through(Body body, const std::vector<std::pair<double, double>>& corners) {
  std::vector<Vec3> path{place_on(body, corners[0].first, corners[0].second)};
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const auto& [east, north] = corners[i - 1];
    const auto& [to_east, to_north] = corners[i];
    const double way = std::hypot(to_east - east, to_north - north);
    const int steps = std::max(1, static_cast<int>(std::lround(way / kStep)));
    for (int k = 1; k <= steps; ++k) {
      const double part = static_cast<double>(k) / steps;
      path.push_back(
          place_on(body, east + part * (to_east - east), north + part * (to_north - north)));
    }
  }
  return path;
}

/// Straight through space, by steps of a sixteenth of the tool as a hand drags.
std::vector<Vec3> drag(const Vec3& from, const Vec3& by) {
  const int steps = static_cast<int>(std::ceil(length(by) / (kGalleryTool / 16.0)));
  std::vector<Vec3> path;
  for (int k = 0; k <= steps; ++k) path.push_back(from + (static_cast<double>(k) / steps) * by);
  return path;
}

Quat upright() {
  // The shortest turn that takes z to the direction out of the ball.
  const Vec3 axis = cross(Vec3{0, 0, 1}, work_place().out);
  return normalized(Quat{1.0 + work_place().out.z, axis.x, axis.y, axis.z});
}

Stroke stroke_along(Action action, const std::vector<Vec3>& path, double strength = 1.0) {
  Stroke stroke;
  stroke.tool.action = action;
  stroke.tool.radii_mm = {kGalleryTool, kGalleryTool, kGalleryTool};
  stroke.tool.strength = strength;
  for (const Vec3& at : path) {
    StrokeSample sample;
    sample.time_s = 0.01 * static_cast<double>(stroke.samples.size());
    sample.position_mm = at;
    sample.orientation = upright();
    stroke.samples.push_back(sample);
  }
  return stroke;
}

Plate plate_of(Action action, Body body, const std::vector<Vec3>& path, double strength,
               BlenderBrush brush, Figures figures) {
  Plate plate;
  plate.action = action;
  plate.body = body;
  plate.strokes.push_back({stroke_along(action, path, strength), std::move(brush)});
  plate.figures = figures;
  plate.toward = normalized(work_place().out + 0.6 * work_place().north);
  return plate;
}

/// Only ours, and why.
Plate alone(Plate plate, const std::string& why) {
  plate.no_counterpart = why;
  return plate;
}

Plate stamp(Action action, const std::string& boolean) {
  Plate plate = plate_of(action, Body::ball, {place_on_ball(0.0, 0.0)}, 1.0, {}, Figures::rim);
  plate.boolean = boolean;
  plate.toward = normalized(work_place().out + 0.35 * work_place().north);
  plate.frame_mm = 6.5;
  return plate;
}

/// To and fro over the middle.
struct Passes {
  double half_mm;  ///< to either side
  int count;
  double strength;
};

/// A brush that follows the surface.
Plate passes(Action action, Body body, const Passes& way, BlenderBrush brush,
             Figures figures = Figures::moved) {
  std::vector<std::pair<double, double>> corners{{-way.half_mm, 0.0}};
  for (int n = 0; n < way.count; ++n) {
    corners.push_back({n % 2 == 0 ? way.half_mm : -way.half_mm, 0.0});
  }
  return plate_of(action, body, path_through(body, corners), way.strength, std::move(brush),
                  figures);
}

/// A brush that drags: by a way across the line of sight, so that Blender's mouse goes the same.
Plate dragged(Action action, Body body, const Vec3& by, const Vec3& toward, BlenderBrush brush) {
  Plate plate = plate_of(action, body, drag(place_on(body, 0.0, 0.0), by), 1.0, std::move(brush),
                         Figures::moved);
  plate.is_matched = false;
  plate.toward = toward;
  return plate;
}

/// Outward and a little down: seen from above, half off the surface.
Plate pulled(Action action, double by_mm, BlenderBrush brush) {
  const WorkPlace& w = work_place();
  const Vec3 toward = normalized(0.5 * w.out + 0.866 * w.north);
  const Vec3 way = normalized(0.866 * w.out - 0.5 * w.north + 0.25 * w.east);
  Plate plate = dragged(action, Body::ball, by_mm * way, toward, std::move(brush));
  plate.frame_up_mm = 0.3 * by_mm;
  plate.frame_mm = 10.0 + 0.4 * by_mm;
  return plate;
}

Plate turned() {
  const WorkPlace& w = work_place();
  // The tool goes to and fro by half a radius, a radius in all: a turn of one radian in the middle.
  // Blender's mouse goes as far around the middle.
  std::vector<Vec3> path;
  for (const double east : {0.0, 1.25, 2.5, 1.25, 0.0}) {
    path.push_back(place_on(Body::welt, east, 0.0));
  }
  const Vec3 middle = place_on(Body::welt, 0.0, 0.0);
  BlenderBrush brush{.name = "Rotate", .path = {middle}};
  for (int k = 0; k <= 16; ++k) {
    const double angle = k / 16.0;
    brush.path.push_back(middle + kGalleryTool * std::cos(angle) * w.east +
                         kGalleryTool * std::sin(angle) * w.north);
  }
  Plate plate = plate_of(Action::twist, Body::welt, path, 1.0, std::move(brush), Figures::moved);
  plate.is_matched = false;
  plate.toward = normalized(w.out + 0.3 * w.north);
  return plate;
}

Plate slid() {
  const WorkPlace& w = work_place();
  const Vec3 toward = normalized(w.out + 0.1 * w.east);
  return dragged(Action::slide, Body::welt, 4.0 * w.north, toward, {"Thumb"});
}

Plate masked() {
  Plate plate = passes(Action::mask, Body::ball, {8.0, 2, 1.0}, {"Mask"}, Figures::held);
  for (PlateStroke& each : plate.strokes) each.stroke.tool.radii_mm = {2.5, 2.5, 2.5};
  const auto path = path_through(Body::ball, {{0.0, -4.0}, {0.0, 4.0}, {0.0, -4.0}});
  plate.strokes.push_back({stroke_along(Action::inflate, path), {"Inflate/Deflate"}});
  return plate;
}

Plate trimmed() {
  Plate plate =
      plate_of(Action::trim, Body::bumpy, path_through(Body::bumpy, {{0.0, 0.0}, {4.0, 0.0}}), 1.0,
               {}, Figures::flat);
  plate.strokes[0].stroke.tool.plane_offset = -0.15;
  return alone(std::move(plate), "trims by a lasso or a box|drawn on the screen");
}

Plate roughened() {
  Plate plate = passes(Action::noise, Body::ball, {4.0, 1, 1.0}, {});
  plate.strokes[0].stroke.tool.wavelength_mm = 2.5;
  return alone(std::move(plate), "a brush's texture is a picture,|not a noise in space");
}

/// Rings about the middle, black at the rim.
std::shared_ptr<const AlphaImage> rings() {
  constexpr int kSide = 64;
  constexpr double kRings = 3.0;
  std::vector<std::uint16_t> pixels;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const double rho = std::hypot(2 * x + 1 - kSide, 2 * y + 1 - kSide) / kSide;
      const double grey =
          rho < 1.0 ? 0.5 + 0.5 * std::cos(2.0 * std::numbers::pi * kRings * rho - std::numbers::pi)
                    : 0.0;
      pixels.push_back(static_cast<std::uint16_t>(std::lround(65535.0 * grey)));
    }
  }
  auto image = AlphaImage::make(kSide, kSide, std::move(pixels));
  assert(image);
  return std::move(image).value();
}

Plate embossed() {
  Plate plate =
      plate_of(Action::emboss, Body::ball, {place_on_ball(0.0, 0.0)}, 1.0, {}, Figures::moved);
  Tool& tool = plate.strokes[0].stroke.tool;
  tool.alpha = rings();
  tool.amplitude_mm = 0.8;
  return alone(std::move(plate), "not compared: Draw's texture|has to be an image of the file");
}

/// With Blender's usual strength: what moves within the surface has no height to be matched by.
Plate pinched() {
  Plate plate =
      passes(Action::pinch, Body::welt, {6.0, 2, 1.0}, {.name = "Pinch/Magnify", .strength = 0.5});
  plate.is_matched = false;
  return plate;
}

/// To a height, which Blender's brush has as a setting of its own.
Plate layered() {
  constexpr double kStrength = 0.6;
  const double height = 0.25 * kStrength * kGalleryTool;
  Plate plate =
      passes(Action::layer, Body::ball, {6.0, 2, kStrength}, {"Layer", {{"height", height}}});
  plate.is_matched = false;
  return plate;
}

Plate plate_for(Action action) {
  using enum Action;
  switch (action) {
    case add:
      return stamp(add, "UNION");
    case carve:
      return stamp(carve, "DIFFERENCE");
    case smooth:
      return passes(smooth, Body::bumpy, {5.0, 4, 1.0}, {"Smooth"}, Figures::bumps);
    case inflate:
      return passes(inflate, Body::ball, {5.0, 1, 1.0}, {"Inflate/Deflate"});
    case flatten:
      return passes(flatten, Body::bumpy, {1.25, 4, 1.0}, {"Flatten/Contrast"}, Figures::flat);
    case scrape:
      return passes(scrape, Body::bumpy, {1.25, 4, 1.0}, {"Scrape/Peaks"}, Figures::flat);
    case fill:
      return passes(fill, Body::bumpy, {1.25, 4, 1.0}, {"Fill/Deepen"}, Figures::flat);
    case pinch:
      return pinched();
    case crease:
      return passes(crease, Body::ball, {16.0, 1, 1.0}, {"Crease", {{"direction", "SUBTRACT"}}},
                    Figures::profile);
    case ridge:
      return passes(ridge, Body::ball, {16.0, 1, 1.0}, {"Crease", {{"direction", "ADD"}}},
                    Figures::profile);
    case grab:
      return pulled(grab, 6.0, {"Grab"});
    case twist:
      return turned();
    case mask:
      return masked();
    case layer:
      return layered();
    case clay:
      return passes(clay, Body::ball, {5.0, 2, 0.6}, {"Clay"});
    case clay_strips:
      return passes(clay_strips, Body::ball, {5.0, 1, 0.6}, {"Clay Strips"});
    case elastic:
      return pulled(elastic, 6.0,
                    {"Elastic Deform", {{"elastic_deform_volume_preservation", 0.5}}, 2.0});
    case snake_hook:
      return pulled(snake_hook, 12.0, {"Snake Hook"});
    case slide:
      return slid();
    case trim:
      return trimmed();
    case emboss:
      return embossed();
    case noise:
      break;
  }
  return roughened();
}

}  // namespace

const char* body_name(Body body) {
  switch (body) {
    case Body::ball:
      return "ball";
    case Body::welt:
      return "welt";
    case Body::bumpy:
      break;
  }
  return "bumpy";
}

double body_distance(Body body, const Vec3& p) noexcept {
  if (body == Body::bumpy) return BumpyBall{kGalleryBall, kBumpMm}.distance(p);
  double height = 0.0;
  if (body == Body::welt) {
    const double beside = dot(p, work_place().north) / kWeltHalfMm;
    const double falloff = std::max(0.0, 1.0 - beside * beside);
    height = kWeltMm * falloff * falloff;
  }
  return length(p) - kGalleryBall - height;
}

const WorkPlace& work_place() {
  static const WorkPlace place = [] {
    const Vec3 out = normalized(Vec3{0.31, -0.87, 0.38});
    const Vec3 east = normalized(cross(Vec3{0, 0, 1}, out));
    return WorkPlace{out, east, cross(out, east)};
  }();
  return place;
}

Vec3 place_on_ball(double east_mm, double north_mm, double up_mm) {
  const WorkPlace& w = work_place();
  const double way = std::hypot(east_mm, north_mm);
  if (way == 0.0) return (kGalleryBall + up_mm) * w.out;
  const Vec3 ahead = (east_mm * w.east + north_mm * w.north) / way;
  const double angle = way / kGalleryBall;
  return (kGalleryBall + up_mm) * (std::cos(angle) * w.out + std::sin(angle) * ahead);
}

std::vector<Plate> all_plates() {
  std::vector<Plate> plates;
  for (const ActionInfo& info : kActionInfos) plates.push_back(plate_for(info.action));
  return plates;
}

std::string plate_text(const Plate& plate) {
  std::string text;
  for (const PlateStroke& each : plate.strokes) {
    const Tool& tool = each.stroke.tool;
    text += (text.empty() ? "" : "; then ") + std::string(info_of(tool.action).name) +
            ", tool of " + cli::number(smallest_radius(tool)) + " mm, strength " +
            cli::number(tool.strength);
  }
  return text + "; h = " + cli::number(kGalleryVoxel) + " mm";
}

}  // namespace argil::evaluation
