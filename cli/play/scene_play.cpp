// SPDX-License-Identifier: GPL-3.0-or-later
// The scenes of the Falcon report, each with what a hand does there.
#include "play/scene_play.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>

#include "argil/haptics/analysis/hold_test.h"
#include "argil/haptics/scene/sine_network.h"
#include "argil/haptics/servo/governor.h"

#include "play/scene_option.h"

namespace argil::cli {
namespace {

using haptics::HandKey;
using haptics::SceneValues;

Vec3 center_of(const SceneValues& values) { return {values["x"], values["y"], values["z"]}; }

constexpr double kPlayPressN = 3.0;

/// What a hand can hold on what is round or gives way sideways: 3 N would roll off it.
constexpr double kLightPressN = 1.5;

ScenePlay touch(const std::vector<Touch>& touches, double press_n = kPlayPressN) {
  assert(!touches.empty() && press_n >= 0.0);
  ScenePlay play;
  play.plan = slide_plan(touches);
  for (HandKey& key : play.plan) key.press_n = std::min(key.press_n, press_n);
  play.surface_mm = touches.back().place_mm;
  play.inward = touches.back().inward;
  return play;
}

/// A scene's stiffness through the coupling, in N/m.
double felt_stiffness(const ScenePlayer& player, double stiffness_n_per_m) {
  assert(stiffness_n_per_m >= 0.0 && player.spring_n_per_m > 0.0);
  if (!std::isfinite(player.spring_n_per_m)) return stiffness_n_per_m;
  // Springs in series.
  return stiffness_n_per_m * player.spring_n_per_m / (stiffness_n_per_m + player.spring_n_per_m);
}

/// How much farther than it gets a hand has to aim, which is a spring itself.
double aim_in(const ScenePlayer& player, double stiffness_n_per_m) {
  const haptics::HandModel hand = haptics::hand_model(player.hand);
  const double own = hand.is_push ? haptics::hand_model(haptics::Hand::light).stiffness_n_per_m
                                  : hand.stiffness_n_per_m;
  return 1.0 + felt_stiffness(player, stiffness_n_per_m) / own;
}

ScenePlay sweep(const ScenePlayer& player, const SceneValues& values) {
  ScenePlay play;
  // A slow sweep at 5 mm/s, as for figure 1, as far as the force is given.
  const double most_mm = std::min(9.0, 7.2e3 / std::max(values["k"], 1.0));
  const double aim_mm = most_mm * aim_in(player, values["k"]);
  for (const auto& [time_s, x] : {std::pair{0.0, 0.0}, {2.0, -1.0}, {6.0, 1.0}, {8.0, 0.0}}) {
    HandKey key;
    key.time_s = time_s;
    key.place_mm = center_of(values) + Vec3{x * aim_mm, 0.0, 0.0};
    play.plan.push_back(key);
  }
  play.surface_mm = center_of(values);
  play.figure = Figure::force_over_position;
  play.axis = 0;
  play.inward = {1.0, 0.0, 0.0};
  return play;
}

ScenePlay let_go(const ScenePlayer& player, const SceneValues& values) {
  constexpr double kMostMm = 9.0;
  constexpr double kMostN = 7.2;  // within what the safety gate gives
  const double from_mm = std::min(kMostMm, 1e3 * kMostN / std::max(values["k"], 1.0));
  ScenePlay play;
  // Held against what it feels, which the coupling makes softer, and then let go.
  HandKey placed;
  placed.place_mm = center_of(values) + Vec3{from_mm, 0.0, 0.0};
  placed.direction = {1.0, 0.0, 0.0};
  HandKey held = placed;
  held.time_s = 0.3;
  held.press_n = 1e-3 * from_mm * felt_stiffness(player, values["k"]);
  HandKey released = held;
  released.time_s = 1.0;
  released.holds = false;
  play.plan = {placed, held, released};
  play.surface_mm = center_of(values);
  play.figure = Figure::position_over_time;
  play.axis = 0;
  play.inward = {1.0, 0.0, 0.0};
  return play;
}

ScenePlay press_wall(const ScenePlayer&, const SceneValues& values) {
  ScenePlay play;
  play.surface_mm = {0.0, values["offset"], 0.0};
  play.plan = haptics::press_plan(play.surface_mm, play.inward, kPlayPressN);
  play.figure = Figure::force_over_position;
  return play;
}

/// Round an arc of a circle about a point, from angle `from` to `to`.
std::vector<Touch> arc(const Vec3& center_mm, double radius_mm, double from, double to,
                       double rise_mm) {
  constexpr int kParts = 16;
  std::vector<Touch> touches;
  for (int n = 0; n <= kParts; ++n) {
    const double t = static_cast<double>(n) / kParts;
    const double angle = from + t * (to - from);
    const Vec3 out{std::sin(angle), std::cos(angle), 0.0};
    touches.push_back({center_mm + radius_mm * out + Vec3{0.0, 0.0, rise_mm * (t - 0.5)}, -out});
  }
  return touches;
}

/// A number as gnuplot reads it: never a whole one, which it would divide as such.
std::string plotted(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "(%.6f)", value);
  return text;
}

/// x, y and z of an object around a point, each over u and v.
std::string splot(const Vec3& at, const std::string& x, const std::string& y,
                  const std::string& z) {
  return "splot " + plotted(at.x) + "+" + x + ", " + plotted(at.y) + "+" + y + ", " +
         plotted(at.z) + "+" + z;
}

ScenePlay slide_over_sphere(const ScenePlayer&, const SceneValues& values) {
  ScenePlay play = touch(arc(center_of(values), values["R"], -0.5, 0.4, 0.0));
  const std::string radius = plotted(values["R"]);
  play.object = splot(center_of(values), radius + "*sin(u)*cos(v)", radius + "*cos(u)",
                      radius + "*sin(u)*sin(v)");
  return play;
}

ScenePlay slide_over_cylinder(const ScenePlayer&, const SceneValues& values) {
  // Not off its ends.
  const double rise_mm = std::min(60.0, 0.6 * values["H"]);
  ScenePlay play = touch(arc(center_of(values), values["R"], -0.7, 0.7, rise_mm), kLightPressN);
  const std::string radius = plotted(values["R"]);
  // As tall as it usually is it would not be in the picture whole.
  play.object =
      "set view 62,38,0.65\n" + splot(center_of(values), radius + "*sin(2*u)", radius + "*cos(2*u)",
                                      plotted(values["H"]) + "*(v/pi/2-0.5)");
  return play;
}

/// Straight along a wall whose solid lies below in z.
std::vector<Touch> line(const Vec3& from, const Vec3& to) {
  return {{from, {0.0, 0.0, -1.0}}, {to, {0.0, 0.0, -1.0}}};
}

ScenePlay slide_over_pebbles(const ScenePlayer&, const SceneValues& values) {
  // Between their tops and the valleys.
  const double radius = std::min(values["r"], 1.5 * values["spacing"]);
  const double z = values["offset"] + radius - 0.5;
  ScenePlay play = touch(line({-15.0, 1.0, z}, {15.0, 4.0, z}), kLightPressN);
  play.object = "set isosamples 41,81\ns=" + plotted(values["spacing"]) + "\nr=" + plotted(radius) +
                "\noff(x)=x-s*floor(x/s+0.5)\ntop(x,y)=" + plotted(values["offset"]) +
                "+sqrt(r>sqrt(off(x)**2+off(y)**2)?r**2-off(x)**2-off(y)**2:0)\n"
                "splot 40*(u-pi/2)/pi, 20*(v-pi)/pi/2+2.5, "
                "top(40*(u-pi/2)/pi,20*(v-pi)/pi/2+2.5)";
  return play;
}

/// Of a wave along one axis, at y = 0 of that along the other.
double height_mm(const SceneValues& values, double frequency_per_m, double along_mm) {
  return values["offset"] +
         values["A"] * std::sin(2e-3 * std::numbers::pi * frequency_per_m * along_mm);
}

/// The wave A sin(2 pi f s) of a parameter in mm, for gnuplot.
std::string wave(const char* function, double frequency_per_m, const std::string& along) {
  return std::string(function) + "(2*pi*" + plotted(1e-3 * frequency_per_m) + "*" + along + ")";
}

ScenePlay slide_over_sine(const ScenePlayer&, const SceneValues& values) {
  // Along x from one trough to the next, or as far as a hand slides.
  const double f = values["fx"];
  const double quarter_mm = f > 0.0 ? std::min(250.0 / f, 12.5) : 12.5;
  const double z = height_mm(values, f, -quarter_mm);
  ScenePlay play = touch(line({-quarter_mm, 0.0, z}, {3.0 * quarter_mm, 1.0, z}));
  play.object = "splot 100*(u-pi/2)/pi, 100*(v-pi)/pi/2, " + plotted(values["offset"]) + "+" +
                plotted(values["A"]) + "*" + wave("sin", f, "100*(u-pi/2)/pi") + "*" +
                wave("cos", values["fy"], "100*(v-pi)/pi/2");
  return play;
}

ScenePlay slide_over_network(const ScenePlayer& player, const SceneValues& values) {
  const double length_mm = 1e3 / values["f"];
  const SceneValues waves = scene_values(haptics::find_scene("sine-normal")->parameters,
                                         {{"A", haptics::SineNetwork::kAmplitude * length_mm},
                                          {"fx", values["f"]},
                                          {"fy", values["f"]},
                                          {"offset", values["offset"]}});
  return slide_over_sine(player, waves);
}

/// The middle of the groove next to y = 0, where the slider is deepest, as far as a hand reaches.
double groove_mm(const SceneValues& values) {
  constexpr double kReachMm = 40.0;
  return values["f"] > 0.0 ? std::max(-250.0 / values["f"], -kReachMm) : -12.5;
}

std::string grooves(const SceneValues& values) {
  return "splot 100*(u-pi/2)/pi, 80*(v-pi)/pi/2, " + plotted(values["offset"]) + "+" +
         plotted(values["A"]) + "*" + wave("sin", values["f"], "80*(v-pi)/pi/2");
}

ScenePlay slide_in_groove(const ScenePlayer&, const SceneValues& values) {
  const double y = groove_mm(values);
  const double z = height_mm(values, values["f"], y);
  ScenePlay play = touch(line({-20.0, y, z}, {20.0, y, z}));
  play.object = grooves(values);
  return play;
}

ScenePlay slide_over_click(const ScenePlayer&, const SceneValues& values) {
  // Along the groove, over the ball, and back onto it. Beside its top, where the groove holds a
  // hand that on the top would slide off.
  constexpr double kOverS = 3.0;
  const double y = groove_mm(values);
  const double z = height_mm(values, values["f"], y);
  const Vec3 ball = center_of(values);
  const double beside_mm = y - ball.y;
  const double height = std::sqrt(std::max(0.0, values["R"] * values["R"] - beside_mm * beside_mm));
  std::vector<Touch> touches = line({-30.0, y, z}, {30.0, y, z});
  touches.push_back({{ball.x, y, std::max(z, ball.z + height)}, {0.0, 0.0, -1.0}});
  ScenePlay play = touch(touches);
  play.plan = slide_plan(touches, kOverS);
  const std::string radius = plotted(values["R"]);
  play.object = splot(center_of(values), radius + "*sin(u)*cos(v)", radius + "*cos(u)",
                      radius + "*sin(u)*sin(v)");
  return play;
}

/// To and fro through all of a box that is larger than what the handle reaches: a sine along each
/// axis, of which none is a multiple of another.
void sweep_volume(std::vector<HandKey>& plan) {
  constexpr int kKeys = 3000;
  constexpr double kKeyS = 0.02;
  constexpr Vec3 kMiddleMm{0.0, 5.0, 0.0};
  constexpr Vec3 kHalfMm{65.0, 85.0, 80.0};
  constexpr Vec3 kHz{0.7, 0.4326, 0.2674};  // each that before it by the golden section
  const double start_s = plan.back().time_s;
  for (int n = 1; n <= kKeys; ++n) {
    const double t = n * kKeyS;
    HandKey key = plan.back();
    key.time_s = start_s + t;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      key.place_mm[axis] =
          kMiddleMm[axis] + kHalfMm[axis] * std::sin(2.0 * std::numbers::pi * kHz[axis] * t);
    }
    plan.push_back(key);
  }
}

/// To the end of each axis, whatever stops the handle there, and back; then everywhere.
ScenePlay go_round(const ScenePlayer&, const SceneValues&) {
  constexpr double kBeyondMm = 110.0;  // farther than it reaches
  constexpr double kWayS = 1.2;
  ScenePlay play;
  HandKey key;
  play.plan.push_back(key);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double end : {-kBeyondMm, 0.0, kBeyondMm, 0.0}) {
      key.time_s += kWayS;
      key.place_mm = {};
      key.place_mm[axis] = end;
      play.plan.push_back(key);
    }
  }
  sweep_volume(play.plan);
  return play;
}

struct Play {
  const char* scene;
  ScenePlay (*make)(const ScenePlayer& player, const SceneValues& values);
};
/// Of every scene of the catalogue.
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
    {"sine-differences", slide_over_sine},
    {"sine-network", slide_over_network},
    {"slider", slide_in_groove},
    {"click", slide_over_click},
    {"workspace", go_round},
};

}  // namespace

double governed_spring_n_per_m(double asked_n_per_m, double device_damping_n_s_per_m,
                               double period_s, double delay_s) noexcept {
  assert(asked_n_per_m > 0.0 && period_s > 0.0 && delay_s >= 0.0);
  return std::min(asked_n_per_m, haptics::GovernorOptions().share *
                                     haptics::stiffness_limit_n_per_m(device_damping_n_s_per_m,
                                                                      period_s, delay_s));
}

ScenePlay play_scene(const haptics::SceneEntry& entry, const SceneValues& values,
                     const ScenePlayer& player) {
  const auto play = std::ranges::find(kPlays, std::string_view(entry.name), &Play::scene);
  assert(play != std::end(kPlays));
  return play->make(player, values);
}

std::vector<HandKey> slide_plan(const std::vector<Touch>& touches, double slide_s) {
  assert(!touches.empty() && slide_s > 0.0);
  assert(std::abs(length(touches.front().inward) - 1.0) < 1e-9);
  std::vector<HandKey> plan =
      haptics::press_plan(touches.front().place_mm, touches.front().inward, kPlayPressN);
  HandKey key = plan.back();
  key.time_s = 1.0;
  plan.push_back(key);
  for (std::size_t n = 1; n < touches.size(); ++n) {
    key.time_s = 1.0 + slide_s * static_cast<double>(n) / static_cast<double>(touches.size() - 1);
    key.place_mm = touches[n].place_mm;
    key.direction = touches[n].inward;
    plan.push_back(key);
  }
  return plan;
}

std::vector<HandKey> after_wait(std::vector<HandKey> plan, double wait_s) {
  assert(!plan.empty() && wait_s >= 0.0);
  const HandKey first = plan.front();
  for (HandKey& key : plan) key.time_s += wait_s;
  // Its first key keeps the time and the position.
  plan.insert(plan.begin(), first);
  return plan;
}

}  // namespace argil::cli
