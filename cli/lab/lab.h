// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
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
#include "play/scene_option.h"
#include "play/scene_play.h"

namespace argil::cli::lab {

/// What the command line chose. Names are those of the options.
struct LabOptions {
  std::string scene;
  SceneSettings settings;
  std::string device = "sim";  ///< sim, falcon, or replay:FILE
  FalconChoice falcon;         ///< of the device falcon
  std::size_t hand = 2;        ///< of kHands
  std::size_t coupling = 1;    ///< direct, indirect
  double seconds = 0.0;        ///< 0: as long as the scene's plan, and the hold after it
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
  std::string piece;    ///< of a project with several
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

/// A scene set up for a hand: the matter, what the hand does there, and what is worth drawing.
struct LabScene : ScenePlay {
  std::unique_ptr<LabClay> clay;  ///< of the scene `clay` only, whose `scene` stays empty
  std::unique_ptr<haptics::ForceScene> scene;
  /// Where in the frame of scene and path the device's 0 lies.
  Vec3 offset_mm;
  haptics::ForceScene& felt() noexcept { return clay ? clay->served().scene() : *scene; }
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
