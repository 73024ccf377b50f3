// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <random>
#include <vector>

#include "argil/core/tool_sample.h"
#include "argil/engine/clay.h"
#include "argil/engine/tool_mesh.h"
#include "argil/io/stroke_script.h"

#include "support/shapes.h"
#include "support/stroke_maker.h"

namespace argil::test {

// One life of a sculpting program, as the child that is killed lives it and as the test that judges
// what it left repeats it: both must do the same steps.

inline constexpr int kLifeTurns = 24;

/// A life that moves is saved under the other name after so many turns each.
inline constexpr int kMoveTurns = 6;
inline std::filesystem::path moved_name(const std::filesystem::path& project) {
  return project.parent_path() / "moved.vdb";
}

/// Lives on end, whose seeds differ in their last digit, agree on it.
inline bool keeps_history(unsigned seed) { return seed / 10U % 2U == 0U; }

inline Clay life_start() { return Clay::ball(6.0, {0.4, 0.1}).value(); }

/// Between -1 and 1, the same on every machine.
inline double any_number(std::mt19937& random) {
  return static_cast<double>(random()) / 2147483648.0 - 1.0;
}

inline Vec3 any_place(std::mt19937& random) {
  const double x = any_number(random);
  const double y = any_number(random);
  return {x, y, any_number(random)};
}

/// A rod of a tool, with coordinates that no float holds. Long ones are quick to make.
inline std::shared_ptr<const ToolMesh> rod_tool(bool thick) {
  static const auto thin_rod = ToolMesh::make(box_mesh({6.0, 0.4 / 3.0, 0.2})).value();
  static const auto thick_rod = ToolMesh::make(box_mesh({5.0, 0.7, 1.0 / 3.0})).value();
  return thick ? thick_rod : thin_rod;
}

inline Stroke rod_stroke(std::mt19937& random) {
  Stroke stroke = random_dab(random, 6.0);
  stroke.tool = {
      random() % 2 == 0 ? Action::add : Action::carve, Shape::mesh, {3.0, 1.5, 1.5}, 1.0};
  stroke.tool.mesh = rod_tool(random() % 2 == 0);
  return stroke;
}

/// Another solid near the surface.
inline Combine any_combination(std::mt19937& random) {
  static const auto box = std::make_shared<const TriangleMesh>(box_mesh({2.1, 3.3, 1.7}));
  static const auto ball = std::make_shared<const Clay>(Clay::ball(3.5, {0.4, 0.1}).value());
  Combine with;
  with.kind = random() % 2 == 0 ? CombineKind::unite : CombineKind::subtract;
  if (random() % 2 == 0) {
    with.mesh = box;
  } else {
    with.clay = ball;
  }
  with.placement.position_mm = any_place(random) * 5.0;
  with.placement.orientation = {1.0, any_number(random), 0.3, 0.1};
  return with;
}

inline Operation any_operation(std::mt19937& random) {
  switch (random() % 6) {
    case 0:
      return Offset{0.4 * any_number(random)};
    case 1:
      return Hollow{1.5, {}};
    case 2:
      return Resample{random() % 2 == 0 ? 0.4 : 0.3};
    case 3:
      return Cut{any_place(random) * 4.0, any_place(random), random() % 2 == 0};
    default:
      return any_combination(random);
  }
}

/// Of a few pieces that may be there or not: what cannot be is refused.
inline PieceEdit any_piece_edit(std::mt19937& random) {
  const auto name = [&] { return std::string(random() % 2 == 0 ? "Clay" : "Other"); };
  switch (random() % 9) {
    case 0:
      return SelectPiece{name()};
    case 6:
      return PlacePieces{{{"Clay", {any_place(random), {}}}, {"Other", {any_place(random), {}}}}};
    case 7:
      return ScalePiece{name(), random() % 2 == 0 ? 1.1 : 0.9, any_place(random)};
    case 8:
      return SplitPiece{name()};
    case 1:
      return CopyPiece{name(), "Other"};
    case 2:
      return RemovePiece{"Other"};
    case 3: {
      ChangePiece change{.name = name()};
      change.placement = Placement{any_place(random) * 3.0, {1.0, any_number(random), 0.3, 0.1}};
      change.is_visible = random() % 2 == 0;
      return change;
    }
    case 4:
      return MergePiece{name(), name(), CombineKind::unite, random() % 2 == 0};
    default: {
      const Combine solid = any_combination(random);
      AddPiece add;
      add.look.name = "Other";
      add.look.placement.position_mm = solid.placement.position_mm;
      add.clay = solid.clay;
      add.mesh = solid.mesh;
      return add;
    }
  }
}

/// A triangle over the picture of a piece of a few millimetres, from anywhere.
inline MaskOutline random_outline(std::mt19937& random) {
  const auto number = [&] { return static_cast<double>(random() % 2001) / 1000.0 - 1.0; };
  MaskOutline outline;
  outline.view = {{9.0 * number(), 9.0 * number(), 30.0}, {1.0, 0.1 * number(), 0.1, 0.0}, false};
  outline.view.is_parallel = random() % 2 == 0;
  const double unit = outline.view.is_parallel ? 6.0 : 0.2;
  auto& loop = outline.loops.emplace_back();
  for (int n = 0; n < 3; ++n) loop.push_back({unit * number(), unit * number()});
  outline.frees = random() % 3 == 0;
  outline.front_only = random() % 3 == 0;
  return outline;
}

/// What is done at a turn: a step, or nothing, which means: save the project.
inline std::optional<io::ScriptStep> life_step(unsigned seed, int turn) {
  std::mt19937 random(seed * 1000U + static_cast<unsigned>(turn));
  switch (random() % 17) {
    case 0:
      return std::nullopt;
    case 1:
    case 2:
      return io::HistoryStep::undo;
    case 3:
      return io::HistoryStep::redo;
    case 4:
      return any_operation(random);
    case 5:
    case 6:
      return rod_stroke(random);
    case 7:
      if (random() % 2 == 0) return random_outline(random);
      if (random() % 4 == 0) return MaskFilter(MaskGrow{random() % 2 == 0 ? 0.8 : -0.6});
      return static_cast<MaskEdit>(random() % 5);
    case 8: {
      Stroke held = random_dab(random, 6.0);
      held.tool.action = Action::mask;
      return held;
    }
    case 9:
    case 10:
    case 11:
      return any_piece_edit(random);
    default:
      return random_dab(random, 6.0);
  }
}

// ---- a life in the hand: samples instead of steps ----------------------------------------------

inline constexpr std::uint64_t kHandRuns = 8;
inline constexpr std::uint64_t kHandRun = 10;    ///< samples from one press to the next
inline constexpr std::uint64_t kHandActive = 7;  ///< of them

inline Tool hand_tool(unsigned seed) {
  Tool tool{seed % 2 == 0 ? Action::carve : Action::add, Shape::mesh, {2.0, 1.0, 1.0}, 0.9};
  tool.mesh = rod_tool(seed % 3 == 0);
  return tool;
}

/// Goes round the ball, pressed in runs.
inline ToolSample hand_sample(unsigned seed, std::uint64_t index) {
  ToolSample sample;
  sample.index = index + 1;
  sample.time_s = 0.002 * static_cast<double>(index);
  const double turn = 0.05 * static_cast<double>(index) + 0.7 * seed;
  const double rise = 0.03 * static_cast<double>(index);
  sample.position_mm =
      Vec3{turn - std::floor(turn) - 0.5, rise - std::floor(rise) - 0.5, 0.4} * 10.0;
  sample.pressure = 1.0;
  sample.is_active = index % kHandRun < kHandActive;
  sample.voxel_mm = 0.75;
  sample.reach_mm = 4.0;
  sample.depth_mm = 3.0;
  return sample;
}

/// The strokes that these samples are.
inline std::vector<Stroke> hand_strokes(unsigned seed) {
  std::vector<Stroke> strokes(kHandRuns);
  for (std::uint64_t run = 0; run < kHandRuns; ++run) {
    strokes[run].tool = hand_tool(seed);
    for (std::uint64_t n = 0; n < kHandActive; ++n) {
      const ToolSample s = hand_sample(seed, run * kHandRun + n);
      strokes[run].samples.push_back({s.time_s, s.position_mm, s.orientation, s.pressure});
    }
  }
  return strokes;
}

}  // namespace argil::test
