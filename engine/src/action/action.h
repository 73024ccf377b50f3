// SPDX-License-Identifier: GPL-3.0-or-later
// The function of each action. Pure: levels and tool in, changed leaves out by the target; no
// history, no input handling. `tool_level` is the level the tool's size asks for.
#pragma once

#include <cstddef>
#include <span>
#include <variant>
#include <vector>

#include "argil/engine/action.h"

#include "brush/dab_plan.h"
#include "edit/edit.h"
#include "edit/stroke_start.h"

namespace argil {

/// The form of an action's function, by its kind.
template <ActionKind kind>
struct ActionForm;

/// A tool on several pieces of path in a row, one after the other: the union of all of them.
using ToolPath = std::vector<PosedTool>;

/// One dab, or several that are joined: the paths of those of its images that come near each other,
/// for one after the other would not leave a mirror image.
template <>
struct ActionForm<ActionKind::stamped> {
  using Function = void(EditTarget& target, std::span<const ToolPath> images, int tool_level);
};
/// One dab: those of its images that come near each other, for one after the other would not leave
/// a mirror image. What it displaces it marks in the target's queue, which is flushed afterwards.
template <>
struct ActionForm<ActionKind::local> {
  using Function = void(EditTarget& target, DabImages images, int tool_level);
};
/// All dabs of a stroke so far, groups of `images`, on the levels as they were before the first; or
/// a piece of them (can_be_carried()).
template <>
struct ActionForm<ActionKind::anchored> {
  using Function = void(EditTarget& target, const Tool& tool, std::span<const Dab> path,
                        std::size_t images);
};
/// One image of one dab, or of several that are joined. `start`: the clay as the stroke found it.
template <>
struct ActionForm<ActionKind::profiled> {
  using Function = void(EditTarget& target, const StrokeStart& start, const ToolPath& path,
                        int tool_level);
};
/// One dab: all images at once, however far apart.
template <>
struct ActionForm<ActionKind::painted> {
  using Function = void(EditTarget& target, DabImages images);
};

template <ActionKind kind>
using ActionFunction = typename ActionForm<kind>::Function;

namespace actions {
#define ARGIL_ACTION(name, kind, ...) ActionFunction<ActionKind::kind> name;
#include "argil/engine/action_rows.h"
}  // namespace actions

/// A function of any kind. Who visits it has to say how each kind is called.
using AnyActionFunction =
    std::variant<ActionFunction<ActionKind::stamped>*, ActionFunction<ActionKind::local>*,
                 ActionFunction<ActionKind::anchored>*, ActionFunction<ActionKind::profiled>*,
                 ActionFunction<ActionKind::painted>*>;
AnyActionFunction function_of(Action action) noexcept;

}  // namespace argil
