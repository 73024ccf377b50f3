// SPDX-License-Identifier: GPL-3.0-or-later
// argil import: a mesh becomes clay.
#include <memory>

#include "argil/engine/import.h"
#include "argil/engine/surface.h"
#include "argil/io/prepared_mesh.h"

#include "command.h"
#include "options.h"
#include "output.h"
#include "project.h"

namespace argil::cli {
namespace {

struct ImportOptions {
  std::string mesh;
  std::filesystem::path project;
  double size_mm = 0.0;   // 0: as the file says
  double voxel_mm = 0.0;  // 0: by resolution
  int resolution = io::kUsualResolution;
  double tolerance_voxels = ClayOptions{}.tolerance_voxels;
  std::size_t repair = 0;  // auto, none
};

Json import_json(const io::PreparedMesh& prepared, const ImportReport& import, const Clay& clay,
                 double volume_mm3, double seconds) {
  const io::CloseReport& closing = prepared.closing;
  Json json;
  json["levels"] = to_json(clay.level_stats());
  json["holes_closed"] = closing.holes_closed;
  json["volume_mm3"] = volume_mm3;
  json["seconds"] = seconds;
  json["hash"] = hex(clay.hash());
  json["triangles"] = prepared.mesh.triangles.size();
  json["scale"] = prepared.scale;
  json["size_mm"] = to_json(bounds(prepared.mesh).size());
  json["boundary_edges"] = closing.boundary_edges;
  json["holes_left"] = closing.holes_left;
  json["welded_vertices"] = closing.welded_vertices;
  json["dropped_triangles"] = closing.dropped_triangles;
  json["parts"] = closing.parts;
  json["parts_flipped"] = closing.parts_flipped;
  json["winding_bridged"] = import.winding_bridged;
  json["bridged_nodes"] = import.bridged_nodes;
  json["lost_vertices"] = import.lost_vertices;
  json["max_vertex_distance_mm"] = import.max_vertex_distance_mm;
  return json;
}

/// What was changed on the way, in words; "" when nothing.
std::string import_changes(const io::CloseReport& closing, const ImportReport& import) {
  std::string text;
  const auto say = [&](std::int64_t n, const char* one, const char* many) {
    if (n > 0) text += "  " + grouped(n) + (n == 1 ? one : many);
  };
  say(closing.welded_vertices, " vertex welded to another at the same place\n",
      " vertices welded to others at the same place\n");
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
  return text;
}

/// A voxel size that the machine cannot hold is the user's number, not the machine's failure.
Error as_bad_voxel_size(Error error) {
  if (error.kind == ErrorKind::memory) error.kind = ErrorKind::bad_input;
  return error;
}

Result<Outcome> run_import(const ImportOptions& options, const Progress& progress) {
  const Stopwatch watch;
  if (auto input = check_input(options.mesh); !input) return input.error();
  if (auto output = check_output(options.project); !output) return output.error();
  const auto prepared =
      io::read_prepared_mesh(options.mesh, {options.size_mm, options.repair == 0});
  if (!prepared) return prepared.error();
  if (auto stop = check_interrupt(); !stop) return stop.error();
  const double voxel = options.voxel_mm > 0.0
                           ? options.voxel_mm
                           : prepared.value().largest_side_mm / options.resolution;
  auto imported = import_mesh(prepared.value().mesh, {voxel, options.tolerance_voxels}, progress);
  if (!imported) return as_bad_voxel_size(imported.error());
  const auto& [clay, report] = imported.value();
  const double volume = signed_volume(extract_surface(clay));
  if (auto stop = check_interrupt(); !stop) return stop.error();
  if (auto saved = replace_project(options.project, clay); !saved) return saved.error();

  Outcome outcome;
  outcome.json = import_json(prepared.value(), report, clay, volume, watch.seconds());
  outcome.text = levels_text(clay.level_stats()) + "volume " + number(volume) + " mm3\n" +
                 import_changes(prepared.value().closing, report) + "saved '" +
                 options.project.string() + "' in " + number(watch.seconds()) + " s\n";
  return outcome;
}

}  // namespace

void add_import(CLI::App& app, Selected& selected) {
  auto options = std::make_shared<ImportOptions>();
  CLI::App* command =
      add_command(app, selected, "import", "turn a mesh into clay",
                  [options](const Progress& progress) { return run_import(*options, progress); });
  command->add_option("MESH", options->mesh, "OBJ, STL, PLY, GLB or 3MF")->required();
  add_file(*command, "-o,--output", options->project, {".vdb"}, "the project to write")->required();
  add_number(*command, "--size-mm", options->size_mm, kPositive,
             "scale so that the largest side has this length; default: the file's units are mm");
  auto* voxel = add_number(*command, "--voxel-mm", options->voxel_mm, kPositive, "finest voxel");
  add_integer(*command, "--resolution", options->resolution, 4, 65536,
              "finest voxels along the largest side; default 256")
      ->excludes(voxel);
  add_number(*command, "--tolerance-voxels", options->tolerance_voxels, {0.01, 0.5},
             "what coarser levels may miss, in finest voxels; default 0.1");
  add_choice(*command, "--repair", options->repair, {"auto", "none"},
             "close openings, or refuse a mesh that has any; default auto");
}

}  // namespace argil::cli
