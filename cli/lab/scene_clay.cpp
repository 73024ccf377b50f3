// SPDX-License-Identifier: GPL-3.0-or-later
// The scene `clay` of the lab: a project or a slab, and a hand that presses and slides
// along its surface.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <optional>
#include <sstream>
#include <utility>

#include "argil/engine/path_on_clay.h"

#include "common/options.h"
#include "common/output.h"
#include "common/project.h"
#include "common/tool_option.h"
#include "lab/lab.h"

namespace argil::cli::lab {
namespace {

/// How fast a hand goes along a path that it is guided on.
constexpr double kFollowMmPerS = 20.0;

/// Of the slab: what is too fine for a tool's windows, for --vibro.
constexpr haptics::SceneParameter kClayParameters[] = {
    {"A", "mm", 0.0, 0.0, 0.3, "the height of waves on the slab's top, along x", "section 3.6.4"},
    {"f", "1/m", 500.0, 50.0, 1000.0, "how many of them there are", "section 3.6.4"}};

/// A smaller slab on voxels that its waves are large for.
Result<Clay> wavy_slab(double height_mm, double frequency_per_m) {
  constexpr Vec3 kHalfMm{20.0, 8.0, 16.0};
  ClayOptions options;
  options.voxel_mm = 0.25;
  // The phase keeps the waves from vanishing at the nodes of coarse levels.
  const double per_mm = 2e-3 * std::numbers::pi * frequency_per_m;
  const auto distance = [=](const Vec3& p) {
    const double waves_mm = height_mm * std::sin(per_mm * (p.x - 0.37));
    return std::max({std::abs(p.x) - kHalfMm.x, std::abs(p.z) - kHalfMm.z, -kHalfMm.y - p.y,
                     p.y - kHalfMm.y - waves_mm});
  };
  constexpr Vec3 kRoom{1.0, 1.0, 1.0};
  return Clay::from_distance(distance, {-kHalfMm - kRoom, kHalfMm + kRoom}, options);
}

Result<Clay> open_clay(const LabOptions& asked, const Progress& progress) {
  haptics::SceneValues values(kClayParameters);
  if (auto good = values.set_all(asked.settings); !good) return good.error();
  if (!asked.project.empty()) {
    if (!asked.settings.empty()) {
      return Error{ErrorKind::bad_input,
                   "--set is of the slab, which --project takes the place of; leave one of them "
                   "out"};
    }
    auto opened = cli::open_clay(asked.project, asked.piece, progress);
    if (!opened) return opened.error();
    return std::move(opened).value().clay;
  }
  if (values["A"] > 0.0) return wavy_slab(values["A"], values["f"]);
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

double path_length(const std::vector<Touch>& touches) {
  double sum = 0.0;
  for (std::size_t n = 1; n < touches.size(); ++n) {
    sum += length(touches[n].place_mm - touches[n - 1].place_mm);
  }
  return sum;
}

Vec3 middle_of(const std::vector<Vec3>& path_mm) {
  Box3 box;
  for (const Vec3& point : path_mm) box.include(point);
  return box.center();
}

/// Along a path as a hand goes that cannot see it: up to 4 mm beside it, now to the one side and
/// now to the other.
Result<std::vector<Touch>> along(const Clay& clay, const std::vector<Vec3>& path_mm) {
  if (auto good = check_path_on_clay(clay, path_mm); !good) return good.error();
  constexpr double kStepMm = 1.0;
  constexpr double kAstrayMm = 4.0;
  constexpr double kWaveMm = 40.0;
  std::vector<Touch> touches;
  double gone_mm = 0.0;
  for (std::size_t n = 0; n < path_mm.size(); ++n) {
    const Vec3 side = n + 1 < path_mm.size() ? path_mm[n + 1] - path_mm[n] : Vec3{};
    const int steps = std::max(1, static_cast<int>(std::ceil(length(side) / kStepMm)));
    for (int step = 0; step < steps; ++step) {
      const Vec3 on = path_mm[n] + static_cast<double>(step) / steps * side;
      const Vec3 inward = inward_at(clay, on);
      const double astray_mm = kAstrayMm * std::sin(2.0 * std::numbers::pi * gone_mm / kWaveMm);
      touches.push_back({on + astray_mm * normalized(cross(inward, side)), inward});
      gone_mm += length(side) / steps;
    }
  }
  return touches;
}

/// A Falcon must come there, and a few millimetres beyond for the approach.
Result<void> check_reach(const std::vector<Touch>& touches) {
  constexpr double kRoomMm = 8.0;
  const Box3 reach = haptics::FalconModel().reach_mm;
  const Vec3 room{kRoomMm, kRoomMm, kRoomMm};
  for (const Touch& touch : touches) {
    Box3 with = reach;
    with.include(touch.place_mm - room);
    with.include(touch.place_mm + room);
    if (with.min == reach.min && with.max == reach.max) continue;
    return Error{ErrorKind::bad_input,
                 "the path reaches " + cli::number(length(touch.place_mm)) +
                     " mm from its middle, farther than a Falcon; take a shorter one"};
  }
  return {};
}

/// The surface around a point, as it is before the run, for the picture: lines along x, y upwards,
/// in the frame of the device, whose middle lies at `offset_mm` of the clay.
std::string drawn_surface(const Clay& clay, const Vec3& middle, const Vec3& offset_mm,
                          const std::vector<Touch>& touches) {
  constexpr double kRimMm = 6.0;
  Box3 box;
  for (const Touch& touch : touches) box.include(touch.place_mm);
  const int along_mm = static_cast<int>(std::ceil(0.5 * box.size().x + kRimMm));
  const int aside_mm = static_cast<int>(std::ceil(0.5 * box.size().z + kRimMm)) / 2 * 2;
  std::ostringstream text;
  text << "$clay << EOD\n";
  for (int z = -aside_mm; z <= aside_mm; z += 2) {
    for (int x = -along_mm; x <= along_mm; ++x) {
      const auto y = height_at(clay, middle.x + x, middle.z + z);
      if (!y) continue;
      const Vec3 point = Vec3{middle.x + x, *y, middle.z + z} - offset_mm;
      text << point.z << ' ' << point.x << ' ' << point.y << '\n';
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

std::span<const haptics::SceneParameter> clay_parameters() { return kClayParameters; }

Result<LabScene> make_clay(const LabOptions& options, const Progress& progress) {
  ClayWorkerOptions worker;
  auto tool = working_tool(options.tool, options.action);
  if (!tool) return tool.error();
  worker.tool = tool.value();
  auto clay = open_clay(options, progress);
  if (!clay) return clay.error();
  auto path = options.guidance.path_mm.empty() ? path_over(clay.value())
                                               : along(clay.value(), options.guidance.path_mm);
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
  // The middle of the device's reach lies where the hand first touches, or in that of its path.
  felt.offset_mm = options.guidance.path_mm.empty() ? touches.front().place_mm
                                                    : middle_of(options.guidance.path_mm);
  for (Touch& touch : touches) touch.place_mm -= felt.offset_mm;
  if (auto reached = check_reach(touches); !reached) return reached.error();

  LabScene lab;
  lab.offset_mm = felt.offset_mm;
  lab.plan = slide_plan(touches, std::max(kSlideS, path_length(touches) / kFollowMmPerS));
  if (options.is_active) carve_on_the_way(lab.plan, options.tool.radii_mm);
  lab.surface_mm = touches.back().place_mm;
  const Vec3 middle =
      options.guidance.path_mm.empty() ? clay.value().bounds_mm().center() : felt.offset_mm;
  lab.is_y_up = true;
  lab.object = drawn_surface(clay.value(), middle, felt.offset_mm, touches);
  lab.clay = std::make_unique<LabClay>(std::move(clay).value(), worker, felt);
  return lab;
}

}  // namespace argil::cli::lab
