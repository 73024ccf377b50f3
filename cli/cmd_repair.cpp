// SPDX-License-Identifier: GPL-3.0-or-later
// argil repair: a mesh from elsewhere made printable by the least change that works.
#include <algorithm>
#include <memory>
#include <utility>

#include "argil/io/assembly_repair.h"
#include "argil/io/body_parts.h"
#include "argil/io/mesh_file.h"
#include "argil/io/mesh_repair.h"

#include "assembly_input.h"
#include "commands.h"
#include "common/options.h"
#include "common/output.h"
#include "common/project.h"
#include "common/reports.h"
#include "mesh_input.h"

namespace argil::cli {
namespace {

struct RepairCommand {
  std::string mesh;
  std::filesystem::path output;
  io::RepairOptions repair;
  bool allow_loss = false;
  bool keep_parts = false;
  bool unite = false;
  MeshFrameOptions frame;
};

std::string repair_changes(const io::RepairReport& report) {
  if (report.path == io::RepairPath::nothing) return "nothing to repair\n";
  std::string text;
  const auto say = [&](std::int64_t n, const char* what) {
    if (n > 0) text += "  " + grouped(n) + " " + what + "\n";
  };
  say(report.closing.welded_vertices + report.joined_vertices, "vertices joined");
  say(report.closing.dropped_triangles, "triangles without area or given twice dropped");
  say(report.split_edges, "edges split where a vertex lay on them");
  say(report.interior_faces, "triangles dropped that solids had in common");
  say(report.dropped_fins, "triangles dropped that stood on the surface");
  say(report.closing.turned_triangles, "triangles turned as most of their part face");
  say(report.closing.parts_flipped, "parts turned to face outward");
  say(report.closing.holes_closed, "holes closed");
  say(report.coned_holes, "of them by cones, since they touched or crossed others");
  say(report.dropped_sheets, "open sheets dropped beside the solids; --thicken keeps them");
  say(report.dropped_crumbs, "flat crumbs dropped that mending cut off");
  say(report.thickened_sheets, "open sheets given a thickness");
  say(report.crossings, "pairs of triangles that crossed");
  say(report.united_parts, "parts united with those they overlapped");
  if (report.parted_vertices > 0) {
    text += "  " + grouped(report.parted_vertices) + " vertices where surfaces only touched, " +
            number(report.gap_mm) + " mm apart now\n";
  }
  if (report.path == io::RepairPath::field) {
    text += "  rebuilt through a level set with voxels of " + number(report.voxel_mm) + " mm\n";
  }
  text += "  " + grouped(report.kept_triangles) +
          " triangles as they were; no point of the result is farther than " +
          number(report.max_change_mm) + " mm from what was given\n";
  return text;
}

std::string places_text(const std::vector<io::RepairPlace>& places) {
  std::string text;
  for (const io::RepairPlace& place : places) {
    text += "  at " + number(place.at_mm.x) + ", " + number(place.at_mm.y) + ", " +
            number(place.at_mm.z) + ": " + number(place.distance_mm) + " mm off\n";
  }
  return text;
}

/// What is gone or guessed and where, or nothing.
std::string loss_text(const io::RepairReport& report) {
  std::string text;
  const io::RepairLoss& loss = report.loss;
  if (loss.parts > 0) text += "lost: " + grouped(loss.parts) + " whole parts\n";
  if (loss.share > 0.0) {
    text += "lost: " + number(100.0 * loss.share) + " % of the surface is farther than " +
            number(loss.tolerance_mm) + " mm from the result and outside it\n";
  }
  if (report.covered_too_much()) {
    text += "covered: " + number(loss.covered_mm3) +
            " mm3 lie between surfaces of which the outer one was taken\n";
  }
  text += places_text(loss.places);
  if (report.guessed_too_much()) {
    text += "guessed: " + number(100.0 * report.guess.share) +
            " % of the new surface is farther than " + number(report.guess.tolerance_mm) +
            " mm from what was given, which tells of no surface there\n" +
            places_text(report.guess.places);
  }
  if (report.lost_too_much() && report.given_volume_mm3) {
    text += "volume: " + number(*report.given_volume_mm3) + " mm3 before, " +
            number(report.verdict.volume_mm3) + " mm3 now\n";
  }
  if (!report.lost_too_much() && !report.guessed_too_much()) return text;
  text += report.path == io::RepairPath::field
              ? "look there; a smaller --voxel-mm may keep more, --allow-loss accepts it\n"
              : "look there; --allow-loss accepts it\n";
  return text;
}

std::string report_text(const io::RepairReport& report) {
  return repair_changes(report) + loss_text(report) + verdict_text(report.verdict);
}

/// The file is written in any case; 1 says that it is not printable or not what it was.
int status_for(const io::RepairReport& report, bool allow_loss) {
  const bool is_kept = allow_loss || !(report.lost_too_much() || report.guessed_too_much());
  return report.verdict.printable && is_kept ? 0 : 1;
}

/// All parts that the file had as one mesh.
Result<Outcome> repair_whole(const RepairCommand& command, io::Assembly assembly,
                             const Progress& progress) {
  const std::size_t parts = io::placed_parts(assembly).size();
  if (parts > 1 && !command.unite) {
    print_notes({"'" + command.mesh + "' has " + std::to_string(parts) +
                 " parts, which become one mesh; name a .3mf with -o to keep them"});
  }
  auto repaired = io::repair_mesh(io::joined(std::move(assembly)), command.repair, progress);
  if (!repaired) return named(command.mesh, repaired.error());
  const auto& [mesh, report] = repaired.value();
  io::WriteOptions options;
  options.title = command.output.stem().string();
  auto written = io::write_mesh(command.output, mesh, options, progress);
  if (!written) return written.error();
  Outcome outcome;
  outcome.json = repair_json(report, mesh.triangles.size());
  outcome.json["parts"] = Json::array();
  outcome.text = report_text(report);
  outcome.status = status_for(report, command.allow_loss);
  return outcome;
}

/// Of all parts where they stand.
Vec3 size_of(const io::Assembly& assembly) {
  Box3 box;
  for (const io::PlacedPart& part : io::placed_parts(assembly)) {
    const Box3 own = io::placed_bounds(assembly.objects[part.object].mesh, part.to_mm);
    box.include(own.min);
    box.include(own.max);
  }
  return box.size();
}

/// Names of the objects, each that of its first part.
std::vector<std::string> object_names(const io::Assembly& assembly) {
  std::vector<std::string> names(assembly.objects.size());
  for (const io::PlacedPart& part : io::placed_parts(assembly)) {
    if (names[part.object].empty()) names[part.object] = part.name;
  }
  return names;
}

void add_closing(const mesh::CloseReport& one, mesh::CloseReport& all) {
  all.welded_vertices += one.welded_vertices;
  all.dropped_triangles += one.dropped_triangles;
  all.turned_triangles += one.turned_triangles;
  all.parts_flipped += one.parts_flipped;
  all.holes_closed += one.holes_closed;
}

void add_mending(const io::RepairReport& one, io::RepairReport& all) {
  all.joined_vertices += one.joined_vertices;
  all.split_edges += one.split_edges;
  all.interior_faces += one.interior_faces;
  all.dropped_fins += one.dropped_fins;
  all.coned_holes += one.coned_holes;
  all.dropped_sheets += one.dropped_sheets;
  all.dropped_crumbs += one.dropped_crumbs;
  all.thickened_sheets += one.thickened_sheets;
  all.parted_vertices += one.parted_vertices;
  all.united_parts += one.united_parts;
  all.crossings += one.crossings;
  all.kept_triangles += one.kept_triangles;
  all.path = std::max(all.path, one.path);
  all.gap_mm = std::max(all.gap_mm, one.gap_mm);
  all.voxel_mm = std::max(all.voxel_mm, one.voxel_mm);
  all.max_change_mm = std::max(all.max_change_mm, one.max_change_mm);
  all.max_change_slack_mm = std::max(all.max_change_slack_mm, one.max_change_slack_mm);
  all.loss.parts += one.loss.parts;
  all.loss.samples += one.loss.samples;
  all.loss.share = std::max(all.loss.share, one.loss.share);
  all.loss.tolerance_mm = std::max(all.loss.tolerance_mm, one.loss.tolerance_mm);
  all.loss.covered_mm3 += one.loss.covered_mm3;
  all.guess.share = std::max(all.guess.share, one.guess.share);
  all.guess.tolerance_mm = std::max(all.guess.tolerance_mm, one.guess.tolerance_mm);
}

void add_verdict(const mesh::MeshVerdict& one, mesh::MeshVerdict& all) {
  all.printable = all.printable && one.printable;
  all.closed = all.closed && one.closed;
  all.manifold = all.manifold && one.manifold;
  all.outward = all.outward && one.outward;
  all.boundary_edges += one.boundary_edges;
  all.nonmanifold_edges += one.nonmanifold_edges;
  all.misoriented_edges += one.misoriented_edges;
  all.nonmanifold_vertices += one.nonmanifold_vertices;
  all.self_intersections += one.self_intersections;
  all.degenerate += one.degenerate;
  all.duplicate += one.duplicate;
  all.components += one.components;
  all.euler += one.euler;
  all.cavities += one.cavities;
  all.small_components += one.small_components;
  all.volume_mm3 += one.volume_mm3;
  all.area_mm2 += one.area_mm2;
}

/// What was done and found in all objects: counts added, distances the greatest, yes where it is so
/// of each. Where it is, each says for itself.
io::RepairReport total_of(const io::RepairedAssembly& made) {
  io::RepairReport all = made.reports[0];
  all.loss.places.clear();
  all.guess.places.clear();
  all.verdict.problems.clear();
  for (std::size_t o = 1; o < made.reports.size(); ++o) {
    const io::RepairReport& one = made.reports[o];
    add_closing(one.closing, all.closing);
    add_mending(one, all);
    add_verdict(one.verdict, all.verdict);
  }
  all.given_volume_mm3.reset();
  return all;
}

Json parts_json(const io::RepairedAssembly& made, const std::vector<std::string>& names) {
  Json parts = Json::array();
  for (std::size_t o = 0; o < made.reports.size(); ++o) {
    Json part = {{"name", names[o]}};
    part.update(repair_json(made.reports[o], made.assembly.objects[o].mesh.triangles.size()));
    parts.push_back(std::move(part));
  }
  return parts;
}

std::string repaired_text(const io::RepairedAssembly& made, const std::vector<std::string>& names) {
  std::string text = parts_text(names) + "\n";
  for (std::size_t o = 0; o < std::min(names.size(), kMostPartsSaid); ++o) {
    text += "'" + names[o] + "': " + report_text(made.reports[o]);
  }
  return text;
}

/// Each part by itself, with its name, color and place.
Result<Outcome> repair_parts(const RepairCommand& command, io::Assembly assembly,
                             const Progress& progress) {
  constexpr double kTouchMm = 1e-3;
  if (command.keep_parts) assembly = io::split_into_bodies(std::move(assembly));
  const Vec3 given_size = size_of(assembly);
  auto repaired = io::repair_assembly(std::move(assembly), command.repair, progress);
  if (!repaired) return named(command.mesh, repaired.error());
  const io::RepairedAssembly& made = repaired.value();
  auto written = io::write_assembly(command.output, made.assembly, progress);
  if (!written) return written.error();
  const std::vector<std::string> names = object_names(made.assembly);
  const StandingParts standing = standing_parts(made.assembly);
  const auto gaps = gaps_between(standing, kTouchMm, progress);
  if (!gaps) return gaps.error();
  std::size_t triangles = 0;
  for (const io::AssemblyObject& object : made.assembly.objects) {
    triangles += object.mesh.triangles.size();
  }
  Outcome outcome;
  outcome.json =
      repair_json(made.reports.size() == 1 ? made.reports[0] : total_of(made), triangles);
  outcome.json["lost"]["too_much"] =
      std::any_of(made.reports.begin(), made.reports.end(),
                  [](const io::RepairReport& report) { return report.lost_too_much(); });
  outcome.json["guessed"]["too_much"] =
      std::any_of(made.reports.begin(), made.reports.end(),
                  [](const io::RepairReport& report) { return report.guessed_too_much(); });
  outcome.json["given_size_mm"] = to_json(given_size);
  outcome.json["size_mm"] = to_json(size_of(made.assembly));
  outcome.json["parts"] = parts_json(made, names);
  outcome.json["part_gaps"] = gaps_json(gaps.value(), standing.names);
  outcome.text = names.size() == 1 ? report_text(made.reports[0]) : repaired_text(made, names);
  for (std::size_t n = 0; n < std::min(gaps.value().size(), kMostPairsSaid); ++n) {
    outcome.text += gap_text(gaps.value()[n], standing.names) +
                    ": they stay two parts; --unite makes one mesh of all\n";
  }
  for (const io::RepairReport& report : made.reports) {
    outcome.status = std::max(outcome.status, status_for(report, command.allow_loss));
  }
  return outcome;
}

Result<Outcome> run_repair(const RepairCommand& command, const Progress& progress) {
  const Stopwatch watch;
  if (auto input = check_input(command.mesh); !input) return input.error();
  if (auto output = check_output(command.output); !output) return output.error();
  auto read = open_assembly(command.mesh, command.frame);
  if (!read) return read.error();
  if (auto stop = check_interrupt(); !stop) return stop.error();
  const bool names_parts = has_ending(command.mesh, ".3mf") && has_ending(command.output, ".3mf");
  const bool keeps_parts = command.keep_parts || (names_parts && !command.unite);
  const auto repair = keeps_parts ? repair_parts : repair_whole;
  auto outcome = repair(command, std::move(read.value().assembly), progress);
  if (!outcome) return outcome;
  add_frame_keys(outcome.value().json, read.value().frame);
  outcome.value().json["seconds"] = watch.seconds();
  outcome.value().text +=
      "saved '" + command.output.string() + "' in " + number(watch.seconds()) + " s\n";
  return outcome;
}

}  // namespace

void add_repair(CLI::App& app, Selected& selected) {
  auto options = std::make_shared<RepairCommand>();
  CLI::App* command =
      add_command(app, selected, "repair", "make a mesh printable by the least change that works",
                  [options](const Progress& progress) { return run_repair(*options, progress); });
  command->add_option("MESH", options->mesh, "OBJ, STL, PLY, GLB, glTF or 3MF")->required();
  add_file(*command, "-o,--output", options->output, {".3mf", ".stl", ".obj", ".ply", ".glb"},
           "the mesh to write")
      ->required();
  options->frame.add_to(*command);
  add_number(*command, "--voxel-mm", options->repair.voxel_mm, {kLeastVoxelMm, kMostVoxelMm},
             "of the level set where all else fails; default: a 512th of the largest side, up to a "
             "220th where its surface is large");
  add_number(*command, "--thicken", options->repair.thickening.thickness_mm, {0.01, 1000.0},
             "mm that open sheets become thick");
  command->add_flag("--inward", options->repair.thickening.inward,
                    "thicken to the inside alone, so that the outside stays where it was");
  command
      ->add_option_function<std::string>(
          "--rim",
          [options](const std::string& rim) {
            options->repair.thickening.rim =
                rim == "round" ? mesh::SheetRim::round : mesh::SheetRim::square;
          },
          "of thickened sheets: square or round")
      ->check(CLI::IsMember({"square", "round"}));
  command->add_flag("--allow-loss", options->allow_loss,
                    "status 0 also where a part, 1 % of the surface or of the volume is gone");
  CLI::Option* keep = command->add_flag(
      "--keep-parts", options->keep_parts,
      "each body of a file that names no parts becomes one, repaired by itself; -o names a .3mf");
  CLI::Option* unite = command->add_flag("--unite", options->unite,
                                         "one mesh of all parts of a 3MF; default: each by itself");
  keep->excludes(unite);
  command->parse_complete_callback([options, keep] {
    if (keep->count() == 0 || has_ending(options->output, ".3mf")) return;
    throw CLI::ValidationError(
        "--keep-parts is for a .3mf, which alone holds parts, and -o names another file; leave it "
        "out or name a .3mf");
  });
}

}  // namespace argil::cli
