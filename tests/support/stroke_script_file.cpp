// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/stroke_script_file.h"

#include <set>
#include <string>

#include "argil/core/no_throw.h"
#include "argil/io/safe_file.h"

#include "file/file_bytes.h"
#include "script/script_line.h"
#include "script/step_solid.h"

namespace argil::test {
namespace {

/// JSON has no NaN: what could not be read back is refused before anything is written.
Result<void> validate_script(const io::StrokeScript& script) {
  for (std::size_t i = 0; i < script.steps.size(); ++i) {
    if (auto valid = io::validate_step(script.steps[i]); !valid) {
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
Result<std::string> script_text(const std::filesystem::path& file, const io::StrokeScript& script) {
  std::string text = io::header_line({script.start, ""}) + "\n";
  std::set<std::string> saved;
  for (const io::ScriptStep& step : script.steps) {
    io::SolidName name;
    if (const auto solid = io::solid_of(step)) {
      name = io::name_of(*solid, solid_front(file));
      if (saved.insert(name.file).second) {
        auto written = io::save_solid(file.parent_path() / name.file, *solid);
        if (!written) return written.error();
      }
    }
    text += io::step_line(step, name) + "\n";
  }
  return text;
}

}  // namespace

Result<void> write_stroke_script(const std::filesystem::path& file,
                                 const io::StrokeScript& script) {
  return no_throw(file.string(), [&]() -> Result<void> {
    if (auto valid = validate_script(script); !valid) return valid;
    const auto text = script_text(file, script);
    if (!text) return text.error();
    return io::replace_file(file, [&](const std::filesystem::path& temporary) -> Result<void> {
      io::OutputFile out(temporary);
      out.write(text.value());
      return out.close();
    });
  });
}

}  // namespace argil::test
