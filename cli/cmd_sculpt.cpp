// SPDX-License-Identifier: GPL-3.0-or-later
// argil sculpt: replays a stroke script.
#include <cassert>
#include <limits>
#include <memory>
#include <optional>
#include <system_error>

#include "argil/io/session.h"
#include "argil/io/stroke_script.h"

#include "commands.h"
#include "common/options.h"
#include "common/output.h"
#include "common/project.h"

namespace argil::cli {
namespace {

struct SculptOptions {
  std::string project;  // "": the script's own start
  std::string strokes;
  std::filesystem::path output;
  bool undo_all = false;
};

struct Replay {
  std::int64_t strokes = 0;
  std::int64_t operations = 0;
  std::int64_t dabs = 0;
  std::vector<double> dab_ms;
  std::optional<int> undone;
};

/// Where the work goes: a session on the output, or, when another file is to be replaced by it, the
/// sculpture alone until it is finished.
struct SculptTarget {
  std::optional<io::Session> session;
  std::optional<Sculpture> alone;
  std::int64_t recovered = 0;

  Sculpture& sculpture() {
    assert(session.has_value() != alone.has_value());
    return session ? session->sculpture() : *alone;
  }
  void record(const io::ScriptStep& step) {
    if (session) session->record(step);
  }
};

Result<io::OpenedProject> start_shape(const SculptOptions& options,
                                      const io::StrokeScript& script) {
  if (!script.start) {
    return Error{ErrorKind::bad_input,
                 "'" + options.strokes +
                     "' has no 'start' and no project was given; name a "
                     "project to sculpt, or add \"start\" to the script's first line"};
  }
  const io::StartShape& start = *script.start;
  auto clay = start.kind == io::StartShape::Kind::ball ? Clay::ball(start.size_mm.x, start.options)
                                                       : Clay::block(start.size_mm, start.options);
  if (clay) return io::OpenedProject{Sculpture(std::move(clay).value()), 0, {}};
  // A start that the machine cannot hold is the script's number, not the machine's failure.
  const ErrorKind kind =
      clay.error().kind == ErrorKind::memory ? ErrorKind::bad_input : clay.error().kind;
  return Error{kind, options.strokes + ": start: " + clay.error().message};
}

bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code error;
  return std::filesystem::equivalent(a, b, error) && !error;
}

/// A session when the output is the project itself or a new file; docs/command_line.md says why.
Result<SculptTarget> prepare(const SculptOptions& options, const io::StrokeScript& script,
                             const Progress& progress) {
  io::SessionOptions keep;
  // A script is one piece of work: it is kept as a whole or not at all.
  keep.is_all_or_nothing = true;
  // Undo has to reach back to the start, however much was done.
  if (options.undo_all) keep.limits.undo_bytes = std::numeric_limits<std::int64_t>::max();
  SculptTarget target;
  if (!options.project.empty() && is_same_file(options.project, options.output)) {
    auto session = io::Session::open(options.output, keep, progress);
    if (!session) return session.error();
    print_notes(session.value().notes());
    target.recovered = session.value().recovered_steps();
    target.session = std::move(session).value();
    return target;
  }
  auto start = options.project.empty() ? start_shape(options, script)
                                       : open_project(options.project, progress);
  if (!start) return start.error();
  target.recovered = start.value().recovered_steps;
  // Another project of that name stays until this one is finished.
  if (std::filesystem::exists(options.output)) {
    target.alone = std::move(start).value().sculpture;
    if (auto ok = target.alone->set_limits(keep.limits); !ok) return ok.error();
    return target;
  }
  auto session = io::Session::create(options.output, std::move(start).value().sculpture, keep);
  if (!session) return session.error();
  print_notes(session.value().notes());
  target.session = std::move(session).value();
  return target;
}

Result<void> replay_step(const SculptOptions& options, const io::StrokeScript& script,
                         std::size_t i, SculptTarget& target, Replay& done,
                         const Progress& progress) {
  const auto count = static_cast<double>(script.steps.size());
  const double before = static_cast<double>(i) / count;
  if (!progress("sculpt", before)) {
    return Error{ErrorKind::interrupted, "interrupted; nothing was written"};
  }
  const auto within = [&](std::string_view, double fraction) {
    return progress("sculpt", before + fraction / count);
  };
  const bool is_operation = std::holds_alternative<Operation>(script.steps[i]);
  const auto report = io::apply_step(target.sculpture(), script.steps[i], within);
  if (!report) {
    const bool is_stroke = std::holds_alternative<Stroke>(script.steps[i]);
    const char* kind = is_operation ? ": operation " : is_stroke ? ": stroke " : ": step ";
    return Error{report.error().kind,
                 options.strokes + kind + std::to_string(i + 1) + ": " + report.error().message};
  }
  target.record(script.steps[i]);
  if (std::holds_alternative<Stroke>(script.steps[i])) ++done.strokes;
  if (is_operation) ++done.operations;
  done.dabs += report.value().dabs;
  const auto& ms = report.value().dab_cpu_ms;
  done.dab_ms.insert(done.dab_ms.end(), ms.begin(), ms.end());
  return {};
}

/// What a sculpture is before the script.
struct Beginning {
  int depth = 0;
  std::uint64_t hash = 0;
  std::string active;
};

Beginning beginning_of(Sculpture& sculpture) {
  return {sculpture.undo_depth(), sculpture.hash(), sculpture.look(sculpture.active()).name};
}

/// Takes every stroke of the script back; the sculpture must then have the bits it started with.
Result<int> undo_all(SculptTarget& target, const Beginning& first) {
  int undone = 0;
  Sculpture& sculpture = target.sculpture();
  while (sculpture.undo_depth() > first.depth && sculpture.undo()) {
    target.record(io::HistoryStep::undo);
    ++undone;
  }
  // Which piece was selected is no step that undo takes back.
  const PieceEdit select = SelectPiece{first.active};
  const bool is_other = sculpture.look(sculpture.active()).name != first.active;
  if (is_other && sculpture.apply(select)) target.record(select);
  if (sculpture.hash() == first.hash) return undone;
  return Error{ErrorKind::internal, "after undoing " + std::to_string(undone) +
                                        " strokes the hash is " + hex(sculpture.hash()) +
                                        " and not " + hex(first.hash) +
                                        "; please report this as a bug"};
}

/// The whole script, and what it comes to saved.
Result<Replay> work(const SculptOptions& options, const io::StrokeScript& script,
                    SculptTarget& target, const Beginning& first, const Progress& progress) {
  Replay done;
  for (std::size_t i = 0; i < script.steps.size(); ++i) {
    auto step = replay_step(options, script, i, target, done, progress);
    if (!step) return step.error();
  }
  if (options.undo_all) {
    const auto undone = undo_all(target, first);
    if (!undone) return undone.error();
    done.undone = undone.value();
  }
  const auto saved =
      target.session ? target.session->save() : replace_project(options.output, *target.alone);
  if (!saved) return saved.error();
  return done;
}

std::string sculpt_text(const Sculpture& sculpture, const Json& json,
                        const std::filesystem::path& output) {
  std::string text = json["strokes"].dump() + " strokes, " + json["dabs"].dump() + " dabs, " +
                     number(json["dab_ms"]["p50"]) + " ms a dab (p99 " +
                     number(json["dab_ms"]["p99"]) + ", max " + number(json["dab_ms"]["max"]) +
                     ")\n";
  if (const auto operations = json["operations"].get<std::int64_t>(); operations > 0) {
    text += std::to_string(operations) + (operations == 1 ? " operation\n" : " operations\n");
  }
  if (json.contains("undone")) text += json["undone"].dump() + " strokes undone\n";
  return text + levels_text(sculpture.clay().level_stats()) + "hash " + hex(sculpture.hash()) +
         "\nsaved '" + output.string() + "'\n";
}

Outcome outcome_of(const Replay& replayed, const Sculpture& sculpture, std::uint64_t first_hash) {
  Outcome outcome;
  outcome.json["strokes"] = replayed.strokes;
  outcome.json["operations"] = replayed.operations;
  outcome.json["dabs"] = replayed.dabs;
  outcome.json["dab_ms"] = percentiles(replayed.dab_ms);
  if (replayed.undone) outcome.json["undone"] = *replayed.undone;
  outcome.json["hash"] = hex(sculpture.hash());
  outcome.json["start_hash"] = hex(first_hash);
  outcome.json["levels"] = to_json(sculpture.clay().level_stats());
  return outcome;
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
  auto prepared = prepare(options, script.value(), progress);
  if (!prepared) return prepared.error();
  SculptTarget& target = prepared.value();
  // Steps of before the script are not its own to take back.
  const Beginning first = beginning_of(target.sculpture());
  const auto replayed = work(options, script.value(), target, first, progress);
  if (!replayed) {
    // What cannot be taken back either is told by the next command that opens the project.
    if (target.session) static_cast<void>(target.session->discard().ok());
    return replayed.error();
  }
  Outcome outcome = outcome_of(replayed.value(), target.sculpture(), first.hash);
  outcome.json["recovered_strokes"] = target.recovered;
  outcome.json["seconds"] = watch.seconds();
  outcome.text = sculpt_text(target.sculpture(), outcome.json, options.output);
  if (target.session) {
    // Last, since it takes the sculpture that the text is about.
    if (auto closed = target.session->close(); !closed) return closed.error();
  }
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
