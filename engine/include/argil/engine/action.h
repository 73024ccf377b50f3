// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string_view>

#include "argil/engine/action_picture.h"
#include "argil/engine/falloff.h"

namespace argil {

/// What a dab does; docs/actions.md shows each. Files have the names and no numbers.
enum class Action {
#define ARGIL_ACTION(name, ...) name,
#include "argil/engine/action_rows.h"
};

/// How an action works: what it reads, and so when it is applied and which shapes it takes.
enum class ActionKind {
  stamped,   ///< reads the tool's exact distance; edit by edit (DabFeeder), any shape
  local,     ///< reads the clay that the last dab left under the tool; dab by dab, a ball or an
             ///< ellipsoid
  anchored,  ///< reads the clay as it was when the stroke began: the whole path of the stroke at
             ///< once, so that detail is resampled once; a ball or an ellipsoid
  profiled,  ///< reads the clay as it was when the stroke began, under the tool; edit by edit
             ///< (DabFeeder), and where its dabs lie over each other the one that moves the surface
             ///< farthest counts; a ball or an ellipsoid
  painted    ///< reads and writes the mask and no level; dab by dab, a ball or an ellipsoid
};

/// As scripts have them.
inline constexpr std::array<std::string_view, 9> kFalloffNames{
    "smooth", "smoother", "sphere",         "root",    "sharp",
    "linear", "sharper",  "inverse_square", "constant"};

/// Whether it falls by at most 2 per radius: a steeper one would fold matter that is moved.
constexpr bool is_gentle(Falloff falloff) noexcept {
  return falloff != Falloff::sphere && falloff != Falloff::root && falloff != Falloff::sharper &&
         falloff != Falloff::constant;
}

/// Which of the falloffs (argil/engine/falloff.h) an action takes.
enum class Curves {
  none,    ///< it has no falloff, or one of its own
  gentle,  ///< it moves matter: those that fold none
  all
};

/// Of an action that no letter chooses: there are more of them than letters. No key has this code.
inline constexpr char kNoKey = '\x01';

/// What there is to say of an action: its row in argil/engine/action_rows.h.
struct ActionInfo {  // NOLINT(clang-analyzer-optin.performance.Padding): in the order of use
  Action action;
  const char* name;  ///< in scripts, as on the command line
  ActionKind kind;

  // What strokes ask.
  bool is_signed = false;   ///< takes negative strengths, which do the opposite
  bool is_cut = false;      ///< of stamped ones: the tool is sunk into the surface, not set on it
  bool is_dragged = false;  ///< a pointer drags what it took in the plane of the picture; else the
                            ///< tool follows the surface
  Curves curves = Curves::none;         ///< which falloffs a tool may have
  std::optional<Action> opposite = {};  ///< what Ctrl does where `is_signed` does not say it

  // What a window shows. A row that leaves one out, or takes another's key or place, does not
  // compile (action/action_table.cpp).
  int place = 0;            ///< where panels show it: the smallest comes first; none twice
  char key = '\0';          ///< letter that chooses it, none twice; or kNoKey
  const char* title = "";   ///< as panels have it
  const char* help = "";    ///< one line
  ActionPicture picture{};  ///< for its button
};

/// All actions, in the order of their numbers. Constant data without an initialiser that runs: to
/// be used from any thread and at any time.
inline constexpr ActionInfo kActionInfos[] = {
#define ARGIL_ACTION(id, form, ...) \
  {.action = Action::id, .name = #id, .kind = ActionKind::form, __VA_ARGS__},
#include "argil/engine/action_rows.h"
};
inline constexpr std::size_t kActionCount = std::size(kActionInfos);

/// The row of an action that there is; a number that is none is a programming error (assert).
constexpr const ActionInfo& info_of(Action action) noexcept {
  const auto n = static_cast<std::size_t>(action);
  assert(n < kActionCount);
  return kActionInfos[n];
}

/// Their names, to be read and written by, each at the place of its number; case counts.
inline constexpr auto kActionNames = [] {
  std::array<std::string_view, kActionCount> names{};
  for (std::size_t n = 0; n < kActionCount; ++n) names[n] = kActionInfos[n].name;
  return names;
}();

/// Whether an action takes negative strengths.
constexpr bool is_signed(Action action) noexcept { return info_of(action).is_signed; }

/// Whether it works by the tool's exact distance: these alone take boxes, capsules and meshes.
constexpr bool is_stamped(Action action) noexcept {
  return info_of(action).kind == ActionKind::stamped;
}
/// Whether each piece of a stroke does the whole path again, at the cost of all dabs so far.
constexpr bool is_anchored(Action action) noexcept {
  return info_of(action).kind == ActionKind::anchored;
}
/// Whether a piece of its path may be applied to what the pieces before left: that comes near to
/// what the whole does, but for detail, which each piece resamples. The end of the stroke does the
/// whole path again, from the clay as it was when it began: what was worked before is thrown away.
constexpr bool can_be_carried(Action action) noexcept {
  return action == Action::grab || action == Action::twist || action == Action::elastic ||
         action == Action::slide;
}
/// Whether it lays a profile along the stroke: these alone read the tool's sharpness and width.
constexpr bool is_profiled(Action action) noexcept {
  return info_of(action).kind == ActionKind::profiled;
}
/// Whether a tool of it may have this falloff; what has none leaves it unread.
constexpr bool takes(Action action, Falloff falloff) noexcept {
  return info_of(action).curves != Curves::gentle || is_gentle(falloff);
}
/// Whether it changes the mask, and so not the surface.
constexpr bool is_painted(Action action) noexcept {
  return info_of(action).kind == ActionKind::painted;
}

}  // namespace argil
