// SPDX-License-Identifier: GPL-3.0-or-later
// argil import: a mesh becomes clay.
#include <cassert>
#include <cmath>
#include <memory>
#include <optional>

#include "argil/engine/import.h"
#include "argil/engine/surface.h"
#include "argil/io/import_comparison.h"
#include "argil/io/prepared_mesh.h"

#include "commands.h"
#include "common/options.h"
#include "common/output.h"
#include "common/project.h"
#include "mesh_input.h"

namespace argil::cli {
namespace {

struct ImportOptions {
  std::string mesh;
  std::filesystem::path project;
  double size_mm = 0.0;   // 0: as the file says
  double voxel_mm = 0.0;  // 0: by resolution
  int resolution = io::kUsualResolution;
  double tolerance_voxels = ClayOptions{}.tolerance_voxels;
  std::optional<double> edge_radius_mm;
  std::size_t repair = 0;  // auto, none
  MeshFrameOptions frame;
};

Json point_json(const io::MeasuredPoint& farthest) {
  return {{"distance_mm", farthest.distance_mm}, {"at_mm", to_json(farthest.at_mm)}};
}

template <class Value>
Json or_null(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json import_json(const io::PreparedMesh& prepared, const ImportReport& import, const Clay& clay,
                 const io::ImportComparison& found, double seconds) {
  const mesh::CloseReport& closing = prepared.closing;
  Json json;
  json["levels"] = to_json(clay.level_stats());
  json["holes_closed"] = closing.holes_closed;
  json["volume_mm3"] = found.volume_mm3;
  json["mesh_volume_mm3"] = or_null(found.given_volume_mm3);
  json["extent_off_mm"] = found.extent_off_mm;
  json["lost"] = point_json(found.lost);
  json["filled"] = point_json(found.filled);
  json["added"] = point_json(found.added);
  json["bodies"] = found.bodies;
  json["mesh_bodies"] = or_null(found.given_bodies);
  json["merged"] = found.merged ? point_json(*found.merged) : Json(nullptr);
  json["seconds"] = seconds;
  json["hash"] = hex(clay.hash());
  json["triangles"] = prepared.mesh.triangles.size();
  json["scale"] = prepared.scale;
  json["size_mm"] = to_json(bounds(prepared.mesh).size());
  json["boundary_edges"] = closing.boundary_edges;
  json["holes_left"] = closing.holes_left;
  json["welded_vertices"] = closing.welded_vertices;
  json["joined_vertices"] = closing.joined_vertices;
  json["dropped_triangles"] = closing.dropped_triangles;
  json["parts"] = closing.parts;
  json["parts_flipped"] = closing.parts_flipped;
  json["winding_bridged"] = import.winding_bridged;
  json["bridged_nodes"] = import.bridged_nodes;
  json["lost_vertices"] = import.lost_vertices;
  json["max_vertex_distance_mm"] = import.max_vertex_distance_mm;
  return json;
}

/// What the import changed, in words; "" when nothing.
std::string import_changes(const mesh::CloseReport& closing, const ImportReport& import,
                           const io::ImportComparison& found) {
  std::string text;
  const auto say = [&](std::int64_t n, const char* one, const char* many) {
    if (n > 0) text += "  " + grouped(n) + (n == 1 ? one : many);
  };
  say(closing.welded_vertices, " vertex welded to another at the same point\n",
      " vertices welded to others at the same point\n");
  say(closing.joined_vertices, " vertex joined to one that it nearly met\n",
      " vertices joined to others that they nearly met\n");
  say(closing.dropped_triangles, " triangle without area or given twice dropped\n",
      " triangles without area or given twice dropped\n");
  say(closing.parts_flipped, " part turned to face outward\n", " parts turned to face outward\n");
  say(closing.holes_closed, " hole closed\n", " holes closed\n");
  say(closing.holes_left, " opening that no patch fits left to bridging\n",
      " openings that no patch fits left to bridging\n");
  if (import.winding_bridged) text += "  open gaps bridged by winding number, over";
  if (import.winding_bridged) text += " " + grouped(import.bridged_nodes) + " nodes\n";
  say(import.lost_vertices, " vertex on a tip or sheet thinner than two voxels lost",
      " vertices on tips or sheets thinner than two voxels lost");
  if (import.lost_vertices > 0) {
    text += ", the farthest by " + number(import.max_vertex_distance_mm) +
            " mm; a finer --voxel-mm keeps more\n";
  }
  if (found.given_bodies && found.bodies < *found.given_bodies) {
    text += "  " + grouped(*found.given_bodies) + " bodies of the mesh are " +
            grouped(found.bodies) + " in clay\n";
  }
  return text;
}

/// Whether the volumes differ by more than rounded edges, and than parts that count twice.
bool is_volume_doubtful(const io::ImportComparison& found) {
  if (!found.given_volume_mm3) return false;
  const double more_mm3 = found.volume_mm3 - *found.given_volume_mm3;
  // Parts that overlap count twice in the mesh and once in the clay.
  if (found.has_inner_walls && more_mm3 < 0.0) return false;
  return std::abs(more_mm3) > found.volume_margin * *found.given_volume_mm3;
}

std::string point_text(const io::MeasuredPoint& measured) {
  const Vec3& at = measured.at_mm;
  return "at " + number(at.x) + "," + number(at.y) + "," + number(at.z) + " mm ";
}

std::string distance_text(const io::MeasuredPoint& measured) {
  return number(measured.distance_mm) + " mm ";
}

/// What a person should look at; empty where the clay is what the mesh was.
std::vector<std::string> doubts(const io::ImportComparison& found, double voxel_mm) {
  constexpr const char* kFiner = "choose a finer --voxel-mm";
  const double most_mm = io::ImportComparison::kMostVoxelsOff * voxel_mm;
  std::vector<std::string> notes;
  const auto note_if = [&](bool is_so, const std::string& what, const std::string& remedy) {
    if (is_so) notes.push_back(what + "; " + remedy);
  };
  note_if(is_volume_doubtful(found),
          "the clay has " + number(found.volume_mm3) + " mm3 and the mesh " +
              number(found.given_volume_mm3.value_or(0.0)),
          std::string("look at it with 'argil render', mend the mesh with 'argil repair', or ") +
              kFiner);
  note_if(found.extent_off_mm > most_mm,
          "the clay ends " + number(found.extent_off_mm) + " mm from where the mesh does",
          std::string("look at it with 'argil render', or ") + kFiner);
  note_if(found.lost.distance_mm > most_mm,
          point_text(found.lost) + "the mesh is " + distance_text(found.lost) +
              "outside the clay: a wall or a tip thinner than two voxels is lost",
          kFiner);
  note_if(found.filled.distance_mm > most_mm,
          point_text(found.filled) + "the mesh is " + distance_text(found.filled) +
              "inside the clay: a gap or a cavity narrower than two voxels is filled",
          kFiner);
  note_if(found.added.distance_mm > most_mm,
          point_text(found.added) + "the clay has a surface " + distance_text(found.added) +
              "from any of the mesh",
          "look at it with 'argil render', or mend the mesh with 'argil repair'");
  if (found.merged) {
    note_if(true,
            grouped(*found.given_bodies) + " bodies of the mesh are " + grouped(found.bodies) +
                " in the clay: " + point_text(*found.merged) + "two of them are only " +
                distance_text(*found.merged) + "apart",
            kFiner);
  }
  return notes;
}

/// A voxel size that the machine cannot hold is the user's number, not the machine's failure;
/// memory that ran out although it looked like enough is that.
Result<ImportResult> import_at(double voxel_mm, const ImportOptions& options,
                               const io::PreparedMesh& prepared, const Progress& progress) {
  assert(std::isfinite(voxel_mm) && voxel_mm > 0.0);
  // Asked before, since the import takes the memory that is asked about.
  const bool is_likely = io::is_likely_to_fit(prepared, voxel_mm);
  auto imported = import_mesh(
      prepared.mesh, {voxel_mm, options.tolerance_voxels, options.edge_radius_mm}, progress);
  if (imported) return imported;
  Error error = imported.error();
  if (error.kind == ErrorKind::memory && !is_likely) error.kind = ErrorKind::bad_input;
  return named(options.mesh, std::move(error));
}

struct Compared {
  io::ImportComparison found;
  std::vector<std::string> notes;
};

/// A clay that is finished is not lost to what would have been said about it.
Compared compare(const io::PreparedMesh& prepared, const ImportResult& imported, double voxel_mm) {
  const TriangleMesh surface = extract_surface(imported.clay);
  auto found =
      io::compare_import(prepared, imported.clay, surface, imported.report.winding_bridged);
  if (found) return {found.value(), doubts(found.value(), voxel_mm)};
  io::ImportComparison unknown;
  unknown.volume_mm3 = signed_volume(surface);
  return {unknown, {"the clay was not compared with the mesh: " + found.error().message}};
}

Result<Outcome> run_import(const ImportOptions& options, const Progress& progress) {
  const Stopwatch watch;
  if (auto input = check_input(options.mesh); !input) return input.error();
  if (auto output = check_output(options.project); !output) return output.error();
  const io::MeshFrame frame = options.frame.frame();
  const auto prepared =
      io::read_prepared_mesh(options.mesh, {options.size_mm, options.repair == 0, frame});
  if (!prepared) return named(options.mesh, prepared.error());
  // With a size it does not matter which unit the file has.
  io::FrameReport read = prepared.value().frame;
  if (options.size_mm > 0.0) read.unit_looks_like.reset();
  print_notes(io::frame_doubts(options.mesh, read));
  if (auto stop = check_interrupt(); !stop) return stop.error();
  const double voxel = options.voxel_mm > 0.0
                           ? options.voxel_mm
                           : prepared.value().largest_side_mm / options.resolution;
  const auto imported = import_at(voxel, options, prepared.value(), progress);
  if (!imported) return imported.error();
  const auto& [clay, report] = imported.value();
  const auto [found, notes] = compare(prepared.value(), imported.value(), voxel);
  if (auto stop = check_interrupt(); !stop) return stop.error();
  if (auto saved = replace_project(options.project, clay); !saved) return saved.error();

  Outcome outcome;
  print_notes(notes);
  outcome.json = import_json(prepared.value(), report, clay, found, watch.seconds());
  add_frame_keys(outcome.json, read);
  outcome.json["doubts"] = notes;
  outcome.text = levels_text(clay.level_stats()) + "volume " + number(found.volume_mm3) + " mm3\n" +
                 import_changes(prepared.value().closing, report, found) + "saved '" +
                 options.project.string() + "' in " + number(watch.seconds()) + " s\n";
  return outcome;
}

}  // namespace

void add_import(CLI::App& app, Selected& selected) {
  auto options = std::make_shared<ImportOptions>();
  CLI::App* command =
      add_command(app, selected, "import", "turn a mesh into clay",
                  [options](const Progress& progress) { return run_import(*options, progress); });
  command->add_option("MESH", options->mesh, "OBJ, STL, PLY, GLB, glTF or 3MF")->required();
  add_file(*command, "-o,--output", options->project, {".vdb"}, "the project to write")->required();
  options->frame.add_to(*command);
  add_number(*command, "--size-mm", options->size_mm, kPositive,
             "scale so that the largest side has this length; default: as large as the file says")
      ->excludes(options->frame.unit_option());
  auto* voxel = add_number(*command, "--voxel-mm", options->voxel_mm, {kLeastVoxelMm, kMostVoxelMm},
                           "finest voxel");
  add_integer(*command, "--resolution", options->resolution, 4, 65536,
              "finest voxels along the largest side; default 256")
      ->excludes(voxel);
  add_number(*command, "--tolerance-voxels", options->tolerance_voxels, {0.01, 0.5},
             "what coarser levels may miss, in finest voxels; default 0.1");
  const auto set_edge = [options](const std::string& text) {
    options->edge_radius_mm = parse_number("--edge-radius-mm", text, {0.0, kMostEdgeRadiusMm});
  };
  command
      ->add_option_function<std::string>(
          "--edge-radius-mm", set_edge,
          "radius of the edges that tools and cuts leave, 0 sharp; default: without steps")
      ->type_name("NUMBER");
  add_choice(*command, "--repair", options->repair, {"auto", "none"},
             "close openings, or refuse a mesh that has any; default auto");
}

}  // namespace argil::cli
