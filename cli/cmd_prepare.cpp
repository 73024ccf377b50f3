// SPDX-License-Identifier: GPL-3.0-or-later
// argil prepare: clay or a mesh made ready for a printer.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "argil/engine/import.h"
#include "argil/io/mesh_file.h"
#include "argil/io/prepared_mesh.h"
#include "argil/io/print_preparation.h"
#include "argil/io/printer_file.h"

#include "commands.h"
#include "common/options.h"
#include "common/output.h"
#include "common/project.h"
#include "preparation_pictures.h"

namespace argil::cli {
namespace {

struct PrepareCommand {
  std::string input;
  std::string piece;
  std::filesystem::path output;
  std::string printer;
  std::filesystem::path pictures;
  double size_mm = 0.0;
  double voxel_mm = 0.0;
  bool keeps_orientation = false;
  io::PreparationOptions preparation;
};

void read_base(const std::string& text, io::PreparationOptions& options) {
  if (text == "auto") {
    options.base = io::PrintBase::automatic;
  } else if (text == "lay") {
    options.base = io::PrintBase::lay;
  } else if (text == "none") {
    options.base = io::PrintBase::none;
  } else if (text.rfind("cut:", 0) == 0) {
    options.base = io::PrintBase::cut;
    options.cut_mm = parse_number("--base cut:MM", text.substr(4), kPositive);
  } else {
    throw CLI::ValidationError("--base is '" + text + "'; must be auto, cut:MM, lay or none");
  }
}

/// Clay, and how many steps of it came from a journal.
struct ReadClay {
  Clay clay;
  std::int64_t recovered = 0;
};

Result<ReadClay> read_clay(const PrepareCommand& command, const Progress& progress) {
  if (has_ending(command.input, ".vdb")) {
    auto opened = open_clay(command.input, command.piece, progress);
    if (!opened) return opened.error();
    return ReadClay{std::move(opened.value().clay), opened.value().recovered_steps};
  }
  if (auto none = check_no_piece(command.input, command.piece); !none) return none.error();
  const auto prepared = io::read_prepared_mesh(command.input, {command.size_mm, true});
  if (!prepared) return named(command.input, prepared.error());
  const double voxel = command.voxel_mm > 0.0
                           ? command.voxel_mm
                           : prepared.value().largest_side_mm / io::kUsualResolution;
  ClayOptions options;
  options.voxel_mm = voxel;
  auto imported = import_mesh(prepared.value().mesh, options, progress);
  if (!imported) return named(command.input, imported.error());
  return ReadClay{std::move(imported.value().clay), 0};
}

Json orientation_json(const mesh::PrintOrientation& o) {
  return {{"up", to_json(o.up)},
          {"overhang_mm2", o.overhang_mm2},
          {"support_mm3", o.support_mm3},
          {"scars_mm2", o.scars_mm2},
          {"height_mm", o.height_mm},
          {"contact_mm2", o.contact_mm2},
          // Nothing stands on a contact without area.
          {"footing_mm", o.contact_mm2 > 0.0 ? Json(o.footing_mm) : Json()},
          {"cost", o.cost}};
}

Json islands_json(const std::vector<mesh::PrintIsland>& islands) {
  Json list = Json::array();
  for (const mesh::PrintIsland& island : islands) {
    list.push_back({{"at_mm", to_json(island.at_mm)},
                    {"area_mm2", island.area_mm2},
                    {"free_mm", std::isfinite(island.free_mm) ? Json(island.free_mm) : Json()}});
  }
  return list;
}

Json pockets_json(const std::vector<mesh::LiquidPocket>& pockets) {
  Json list = Json::array();
  for (const mesh::LiquidPocket& pocket : pockets) {
    list.push_back({{"lowest_mm", to_json(pocket.lowest_mm)},
                    {"highest_mm", to_json(pocket.highest_mm)},
                    {"volume_mm3", pocket.volume_mm3},
                    {"closed", pocket.closed}});
  }
  return list;
}

Json prepare_json(const io::PrintPreparation& made) {
  Json json;
  json["printable"] = made.is_printable();
  json["orientations"] = Json::array();
  for (const auto& each : made.orientations) json["orientations"].push_back(orientation_json(each));
  json["orientation"] = orientation_json(made.chosen);
  json["cut_mm"] = made.cut_mm;
  if (made.wall_mm > 0.0) json["wall_mm"] = made.wall_mm;
  json["holes"] = Json::array();
  for (const io::PrintHole& hole : made.holes) {
    json["holes"].push_back({{"mouth_mm", to_json(hole.mouth_mm)},
                             {"inward", to_json(hole.inward)},
                             {"air", hole.is_for_air}});
  }
  json["plugs"] = made.plugs;
  json["plug_radius_mm"] = made.plug_radius_mm;
  json["joints_without_plug"] = made.joints_without_plug;
  json["pieces"] = Json::array();
  for (const io::PreparedPiece& piece : made.pieces) {
    Json one = {{"name", piece.name}, {"triangles", piece.mesh.triangles.size()}};
    one["filled_cavities"] = piece.filled_cavities;
    one["islands"] = islands_json(piece.islands);
    one["pockets"] = pockets_json(piece.pockets);
    one.update(to_json(piece.verdict));
    json["pieces"].push_back(std::move(one));
  }
  return json;
}

std::string place_text(const Vec3& p) {
  return number(p.x) + "," + number(p.y) + "," + number(p.z);
}

/// Figures to three digits: nobody chooses between orientations by the fourth.
std::string rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return std::abs(value) >= 1000.0 ? grouped(std::llround(value)) : text;
}

std::string orientation_text(const mesh::PrintOrientation& o) {
  return "up " + rounded(o.up.x) + "," + rounded(o.up.y) + "," + rounded(o.up.z) + ": overhang " +
         rounded(o.overhang_mm2) + " mm2, supports " + rounded(o.support_mm3) + " mm3, scars " +
         rounded(o.scars_mm2) + " mm2, height " + rounded(o.height_mm) + " mm, contact " +
         rounded(o.contact_mm2) + " mm2, cost " + rounded(o.cost) + "\n";
}

std::string piece_text(const io::PreparedPiece& piece) {
  constexpr std::size_t kMostNamed = 5;
  std::string text = piece.name + ", " +
                     grouped(static_cast<std::int64_t>(piece.mesh.triangles.size())) +
                     " triangles\n" + verdict_text(piece.verdict);
  if (piece.filled_cavities > 0) {
    text += grouped(piece.filled_cavities) + " closed cavities filled, too small for a drain\n";
  }
  if (!piece.islands.empty()) {
    text += grouped(static_cast<std::int64_t>(piece.islands.size())) +
            " islands begin in mid-air and want supports, the lowest at\n";
  }
  for (std::size_t i = 0; i < std::min(kMostNamed, piece.islands.size()); ++i) {
    const mesh::PrintIsland& island = piece.islands[i];
    text += "  " + place_text(island.at_mm) + " mm, " + rounded(island.area_mm2) + " mm2\n";
  }
  for (std::size_t i = 0; i < std::min(kMostNamed, piece.pockets.size()); ++i) {
    const mesh::LiquidPocket& pocket = piece.pockets[i];
    text += std::string(pocket.closed ? "closed cavity" : "pocket") + " at " +
            place_text(pocket.lowest_mm) + " mm keeps " + rounded(pocket.volume_mm3) +
            " mm3 of liquid\n";
  }
  return text;
}

std::string prepare_text(const io::PrintPreparation& made) {
  std::string text;
  for (std::size_t i = 0; i < made.orientations.size(); ++i) {
    text += "orientation " + std::to_string(i + 1) + ", " + orientation_text(made.orientations[i]);
  }
  text += "chosen, " + orientation_text(made.chosen);
  if (made.cut_mm > 0.0) text += "cut off below " + rounded(made.cut_mm) + " mm for a flat base\n";
  if (made.wall_mm > 0.0) text += "hollow, with a wall of " + rounded(made.wall_mm) + " mm\n";
  for (const io::PrintHole& hole : made.holes) {
    text += std::string(hole.is_for_air ? "hole for air" : "drain") + " at " +
            place_text(hole.mouth_mm) + " mm\n";
  }
  if (made.plugs > 0) {
    text += grouped(made.plugs) + " plugs of " + number(2.0 * made.plug_radius_mm) +
            " mm across join the pieces\n";
  }
  if (made.joints_without_plug > 0) {
    text += grouped(made.joints_without_plug) + " cut faces are too small for a plug: glue them\n";
  }
  for (const io::PreparedPiece& piece : made.pieces) text += piece_text(piece);
  return text;
}

/// M.3mf for one piece, else M-1.3mf, ..., M-plugs.3mf.
std::filesystem::path file_of(const std::filesystem::path& output, const std::string& name) {
  if (name == "piece") return output;
  const std::string mark = name.rfind("piece ", 0) == 0 ? name.substr(6) : name;
  return output.parent_path() / (output.stem().string() + "-" + mark + output.extension().string());
}

Result<void> write_pieces(const PrepareCommand& command, const io::PrintPreparation& made,
                          Outcome& outcome, const Progress& progress) {
  for (std::size_t i = 0; i < made.pieces.size(); ++i) {
    const std::filesystem::path file = file_of(command.output, made.pieces[i].name);
    io::WriteOptions options;
    options.title = file.stem().string();
    if (auto written = io::write_mesh(file, made.pieces[i].mesh, options, progress); !written) {
      return written.error();
    }
    outcome.json["pieces"][i]["file"] = file.string();
    outcome.text += "saved '" + file.string() + "'\n";
  }
  return {};
}

Result<void> check_files(const PrepareCommand& command) {
  if (auto input = check_input(command.input); !input) return input;
  if (!command.printer.empty()) {
    if (auto input = check_input(command.printer); !input) return input;
  }
  if (auto output = check_output(command.output); !output) return output;
  if (command.pictures.empty()) return {};
  std::error_code error;
  std::filesystem::create_directories(command.pictures, error);
  if (std::filesystem::is_directory(command.pictures)) return {};
  return Error{ErrorKind::disk, "cannot make a folder for pictures at '" +
                                    command.pictures.string() + "'; choose another"};
}

Result<Outcome> run_prepare(const PrepareCommand& command, const Progress& progress) {
  const Stopwatch watch;
  if (auto files = check_files(command); !files) return files.error();
  io::PreparationOptions options = command.preparation;
  if (command.keeps_orientation) options.up = Vec3{0.0, 0.0, 1.0};
  if (!command.printer.empty()) {
    auto printer = io::read_printer(command.printer);
    if (!printer) return printer.error();
    options.printer = std::move(printer).value();
  }
  const auto read = read_clay(command, progress);
  if (!read) return read.error();
  const auto prepared = io::prepare_print(read.value().clay, options, progress);
  if (!prepared) return named(command.input, prepared.error());
  const io::PrintPreparation& made = prepared.value();
  Outcome outcome;
  outcome.json = prepare_json(made);
  outcome.text = prepare_text(made);
  // 1 as check has it: the files are there, and the answer is no.
  outcome.status = made.is_printable() ? 0 : 1;
  if (auto written = write_pieces(command, made, outcome, progress); !written) {
    return written.error();
  }
  outcome.json["pictures"] = Json::array();
  if (!command.pictures.empty()) {
    constexpr double kUsualOverhang = mesh::OrientationOptions{}.max_overhang_deg;
    const double most = options.printer.max_overhang_deg;
    const auto pictures = write_preparation_pictures(command.pictures, made,
                                                     most > 0.0 ? most : kUsualOverhang, progress);
    if (!pictures) return pictures.error();
    for (const auto& file : pictures.value()) {
      outcome.json["pictures"].push_back(file.string());
      outcome.text += "saved '" + file.string() + "'\n";
    }
  }
  outcome.json["recovered_strokes"] = read.value().recovered;
  outcome.json["seconds"] = watch.seconds();
  return outcome;
}

void add_orientation_options(CLI::App& command, const std::shared_ptr<PrepareCommand>& options) {
  CLI::Option* keep = command.add_flag("--keep-orientation", options->keeps_orientation,
                                       "z stays up; default: the cheapest orientation");
  command
      .add_option_function<std::string>(
          "--up",
          [options](const std::string& text) {
            options->preparation.up = parse_triple("--up", text);
          },
          "what shall be up")
      ->type_name("X,Y,Z")
      ->excludes(keep);
  command
      .add_option_function<std::string>(
          "--base", [options](const std::string& text) { read_base(text, options->preparation); },
          "auto (cut off as little as stands firmly), cut:MM, lay (roll onto a flat side), none")
      ->type_name("BASE");
}

}  // namespace

void add_prepare(CLI::App& app, Selected& selected) {
  auto options = std::make_shared<PrepareCommand>();
  io::PreparationOptions& preparation = options->preparation;
  CLI::App* command = add_command(
      app, selected, "prepare",
      "orient, flatten, hollow, cut to the bed and judge for a printer; status 1 if not printable",
      [options](const Progress& progress) { return run_prepare(*options, progress); });
  command->add_option("INPUT", options->input, "a project (NAME.vdb) or OBJ, STL, PLY, GLB, 3MF")
      ->required();
  add_piece_option(*command, options->piece);
  add_file(*command, "-o,--output", options->output, {".3mf", ".stl", ".obj", ".ply", ".glb"},
           "the mesh to write; of several pieces NAME-1, NAME-2, ..., NAME-plugs")
      ->required();
  command->add_option("--printer", options->printer, "a printer profile: what it takes")
      ->type_name("FILE.json");
  add_number(*command, "--size-mm", options->size_mm, kPositive,
             "scale a mesh so that its largest side is this");
  add_number(*command, "--voxel-mm", options->voxel_mm, {kLeastVoxelMm, kMostVoxelMm},
             "of the clay a mesh becomes; default: a 256th of its largest side");
  add_orientation_options(*command, options);
  add_number(*command, "--wall-mm", preparation.wall_mm, kPositive,
             "hollow it, leaving such a wall, with drains");
  add_number(*command, "--drain-radius-mm", preparation.drain_radius_mm, kPositive,
             "of drains and holes for air; default 1.5");
  command->add_flag("--fit", preparation.fits_bed,
                    "cut it into pieces that fit the printer's bed, with plugs to join them");
  add_number(*command, "--plug-tolerance-mm", preparation.plug_tolerance_mm, {0.0, 2.0},
             "air around a plug in its hole; default 0.15");
  add_number(*command, "--layer-mm", preparation.layer_mm, kPositive,
             "islands lower than a layer are none; default 0.2");
  command
      ->add_option_function<std::string>(
          "--pictures", [options](const std::string& text) { options->pictures = text; },
          "a folder for pictures of all that was found and done")
      ->type_name("FOLDER");
}

}  // namespace argil::cli
