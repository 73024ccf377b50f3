// SPDX-License-Identifier: GPL-3.0-or-later
// argil repair: a mesh from elsewhere made printable by the least change that works.
#include <memory>

#include "argil/io/mesh_file.h"
#include "argil/io/mesh_repair.h"

#include "commands.h"
#include "common/options.h"
#include "common/output.h"
#include "mesh_input.h"

namespace argil::cli {
namespace {

struct RepairCommand {
  std::string mesh;
  std::filesystem::path output;
  io::RepairOptions repair;
  bool allow_loss = false;
  MeshFrameOptions frame;
};

const char* path_name(io::RepairPath path) {
  if (path == io::RepairPath::nothing) return "nothing";
  return path == io::RepairPath::local ? "local" : "field";
}

Json repair_json(const io::RepairReport& report) {
  Json json;
  // The key that scripts know (docs/command_line.md).
  json["way"] = path_name(report.path);
  json["welded_vertices"] = report.closing.welded_vertices + report.joined_vertices;
  json["dropped_triangles"] = report.closing.dropped_triangles;
  json["split_edges"] = report.split_edges;
  json["interior_faces"] = report.interior_faces;
  json["dropped_fins"] = report.dropped_fins;
  json["parts_flipped"] = report.closing.parts_flipped;
  json["holes_closed"] = report.closing.holes_closed;
  json["thickened_sheets"] = report.thickened_sheets;
  json["coned_holes"] = report.coned_holes;
  json["dropped_sheets"] = report.dropped_sheets;
  json["dropped_crumbs"] = report.dropped_crumbs;
  json["parted_vertices"] = report.parted_vertices;
  json["gap_mm"] = report.gap_mm;
  json["united_parts"] = report.united_parts;
  json["crossings"] = report.crossings;
  json["voxel_mm"] = report.voxel_mm;
  json["kept_triangles"] = report.kept_triangles;
  json["turned_triangles"] = report.closing.turned_triangles;
  json["max_change_mm"] = report.max_change_mm;
  json["max_change_slack_mm"] = report.max_change_slack_mm;
  json["given_size_mm"] = to_json(report.given_size_mm);
  json["given_volume_mm3"] = report.given_volume_mm3 ? Json(*report.given_volume_mm3) : Json();
  const auto places = [](const std::vector<io::RepairPlace>& all) {
    Json array = Json::array();
    for (const io::RepairPlace& place : all) {
      array.push_back({{"at_mm", to_json(place.at_mm)}, {"distance_mm", place.distance_mm}});
    }
    return array;
  };
  json["lost"] = {{"too_much", report.lost_too_much()},  {"share", report.loss.share},
                  {"parts", report.loss.parts},          {"tolerance_mm", report.loss.tolerance_mm},
                  {"samples", report.loss.samples},      {"covered_mm3", report.loss.covered_mm3},
                  {"places", places(report.loss.places)}};
  json["guessed"] = {{"too_much", report.guessed_too_much()},
                     {"share", report.guess.share},
                     {"tolerance_mm", report.guess.tolerance_mm},
                     {"places", places(report.guess.places)}};
  return json;
}

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

Result<Outcome> run_repair(const RepairCommand& command, const Progress& progress) {
  const Stopwatch watch;
  if (auto input = check_input(command.mesh); !input) return input.error();
  if (auto output = check_output(command.output); !output) return output.error();
  const auto read = open_mesh(command.mesh, command.frame);
  if (!read) return read.error();
  if (auto stop = check_interrupt(); !stop) return stop.error();
  auto repaired = io::repair_mesh(read.value().mesh, command.repair, progress);
  if (!repaired) return named(command.mesh, repaired.error());
  const io::RepairReport& report = repaired.value().report;
  io::WriteOptions options;
  options.title = command.output.stem().string();
  auto written = io::write_mesh(command.output, repaired.value().mesh, options, progress);
  if (!written) return written.error();
  Outcome outcome;
  outcome.json = repair_json(report);
  outcome.json.update(to_json(report.verdict));
  add_frame_keys(outcome.json, read.value().frame);
  outcome.json["triangles"] = repaired.value().mesh.triangles.size();
  outcome.json["seconds"] = watch.seconds();
  outcome.text = repair_changes(report) + loss_text(report) + verdict_text(report.verdict) +
                 "saved '" + command.output.string() + "' in " + number(watch.seconds()) + " s\n";
  // The file is written in any case; 1 says that it is not printable or not what it was.
  const bool is_kept = command.allow_loss || !(report.lost_too_much() || report.guessed_too_much());
  outcome.status = report.verdict.printable && is_kept ? 0 : 1;
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
}

}  // namespace argil::cli
