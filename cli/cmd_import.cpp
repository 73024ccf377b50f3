// SPDX-License-Identifier: GPL-3.0-or-later
// argil import: a mesh becomes clay.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "argil/engine/import.h"
#include "argil/engine/surface.h"
#include "argil/io/import_comparison.h"
#include "argil/io/prepared_mesh.h"
#include "argil/io/project_file.h"
#include "argil/io/safe_file.h"

#include "assembly_input.h"
#include "commands.h"
#include "common/options.h"
#include "common/output.h"
#include "common/project.h"
#include "mesh_input.h"

namespace argil::cli {
namespace {

struct ImportOptions {
  std::string mesh;
  std::filesystem::path project;  // with keep_parts: a folder of them
  bool keep_parts = false;
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
  const auto apart = std::find_if(found.fused.begin(), found.fused.end(),
                                  [](const mesh::PartGap& gap) { return !gap.meet(); });
  json["merged"] =
      apart == found.fused.end() ? Json(nullptr) : point_json({apart->at_mm, apart->gap_mm});
  json["fused"] = gaps_json(found.fused, found.part_names);
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

/// Each pair of parts that became one, at most kMostPairsSaid.
std::vector<std::string> fused_notes(const io::ImportComparison& found) {
  std::vector<std::string> notes;
  for (const mesh::PartGap& gap : found.fused) {
    if (notes.size() == kMostPairsSaid) {
      notes.push_back("and " +
                      grouped(static_cast<std::int64_t>(found.fused.size() - notes.size())) +
                      " more pairs are one body in the clay; --json names all");
      break;
    }
    notes.push_back(gap_text(gap, found.part_names) + " and are one body in the clay; " +
                    (gap.meet() ? "" : "choose a finer --voxel-mm, or ") +
                    "keep each in a clay of its own with --keep-parts");
  }
  return notes;
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
  for (std::string& note : fused_notes(found)) notes.push_back(std::move(note));
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

io::MeshPreparation preparation_of(const ImportOptions& options) {
  return {options.size_mm, options.repair == 0, options.frame.frame()};
}

/// Says on stderr how the file was understood, and what of it was left out.
void print_reading(const ImportOptions& options, io::FrameReport& frame,
                   const std::vector<std::string>& notes) {
  // With a size it does not matter which unit the file has.
  if (options.size_mm > 0.0) frame.unit_looks_like.reset();
  print_notes(io::frame_doubts(options.mesh, frame));
  for (const std::string& note : notes) print_notes({"'" + options.mesh + "': " + note});
}

double voxel_for(const ImportOptions& options, double largest_side_mm) {
  return options.voxel_mm > 0.0 ? options.voxel_mm : largest_side_mm / options.resolution;
}

Result<Outcome> import_whole(const ImportOptions& options, const Progress& progress) {
  const Stopwatch watch;
  if (auto output = check_output(options.project); !output) return output.error();
  auto prepared = io::read_prepared_mesh(options.mesh, preparation_of(options));
  if (!prepared) return named(options.mesh, prepared.error());
  print_reading(options, prepared.value().frame, prepared.value().notes);
  if (auto stop = check_interrupt(); !stop) return stop.error();
  const double voxel = voxel_for(options, prepared.value().largest_side_mm);
  const auto imported = import_at(voxel, options, prepared.value(), progress);
  if (!imported) return imported.error();
  const auto& [clay, report] = imported.value();
  const auto [found, notes] = compare(prepared.value(), imported.value(), voxel);
  if (auto stop = check_interrupt(); !stop) return stop.error();
  if (auto saved = replace_project(options.project, clay); !saved) return saved.error();

  Outcome outcome;
  print_notes(notes);
  outcome.json = import_json(prepared.value(), report, clay, found, watch.seconds());
  outcome.json["part_names"] = prepared.value().part_names;
  add_frame_keys(outcome.json, prepared.value().frame);
  outcome.json["doubts"] = notes;
  const std::vector<std::string>& parts = prepared.value().part_names;
  if (!parts.empty()) outcome.text = parts_text(parts) + "\n";
  outcome.text += levels_text(clay.level_stats()) + "volume " + number(found.volume_mm3) +
                  " mm3\n" + import_changes(prepared.value().closing, report, found) + "saved '" +
                  options.project.string() + "' in " + number(watch.seconds()) + " s\n";
  return outcome;
}

/// Imports parts into projects that are not there yet, so that all of them come to be or none: each
/// is saved under its name only when the last is written.
class PartsImport {
 public:
  PartsImport(const ImportOptions& options, io::PreparedParts prepared, const Progress& progress)
      : options_(options),
        prepared_(std::move(prepared)),
        progress_(progress),
        voxel_mm_(voxel_for(options, prepared_.largest_side_mm)) {}

  Result<Outcome> run();

 private:
  Result<void> name_files();
  Result<void> import_from(std::size_t part);
  Result<void> save(std::size_t part, const std::filesystem::path& file);
  void describe(std::size_t part, const ImportResult& imported, double seconds);

  const ImportOptions& options_;
  io::PreparedParts prepared_;
  const Progress& progress_;
  double voxel_mm_;
  std::vector<std::filesystem::path> files_;
  Outcome outcome_;
};

Result<void> PartsImport::name_files() {
  for (const std::string& stem : file_stems(prepared_.names)) {
    files_.push_back(options_.project / (stem + ".vdb"));
    std::error_code unknown;
    if (std::filesystem::exists(files_.back(), unknown)) {
      return Error{ErrorKind::bad_input, "'" + files_.back().string() +
                                             "' is there already; remove it, or name another "
                                             "folder with -o"};
    }
  }
  return {};
}

void PartsImport::describe(std::size_t part, const ImportResult& imported, double seconds) {
  const io::PreparedMesh& prepared = prepared_.parts[part];
  const std::string& name = prepared_.names[part];
  auto [found, notes] = compare(prepared, imported, voxel_mm_);
  Json json = {{"name", name}, {"file", files_[part].string()}};
  json.update(import_json(prepared, imported.report, imported.clay, found, seconds));
  json["doubts"] = notes;
  outcome_.json["projects"].push_back(std::move(json));
  for (std::string& note : notes) note.insert(0, "'" + name + "': ");
  print_notes(notes);
  outcome_.text += "'" + name + "': volume " + number(found.volume_mm3) + " mm3\n" +
                   import_changes(prepared.closing, imported.report, found) + "  saved '" +
                   files_[part].string() + "'\n";
}

Result<void> PartsImport::save(std::size_t part, const std::filesystem::path& file) {
  const Stopwatch watch;
  const auto imported = import_at(voxel_mm_, options_, prepared_.parts[part], progress_);
  if (!imported) {
    Error error = imported.error();
    error.message += " (part '" + prepared_.names[part] + "')";
    return error;
  }
  describe(part, imported.value(), watch.seconds());
  prepared_.parts[part] = {};
  return io::save_project(file, imported.value().clay);
}

Result<void> PartsImport::import_from(std::size_t part) {
  if (part == files_.size()) return check_interrupt();
  return io::replace_file(files_[part], [&](const std::filesystem::path& temporary) {
    const Result<void> saved = save(part, temporary);
    return saved ? import_from(part + 1) : saved;
  });
}

Result<Outcome> PartsImport::run() {
  namespace fs = std::filesystem;
  if (auto named = name_files(); !named) return named.error();
  outcome_.json["voxel_mm"] = voxel_mm_;
  outcome_.json["projects"] = Json::array();
  outcome_.text = parts_text(prepared_.names) + "\n";
  std::error_code failed;
  const bool is_new = fs::create_directory(options_.project, failed);
  if (failed) {
    return Error{ErrorKind::disk, "cannot make the folder '" + options_.project.string() +
                                      "': " + failed.message() + "; name another with -o"};
  }
  const Result<void> imported = import_from(0);
  if (imported) return std::move(outcome_);
  std::error_code ignored;
  for (const fs::path& file : files_) fs::remove(file, ignored);
  if (is_new) fs::remove(options_.project, ignored);
  return imported.error();
}

/// The parts as pieces of one project.
Result<Outcome> import_pieces(const ImportOptions& options, const io::PreparedParts& prepared,
                              const Progress& progress) {
  const double voxel_mm = voxel_for(options, prepared.largest_side_mm);
  std::vector<Sculpture::ReadyPiece> pieces;
  const std::vector<std::string> names = io::piece_names(prepared.names);
  Outcome outcome;
  outcome.json["voxel_mm"] = voxel_mm;
  outcome.json["pieces"] = Json::array();
  outcome.text = parts_text(prepared.names) + "\n";
  for (std::size_t n = 0; n < prepared.parts.size(); ++n) {
    const Stopwatch watch;
    const io::PreparedMesh& part = prepared.parts[n];
    auto imported = import_at(voxel_mm, options, part, progress);
    if (!imported) {
      Error error = imported.error();
      error.message += " (part '" + prepared.names[n] + "')";
      return error;
    }
    const std::string& name = names[n];
    auto [found, notes] = compare(part, imported.value(), voxel_mm);
    Json json = {{"name", name}};
    json.update(
        import_json(part, imported.value().report, imported.value().clay, found, watch.seconds()));
    json["doubts"] = notes;
    outcome.json["pieces"].push_back(std::move(json));
    for (std::string& note : notes) note.insert(0, "'" + name + "': ");
    print_notes(notes);
    outcome.text += "'" + name + "': volume " + number(found.volume_mm3) + " mm3\n" +
                    import_changes(part.closing, imported.value().report, found);
    pieces.push_back({{.name = name}, std::move(imported.value().clay)});
  }
  auto sculpture = Sculpture::of(std::move(pieces), 0);
  if (!sculpture) return named(options.mesh, sculpture.error());
  if (auto stop = check_interrupt(); !stop) return stop.error();
  if (auto saved = replace_project(options.project, sculpture.value()); !saved) {
    return saved.error();
  }
  outcome.json["hash"] = hex(sculpture.value().hash());
  outcome.text += "saved '" + options.project.string() + "'\n";
  return outcome;
}

Result<Outcome> import_parts(const ImportOptions& options, const Progress& progress) {
  const Stopwatch watch;
  // "parts/" is the folder "parts".
  ImportOptions in_folder = options;
  if (!options.project.has_filename()) in_folder.project = options.project.parent_path();
  if (auto output = check_output(in_folder.project); !output) return output.error();
  auto prepared = io::read_prepared_parts(options.mesh, preparation_of(options));
  if (!prepared) return named(options.mesh, prepared.error());
  io::FrameReport frame = prepared.value().frame;
  print_reading(options, frame, prepared.value().notes);
  if (auto stop = check_interrupt(); !stop) return stop.error();
  auto outcome = has_ending(options.project, ".vdb")
                     ? import_pieces(options, prepared.value(), progress)
                     : PartsImport(in_folder, std::move(prepared).value(), progress).run();
  if (!outcome) return outcome;
  add_frame_keys(outcome.value().json, frame);
  outcome.value().json["seconds"] = watch.seconds();
  return outcome;
}

Result<Outcome> run_import(const ImportOptions& options, const Progress& progress) {
  if (auto input = check_input(options.mesh); !input) return input.error();
  return options.keep_parts ? import_parts(options, progress) : import_whole(options, progress);
}

}  // namespace

void add_import(CLI::App& app, Selected& selected) {
  auto options = std::make_shared<ImportOptions>();
  CLI::App* command =
      add_command(app, selected, "import", "turn a mesh into clay",
                  [options](const Progress& progress) { return run_import(*options, progress); });
  command->add_option("MESH", options->mesh, "OBJ, STL, PLY, GLB, glTF or 3MF")->required();
  command
      ->add_option("-o,--output", options->project,
                   "the project to write (NAME.vdb); with --keep-parts also a folder for several")
      ->type_name("FILE")
      ->required();
  command->add_flag(
      "--keep-parts", options->keep_parts,
      "each part of a 3MF, or body of another file, a clay of its own: a piece of the project, or "
      "a project in the folder");
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
  command->parse_complete_callback([options] {
    if (!options->keep_parts) check_ending("--output", options->project, {".vdb"});
  });
}

}  // namespace argil::cli
