// SPDX-License-Identifier: GPL-3.0-or-later
// argil export: clay becomes a printable mesh file, or a grid for other programs.
#include <algorithm>
#include <cstdint>
#include <fstream>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "argil/io/assembly.h"
#include "argil/io/export.h"
#include "argil/io/piece_export.h"
#include "argil/io/project_file.h"
#include "argil/io/safe_file.h"
#include "argil/io/volume_file.h"

#include "assembly_input.h"
#include "commands.h"
#include "common/options.h"
#include "common/output.h"
#include "common/project.h"
#include "common/reports.h"

namespace argil::cli {
namespace {

struct ExportArguments {
  std::vector<std::string> projects;
  std::string piece;
  std::filesystem::path mesh;
  std::filesystem::path report;  // "": none
  int triangles = 0;
  double max_error_mm = 0.0;
  bool parts = false;
};

/// What was proven of the error, and what samples of both surfaces show.
std::string error_text(const io::ExportReport& report) {
  const mesh::Certificate& certificate = report.certificate;
  const mesh::MeshError& error = certificate.error;
  std::string text;
  if (certificate.proven_max_mm > 0.0) {
    text = ", proven within " + number(certificate.proven_max_mm) + " mm of the clay both ways";
  }
  return text + ", error " + number(report.max_error_mm) + " mm (rms " +
         number(report.rms_error_mm) + ") at " +
         grouped(error.mesh_to_field.samples + error.field_to_mesh.samples) + " samples\n";
}

Result<void> write_report(const std::filesystem::path& file, const Json& json) {
  return io::replace_text(file, json.dump(2) + "\n");
}

io::ExportOptions wanted_of(const ExportArguments& options) {
  io::ExportOptions wanted;
  wanted.triangles = options.triangles;
  wanted.max_error_mm = options.max_error_mm;
  wanted.parts = options.parts;
  return wanted;
}

/// One clay as a mesh, measured, read back and judged.
Result<Outcome> outcome_of(const Result<io::ExportReport>& report, const std::string& project,
                           const Stopwatch& watch) {
  if (!report) return named(project, report.error());
  Outcome outcome;
  outcome.json = export_json(report.value(), watch.seconds());
  // The file is written in any case; 1 says that it is not printable.
  outcome.status = report.value().verdict.printable ? 0 : 1;
  outcome.text = grouped(report.value().triangles) + " triangles" + error_text(report.value()) +
                 verdict_text(report.value().verdict);
  return outcome;
}

Result<Outcome> export_as_mesh(const ExportArguments& options, const Progress& progress) {
  const std::string& project = options.projects[0];
  const auto opened = open_clay(project, options.piece, progress);
  if (!opened) return opened.error();
  const Stopwatch watch;
  const auto report =
      io::export_mesh(options.mesh, opened.value().clay, wanted_of(options), progress);
  auto outcome = outcome_of(report, project, watch);
  if (!outcome) return outcome;
  outcome.value().json["recovered_strokes"] = opened.value().recovered_steps;
  outcome.value().text += "saved '" + options.mesh.string() + "'\n";
  return outcome;
}

/// The pieces of projects that become objects of one 3MF: each is written, measured and judged as
/// if it were alone, and what was read back of it becomes an object of the whole.
class TogetherExport {
 public:
  TogetherExport(const ExportArguments& options, const Progress& progress)
      : options_(options), progress_(progress) {}

  Result<Outcome> run();

 private:
  Result<void> add_project(const std::string& project, const std::filesystem::path& temporary);
  Result<void> add_piece(const std::string& project, const std::string& name, const PieceLook& look,
                         const Clay& clay, std::int64_t recovered,
                         const std::filesystem::path& temporary);
  Result<void> say_what_meets();

  const ExportArguments& options_;
  const Progress& progress_;
  io::Assembly assembly_;
  Outcome all_;
};

Result<void> TogetherExport::add_piece(const std::string& project, const std::string& name,
                                       const PieceLook& look, const Clay& clay,
                                       std::int64_t recovered,
                                       const std::filesystem::path& temporary) {
  const Stopwatch watch;
  PieceLook shown = look;
  shown.name = name;
  const auto report =
      io::add_piece(assembly_, shown, clay, temporary, wanted_of(options_), progress_);
  const auto one = outcome_of(report, project, watch);
  if (!one) return one.error();
  Json json = {{"name", name}, {"file", project}, {"recovered_strokes", recovered}};
  json.update(one.value().json);
  all_.json["triangles"] = all_.json["triangles"].get<std::int64_t>() +
                           one.value().json["triangles"].get<std::int64_t>();
  all_.json["projects"].push_back(std::move(json));
  all_.text += "'" + (name == look.name ? name : project) + "': " + one.value().text;
  all_.status = std::max(all_.status, one.value().status);
  return {};
}

/// A clay that has no name of its own is called by its file.
Result<void> TogetherExport::add_project(const std::string& project,
                                         const std::filesystem::path& temporary) {
  const auto opened = open_project(project, progress_);
  if (!opened) return opened.error();
  const Sculpture& sculpture = opened.value().sculpture;
  for (std::size_t n = 0; n < sculpture.piece_count(); ++n) {
    const PieceLook& look = sculpture.look(n);
    if (!look.is_visible) continue;
    const bool has_name = sculpture.piece_count() > 1 || look.name != PieceLook().name;
    const std::string name = has_name ? look.name : std::filesystem::path(project).stem().string();
    auto added = add_piece(project, name, look, sculpture.clay(n), opened.value().recovered_steps,
                           temporary);
    if (!added) return added;
  }
  return {};
}

Result<void> TogetherExport::say_what_meets() {
  constexpr double kTouchMm = 1e-3;
  const StandingParts standing = standing_parts(assembly_);
  const auto gaps = gaps_between(standing, kTouchMm, progress_);
  if (!gaps) return gaps.error();
  all_.json["part_gaps"] = gaps_json(gaps.value(), standing.names);
  for (std::size_t n = 0; n < std::min(gaps.value().size(), kMostPairsSaid); ++n) {
    all_.text += gap_text(gaps.value()[n], standing.names) + ": they print as one\n";
  }
  return {};
}

Result<Outcome> TogetherExport::run() {
  const Stopwatch watch;
  all_.json["triangles"] = 0;
  all_.json["projects"] = Json::array();
  const auto write_all = [&](const std::filesystem::path& temporary) -> Result<void> {
    for (const std::string& project : options_.projects) {
      if (auto added = add_project(project, temporary); !added) return added;
    }
    if (!assembly_.objects.empty()) return io::write_assembly(temporary, assembly_, progress_);
    return Error{ErrorKind::bad_input,
                 "'" + options_.projects[0] + "' has no visible piece; show one first"};
  };
  if (auto written = io::replace_file(options_.mesh, write_all); !written) return written.error();
  if (auto said = say_what_meets(); !said) return said.error();
  all_.json["printable"] = all_.status == 0;
  all_.json["seconds"] = watch.seconds();
  all_.text += "saved '" + options_.mesh.string() + "'\n";
  return std::move(all_);
}

/// A project of several pieces goes into a 3MF as they are, unless one is named.
Result<bool> has_pieces_together(const ExportArguments& options, const Progress& progress) {
  if (options.projects.size() > 1) return true;
  if (!options.piece.empty() || !has_ending(options.mesh, ".3mf") || options.parts) return false;
  const auto opened = io::open_project(options.projects[0], progress);
  if (!opened) return opened.error();
  return opened.value().sculpture.piece_count() > 1;
}

/// The field of a project as one grid for other programs (volume_file.h).
Result<Outcome> export_volume(const std::string& project, const std::string& piece,
                              const std::filesystem::path& file, const Progress& progress) {
  const Stopwatch watch;
  const auto opened = open_clay(project, piece, progress);
  if (!opened) return opened.error();
  std::error_code none;
  if (std::filesystem::equivalent(project, file, none)) {
    return Error{ErrorKind::bad_input, "'" + file.string() +
                                           "' is the project itself, which its field would "
                                           "replace; give another name"};
  }
  // A field under its name would be the end of its levels and its mask.
  if (io::holds_project(file)) {
    return Error{ErrorKind::bad_input, "'" + file.string() +
                                           "' is a project, which a field would replace for good; "
                                           "give another name, or remove it first"};
  }
  const Clay& clay = opened.value().clay;
  const auto written = io::export_volume(file, clay, progress);
  if (!written) return written.error();
  const io::VolumeReport& report = written.value();
  Outcome outcome;
  outcome.json["voxel_mm"] = report.voxel_mm;
  outcome.json["active_voxels"] = report.active_voxels;
  outcome.json["leaves"] = report.leaves;
  outcome.json["bytes"] = report.bytes;
  outcome.json["file_bytes"] = std::filesystem::file_size(file);
  outcome.json["clay_hash"] = hex(clay.hash());
  outcome.json["recovered_strokes"] = opened.value().recovered_steps;
  outcome.json["seconds"] = watch.seconds();
  outcome.text = grouped(report.active_voxels) + " voxels of " + number(report.voxel_mm) +
                 " mm in one level set, in mm\nsaved '" + file.string() + "'\n";
  return outcome;
}

Result<Outcome> run_export(const ExportArguments& options, const Progress& progress) {
  for (const std::string& project : options.projects) {
    if (auto input = check_input(project); !input) return input.error();
  }
  if (auto output = check_output(options.mesh); !output) return output.error();
  if (!options.report.empty()) {
    if (auto output = check_output(options.report); !output) return output.error();
  }
  const auto together = has_pieces_together(options, progress);
  if (!together) return together.error();
  auto outcome = together.value() ? TogetherExport(options, progress).run()
                 : has_ending(options.mesh, ".vdb")
                     ? export_volume(options.projects[0], options.piece, options.mesh, progress)
                     : export_as_mesh(options, progress);
  if (!outcome || options.report.empty()) return outcome;
  if (auto written = write_report(options.report, outcome.value().json); !written) {
    return written.error();
  }
  return outcome;
}

/// The output's ending says whether an option means anything.
void refuse_for(bool is_other, const CLI::Option& option, const std::string& kind) {
  if (!is_other || option.count() == 0) return;
  throw CLI::ValidationError(option.get_name() + " is for " + kind +
                             ", which -o does not name; leave it out or name another file");
}

}  // namespace

void add_export(CLI::App& app, Selected& selected) {
  auto options = std::make_shared<ExportArguments>();
  CLI::App* command = add_command(
      app, selected, "export",
      "write the surface as a mesh file and check it; status 1 when it is not printable",
      [options](const Progress& progress) { return run_export(*options, progress); });
  command
      ->add_option("PROJECT", options->projects,
                   "a project (NAME.vdb); several, or several pieces, become named parts of one "
                   ".3mf")
      ->required();
  add_piece_option(*command, options->piece);
  add_file(*command, "-o,--output", options->mesh, {".3mf", ".stl", ".obj", ".ply", ".glb", ".vdb"},
           "the mesh to write, in mm; its ending chooses the format; .vdb: the field instead")
      ->required();
  CLI::Option* count =
      add_integer(*command, "--triangles", options->triangles, 4, std::numeric_limits<int>::max(),
                  "at most so many triangles, as near to the clay as they can be");
  CLI::Option* bound = add_number(*command, "--max-error-mm", options->max_error_mm, kPositive,
                                  "as few triangles as stay this near to the clay everywhere");
  count->excludes(bound);
  CLI::Option* parts =
      command->add_flag("--parts", options->parts, "each body a part of its own; .3mf only");
  add_file(*command, "--report", options->report, {".json"}, "also write the JSON object here");
  command->parse_complete_callback([options, count, bound, parts] {
    for (const CLI::Option* option : {count, bound}) {
      refuse_for(has_ending(options->mesh, ".vdb"), *option, "meshes");
    }
    refuse_for(!has_ending(options->mesh, ".3mf"), *parts, ".3mf files");
    if (options->projects.size() < 2) return;
    if (!options->piece.empty()) {
      throw CLI::ValidationError("--piece is for one project; leave it out, or name one project");
    }
    if (options->parts) {
      throw CLI::ValidationError(
          "--parts is for one project; each of several is a part already: leave it out");
    }
    if (has_ending(options->mesh, ".3mf")) return;
    throw CLI::ValidationError(
        "several projects become parts of one .3mf, and -o names another file; name a .3mf, or "
        "export each by itself");
  });
}

}  // namespace argil::cli
