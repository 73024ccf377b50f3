// SPDX-License-Identifier: GPL-3.0-or-later
// argil info: what is in a project.
#include <filesystem>
#include <memory>

#include "argil/engine/surface.h"

#include "commands.h"
#include "common/output.h"
#include "common/project.h"

namespace argil::cli {
namespace {

std::int64_t total_bytes(const std::vector<LevelStats>& levels) {
  std::int64_t bytes = 0;
  for (const LevelStats& level : levels) bytes += level.bytes;
  return bytes;
}

Json bbox_json(const Box3& box) {
  if (box.empty()) return Json();
  return Json::array({to_json(box.min), to_json(box.max)});
}

std::string info_text(const Clay& clay, const TriangleMesh& surface, const std::string& hash) {
  const Vec3 size = bounds(surface).size();
  return levels_text(clay.level_stats()) + "size " + number(size.x) + " x " + number(size.y) +
         " x " + number(size.z) + " mm, volume " + number(signed_volume(surface)) + " mm3, area " +
         number(surface_area(surface)) + " mm2\nhash " + hash + "\n";
}

Result<Outcome> run_info(const std::string& project, const Progress& progress) {
  const auto opened = open_project(project, progress);
  if (!opened) return opened.error();
  const Clay& clay = opened.value().clay;
  const TriangleMesh surface = extract_surface(clay);
  const std::vector<LevelStats> levels = clay.level_stats();
  const std::string hash = hex(clay.hash());
  Outcome outcome;
  outcome.json["levels"] = to_json(levels);
  outcome.json["bbox_mm"] = bbox_json(bounds(surface));
  outcome.json["volume_mm3"] = signed_volume(surface);
  outcome.json["area_mm2"] = surface_area(surface);
  outcome.json["hash"] = hash;
  outcome.json["bytes"] = total_bytes(levels);
  // Of the project alone, without its journal.
  outcome.json["file_bytes"] = std::filesystem::file_size(project);
  outcome.json["triangles"] = surface.triangles.size();
  outcome.json["tolerance_voxels"] = clay.options().tolerance_voxels;
  const auto& edge = clay.options().edge_radius_mm;
  outcome.json["edge_radius_mm"] = edge ? Json(*edge) : Json(nullptr);
  outcome.json["recovered_strokes"] = opened.value().recovered_steps;
  outcome.text = info_text(clay, surface, hash);
  return outcome;
}

}  // namespace

void add_info(CLI::App& app, Selected& selected) {
  auto project = std::make_shared<std::string>();
  CLI::App* command =
      add_command(app, selected, "info", "say what is in a project",
                  [project](const Progress& progress) { return run_info(*project, progress); });
  command->add_option("PROJECT", *project, "a project (NAME.vdb)")->required();
}

}  // namespace argil::cli
