// SPDX-License-Identifier: GPL-3.0-or-later
// Stroke scripts as a whole: read line by line, and applied step by step.
#include "argil/io/stroke_script.h"

#include <algorithm>
#include <set>
#include <string_view>

#include "argil/core/no_throw.h"
#include "argil/io/safe_file.h"

#include "file/file_bytes.h"
#include "script/script_line.h"
#include "script/script_operation.h"
#include "script/script_piece.h"

namespace argil::io {
namespace {

Result<void> read_stroke_line(const FileLine& where, std::string_view line, bool first,
                              SolidReader& solids, StrokeScript& script) {
  if (first) {
    auto header = read_header_line(where, line);
    if (!header) return header.error();
    script.start = header.value().start;
    return {};
  }
  auto read = read_script_line(where, line, solids);
  if (!read) return read.error();
  if (auto* step = std::get_if<ScriptStep>(&read.value())) script.steps.push_back(std::move(*step));
  return {};
}

Result<StrokeScript> parse_script(const std::filesystem::path& file, std::string_view text) {
  StrokeScript script;
  FileLine where{file.string(), 0};
  SolidReader solids(file.parent_path());
  bool first = true;
  while (!text.empty()) {
    ++where.line;
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (is_blank(line)) continue;
    if (auto read = read_stroke_line(where, line, first, solids, script); !read)
      return read.error();
    first = false;
  }
  if (first) {
    return Error{
        ErrorKind::bad_input,
        where.file + ": the stroke script is empty; its first line must be {\"argil_strokes\":1}"};
  }
  return script;
}

Result<StrokeReport> apply_one(Clay& clay, const Stroke& stroke, const Progress& progress) {
  return clay.apply(stroke, progress);
}

Result<StrokeReport> apply_one(Clay& clay, const Operation& operation, const Progress& progress) {
  if (auto report = clay.apply(operation, progress); !report) return report.error();
  return StrokeReport{};
}

Error nothing_there(HistoryStep step) {
  return {ErrorKind::bad_input, step == HistoryStep::undo
                                    ? "there is nothing to undo; take this line out"
                                    : "there is nothing to redo; take this line out"};
}

Result<StrokeReport> apply_one(Clay& clay, HistoryStep step, const Progress&) {
  const bool done = step == HistoryStep::undo ? clay.undo() : clay.redo();
  return done ? Result<StrokeReport>(StrokeReport{}) : nothing_there(step);
}

Result<StrokeReport> apply_one(Clay& clay, MaskEdit edit, const Progress&) {
  if (auto ok = clay.apply(edit); !ok) return ok.error();
  return StrokeReport{};
}

Result<StrokeReport> apply_one(Clay& clay, const MaskFilter& filter, const Progress& progress) {
  if (auto ok = filter_mask(clay, filter, progress); !ok) return ok.error();
  return StrokeReport{};
}

Result<StrokeReport> apply_one(Clay& clay, const MaskOutline& outline, const Progress& progress) {
  if (auto ok = mask_within(clay, outline, progress); !ok) return ok.error();
  return StrokeReport{};
}

Result<StrokeReport> apply_one(Clay&, const PieceEdit&, const Progress&) {
  return Error{ErrorKind::bad_input,
               "pieces belong to a project, and this is a clay alone; take this line out"};
}

template <class Step>
Result<StrokeReport> apply_one(Sculpture& sculpture, const Step& step, const Progress& progress) {
  return apply_one(sculpture.clay(), step, progress);
}

Result<StrokeReport> apply_one(Sculpture& sculpture, HistoryStep step, const Progress&) {
  const bool done = step == HistoryStep::undo ? sculpture.undo() : sculpture.redo();
  return done ? Result<StrokeReport>(StrokeReport{}) : nothing_there(step);
}

Result<StrokeReport> apply_one(Sculpture& sculpture, const PieceEdit& edit,
                               const Progress& progress) {
  if (auto done = sculpture.apply(edit, progress); !done) return done.error();
  return StrokeReport{};
}

}  // namespace

Result<StrokeReport> apply_step(Sculpture& sculpture, const ScriptStep& step,
                                const Progress& progress) {
  const bool is_of_the_list =
      std::holds_alternative<HistoryStep>(step) || std::holds_alternative<PieceEdit>(step);
  if (!is_of_the_list) {
    if (auto free = sculpture.check_unlocked(); !free) return free.error();
  }
  return repeat_step(sculpture, step, progress);
}

Result<StrokeReport> repeat_step(Sculpture& sculpture, const ScriptStep& step,
                                 const Progress& progress) {
  return std::visit([&](const auto& chosen) { return apply_one(sculpture, chosen, progress); },
                    step);
}

Result<StrokeReport> apply_step(Clay& clay, const ScriptStep& step, const Progress& progress) {
  return std::visit([&](const auto& chosen) { return apply_one(clay, chosen, progress); }, step);
}

Result<void> validate_step(const ScriptStep& step) {
  if (const auto* stroke = std::get_if<Stroke>(&step)) return validate_stroke(*stroke);
  if (const auto* operation = std::get_if<Operation>(&step)) return validate_operation(*operation);
  if (const auto* filter = std::get_if<MaskFilter>(&step)) return validate_filter(*filter);
  if (const auto* outline = std::get_if<MaskOutline>(&step)) return validate_outline(*outline);
  if (const auto* edit = std::get_if<PieceEdit>(&step)) return validate_piece_edit(*edit);
  return {};
}

Result<StrokeScript> read_stroke_script(const std::filesystem::path& file) {
  return no_throw(file.string(), [&]() -> Result<StrokeScript> {
    const auto bytes = read_file_bytes(file);
    if (!bytes) return bytes.error();
    return parse_script(
        file, {reinterpret_cast<const char*>(bytes.value().data()), bytes.value().size()});
  });
}

Result<ScriptStep> read_script_step(const std::string& name, std::string_view line,
                                    const std::filesystem::path& folder) {
  return no_throw(name, [&]() -> Result<ScriptStep> {
    if (line.find('\n') != std::string_view::npos) {
      return Error{ErrorKind::bad_input, name + " has several lines; give one step"};
    }
    SolidReader solids(folder);
    auto read = read_script_line({name, 0}, line, solids);
    if (!read) return read.error();
    if (auto* step = std::get_if<ScriptStep>(&read.value())) return std::move(*step);
    return Error{ErrorKind::bad_input,
                 name + " is a mark of a journal; give a stroke, an operation or another step"};
  });
}

}  // namespace argil::io
