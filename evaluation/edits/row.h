// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "edits/stroke_plan.h"

namespace argil::evaluation {

/// Who edits, and how it keeps its surface whole: Argil; Blender on a mesh that stays as it is,
/// with dynamic topology, or with its voxel remesher after each stroke.
enum class Editor { argil, plain, dyntopo, remesh };
const char* editor_name(Editor editor);

/// Of one stroke.
struct StrokeTime {
  double wall_ms = 0.0;
  double cpu_ms = 0.0;  ///< of all threads
};

/// The least of several runs each: what the machine takes while it does nothing else.
struct StrokeTimes {
  StrokeTime short_stroke;  ///< of kShortDabs
  StrokeTime long_stroke;   ///< of kLongDabs
  StrokeTime once;          ///< of what comes once after a stroke: the voxel remesher

  double dab_wall_ms() const noexcept {
    return (long_stroke.wall_ms - short_stroke.wall_ms) / (kLongDabs - kShortDabs);
  }
  double dab_cpu_ms() const noexcept {
    return (long_stroke.cpu_ms - short_stroke.cpu_ms) / (kLongDabs - kShortDabs);
  }
  /// The long stroke and what comes after it.
  double stroke_wall_ms() const noexcept { return long_stroke.wall_ms + once.wall_ms; }
};

/// Distances in mm.
struct DistanceSpread {
  double mean_mm = 0.0;
  double p99_mm = 0.0;
  double max_mm = 0.0;
};

/// How exact a result is.
struct EditError {
  /// To the same stroke of the same program and tool where edges are a quarter as long, the worse
  /// of both directions.
  DistanceSpread to_finer;
  /// To the exact shape, likewise: the ball united with, or less, the swept tool.
  std::optional<DistanceSpread> to_swept;
  double longest_edge_mm = 0.0;  ///< of the result where the stroke went
};

/// One tool on one ball.
struct EditRow {
  Editor editor = Editor::argil;
  std::string tool;  ///< the program's own name of it
  Brush brush = Brush::draw;
  double vertices = 0.0;              ///< of the ball, as asked for
  double covered = 0.0;               ///< under a dab, as asked for
  std::int64_t covered_vertices = 0;  ///< under the first dab, counted
  double radius_mm = 0.0;             ///< of what is covered
  double voxel_mm = 0.0;              ///< of a clay with so many vertices
  StrokeTimes times;
  /// The farthest that the surface moved: a row of nothing is none. Of Argil as seen from outside
  /// at the dabs, of Blender the farthest way of a vertex; 0: not counted for this editor.
  double moved_mm = 0.0;
  std::optional<EditError> error;
};

std::string edits_csv(const std::vector<EditRow>& rows);

}  // namespace argil::evaluation
