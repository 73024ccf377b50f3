// SPDX-License-Identifier: GPL-3.0-or-later
// argil sculpt: replays a stroke script.
#include <memory>

#include "argil/io/project_file.h"
#include "argil/io/stroke_script.h"

#include "command.h"
#include "options.h"
#include "output.h"

namespace argil::cli {
namespace {

struct SculptOptions {
  std::string project;  // "": the script's own start
  std::string strokes;
  std::filesystem::path output;
  bool undo_all = false;
};

struct Replay {
  std::int64_t dabs = 0;
  std::vector<double> dab_ms;
};

Result<Clay> start_clay(const SculptOptions& options, const io::StrokeScript& script) {
  if (!options.project.empty()) return io::load_project(options.project);
  if (!script.start) {
    return Error{ErrorKind::bad_input,
                 "'" + options.strokes +
                     "' has no 'start' and no project was given; name a "
                     "project to sculpt, or add \"start\" to the script's first line"};
  }
  const io::StartShape& start = *script.start;
  auto clay = start.kind == io::StartShape::Kind::ball ? Clay::ball(start.size_mm.x, start.options)
                                                       : Clay::block(start.size_mm, start.options);
  if (clay) return clay;
  // A start that the machine cannot hold is the script's number, not the machine's failure.
  const ErrorKind kind =
      clay.error().kind == ErrorKind::memory ? ErrorKind::bad_input : clay.error().kind;
  return Error{kind, options.strokes + ": start: " + clay.error().message};
}

Result<Replay> replay(const SculptOptions& options, const io::StrokeScript& script, Clay& clay,
                      const Progress& progress) {
  Replay done;
  const auto count = static_cast<double>(script.strokes.size());
  for (std::size_t i = 0; i < script.strokes.size(); ++i) {
    const double before = static_cast<double>(i) / count;
    if (!progress("sculpt", before)) {
      return Error{ErrorKind::interrupted, "interrupted; nothing was written"};
    }
    const auto within = [&](std::string_view, double fraction) {
      return progress("sculpt", before + fraction / count);
    };
    const auto report = clay.apply(script.strokes[i], within);
    if (!report) {
      return Error{report.error().kind, options.strokes + ": stroke " + std::to_string(i + 1) +
                                            ": " + report.error().message};
    }
    done.dabs += report.value().dabs;
    const auto& ms = report.value().dab_cpu_ms;
    done.dab_ms.insert(done.dab_ms.end(), ms.begin(), ms.end());
  }
  return done;
}

/// Takes every stroke back; the clay must then have the bits it started with.
Result<int> undo_all(Clay& clay, std::uint64_t first_hash) {
  int undone = 0;
  while (clay.undo()) ++undone;
  if (clay.hash() == first_hash) return undone;
  return Error{ErrorKind::internal, "after undoing " + std::to_string(undone) +
                                        " strokes the hash is " + hex(clay.hash()) + " and not " +
                                        hex(first_hash) + "; please report this as a bug"};
}

std::string text_of(const Clay& clay, const Json& json, const std::filesystem::path& output) {
  std::string text = json["strokes"].dump() + " strokes, " + json["dabs"].dump() + " dabs, " +
                     number(json["dab_ms"]["p50"]) + " ms a dab (p99 " +
                     number(json["dab_ms"]["p99"]) + ", max " + number(json["dab_ms"]["max"]) +
                     ")\n";
  if (json.contains("undone")) text += json["undone"].dump() + " strokes undone\n";
  return text + levels_text(clay.level_stats()) + "hash " + hex(clay.hash()) + "\nsaved '" +
         output.string() + "'\n";
}

Result<Outcome> run_sculpt(const SculptOptions& options, const Progress& progress) {
  const Stopwatch watch;
  if (!options.project.empty()) {
    if (auto input = check_input(options.project); !input) return input.error();
  }
  if (auto input = check_input(options.strokes); !input) return input.error();
  if (auto output = check_output(options.output); !output) return output.error();
  const auto script = io::read_stroke_script(options.strokes);
  if (!script) return script.error();
  auto started = start_clay(options, script.value());
  if (!started) return started.error();
  Clay& clay = started.value();
  const std::uint64_t first_hash = clay.hash();
  const auto replayed = replay(options, script.value(), clay, progress);
  if (!replayed) return replayed.error();

  Outcome outcome;
  outcome.json["strokes"] = script.value().strokes.size();
  outcome.json["dabs"] = replayed.value().dabs;
  outcome.json["dab_ms"] = percentiles(replayed.value().dab_ms);
  if (options.undo_all) {
    const auto undone = undo_all(clay, first_hash);
    if (!undone) return undone.error();
    outcome.json["undone"] = undone.value();
  }
  if (auto saved = io::save_project(options.output, clay); !saved) return saved.error();
  outcome.json["hash"] = hex(clay.hash());
  outcome.json["start_hash"] = hex(first_hash);
  outcome.json["levels"] = to_json(clay.level_stats());
  outcome.json["seconds"] = watch.seconds();
  outcome.text = text_of(clay, outcome.json, options.output);
  return outcome;
}

}  // namespace

void add_sculpt(CLI::App& app, Selected& selected) {
  auto options = std::make_shared<SculptOptions>();
  CLI::App* command = add_command(
      app, selected, "sculpt", "replay a stroke script on a project or on the script's start shape",
      [options](const Progress& progress) { return run_sculpt(*options, progress); });
  command->add_option("PROJECT", options->project,
                      "the project to start from; default: the script's start shape");
  command->add_option("--strokes", options->strokes, "the script (NAME.strokes.jsonl)")->required();
  add_file(*command, "-o,--output", options->output, {".vdb"}, "the project to write")->required();
  command->add_flag("--undo-all", options->undo_all,
                    "take every stroke back before saving and check that the first hash returns");
}

}  // namespace argil::cli
