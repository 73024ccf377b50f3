// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/stroke_script.h"

#include <algorithm>
#include <set>
#include <string_view>

#include "argil/io/safe_file.h"

#include "file_bytes.h"
#include "no_throw.h"
#include "script_line.h"
#include "script_operation.h"

namespace argil::io {
namespace {

Result<void> read_stroke_line(const Place& place, std::string_view line, bool first,
                              SolidReader& solids, StrokeScript& script) {
  if (first) {
    auto header = read_header_line(place, line);
    if (!header) return header.error();
    script.start = header.value().start;
    return {};
  }
  auto read = read_script_line(place, line, solids);
  if (!read) return read.error();
  if (auto* step = std::get_if<ScriptStep>(&read.value())) script.steps.push_back(std::move(*step));
  return {};
}

Result<StrokeScript> parse_script(const std::filesystem::path& file, std::string_view text) {
  StrokeScript script;
  Place place{file.string(), 0};
  SolidReader solids(file.parent_path());
  bool first = true;
  while (!text.empty()) {
    ++place.line;
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (is_blank(line)) continue;
    if (auto read = read_stroke_line(place, line, first, solids, script); !read)
      return read.error();
    first = false;
  }
  if (first) {
    return Error{
        ErrorKind::bad_input,
        place.file + ": the stroke script is empty; its first line must be {\"argil_strokes\":1}"};
  }
  return script;
}

/// JSON has no NaN: what could not be read back is refused before anything is written.
Result<void> validate_script(const StrokeScript& script) {
  for (std::size_t i = 0; i < script.steps.size(); ++i) {
    if (auto valid = validate_step(script.steps[i]); !valid) {
      return Error{ErrorKind::bad_input,
                   "stroke " + std::to_string(i) + ": " + valid.error().message};
    }
  }
  if (script.start && !(is_finite(script.start->size_mm) && script.start->size_mm.x > 0.0)) {
    return Error{ErrorKind::bad_input, "the start shape's size must be finite and greater than 0"};
  }
  return {};
}

/// What the names of a script's solids begin with: NAME.solid- for NAME.strokes.jsonl.
std::string solid_front(const std::filesystem::path& script) {
  std::filesystem::path name = script.filename();
  for (const char* ending : {".jsonl", ".strokes"}) {
    if (name.extension() == ending) name = name.stem();
  }
  return name.string() + ".solid-";
}

/// Its text, once all that it names is on the disk.
Result<std::string> script_text(const std::filesystem::path& file, const StrokeScript& script) {
  std::string text = header_line({script.start, ""}) + "\n";
  std::set<std::string> saved;
  for (const ScriptStep& step : script.steps) {
    SolidName name;
    if (const auto solid = solid_of(step)) {
      name = name_of(*solid, solid_front(file));
      if (saved.insert(name.file).second) {
        auto written = save_solid(file.parent_path() / name.file, *solid);
        if (!written) return written.error();
      }
    }
    text += step_line(step, name) + "\n";
  }
  return text;
}

Result<StrokeReport> apply_one(Clay& clay, const Stroke& stroke, const Progress& progress) {
  return clay.apply(stroke, progress);
}

Result<StrokeReport> apply_one(Clay& clay, const Operation& operation, const Progress& progress) {
  if (auto report = clay.apply(operation, progress); !report) return report.error();
  return StrokeReport{};
}

Result<StrokeReport> apply_one(Clay& clay, HistoryStep step, const Progress&) {
  const bool done = step == HistoryStep::undo ? clay.undo() : clay.redo();
  if (done) return StrokeReport{};
  return Error{ErrorKind::bad_input, step == HistoryStep::undo
                                         ? "there is nothing to undo; take this line out"
                                         : "there is nothing to redo; take this line out"};
}

Result<StrokeReport> apply_one(Clay& clay, MaskEdit edit, const Progress&) {
  if (auto ok = clay.apply(edit); !ok) return ok.error();
  return StrokeReport{};
}

}  // namespace

Result<StrokeReport> apply_step(Clay& clay, const ScriptStep& step, const Progress& progress) {
  return std::visit([&](const auto& chosen) { return apply_one(clay, chosen, progress); }, step);
}

Result<void> validate_step(const ScriptStep& step) {
  if (const auto* stroke = std::get_if<Stroke>(&step)) return validate_stroke(*stroke);
  if (const auto* operation = std::get_if<Operation>(&step)) return validate_operation(*operation);
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

Result<void> write_stroke_script(const std::filesystem::path& file, const StrokeScript& script) {
  return no_throw(file.string(), [&]() -> Result<void> {
    if (auto valid = validate_script(script); !valid) return valid;
    const auto text = script_text(file, script);
    if (!text) return text.error();
    return replace_file(file, [&](const std::filesystem::path& temporary) -> Result<void> {
      OutputFile out(temporary);
      out.write(text.value());
      return out.close();
    });
  });
}

}  // namespace argil::io
