// SPDX-License-Identifier: GPL-3.0-or-later
#include "arena/slice/slice.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include <nlohmann/json.hpp>

#include "argil/io/mesh_file.h"

#include "arena/child.h"
#include "arena/slice/gcode.h"
#include "arena/slice/raster.h"
#include "support/built.h"
#include "support/scratch.h"

namespace argil::arena {
namespace {

constexpr double kPatienceOfSlicerS = 60.0;
constexpr double kLayerMm = 0.2;
constexpr double kCellMm = 0.05;
constexpr double kEdgeMm = 0.01;
/// Beads are round at their ends, and corners of a section are not.
constexpr double kRoundMm = 0.1;
/// A section that is smaller is the end of a tip.
constexpr double kTipMm2 = 0.02;
/// The least region of a section that is missed.
constexpr double kRegionMm2 = 0.16;

void ask_argil(SliceRow& row, const std::filesystem::path& folder,
               const std::filesystem::path& mesh) {
  const std::filesystem::path printer =
      std::filesystem::path(test::source_folder()) / "printers/filament.json";
  const ChildEnd end = run_child(
      folder,
      {test::argil_program(), "check", "--json", "--printer", printer.string(), mesh.string()},
      kPatienceOfSlicerS);
  const auto json = nlohmann::json::parse(end.out, nullptr, false);
  if (!json.is_object()) return;
  row.printable = json.value("printable", false);
  const auto least = [&](const char* key) {
    return json.contains(key) && json[key].is_number() ? json[key].get<double>() : -1.0;
  };
  row.min_wall_mm = least("min_wall_mm");
  row.min_gap_mm = least("min_gap_mm");
  for (const auto& problem : json["problems"]) {
    row.says_thin |= problem["kind"] == "thin_wall";
    row.says_gap |= problem["kind"] == "narrow_gap";
  }
}

std::size_t cells_of(double mm2) {
  return static_cast<std::size_t>(std::ceil(mm2 / (kCellMm * kCellMm)));
}

void compare_layer(SliceRow& row, const Raster& section, const PrintedLayer* printed,
                   const Raster& empty, const Vec3& by) {
  ++row.layers;
  if (printed == nullptr) {
    ++row.empty;
    return;
  }
  Raster laid = empty;
  laid.add_beads(*printed, 0.0, by);
  Raster reached = empty;
  reached.add_beads(*printed, kRoundMm, by);
  if (!section.without(reached).regions(cells_of(kRegionMm2)).empty()) ++row.lost_walls;
  if (2 * laid.count() > 3 * section.count()) ++row.fat_walls;
  const std::size_t least = cells_of(kRegionMm2);
  if (laid.regions(least).size() < section.regions(least).size()) ++row.closed_gaps;
}

/// Layers by the height of their upper side, which the slicer says to the micrometre.
const PrintedLayer* layer_at(const std::vector<PrintedLayer>& layers, double z_mm) {
  for (const PrintedLayer& layer : layers) {
    if (std::abs(layer.z_mm - z_mm) < 0.25 * kLayerMm) return &layer;
  }
  return nullptr;
}

/// Whether something within the height of layer `i` is in no layer near it: a floor that lies
/// between the middles of layers, where the slicer looks.
bool is_floor_lost(const TriangleMesh& mesh, double bottom, int i,
                   const std::vector<PrintedLayer>& printed, const Raster& empty, const Vec3& by) {
  Raster solid = empty;
  for (const double part : {0.1, 0.3, 0.7, 0.9}) {
    solid.add_section(mesh, bottom + (i + part) * kLayerMm);
  }
  Raster reached = empty;
  for (const int near : {i, i + 1, i + 2}) {
    const PrintedLayer* layer = layer_at(printed, near * kLayerMm);
    if (layer != nullptr) reached.add_beads(*layer, kRoundMm, by);
  }
  return !solid.without(reached).regions(cells_of(kRegionMm2)).empty();
}

void ask_slicer(SliceRow& row, const std::filesystem::path& folder,
                const std::filesystem::path& file, const TriangleMesh& mesh) {
  const std::filesystem::path gcode = folder / "piece.gcode";
  const ChildEnd end = run_child(folder,
                                 {"prusa-slicer",
                                  "--loglevel",
                                  "1",
                                  "--nozzle-diameter",
                                  "0.4",
                                  "--layer-height",
                                  "0.2",
                                  "--first-layer-height",
                                  "0.2",
                                  "--fill-density",
                                  "100%",
                                  "--fill-pattern",
                                  "rectilinear",
                                  "--skirts",
                                  "0",
                                  "--brim-width",
                                  "0",
                                  "--elefant-foot-compensation",
                                  "0",
                                  "--center",
                                  "100,100",
                                  "--export-gcode",
                                  "-o",
                                  gcode.string(),
                                  file.string()},
                                 kPatienceOfSlicerS);
  const std::vector<PrintedLayer> printed = printed_layers(test::content_of(gcode));
  const Box3 box = bounds(mesh);
  const Raster empty(box, kCellMm);
  const Vec3 by = Vec3{box.center().x - 100.0, box.center().y - 100.0, 0.0};
  const auto count = static_cast<int>(std::ceil(box.size().z / kLayerMm - 1e-6));
  for (int i = 0; i < count; ++i) {
    if (is_floor_lost(mesh, box.min.z, i, printed, empty, by)) ++row.lost_floors;
    const double middle = (i + 0.5) * kLayerMm;
    if (middle > box.size().z - kEdgeMm) continue;  // not half of a layer is left
    Raster section = empty;
    section.add_section(mesh, box.min.z + middle);
    if (section.regions(cells_of(kTipMm2)).empty()) continue;
    compare_layer(row, section, layer_at(printed, (i + 1) * kLayerMm), empty, by);
  }
  row.has_gcode = !printed.empty();
}

std::string listed(const std::vector<SliceRow>& rows, const char* title,
                   const std::function<bool(const SliceRow&)>& is_in) {
  std::string text;
  std::size_t count = 0;
  for (const SliceRow& row : rows) {
    if (!is_in(row)) continue;
    text += " " + row.piece;
    ++count;
  }
  return std::string(title) + ": " + std::to_string(count) + text + "\n";
}

template <class... Values>
std::string row_text(const char* format, Values... values) {
  char line[320];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

}  // namespace

std::vector<SliceRow> compare_with_slicer(const std::vector<PrintPiece>& pieces) {
  std::vector<SliceRow> rows;
  for (const PrintPiece& piece : pieces) {
    const test::ScratchFolder folder;
    const std::filesystem::path file = folder / (piece.name + ".stl");
    SliceRow row;
    row.piece = piece.name;
    if (!io::write_mesh(file, piece.mesh)) continue;
    ask_argil(row, folder.path(), file);
    ask_slicer(row, folder.path(), file, piece.mesh);
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string slice_csv(const std::vector<SliceRow>& rows) {
  std::string text =
      "piece,printable,min_wall_mm,min_gap_mm,says_thin,says_gap,layers,empty,lost_walls,"
      "lost_floors,fat_walls,closed_gaps,has_gcode\n";
  for (const SliceRow& r : rows) {
    text +=
        r.piece + row_text(",%d,%.3f,%.3f,%d,%d,%zu,%zu,%zu,%zu,%zu,%zu,%d\n", r.printable,
                           r.min_wall_mm, r.min_gap_mm, r.says_thin, r.says_gap, r.layers, r.empty,
                           r.lost_walls, r.lost_floors, r.fat_walls, r.closed_gaps, r.has_gcode);
  }
  return text;
}

std::string slice_table(const std::vector<SliceRow>& rows) {
  std::string text =
      row_text("%-16s %9s %9s %5s %5s | %6s %6s %6s %6s %6s %6s\n", "piece", "wall mm", "gap mm",
               "thin", "gap", "layers", "empty", "lost", "floors", "fat", "closed");
  for (const SliceRow& r : rows) {
    text += row_text("%-16s %9.3f %9.3f %5s %5s | %6zu %6zu %6zu %6zu %6zu %6zu%s\n",
                     r.piece.c_str(), r.min_wall_mm, r.min_gap_mm, r.says_thin ? "thin" : "",
                     r.says_gap ? "gap" : "", r.layers, r.empty, r.lost_walls, r.lost_floors,
                     r.fat_walls, r.closed_gaps, r.has_gcode ? "" : " nothing to print");
  }
  text += listed(rows, "both find lost walls or layers",
                 [](const SliceRow& r) { return r.is_lost() && r.says_thin; });
  text += listed(rows, "the slicer loses some, argil says nothing",
                 [](const SliceRow& r) { return r.is_lost() && !r.says_thin; });
  text += listed(rows, "argil says thin, the slicer prints it much wider",
                 [](const SliceRow& r) { return !r.is_lost() && r.says_thin && r.fat_walls > 0; });
  text += listed(rows, "argil says thin, the slicer prints it",
                 [](const SliceRow& r) { return !r.is_lost() && r.says_thin && r.fat_walls == 0; });
  text += listed(rows, "both close a gap",
                 [](const SliceRow& r) { return r.closed_gaps > 0 && r.says_gap; });
  text += listed(rows, "the slicer closes a gap, argil says nothing",
                 [](const SliceRow& r) { return r.closed_gaps > 0 && !r.says_gap; });
  text += listed(rows, "argil says gap, the slicer keeps it",
                 [](const SliceRow& r) { return r.closed_gaps == 0 && r.says_gap; });
  return text;
}

}  // namespace argil::arena
