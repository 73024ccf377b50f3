// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "commands/ui_state.h"
#include "picture/stereo.h"

namespace argil::viewer {

/// Where the points of a measurement lie in the sculpture; nothing while a piece of theirs is
/// hidden, or gone.
std::optional<std::vector<Vec3>> places_of(std::span<const MeasurePoint> points, const UiState& ui);

/// A number on the picture, beside its line.
struct MeasureLabel {
  Camera::Pixel at;  ///< of the window: the middle of the text
  std::string text;
  bool is_seen = true;  ///< else all of its points lie behind clay
  bool is_chosen = false;
};

/// An end, or a point that was begun.
struct MeasureDot {
  Camera::Pixel at;
  bool is_seen = true;
  bool is_chosen = false;
  bool is_under_pointer = false;
};

struct MeasureMarks {
  std::vector<MeasureLabel> labels;
  std::vector<MeasureDot> dots;
};

/// What is drawn over a part of the window, as large on the screen whatever the distance: of all
/// measurements whose pieces are shown, and of the one that is begun up to the pointer.
MeasureMarks measure_marks(const UiState& ui, const WindowPart& part);

/// The lines between them, and the arcs of angles.
void add_measure_lines(const UiState& ui, Picture& picture);

}  // namespace argil::viewer
