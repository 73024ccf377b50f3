// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "argil/core/result.h"
#include "argil/haptics/analysis/hold_test.h"
#include "argil/haptics/scene/scene_parameters.h"

#include "common/command.h"
#include "common/falcon_options.h"
#include "common/feel_options.h"
#include "common/guidance_option.h"
#include "common/hand_option.h"
#include "lab/clay.h"

namespace argil::cli::lab {

/// What the command line chose. Names are those of the options.
struct LabOptions {
  std::string scene;
  std::map<std::string, double> settings;  ///< parameters of the scene that are not to be usual
  std::string device = "sim";              ///< sim, falcon, or replay:FILE
  FalconChoice falcon;                     ///< of the device falcon
  std::size_t hand = 2;                    ///< of kHands
  std::size_t coupling = 1;                ///< direct, indirect
  std::size_t damping = 0;                 ///< of haptics::DampingKind: fixed, adaptive
  double seconds = 0.0;  ///< 0: as long as the scene's plan, and the hold after it
  double rate_hz = 1000.0;
  int delay_ticks = 1;
  double coupling_stiffness_n_per_m = 1500.0;
  FeelChoice feel;  ///< its mix is of the scene `clay`
  bool is_frictionless = false;
  bool has_governor = true;
  bool has_passivity = false;
  bool is_as_printed = false;
  bool has_vibro = false;
  GuidanceChoice guide;
  haptics::GuidanceOptions guidance;  ///< of `guide`, or of a recording; in the scene's frame
  bool is_real_time = false;
  bool is_quiet = false;
  bool is_list = false;              ///< of the scenes; nothing runs
  bool is_held_by_a_person = false;  ///< of a replay: it was recorded on a real device
  std::filesystem::path output;
  std::filesystem::path plot;

  // Of the scene `clay`.
  std::string project;  ///< "": a slab of clay
  haptics::ForceTool tool{haptics::ToolShape::ellipsoid, {4.0, 4.0, 4.0}, {}, {}, {}, {}};
  haptics::ForceMaterial material;
  std::size_t law = 0;     ///< energy, blanch
  std::size_t method = 2;  ///< volume, point, auto
  std::size_t action = 1;  ///< which of kWorkActions
  bool is_active = false;  ///< the hand works the clay while it slides
  std::filesystem::path save;
};

inline constexpr double kLeastRateHz = 50.0;
inline constexpr double kMostRateHz = 4000.0;
inline constexpr double kMostSeconds = 3600.0;

/// How a run is drawn.
enum class Figure {
  force_over_position,  ///< force against the position along `axis`, and that over time
  position_over_time,   ///< the position over time alone
  trajectory,           ///< the path of the handle over the object
};

/// A scene set up for a hand: the matter, what the hand does there, and what is worth drawing.
struct LabScene {
  std::unique_ptr<LabClay> clay;  ///< of the scene `clay` only, whose `scene` stays empty
  std::unique_ptr<haptics::ForceScene> scene;
  std::vector<haptics::HandKey> plan;
  /// Where in the frame of scene and path the device's 0 lies.
  Vec3 offset_mm;
  Figure figure = Figure::trajectory;
  std::size_t axis = 1;         ///< of force_over_position: 0 x, 1 y, 2 z
  Vec3 surface_mm;              ///< a point of the surface where the plan ends ...
  Vec3 inward{0.0, -1.0, 0.0};  ///< ... and the direction in: what depth is counted from
  haptics::ForceScene& felt() noexcept { return clay ? clay->served().scene() : *scene; }

  std::string object;    ///< gnuplot's commands for the object, a splot last; "" none
  bool is_y_up = false;  ///< it is drawn with y upwards: its columns are z, x, y
};

/// A kind of scene by its name.
struct LabSceneKind {
  const char* name;
  const char* about;  ///< one line, with the equation
  std::span<const haptics::SceneParameter> parameters;
  std::function<Result<LabScene>(const LabOptions& options, const Progress& progress)> make;
};
/// The scenes of haptics' catalogue, each with what a hand does there, and the clay.
const std::vector<LabSceneKind>& scene_kinds();

/// The scene `clay`: a project or a slab, pressed from above at its middle, then slid along.
std::span<const haptics::SceneParameter> clay_parameters();
Result<LabScene> make_clay(const LabOptions& options, const Progress& progress);

inline constexpr double kSlideS = 2.0;

/// Comes to the first point from 5 mm off, presses 3 N, and slides along the others in `slide_s`.
struct Touch {
  Vec3 place_mm;
  Vec3 inward;  ///< unit length
};
std::vector<haptics::HandKey> slide_plan(const std::vector<Touch>& touches,
                                         double slide_s = kSlideS);

/// The guidance of the options in the device's frame.
haptics::GuidanceOptions guidance_for(const LabOptions& options, const LabScene& scene);

/// The simulated hand and device and the servo that the options ask for.
haptics::HoldTest hold_test_for(const LabOptions& options, const LabScene& scene);

/// How far the handle came along each axis, within 2 mm of it; empty where it was at none.
Box3 reach_along_axes(const std::vector<haptics::ServoTick>& ticks);

/// Draws a run as the figures of the Falcon report are drawn.
/// Errors  as draw_plot.
Result<void> draw_run(const std::filesystem::path& picture, const LabOptions& options,
                      const LabScene& scene, const std::vector<haptics::ServoTick>& ticks);

}  // namespace argil::cli::lab
