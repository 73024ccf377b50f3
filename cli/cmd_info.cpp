// SPDX-License-Identifier: GPL-3.0-or-later
// argil info: what is in a project.
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "argil/engine/surface.h"

#include "commands.h"
#include "common/output.h"
#include "common/project.h"
#include "common/reports.h"

namespace argil::cli {
namespace {

std::string color_text(const Rgb8& color) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", color[0], color[1], color[2]);
  return text.data();
}

Json placement_json(const Placement& placement) {
  const Quat& q = placement.orientation;
  return {{"position_mm", to_json(placement.position_mm)},
          {"orientation", Json::array({q.w, q.x, q.y, q.z})}};
}

std::string clay_text(const Clay& clay, const TriangleMesh& surface) {
  const Vec3 size = bounds(surface).size();
  return levels_text(clay.level_stats()) + "size " + number(size.x) + " x " + number(size.y) +
         " x " + number(size.z) + " mm, volume " + number(signed_volume(surface)) + " mm3, area " +
         number(surface_area(surface)) + " mm2\n";
}

std::string look_text(const PieceLook& look, bool is_active) {
  const Vec3& at = look.placement.position_mm;
  std::string text = "piece '" + look.name + "' at " + number(at.x) + "," + number(at.y) + "," +
                     number(at.z) + " mm";
  if (is_active) text += ", active";
  if (!look.is_visible) text += ", hidden";
  if (look.is_locked) text += ", locked";
  return text + "\n";
}

Json look_json(const PieceLook& look) {
  Json json = placement_json(look.placement);
  json["name"] = look.name;
  json["visible"] = look.is_visible;
  json["locked"] = look.is_locked;
  json["color"] = look.color ? Json(color_text(*look.color)) : Json(nullptr);
  return json;
}

/// Keys of a clay alone stand at the top, as they always did; several pieces are a list.
Result<Outcome> run_info(const std::string& project, const Progress& progress) {
  const auto opened = open_project(project, progress);
  if (!opened) return opened.error();
  const Sculpture& sculpture = opened.value().sculpture;
  Outcome outcome;
  outcome.json["pieces"] = Json::array();
  for (std::size_t n = 0; n < sculpture.piece_count(); ++n) {
    const Clay& clay = sculpture.clay(n);
    const auto surface = extract_surface(clay, progress);
    if (!surface) return surface.error();
    Json piece = clay_json(clay, surface.value());
    if (sculpture.piece_count() == 1) outcome.json.update(piece);
    piece.update(look_json(sculpture.look(n)));
    outcome.json["pieces"].push_back(std::move(piece));
    if (!sculpture.is_plain()) {
      outcome.text += look_text(sculpture.look(n), n == sculpture.active());
    }
    outcome.text += clay_text(clay, surface.value());
  }
  const std::string hash = hex(sculpture.hash());
  outcome.json["active"] = sculpture.look(sculpture.active()).name;
  outcome.json["hash"] = hash;
  // Of the project alone, without its journal.
  outcome.json["file_bytes"] = std::filesystem::file_size(project);
  outcome.json["recovered_strokes"] = opened.value().recovered_steps;
  const io::HistorySize& history = opened.value().history;
  outcome.json["history"] = {{"steps", history.steps}, {"bytes", history.bytes}};
  if (history.steps > 0) {
    outcome.text += "history " + std::to_string(history.steps) +
                    (history.steps == 1 ? " step, " : " steps, ") +
                    number(1e-6 * static_cast<double>(history.bytes)) + " MB\n";
  }
  outcome.text += "hash " + hash + "\n";
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
