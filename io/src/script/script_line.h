// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "argil/io/stroke_script.h"

#include "format/json_fields.h"
#include "script/step_solid.h"

namespace argil::io {

/// As apply_step, also where the active piece is locked: what a journal tells was done.
Result<StrokeReport> repeat_step(Sculpture& sculpture, const ScriptStep& step,
                                 const Progress& progress);

// One line of a stroke script or of a journal, which is a script too (docs/files.md). No line ends
// here: a line is what stands between them.

inline constexpr int kScriptVersion = 1;

/// Names in the order of the enumeration, to be read and written by; those of actions are
/// argil::kActionNames.
inline constexpr auto kShapeNames =
    std::to_array<std::string_view>({"ball", "ellipsoid", "box", "capsule", "mesh"});
inline constexpr auto kAlphaModeNames =
    std::to_array<std::string_view>({"space", "anchored", "tiled"});
inline constexpr auto kAxisNames = std::to_array<std::string_view>({"x", "y", "z"});
inline constexpr auto kHistoryNames = std::to_array<std::string_view>({"undo", "redo"});
inline constexpr auto kMaskNames =
    std::to_array<std::string_view>({"clear", "invert", "blur", "fill", "sharpen"});
static_assert(static_cast<int>(Shape::ball) == 0 && static_cast<int>(Shape::mesh) == 4);
static_assert(static_cast<int>(AlphaMode::space) == 0 && static_cast<int>(AlphaMode::tiled) == 2);
static_assert(static_cast<int>(MaskEdit::clear) == 0 && static_cast<int>(MaskEdit::sharpen) == 4);
static_assert(static_cast<int>(HistoryStep::undo) == 0 && static_cast<int>(HistoryStep::redo) == 1);

struct ScriptHeader {
  std::optional<StartShape> start;
  std::string base_hash;       ///< of a journal: the clay its steps start from; else empty
  bool keeps_history = false;  ///< of a journal: it stays for undo when its session ends
};

/// Says in a journal that the clay has this hash after so many of the journal's steps.
struct HashMark {
  std::string hash;
  std::size_t after = 0;
  bool is_closing = false;  ///< the project is that clay: its session ended in order
};

using ScriptLine = std::variant<ScriptStep, HashMark>;

// A sealed line ends in the key `xxh64`: the hash of the line without that key. Every line of a
// journal is sealed; of a script none needs to be, but a seal that does not fit is an error.
inline constexpr std::string_view kLineSealKey = ",\"xxh64\":\"";
inline constexpr std::size_t kLineSealLetters = kLineSealKey.size() + 16 + 2;

bool is_blank(std::string_view line) noexcept;
bool is_sealed(std::string_view line) noexcept;
/// Whether the line is sealed and the seal is that of its content.
bool has_whole_seal(std::string_view line);

/// Errors  bad_input naming line and key; disk and memory as SolidReader has them.
Result<ScriptHeader> read_header_line(const FileLine& where, std::string_view line);
Result<ScriptLine> read_script_line(const FileLine& where, std::string_view line,
                                    SolidReader& solids);

std::string header_line(const ScriptHeader& header);
/// `solid` names what solid_of(step) gives; nothing for a step without.
std::string step_line(const ScriptStep& step, const SolidName& solid = {});
std::string mark_line(const HashMark& mark);
/// `line` is a JSON object with at least one key.
std::string sealed_line(std::string line);

}  // namespace argil::io
