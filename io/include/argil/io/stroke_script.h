// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/engine/clay.h"
#include "argil/engine/mask_filter.h"
#include "argil/engine/mask_outline.h"
#include "argil/engine/operation.h"
#include "argil/engine/sculpture.h"
#include "argil/engine/stroke.h"

namespace argil::io {

/// What a script may start from, so that it needs no project file.
struct StartShape {
  enum class Kind { ball, block } kind = Kind::ball;
  Vec3 size_mm;  ///< ball: the radius in x; block: the three sides
  ClayOptions options;
};

/// Takes the last stroke back, or repeats it.
enum class HistoryStep { undo, redo };

/// What a person did to the clay, as one line of a script or journal.
using ScriptStep =
    std::variant<Stroke, HistoryStep, Operation, MaskEdit, MaskFilter, MaskOutline, PieceEdit>;

struct StrokeScript {
  std::optional<StartShape> start;
  std::vector<ScriptStep> steps;
};

/// Does one step to the active piece, or to the list of pieces; only a stroke reports dabs.
/// Errors  those of Clay::apply and Sculpture::apply; bad_input when the active piece is locked, or
///         there is nothing to undo or redo.
Result<StrokeReport> apply_step(Sculpture& sculpture, const ScriptStep& step,
                                const Progress& progress = {});

/// The same to a clay that is no piece of a sculpture; steps of pieces are refused.
Result<StrokeReport> apply_step(Clay& clay, const ScriptStep& step, const Progress& progress = {});

/// Success, or bad_input naming what of the step is out of its range.
Result<void> validate_step(const ScriptStep& step);

/// Reads JSON Lines: one header line, then one step per line (DESIGN section 6; docs/files.md). A
/// session's journal is a script too. The meshes and clays that lines name are read with it, each
/// once.
/// Errors  bad_input "FILE:LINE: key 'radius_mm' is -4; must be greater than 0": names line and
///         key, also for a mesh or clay that is not there or not what it should be; disk.
Result<StrokeScript> read_stroke_script(const std::filesystem::path& file);

/// One step as a line of a script has it, from a program that makes steps itself. `name` is what
/// messages call where it comes from; files that it names are seen from `folder`.
/// Errors  as read_stroke_script, without a line's number; bad_input for several lines, and for
///         what only a journal has.
Result<ScriptStep> read_script_step(const std::string& name, std::string_view line,
                                    const std::filesystem::path& folder);

}  // namespace argil::io
