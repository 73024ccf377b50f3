// SPDX-License-Identifier: GPL-3.0-or-later
// argil export: clay becomes a printable mesh file, or a grid for other programs.
#include <fstream>
#include <limits>
#include <memory>

#include "argil/io/export.h"
#include "argil/io/project_file.h"
#include "argil/io/safe_file.h"
#include "argil/io/volume_file.h"

#include "commands.h"
#include "common/options.h"
#include "common/output.h"
#include "common/project.h"

namespace argil::cli {
namespace {

struct ExportArguments {
  std::string project;
  std::string piece;
  std::filesystem::path mesh;
  std::filesystem::path report;  // "": none
  int triangles = 0;
  double max_error_mm = 0.0;
  bool parts = false;
};

Json distance_json(const mesh::DistanceSummary& distance) {
  return {{"max_mm", distance.max_mm},
          {"mean_mm", distance.mean_mm},
          {"rms_mm", distance.rms_mm},
          {"samples", distance.samples}};
}

Json certificate_json(const mesh::Certificate& certificate) {
  // 0 stands for not asked.
  const auto or_null = [](auto asked) { return asked > 0 ? Json(asked) : Json(); };
  Json json;
  json["units"] = "mm";
  json["mesh_to_field"] = distance_json(certificate.error.mesh_to_field);
  json["field_to_mesh"] = distance_json(certificate.error.field_to_mesh);
  json["volume_change"] = certificate.volume_change;
  json["triangles"] = certificate.triangles;
  json["surface_triangles"] = certificate.surface_triangles;
  json["voxel_mm"] = certificate.voxel_mm;
  json["tolerance_voxels"] = certificate.tolerance_voxels;
  json["proven_max_mm"] = or_null(certificate.proven_max_mm);
  json["asked_max_error_mm"] = or_null(certificate.asked_max_error_mm);
  json["asked_triangles"] = or_null(certificate.asked_triangles);
  json["clay_hash"] = hex(certificate.clay_hash);
  return json;
}

Json export_json(const io::ExportReport& report, double seconds) {
  Json json;
  json["triangles"] = report.triangles;
  json["max_error_mm"] = report.max_error_mm;
  json["rms_error_mm"] = report.rms_error_mm;
  json["volume_change"] = report.volume_change;
  json["parts"] = report.parts;
  json["removed_crumbs"] = report.removed_components;
  json["certificate"] = certificate_json(report.certificate);
  json.update(to_json(report.verdict));
  json["seconds"] = seconds;
  return json;
}

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

Result<Outcome> export_as_mesh(const ExportArguments& options, const Progress& progress) {
  const Stopwatch watch;
  const auto opened = open_clay(options.project, options.piece, progress);
  if (!opened) return opened.error();
  io::ExportOptions wanted;
  wanted.triangles = options.triangles;
  wanted.max_error_mm = options.max_error_mm;
  wanted.parts = options.parts;
  const auto report = io::export_mesh(options.mesh, opened.value().clay, wanted, progress);
  if (!report) return named(options.project, report.error());
  Outcome outcome;
  outcome.json = export_json(report.value(), watch.seconds());
  outcome.json["recovered_strokes"] = opened.value().recovered_steps;
  // The file is written in any case; 1 says that it is not printable.
  outcome.status = report.value().verdict.printable ? 0 : 1;
  outcome.text = grouped(report.value().triangles) + " triangles" + error_text(report.value()) +
                 verdict_text(report.value().verdict) + "saved '" + options.mesh.string() + "'\n";
  return outcome;
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
  if (auto input = check_input(options.project); !input) return input.error();
  if (auto output = check_output(options.mesh); !output) return output.error();
  if (!options.report.empty()) {
    if (auto output = check_output(options.report); !output) return output.error();
  }
  auto outcome = has_ending(options.mesh, ".vdb")
                     ? export_volume(options.project, options.piece, options.mesh, progress)
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
  command->add_option("PROJECT", options->project, "a project (NAME.vdb)")->required();
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
  });
}

}  // namespace argil::cli
