// SPDX-License-Identifier: GPL-3.0-or-later
// argil check: would a printer, or a print service, take this mesh or clay?
#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "argil/io/clay_check.h"
#include "argil/io/printer_file.h"
#include "argil/mesh/check.h"

#include "assembly_input.h"
#include "commands.h"
#include "common/options.h"
#include "common/output.h"
#include "common/project.h"
#include "marked_mesh.h"
#include "mesh_input.h"

namespace argil::cli {
namespace {

struct CheckOptions {
  std::string mesh;
  std::string piece;
  std::string printer;
  std::optional<double> min_wall_mm;
  std::optional<double> min_gap_mm;
  std::optional<double> overhang_deg;
  std::filesystem::path picture;
  std::filesystem::path ply;
  MeshFrameOptions frame;
};

Result<mesh::Printer> printer_of(const CheckOptions& options) {
  mesh::Printer printer;
  if (!options.printer.empty()) {
    if (auto input = check_input(options.printer); !input) return input.error();
    auto read = io::read_printer(options.printer);
    if (!read) return read;
    printer = std::move(read).value();
  }
  // What is asked for by name counts more than the profile.
  printer.min_wall_mm = options.min_wall_mm.value_or(printer.min_wall_mm);
  printer.min_gap_mm = options.min_gap_mm.value_or(printer.min_gap_mm);
  printer.max_overhang_deg = options.overhang_deg.value_or(printer.max_overhang_deg);
  return printer;
}

struct Judged {
  TriangleMesh mesh;
  mesh::MeshVerdict verdict;
  Json more;               ///< keys of one kind of input
  std::string parts_text;  ///< of several parts, each by itself
  bool are_parts_printable = true;
};

/// A line for a part that may be printed, all of the verdict for one that may not.
std::string part_text(const std::string& name, const mesh::MeshVerdict& verdict) {
  if (!verdict.printable) return "'" + name + "': " + verdict_text(verdict);
  return "'" + name + "': printable: yes, volume " + number(verdict.volume_mm3) + " mm3\n";
}

/// Each part of several by itself, and the pairs that would not come apart.
Result<void> judge_parts(const io::Assembly& assembly, const mesh::Printer& printer,
                         const Progress& progress, Judged& judged) {
  constexpr double kTouchMm = 1e-3;
  judged.more["parts"] = Json::array();
  judged.more["part_gaps"] = Json::array();
  const std::size_t count = io::placed_parts(assembly).size();
  if (count < 2) return {};
  if (count > mesh::kMostParts) {
    print_notes({std::to_string(count) + " parts are judged as one mesh; up to " +
                 std::to_string(mesh::kMostParts) + " are judged each by itself"});
    return {};
  }
  const StandingParts parts = standing_parts(assembly);
  judged.parts_text = parts_text(parts.names) + "\n";
  for (std::size_t p = 0; p < parts.meshes.size(); ++p) {
    const auto verdict = mesh::check_print(parts.meshes[p], printer, 0, progress);
    if (!verdict) return verdict.error();
    judged.are_parts_printable = judged.are_parts_printable && verdict.value().printable;
    Json part = {{"name", parts.names[p]}};
    part.update(to_json(verdict.value()));
    part["triangles"] = parts.meshes[p].triangles.size();
    judged.more["parts"].push_back(std::move(part));
    if (p < kMostPartsSaid) judged.parts_text += part_text(parts.names[p], verdict.value());
  }
  const auto gaps = gaps_between(parts, std::max(printer.min_gap_mm, kTouchMm), progress);
  if (!gaps) return gaps.error();
  judged.more["part_gaps"] = gaps_json(gaps.value(), parts.names);
  for (std::size_t n = 0; n < std::min(gaps.value().size(), kMostPairsSaid); ++n) {
    judged.parts_text += gap_text(gaps.value()[n], parts.names) + ": they print as one\n";
  }
  return {};
}

Result<Judged> judge_file(const std::string& file, const MeshFrameOptions& frame,
                          const mesh::Printer& printer, const Progress& progress) {
  auto read = open_assembly(file, frame);
  if (!read) return read.error();
  io::Assembly& assembly = read.value().assembly;
  const auto bytes = static_cast<std::int64_t>(std::filesystem::file_size(file));
  Judged judged;
  judged.more = {{"file_bytes", bytes}};
  add_frame_keys(judged.more, read.value().frame);
  if (auto parts = judge_parts(assembly, printer, progress, judged); !parts) {
    return parts.error();
  }
  judged.mesh = io::joined(std::move(assembly));
  auto verdict = mesh::check_print(judged.mesh, printer, bytes, progress);
  if (!verdict) return verdict.error();
  judged.verdict = std::move(verdict).value();
  return judged;
}

Result<Judged> judge_project(const std::string& file, const std::string& piece,
                             const mesh::Printer& printer, const Progress& progress) {
  const auto opened = open_clay(file, piece, progress);
  if (!opened) return opened.error();
  auto found = io::check_clay(opened.value().clay, printer, progress);
  if (!found) return found.error();
  io::ClayVerdict& judged = found.value();
  return Judged{std::move(judged.mesh),
                std::move(judged.verdict),
                // A clay has no mesh file that could be too large.
                {{"file_bytes", nullptr},
                 {"removed_crumbs", judged.removed_components},
                 {"recovered_strokes", opened.value().recovered_steps}},
                {}};
}

Result<Outcome> run_check(const CheckOptions& options, const Progress& progress) {
  if (auto input = check_input(options.mesh); !input) return input.error();
  for (const auto& output : {options.picture, options.ply}) {
    if (output.empty()) continue;
    if (auto fits = check_output(output); !fits) return fits.error();
  }
  const auto printer = printer_of(options);
  if (!printer) return printer.error();
  const bool is_project = has_ending(options.mesh, ".vdb");
  if (is_project) {
    if (auto none = check_no_frame(options.mesh, options.frame); !none) return none.error();
  } else if (auto none = check_no_piece(options.mesh, options.piece); !none) {
    return none.error();
  }
  const auto judged = is_project
                          ? judge_project(options.mesh, options.piece, printer.value(), progress)
                          : judge_file(options.mesh, options.frame, printer.value(), progress);
  if (!judged) return named(options.mesh, judged.error());
  const auto& [mesh, verdict, more, parts_text, are_parts_printable] = judged.value();
  Outcome outcome;
  outcome.json = to_json(verdict);
  outcome.json["triangles"] = mesh.triangles.size();
  outcome.json.update(more);
  outcome.json["printer"] = options.printer.empty() ? Json() : Json(printer.value().name);
  outcome.text = grouped(static_cast<std::int64_t>(mesh.triangles.size())) + " triangles\n" +
                 verdict_text(verdict) + parts_text;
  // 1 as grep has it: the command worked, and the answer is no.
  outcome.status = verdict.printable && are_parts_printable ? 0 : 1;
  if (!options.picture.empty()) {
    auto saved = write_marked_picture(options.picture, mesh, verdict, progress);
    if (!saved) return saved.error();
    outcome.text += "saved '" + options.picture.string() + "'\n";
  }
  if (!options.ply.empty()) {
    auto saved = write_marked_ply(options.ply, mesh, verdict);
    if (!saved) return saved.error();
    outcome.text += "saved '" + options.ply.string() + "'\n";
  }
  return outcome;
}

/// As add_number, and told whether it was given.
void add_asked(CLI::App& command, const std::string& name, std::optional<double>& target,
               const Range& range, const std::string& help) {
  command
      .add_option_function<std::string>(
          name,
          [name, &target, range](const std::string& text) {
            target = parse_number(name, text, range);
          },
          help)
      ->type_name("NUMBER");
}

}  // namespace

void add_check(CLI::App& app, Selected& selected) {
  auto options = std::make_shared<CheckOptions>();
  CLI::App* command = add_command(
      app, selected, "check", "judge a mesh or clay for printing; status 1 when it is not",
      [options](const Progress& progress) { return run_check(*options, progress); });
  command
      ->add_option("MESH", options->mesh,
                   "OBJ, STL, PLY, GLB, glTF or 3MF; or a project (NAME.vdb)")
      ->required();
  add_piece_option(*command, options->piece);
  options->frame.add_to(*command);
  command->add_option("--printer", options->printer, "a printer profile: what it takes")
      ->type_name("FILE.json");
  add_asked(*command, "--min-wall-mm", options->min_wall_mm, kPositive,
            "also measure walls and report those thinner than this");
  add_asked(*command, "--min-gap-mm", options->min_gap_mm, kPositive,
            "also report surfaces that face each other across less air than this");
  add_asked(*command, "--overhang-deg", options->overhang_deg, {0.0, 89.0, true},
            "also report what leans out more than this from the vertical, z up");
  add_file(*command, "--picture", options->picture, {".png"}, "a picture with the problems marked");
  add_file(*command, "--ply", options->ply, {".ply"}, "the mesh with the problems colored");
}

}  // namespace argil::cli
