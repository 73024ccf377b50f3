// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene/scene_catalogue.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "argil/haptics/scene/scene_pebbles.h"
#include "argil/haptics/scene/scene_round.h"
#include "argil/haptics/scene/scene_sine.h"
#include "argil/haptics/scene/scene_sine_network.h"
#include "argil/haptics/scene/scene_slider.h"
#include "argil/haptics/scene/scene_spring.h"
#include "argil/haptics/scene/scene_wall.h"
#include "argil/haptics/scene/scene_workspace.h"

namespace argil::haptics {
namespace {

using Made = std::unique_ptr<ForceScene>;

constexpr double kFarthestMm = 60.0;  ///< of what a handle can reach
constexpr SceneParameter place(const char* equation, const char* name, double usual,
                               const char* about) {
  return {name, "mm", usual, -kFarthestMm, kFarthestMm, about, equation};
}
constexpr SceneParameter offset(const char* equation, double usual) {
  return place(equation, "offset", usual, "where the middle of the surface is");
}
constexpr SceneParameter damping(const char* equation, double usual, double most = 20.0) {
  return {"c", "N s/m", usual, 0.0, most, "the damper", equation};
}
constexpr SceneParameter stiffness(const char* equation, double usual, double most) {
  return {"k", "N/m", usual, 0.0, most, "the spring", equation};
}
/// Stiffer than any hand can hold directly; through the coupling all are quiet.
constexpr double kMostWallStiffness = 40'000.0;
constexpr double kMostStiffness = 10'000.0;
/// Of what is large, or let go: softer.
constexpr double kMostSoftStiffness = 3000.0;

Vec3 center_of(const SceneValues& values) { return {values["x"], values["y"], values["z"]}; }
double stiffness_of(const SceneValues& values) { return values["k"]; }

#define ARGIL_CENTER(equation)                                                      \
  place(equation, "x", 0.0, "the middle"), place(equation, "y", 0.0, "the middle"), \
      place(equation, "z", 0.0, "the middle")

// A spring, and the handle let go in it.

constexpr SceneParameter kSpring[] = {stiffness("(3.1)", 800.0, kMostStiffness),
                                      damping("(3.1)", 10.0), ARGIL_CENTER("(3.1)")};
constexpr SceneParameter kFree[] = {stiffness("(3.1), (3.5)", 800.0, kMostSoftStiffness),
                                    damping("(3.1)", 0.0), ARGIL_CENTER("(3.1)")};

Made make_spring(const SceneValues& values) {
  return std::make_unique<SpringScene>(SpringOptions{center_of(values), values["k"], values["c"]});
}

// Walls.

constexpr SceneParameter kRigidWall[] = {
    {"F", "N", 20.0, 0.1, 100.0, "the push behind the surface", "(3.6)"}, offset("(3.6)", -20.0)};
constexpr SceneParameter kLinearWall[] = {stiffness("(3.7)", 800.0, kMostWallStiffness),
                                          damping("(3.7)", 10.0), offset("(3.7)", -20.0)};
constexpr SceneParameter kNonlinearWall[] = {
    {"k", "N/m^n", 1e5, 0.0, 1e7, "of the depth", "(3.8)"},
    {"c", "N/(m/s)^m", 10.0, 0.0, 1000.0, "of the speed", "(3.8)"},
    {"n", "", 2.0, 1.0, 4.0, "the power of the depth", "(3.8)"},
    {"m", "", 2.0, 1.0, 4.0, "the power of the speed", "(3.8)"},
    offset("(3.8)", -20.0)};

Made make_rigid_wall(const SceneValues& values) {
  WallOptions options;
  options.kind = WallKind::rigid;
  options.offset_mm = values["offset"];
  options.rigid_force_n = values["F"];
  return std::make_unique<WallScene>(options);
}
double rigid_stiffness(const SceneValues&) { return kRigidStiffnessNPerM; }

Made make_linear_wall(const SceneValues& values) {
  WallOptions options;
  options.offset_mm = values["offset"];
  options.stiffness_n_per_m = values["k"];
  options.damping_n_s_per_m = values["c"];
  return std::make_unique<WallScene>(options);
}

Made make_nonlinear_wall(const SceneValues& values) {
  WallOptions options;
  options.kind = WallKind::nonlinear;
  options.offset_mm = values["offset"];
  options.power_stiffness_n_per_m_to_n = values["k"];
  options.power_damping_n_per_mps_to_m = values["c"];
  options.depth_exponent = values["n"];
  options.speed_exponent = values["m"];
  return std::make_unique<WallScene>(options);
}

/// The slope of F = k d^n where that is 8 N.
double nonlinear_stiffness(const SceneValues& values) {
  constexpr double kMostN = 8.0;
  const double n = values["n"];
  return n * std::pow(values["k"] * std::pow(kMostN, n - 1.0), 1.0 / n);
}

// What is round.

constexpr SceneParameter radius(const char* equation, double usual) {
  return {"R", "mm", usual, 5.0, 100.0, "the radius", equation};
}
constexpr SceneParameter kSphere[] = {radius("(3.9)", 50.0),
                                      stiffness("(3.9)", 3000.0, kMostStiffness),
                                      damping("(3.9)", 50.0, 100.0), ARGIL_CENTER("(3.9)")};
constexpr SceneParameter kCylinder[] = {
    radius("(3.11)", 30.0),
    {"H", "mm", 100.0, 1.0, 500.0, "the height", "section 3.5.2"},
    stiffness("(3.13)", 3000.0, kMostStiffness),
    damping("(3.13), (3.14)", 50.0, 100.0),
    ARGIL_CENTER("(3.10)")};

Made make_sphere(const SceneValues& values) {
  return std::make_unique<SphereScene>(
      SphereOptions{center_of(values), values["R"], values["k"], values["c"]});
}
Made make_cylinder(const SceneValues& values) {
  return std::make_unique<CylinderScene>(
      CylinderOptions{center_of(values), values["R"], values["H"], values["k"], values["c"]});
}

constexpr SceneParameter kPebbles[] = {
    {"spacing", "mm", 5.0, 0.5, 50.0, "between neighbours", "section 3.6.1"},
    {"r", "mm", 6.0, 0.1, 75.0, "the radius of each; at most 1.5 spacings count", "(3.15)"},
    {"columns", "", 21.0, 1.0, 1000.0, "balls along x", "section 3.6.1"},
    {"rows", "", 21.0, 1.0, 1000.0, "balls along y", "section 3.6.1"},
    stiffness("(3.15)", 1000.0, kMostSoftStiffness),
    damping("(3.15)", 5.0),
    offset("section 3.6.1", -20.0)};

Made make_pebbles(const SceneValues& values) {
  PebblesOptions options;
  options.center_mm.z = values["offset"];
  options.spacing_mm = values["spacing"];
  options.radius_mm = std::min(values["r"], 1.5 * options.spacing_mm);
  options.columns = static_cast<int>(std::lround(values["columns"]));
  options.rows = static_cast<int>(std::lround(values["rows"]));
  options.stiffness_n_per_m = values["k"];
  options.damping_n_s_per_m = values["c"];
  return std::make_unique<PebblesScene>(options);
}
/// Of three that a handle sinks in between.
double pebbles_stiffness(const SceneValues& values) { return 3.0 * values["k"]; }

// Waves.

constexpr SceneParameter amplitude(const char* equation) {
  return {"A", "mm", 5.0, 0.0, 20.0, "the height of the waves", equation};
}
constexpr SceneParameter frequency(const char* equation, const char* name) {
  return {name, "1/m", 20.0, 0.0, 500.0, "how many there are", equation};
}
#define ARGIL_SINE                                                           \
  amplitude("(3.16)"), frequency("(3.16)", "fx"), frequency("(3.16)", "fy"), \
      stiffness("(3.17)", 1000.0, kMostStiffness), damping("(3.17)", 0.0), offset("(3.16)", -20.0)
constexpr SceneParameter kSine[] = {ARGIL_SINE};
constexpr SceneParameter kSineTable[] = {
    ARGIL_SINE,
    {"spacing", "mm", 1.0, 0.2, 80.0, "from one normal of the table to the next", "section 3.6.4"}};
constexpr SceneParameter kSineDifferences[] = {
    ARGIL_SINE, {"step", "mm", 0.1, 1e-6, 10.0, "between the heights compared", "section 3.6.4"}};
constexpr SceneParameter kSineNetwork[] = {
    {"f", "1/m", 20.0, 5.0, 200.0, "how many waves there are; each a tenth as high as long",
     "(3.16)"},
    stiffness("(3.17)", 1000.0, kMostStiffness),
    damping("(3.17)", 0.0),
    offset("(3.16)", -20.0)};

SineOptions sine_of(SineDirection direction, const SceneValues& values) {
  SineOptions options;
  options.direction = direction;
  options.offset_mm = values["offset"];
  options.amplitude_mm = values["A"];
  options.frequency_x_per_m = values["fx"];
  options.frequency_y_per_m = values["fy"];
  options.stiffness_n_per_m = values["k"];
  options.damping_n_s_per_m = values["c"];
  return options;
}
template <SineDirection direction>
Made make_sine(const SceneValues& values) {
  return std::make_unique<SineScene>(sine_of(direction, values));
}
template <SineDirection direction>
Made make_sine_table(const SceneValues& values) {
  SineOptions options = sine_of(direction, values);
  options.table_spacing_mm = values["spacing"];
  return std::make_unique<SineScene>(options);
}

Made make_sine_differences(const SceneValues& values) {
  SineOptions options = sine_of(SineDirection::differences_central, values);
  options.difference_step_mm = values["step"];
  return std::make_unique<SineScene>(options);
}
Made make_sine_network(const SceneValues& values) {
  return std::make_unique<SineNetworkScene>(
      SineNetworkOptions{values["offset"], values["f"], values["k"], values["c"]});
}
/// As deep as it is accurate its gradient is of unit length within this, squared (SineNetwork.*).
double sine_network_stiffness(const SceneValues& values) {
  constexpr double kSquare = 1.05;
  return kSquare * values["k"];
}

/// Of the normal's square of length, where the waves are steepest.
double steepest(const SceneValues& values) {
  const double per_mm = 2e-3 * std::numbers::pi * std::max(values["fx"], values["fy"]);
  return 1.0 + std::pow(per_mm * values["A"], 2);
}
double sine_stiffness(const SceneValues& values) { return values["k"] * steepest(values); }
double gradient_stiffness(const SceneValues& values) {
  return values["k"] * std::pow(steepest(values), 2);
}

constexpr SceneParameter kSlider[] = {amplitude("(3.23)"), frequency("(3.23)", "f"),
                                      stiffness("(3.26)", 1500.0, kMostSoftStiffness),
                                      damping("(3.27)", 5.0), offset("(3.23)", 40.0)};
constexpr SceneParameter kClick[] = {
    amplitude("(3.23)"),
    frequency("(3.23)", "f"),
    stiffness("(3.26)", 1500.0, kMostSoftStiffness),
    damping("(3.27)", 5.0),
    offset("(3.23)", -6.0),
    {"R", "mm", 15.0, 5.0, 100.0, "the radius of the ball", "(3.28)"},
    {"ball-k", "N/m", 8000.0, 0.0, kMostStiffness, "the spring of the ball", "(3.28)"},
    place("(3.28)", "x", 0.0, "the middle of the ball"),
    place("(3.28)", "y", -20.0, "the middle of the ball"),
    place("(3.28)", "z", -20.0, "the middle of the ball")};

SliderOptions slider_of(const SceneValues& values) {
  return {values["offset"], values["A"], values["f"], values["k"], values["c"]};
}
Made make_slider(const SceneValues& values) {
  return std::make_unique<SliderScene>(slider_of(values));
}
Made make_click(const SceneValues& values) {
  ClickOptions options;
  options.slider = slider_of(values);
  options.sphere = {center_of(values), values["R"], values["ball-k"], 0.0};
  return std::make_unique<ClickScene>(options);
}
double click_stiffness(const SceneValues& values) { return values["k"] + values["ball-k"]; }

constexpr SceneParameter kWorkspace[] = {
    {"k", "N/m", 0.0, 0.0, 1850.0, "a wall around what the report reached", "section 3.1"},
    damping("section 3.1", 0.0)};

Made make_workspace(const SceneValues& values) {
  WorkspaceOptions options;
  options.wall_stiffness_n_per_m = values["k"];
  options.wall_damping_n_s_per_m = values["c"];
  return std::make_unique<WorkspaceScene>(options);
}

// Where a hand begins: the middle, or 5 mm off what would be felt there.

constexpr double kOffMm = 5.0;

Vec3 start_at_middle(const SceneValues&) { return {}; }
Vec3 start_at_center(const SceneValues& values) { return center_of(values); }
Vec3 start_above_y(const SceneValues& values) {
  return {0.0, std::max(values["offset"] + kOffMm, 0.0), 0.0};
}
Vec3 start_above_ball(const SceneValues& values) {
  return center_of(values) + Vec3{0.0, values["R"] + kOffMm, 0.0};
}
Vec3 start_above_pebbles(const SceneValues& values) {
  return {0.0, 0.0, std::max(values["offset"] + values["r"] + kOffMm, 0.0)};
}
Vec3 start_above_waves(const SceneValues& values) {
  return {0.0, 0.0, std::max(values["offset"] + values["A"] + kOffMm, 0.0)};
}
Vec3 start_above_network(const SceneValues& values) {
  const double height_mm = 1e3 * SineNetwork::kAmplitude / values["f"];
  return {0.0, 0.0, std::max(values["offset"] + height_mm + kOffMm, 0.0)};
}
Vec3 start_above_click(const SceneValues& values) {
  return {0.0, 0.0,
          std::max({values["offset"] + values["A"], values["z"] + values["R"], 0.0}) + kOffMm};
}

using enum SineDirection;

constexpr SceneEntry kScenes[] = {
    {"spring", "a spring and damper about the middle (3.1)", kSpring, start_at_center, make_spring,
     stiffness_of},
    {"free", "the handle let go in a spring, and what that tells of it (3.2-3.5)", kFree,
     start_at_center, make_spring, stiffness_of},
    {"wall-rigid", "a constant 20 N below y = -20 mm (3.6)", kRigidWall, start_above_y,
     make_rigid_wall, rigid_stiffness},
    {"wall-linear", "a spring and damper there (3.7)", kLinearWall, start_above_y, make_linear_wall,
     stiffness_of},
    {"wall-nonlinear", "squares of depth and speed (3.8)", kNonlinearWall, start_above_y,
     make_nonlinear_wall, nonlinear_stiffness},
    {"sphere", "a ball of 50 mm (3.9)", kSphere, start_above_ball, make_sphere, stiffness_of},
    {"cylinder", "a cylinder of 30 mm about z (3.10-3.14)", kCylinder, start_above_ball,
     make_cylinder, stiffness_of},
    {"pebbles", "a wall of balls (3.15)", kPebbles, start_above_pebbles, make_pebbles,
     pebbles_stiffness},
    {"sine-z", "a sine wall that pushes along z (3.17)", kSine, start_above_waves,
     make_sine<z_only>, sine_stiffness},
    {"sine-normal", "along its unit normal (3.22)", kSine, start_above_waves,
     make_sine<unit_normal>, sine_stiffness},
    {"sine-gradient", "along its gradient: no work on a closed path", kSine, start_above_waves,
     make_sine<gradient>, gradient_stiffness},
    {"sine-table", "along normals of a table, bilinear (section 3.6.4)", kSineTable,
     start_above_waves, make_sine_table<table_bilinear>, sine_stiffness},
    {"sine-nearest", "the same, nearest", kSineTable, start_above_waves,
     make_sine_table<table_nearest>, sine_stiffness},
    {"sine-differences", "along normals from differences of the height (section 3.6.4)",
     kSineDifferences, start_above_waves, make_sine_differences, sine_stiffness},
    {"sine-network", "a network of sines for distance and normal (section 3.6.4)", kSineNetwork,
     start_above_network, make_sine_network, sine_network_stiffness},
    {"slider", "grooves along x (3.23-3.27)", kSlider, start_above_waves, make_slider,
     stiffness_of},
    {"click", "the slider with a hard ball in it (3.28)", kClick, start_above_click, make_click,
     click_stiffness},
    {"workspace", "nothing to feel: how far the handle reaches (section 3.1)", kWorkspace,
     start_at_middle, make_workspace, stiffness_of},
};

}  // namespace

std::span<const SceneEntry> scene_catalogue() noexcept { return kScenes; }

const SceneEntry* find_scene(std::string_view name) noexcept {
  for (const SceneEntry& scene : kScenes) {
    if (scene.name == name) return &scene;
  }
  return nullptr;
}

}  // namespace argil::haptics
