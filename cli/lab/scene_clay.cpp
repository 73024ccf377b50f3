// SPDX-License-Identifier: GPL-3.0-or-later
// The scene `clay` of the lab: a project or a slab, and a hand that presses and slides
// along its surface.
#include <algorithm>
#include <cassert>
#include <optional>
#include <sstream>
#include <utility>

#include "common/options.h"
#include "common/project.h"
#include "common/tool_option.h"
#include "lab/lab.h"

namespace argil::cli::lab {
namespace {

Result<Clay> open_clay(const std::string& project, const Progress& progress) {
  if (!project.empty()) {
    auto opened = cli::open_project(project, progress);
    if (!opened) return opened.error();
    return std::move(opened).value().clay;
  }
  // Flat: on a ball of 25 mm a press of 3 N pushes sideways more stiffly than a light hand holds.
  ClayOptions options;
  options.voxel_mm = 0.5;
  return Clay::block({60.0, 30.0, 60.0}, options);
}

/// The highest point of the surface on the line x, z: from above down to where it is inside.
std::optional<double> height_at(const Clay& clay, double x_mm, double z_mm) {
  const Box3 bounds = clay.bounds_mm();
  // Half a voxel, so that no sheet the field resolves lies between two steps.
  const double step = 0.5 * clay.options().voxel_mm;
  const auto steps = static_cast<int>(bounds.size().y / step) + 2;
  double before = 0.0;
  for (int n = 0; n < steps; ++n) {
    const double y = bounds.max.y - n * step;
    const double distance = clay.distance_at({x_mm, y, z_mm});
    // Linear between the last two steps.
    if (distance <= 0.0) return y + step * (n > 0 ? distance / (distance - before) : 0.0);
    before = distance;
  }
  return std::nullopt;
}

/// Into the clay, straight on.
Vec3 inward_at(const Clay& clay, const Vec3& point) {
  const double step = clay.options().voxel_mm;
  Vec3 slope;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Vec3 to = point;
    Vec3 from = point;
    to[axis] += step;
    from[axis] -= step;
    slope[axis] = clay.distance_at(from) - clay.distance_at(to);
  }
  return dot(slope, slope) > 0.0 ? normalized(slope) : Vec3{0.0, -1.0, 0.0};
}

/// Along x over the middle, following the surface as it was.
Result<std::vector<Touch>> path_over(const Clay& clay) {
  constexpr int kParts = 16;
  constexpr double kLengthMm = 16.0;
  const Vec3 middle = clay.bounds_mm().center();
  std::vector<Touch> touches;
  for (int n = 0; n <= kParts; ++n) {
    const double x = middle.x + kLengthMm * (static_cast<double>(n) / kParts - 0.5);
    if (const auto y = height_at(clay, x, middle.z)) {
      const Vec3 point{x, *y, middle.z};
      touches.push_back({point, inward_at(clay, point)});
    }
  }
  if (!touches.empty()) return touches;
  return Error{ErrorKind::bad_input,
               "there is no clay under the middle of the project, where the hand would press; use "
               "another project"};
}

/// The surface around a point, as it is before the run, for the picture: lines along x, in the
/// frame of the device, whose middle lies at `offset_mm` of the clay.
std::string drawn_surface(const Clay& clay, const Vec3& middle, const Vec3& offset_mm) {
  constexpr int kAlongMm = 14;
  constexpr int kAsideMm = 8;
  std::ostringstream text;
  text << "$clay << EOD\n";
  for (int z = -kAsideMm; z <= kAsideMm; z += 2) {
    for (int x = -kAlongMm; x <= kAlongMm; ++x) {
      const auto y = height_at(clay, middle.x + x, middle.z + z);
      if (!y) continue;
      const Vec3 point = Vec3{middle.x + x, *y, middle.z + z} - offset_mm;
      text << point.x << ' ' << point.y << ' ' << point.z << '\n';
    }
    text << '\n';
  }
  text << "EOD\nsplot $clay";
  return text.str();
}

/// The button goes down once the tool rests on the clay, and the hand guides it at a depth; at the
/// end of the slide it comes up, and the hand presses again. Pressing on while the clay gives way
/// would be drilling.
void carve_on_the_way(std::vector<haptics::HandKey>& plan, const Vec3& radii_mm) {
  constexpr double kMostDepthMm = 2.0;
  const double depth = std::min(kMostDepthMm, 0.5 * std::min({radii_mm.x, radii_mm.y, radii_mm.z}));
  assert(depth > 0.0);
  for (std::size_t n = 2; n + 1 < plan.size(); ++n) {
    plan[n].is_active = true;
    plan[n].press_n = 0.0;
    plan[n].place_mm += depth * plan[n].direction;
  }
}

}  // namespace

Result<LabScene> make_clay(const LabOptions& options, const Progress& progress) {
  ClayWorkerOptions worker;
  auto tool = working_tool(options.tool, options.action);
  if (!tool) return tool.error();
  worker.tool = tool.value();
  auto clay = open_clay(options.project, progress);
  if (!clay) return clay.error();
  auto path = path_over(clay.value());
  if (!path) return path.error();
  std::vector<Touch>& touches = path.value();

  haptics::ClaySceneOptions felt;
  felt.tool = options.tool;
  felt.material = options.material;
  felt.mix = options.feel.mix;
  felt.mix_ramp_s = options.feel.mix_ramp_s;
  felt.law = options.law == 0 ? haptics::ForceLaw::energy : haptics::ForceLaw::blanch;
  constexpr haptics::ForceMethod kMethods[] = {
      haptics::ForceMethod::volume, haptics::ForceMethod::point, haptics::ForceMethod::automatic};
  felt.method = kMethods[options.method];
  if (worker.tool.action == Action::carve && worker.tool.shape == Shape::ball) {
    felt.own_cut_mm = worker.tool.radii_mm.x;
  }
  if (options.has_vibro) felt.texture.emplace();
  // The middle of the device's reach lies where the hand first touches.
  felt.offset_mm = touches.front().place_mm;
  for (Touch& touch : touches) touch.place_mm -= felt.offset_mm;

  LabScene lab;
  lab.plan = slide_plan(touches);
  if (options.is_active) carve_on_the_way(lab.plan, options.tool.radii_mm);
  lab.surface_mm = touches.back().place_mm;
  lab.object = drawn_surface(clay.value(), clay.value().bounds_mm().center(), felt.offset_mm);
  lab.clay = std::make_unique<LabClay>(std::move(clay).value(), worker, felt);
  return lab;
}

}  // namespace argil::cli::lab
