// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/stroke_maker.h"

#include <cmath>
#include <cstdio>
#include <sstream>

namespace argil {
namespace {

/// Uniform in [lo, hi) from the raw generator, whose bits are the same on every machine (those of
/// the standard distributions are not).
double uniform(std::mt19937& random, double lo, double hi) {
  return lo + (hi - lo) * (static_cast<double>(random()) / 4294967296.0);
}

Vec3 in_cube(std::mt19937& random, double half) {
  const double x = uniform(random, -half, half);
  const double y = uniform(random, -half, half);
  return {x, y, uniform(random, -half, half)};
}

}  // namespace

const std::vector<Action>& actions_on_levels() {
  static const std::vector<Action> actions = [] {
    std::vector<Action> found;
    for (const ActionInfo& info : kActionInfos) {
      if (!is_painted(info.action)) found.push_back(info.action);
    }
    return found;
  }();
  return actions;
}

Clay random_start(std::mt19937& random) {
  ClayOptions options;
  options.voxel_mm = uniform(random, 0.3, 0.8);
  options.tolerance_voxels = uniform(random, 0.03, 0.2);
  if (random() % 3 == 0) {
    const double x = uniform(random, 8.0, 16.0);
    const double y = uniform(random, 8.0, 16.0);
    return Clay::block({x, y, uniform(random, 8.0, 16.0)}, options).value();
  }
  return Clay::ball(uniform(random, 7.0, 10.0), options).value();
}

Stroke random_dab(std::mt19937& random, double reach_mm) {
  Stroke stroke;
  stroke.tool.action = static_cast<Action>(random() % 4);
  const double size = std::exp2(uniform(random, -1.0, 3.0));
  stroke.tool.radii_mm = {size, size, size};
  if (random() % 3 == 0) {
    stroke.tool.shape = Shape::ellipsoid;
    stroke.tool.radii_mm.y *= uniform(random, 0.3, 1.0);
    stroke.tool.radii_mm.z *= uniform(random, 0.3, 1.0);
  }
  stroke.tool.strength = uniform(random, 0.2, 1.0);
  if (stroke.tool.action == Action::inflate && random() % 2 == 0) stroke.tool.strength *= -1.0;
  stroke.spacing = uniform(random, 0.2, 1.0);
  stroke.mirror.x = random() % 4 == 0;
  StrokeSample sample;
  sample.position_mm = in_cube(random, reach_mm);
  const Vec3 axis = in_cube(random, 1.0);
  sample.orientation = normalized(Quat{uniform(random, -1.0, 1.0), axis.x, axis.y, axis.z});
  stroke.samples.push_back(sample);
  if (random() % 2 == 0) {
    sample.time_s = 1.0;
    sample.position_mm += in_cube(random, size * stroke.spacing);
    stroke.samples.push_back(sample);
  }
  return stroke;
}

Stroke stroke_of(Action action, double radius_mm, double strength,
                 const std::vector<Vec3>& places) {
  Stroke stroke;
  stroke.tool = {action, Shape::ball, {radius_mm, radius_mm, radius_mm}, strength};
  for (const Vec3& place : places) {
    stroke.samples.push_back({0.1 * static_cast<double>(stroke.samples.size()), place, {}, 1.0});
  }
  return stroke;
}

void SymmetryCount::print() const {
  const auto of = [&](StrokeSymmetry kind) { return of_[static_cast<std::size_t>(kind)]; };
  std::printf("symmetric strokes: %d exact, %d of clay that was not symmetric, %d withheld\n",
              of(StrokeSymmetry::exact), of(StrokeSymmetry::unlike), of(StrokeSymmetry::withheld));
}

std::string describe(const Stroke& stroke) {
  std::ostringstream out;
  const Vec3& r = stroke.tool.radii_mm;
  const Vec3& p = stroke.samples[0].position_mm;
  out << info_of(stroke.tool.action).name << " radii " << r.x << ' ' << r.y << ' ' << r.z
      << " strength " << stroke.tool.strength << " at " << p.x << ' ' << p.y << ' ' << p.z
      << " samples " << stroke.samples.size() << (stroke.mirror.x ? " mirrored" : "") << " radial "
      << stroke.radial.count << " about " << stroke.radial.axis;
  return out.str();
}

}  // namespace argil
