// SPDX-License-Identifier: GPL-3.0-or-later
// argil import: a mesh becomes clay.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

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

/// What became of the mesh, beside the mesh.
struct Comparison {
  double volume_mm3 = 0.0;
  std::optional<double> given_mm3;
  double extent_off_mm = 0.0;  ///< the farthest that a side of the clay's box is from the mesh's
};

Json import_json(const io::PreparedMesh& prepared, const ImportReport& import, const Clay& clay,
                 const Comparison& found, double seconds) {
  const io::CloseReport& closing = prepared.closing;
  Json json;
  json["levels"] = to_json(clay.level_stats());
  json["holes_closed"] = closing.holes_closed;
  json["volume_mm3"] = found.volume_mm3;
  json["mesh_volume_mm3"] = found.given_mm3 ? Json(*found.given_mm3) : Json(nullptr);
  json["extent_off_mm"] = found.extent_off_mm;
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

/// What was changed on the way, in words; "" when nothing.
std::string import_changes(const io::CloseReport& closing, const ImportReport& import) {
  std::string text;
  const auto say = [&](std::int64_t n, const char* one, const char* many) {
    if (n > 0) text += "  " + grouped(n) + (n == 1 ? one : many);
  };
  say(closing.welded_vertices, " vertex welded to another at the same place\n",
      " vertices welded to others at the same place\n");
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
  return text;
}

Comparison compare(const io::PreparedMesh& prepared, const TriangleMesh& surface) {
  Comparison found{signed_volume(surface), prepared.given_volume_mm3, 0.0};
  const Box3 given = bounds(prepared.mesh);
  const Box3 made = bounds(surface);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    found.extent_off_mm = std::max({found.extent_off_mm, std::abs(made.min[axis] - given.min[axis]),
                                    std::abs(made.max[axis] - given.max[axis])});
  }
  return found;
}

/// What a person should look at; empty where the clay is what the mesh was.
std::vector<std::string> doubts(const Comparison& found, const io::CloseReport& closing,
                                double voxel_mm) {
  constexpr double kMostOff = 0.02;  // of the volume
  constexpr double kMostVoxelsOff = 2.0;
  std::vector<std::string> notes;
  if (found.given_mm3 &&
      std::abs(found.volume_mm3 - *found.given_mm3) > kMostOff * *found.given_mm3) {
    notes.push_back(
        "the clay has " + number(found.volume_mm3) + " mm3 and the mesh " +
        number(*found.given_mm3) +
        (closing.parts > 1 ? ", where parts that overlap count twice" : "") +
        "; look at it with 'argil render', mend the mesh with 'argil repair', or choose a "
        "finer --voxel-mm");
  }
  if (found.extent_off_mm > kMostVoxelsOff * voxel_mm) {
    notes.push_back(
        "the clay ends " + number(found.extent_off_mm) +
        " mm from where the mesh does; look at it with 'argil render', or choose a finer "
        "--voxel-mm");
  }
  return notes;
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
  const Comparison found = compare(prepared.value(), extract_surface(clay));
  const auto notes = doubts(found, prepared.value().closing, voxel);
  if (auto stop = check_interrupt(); !stop) return stop.error();
  if (auto saved = replace_project(options.project, clay); !saved) return saved.error();

  Outcome outcome;
  print_notes(notes);
  outcome.json = import_json(prepared.value(), report, clay, found, watch.seconds());
  outcome.json["doubts"] = notes;
  outcome.text = levels_text(clay.level_stats()) + "volume " + number(found.volume_mm3) + " mm3\n" +
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
