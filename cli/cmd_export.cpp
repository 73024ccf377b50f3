// SPDX-License-Identifier: GPL-3.0-or-later
// argil export: clay becomes a printable mesh file.
#include <fstream>
#include <memory>

#include "argil/io/export.h"
#include "argil/io/safe_file.h"

#include "command.h"
#include "options.h"
#include "output.h"
#include "project.h"

namespace argil::cli {
namespace {

struct ExportOptions {
  std::string project;
  std::filesystem::path mesh;
  std::filesystem::path report;  // "": none
};

Json report_json(const io::ExportReport& report, double seconds) {
  Json json;
  json["triangles"] = report.triangles;
  json["max_error_mm"] = report.max_error_mm;
  json["rms_error_mm"] = report.rms_error_mm;
  json["volume_change"] = report.volume_change;
  json["removed_crumbs"] = report.removed_crumbs;
  json.update(to_json(report.verdict));
  json["seconds"] = seconds;
  return json;
}

Result<void> write_report(const std::filesystem::path& file, const Json& json) {
  return io::replace_file(file, [&](const std::filesystem::path& temporary) -> Result<void> {
    std::ofstream out(temporary);
    out << json.dump(2) << '\n';
    out.close();
    if (out) return {};
    return Error{ErrorKind::disk,
                 "cannot write '" + file.string() + "'; free space on the disk and try again"};
  });
}

Result<Outcome> run_export(const ExportOptions& options, const Progress& progress) {
  const Stopwatch watch;
  if (auto input = check_input(options.project); !input) return input.error();
  if (auto output = check_output(options.mesh); !output) return output.error();
  const auto opened = open_project(options.project, progress);
  if (!opened) return opened.error();
  const auto report = io::export_mesh(options.mesh, opened.value().clay, progress);
  if (!report) return report.error();
  Outcome outcome;
  outcome.json = report_json(report.value(), watch.seconds());
  outcome.json["recovered_strokes"] = opened.value().recovered_steps;
  if (!options.report.empty()) {
    if (auto written = write_report(options.report, outcome.json); !written) return written.error();
  }
  outcome.status = report.value().verdict.printable ? 0 : 1;
  outcome.text = grouped(report.value().triangles) + " triangles, error at most " +
                 number(report.value().max_error_mm) + " mm (rms " +
                 number(report.value().rms_error_mm) + ")\n" +
                 verdict_text(report.value().verdict) + "saved '" + options.mesh.string() + "'\n";
  return outcome;
}

}  // namespace

void add_export(CLI::App& app, Selected& selected) {
  auto options = std::make_shared<ExportOptions>();
  CLI::App* command = add_command(
      app, selected, "export",
      "write the surface as a mesh file and check it; status 1 when it is not printable",
      [options](const Progress& progress) { return run_export(*options, progress); });
  command->add_option("PROJECT", options->project, "a project (NAME.vdb)")->required();
  add_file(*command, "-o,--output", options->mesh, {".3mf", ".stl", ".obj", ".ply", ".glb"},
           "the mesh to write, in mm; its ending chooses the format")
      ->required();
  add_file(*command, "--report", options->report, {".json"}, "also write the JSON object here");
}

}  // namespace argil::cli
