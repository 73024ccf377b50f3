// SPDX-License-Identifier: GPL-3.0-or-later
// The scenes of the Falcon report, each with what a hand does there.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "argil/haptics/scene/scene_catalogue.h"
#include "argil/haptics/scene/scene_spring.h"
#include "argil/haptics/scene/scene_wall.h"

#include "lab/lab.h"

namespace argil::cli::lab {
namespace {

using haptics::HandKey;

constexpr double kLabPressN = 3.0;
constexpr double kSlideS = 2.0;

/// What a hand can hold on what is round or gives way sideways: 3 N would roll off it.
constexpr double kLightPressN = 1.5;

LabScene touch(const std::vector<Touch>& touches, double press_n = kLabPressN) {
  assert(!touches.empty() && press_n >= 0.0);
  LabScene lab;
  lab.plan = slide_plan(touches);
  for (HandKey& key : lab.plan) key.press_n = std::min(key.press_n, press_n);
  lab.surface_mm = touches.back().place_mm;
  lab.inward = touches.back().inward;
  return lab;
}

/// A scene's stiffness through the coupling that the options ask for, in N/m.
double felt_stiffness(const LabOptions& options, double stiffness_n_per_m) {
  assert(stiffness_n_per_m > 0.0 && options.rate_hz > 0.0);
  if (options.coupling == 0) return stiffness_n_per_m;
  double spring = options.coupling_stiffness_n_per_m;
  if (options.has_governor) {
    const haptics::FalconModel device =
        options.is_frictionless ? haptics::frictionless_falcon() : haptics::FalconModel();
    const double period_s = 1.0 / options.rate_hz;
    spring =
        std::min(spring, haptics::GovernorOptions().share *
                             haptics::stiffness_limit_n_per_m(device.damping_n_s_per_m, period_s,
                                                              options.delay_ticks * period_s));
  }
  // Springs in series.
  return stiffness_n_per_m * spring / (stiffness_n_per_m + spring);
}

LabScene sweep(const LabOptions&) {
  LabScene lab;
  // a slow sweep at 5 mm/s, as for figure 1
  for (const auto& [time_s, x_mm] : {std::pair{0.0, 0.0}, {2.0, -10.0}, {6.0, 10.0}, {8.0, 0.0}}) {
    HandKey key;
    key.time_s = time_s;
    key.place_mm = {x_mm, 0.0, 0.0};
    lab.plan.push_back(key);
  }
  lab.figure = Figure::force_over_position;
  lab.axis = 0;
  lab.inward = {1.0, 0.0, 0.0};
  return lab;
}

LabScene let_go(const LabOptions& options) {
  constexpr double kFromMm = 9.0;  // 7.2 N, within what the safety gate gives
  LabScene lab;
  // Held against what it feels, which the coupling makes softer, and then let go.
  HandKey placed;
  placed.place_mm = {kFromMm, 0.0, 0.0};
  placed.direction = {1.0, 0.0, 0.0};
  HandKey held = placed;
  held.time_s = 0.3;
  held.press_n =
      1e-3 * kFromMm * felt_stiffness(options, haptics::SpringOptions().stiffness_n_per_m);
  HandKey released = held;
  released.time_s = 1.0;
  released.holds = false;
  lab.plan = {placed, held, released};
  lab.figure = Figure::position_over_time;
  lab.axis = 0;
  lab.inward = {1.0, 0.0, 0.0};
  return lab;
}

LabScene press_wall(const LabOptions&) {
  LabScene lab;
  lab.surface_mm = {0.0, haptics::WallOptions().offset_mm, 0.0};
  lab.plan = haptics::press_plan(lab.surface_mm, lab.inward, kLabPressN);
  lab.figure = Figure::force_over_position;
  return lab;
}

/// Round an arc of a circle of `radius_mm` about the origin, from angle `from` to `to`.
std::vector<Touch> arc(double radius_mm, double from, double to, double rise_mm) {
  constexpr int kParts = 16;
  std::vector<Touch> touches;
  for (int n = 0; n <= kParts; ++n) {
    const double t = static_cast<double>(n) / kParts;
    const double angle = from + t * (to - from);
    const Vec3 out{std::sin(angle), std::cos(angle), 0.0};
    touches.push_back({radius_mm * out + Vec3{0.0, 0.0, rise_mm * (t - 0.5)}, -out});
  }
  return touches;
}

LabScene slide_over_sphere(const LabOptions&) {
  LabScene lab = touch(arc(50.0, -0.5, 0.4, 0.0));
  lab.object = "splot 50*sin(u)*cos(v), 50*cos(u), 50*sin(u)*sin(v)";
  return lab;
}

LabScene slide_over_cylinder(const LabOptions&) {
  LabScene lab = touch(arc(30.0, -0.7, 0.7, 60.0), kLightPressN);
  lab.object = "splot 30*sin(2*u), 30*cos(2*u), 100*v/pi-50";
  return lab;
}

/// Straight along a wall whose solid lies below in z.
std::vector<Touch> line(const Vec3& from, const Vec3& to) {
  return {{from, {0.0, 0.0, -1.0}}, {to, {0.0, 0.0, -1.0}}};
}

LabScene slide_over_pebbles(const LabOptions&) {
  LabScene lab = touch(line({-15.0, 1.0, -14.5}, {15.0, 4.0, -14.5}), kLightPressN);
  lab.object =
      "set isosamples 41,81\noff(x)=x-5*floor(x/5+0.5)\ntop(x,y)=-20+sqrt(36-off(x)**2-off(y)**2)\n"
      "splot 40*(u-pi/2)/pi, 20*(v-pi)/pi/2+2.5, top(40*(u-pi/2)/pi,20*(v-pi)/pi/2+2.5)";
  return lab;
}

LabScene slide_over_sine(const LabOptions&) {
  LabScene lab = touch(line({-12.5, 0.0, -25.0}, {37.5, 1.0, -25.0}));
  lab.object =
      "splot 100*(u-pi/2)/pi, 100*(v-pi)/pi/2, "
      "-20+5*sin(2*pi*0.02*100*(u-pi/2)/pi)*cos(2*pi*0.02*100*(v-pi)/pi/2)";
  return lab;
}

LabScene slide_in_groove(const LabOptions&) {
  LabScene lab = touch(line({-20.0, -12.5, 35.0}, {20.0, -12.5, 35.0}));
  lab.object = "splot 100*(u-pi/2)/pi, 80*(v-pi)/pi/2, 40+5*sin(2*pi*0.02*80*(v-pi)/pi/2)";
  return lab;
}

LabScene slide_over_click(const LabOptions&) {
  // On the ball's top a light hand would slide off: along the groove, over the ball, and on.
  LabScene lab = touch(line({-30.0, -12.5, -11.0}, {30.0, -12.5, -11.0}));
  lab.object = "splot 15*sin(u)*cos(v), 15*cos(u)-20, 15*sin(u)*sin(v)-20";
  return lab;
}

LabScene go_round(const LabOptions&) {
  LabScene lab;
  double time_s = 0.0;
  for (const Vec3& point : {Vec3{}, Vec3{-35, 0, 0}, Vec3{35, 0, 0}, Vec3{}, Vec3{0, -35, 0},
                            Vec3{0, 35, 0}, Vec3{}, Vec3{0, 0, -35}, Vec3{0, 0, 35}, Vec3{}}) {
    HandKey key;
    key.time_s = time_s;
    key.place_mm = point;
    lab.plan.push_back(key);
    time_s += 0.7;
  }
  return lab;
}

/// What a hand does in a scene of the catalogue; the scene itself is put in afterwards.
struct Play {
  const char* scene;
  LabScene (*make)(const LabOptions& options);
};
constexpr Play kPlays[] = {
    {"spring", sweep},
    {"free", let_go},
    {"wall-rigid", press_wall},
    {"wall-linear", press_wall},
    {"wall-nonlinear", press_wall},
    {"sphere", slide_over_sphere},
    {"cylinder", slide_over_cylinder},
    {"pebbles", slide_over_pebbles},
    {"sine-z", slide_over_sine},
    {"sine-normal", slide_over_sine},
    {"sine-gradient", slide_over_sine},
    {"sine-table", slide_over_sine},
    {"sine-nearest", slide_over_sine},
    {"slider", slide_in_groove},
    {"click", slide_over_click},
    {"workspace", go_round},
};

std::vector<LabSceneKind> all_kinds() {
  std::vector<LabSceneKind> kinds;
  for (const Play& play : kPlays) {
    const haptics::SceneEntry* entry = haptics::find_scene(play.scene);
    assert(entry != nullptr);
    kinds.push_back(
        {entry->name, entry->about,
         [entry, make = play.make](const LabOptions& options, const Progress&) -> Result<LabScene> {
           LabScene lab = make(options);
           lab.scene = entry->make();
           return lab;
         }});
  }
  kinds.push_back({"clay",
                   "a project, or a slab of clay: pressed, slid over, and worked with --active",
                   make_clay});
  return kinds;
}

}  // namespace

std::vector<HandKey> slide_plan(const std::vector<Touch>& touches) {
  assert(!touches.empty());
  assert(std::abs(length(touches.front().inward) - 1.0) < 1e-9);
  std::vector<HandKey> plan =
      haptics::press_plan(touches.front().place_mm, touches.front().inward, kLabPressN);
  HandKey key = plan.back();
  key.time_s = 1.0;
  plan.push_back(key);
  for (std::size_t n = 1; n < touches.size(); ++n) {
    key.time_s = 1.0 + kSlideS * static_cast<double>(n) / static_cast<double>(touches.size() - 1);
    key.place_mm = touches[n].place_mm;
    key.direction = touches[n].inward;
    plan.push_back(key);
  }
  return plan;
}

const std::vector<LabSceneKind>& scene_kinds() {
  static const std::vector<LabSceneKind> kinds = all_kinds();
  return kinds;
}

}  // namespace argil::cli::lab
