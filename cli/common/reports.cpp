// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/reports.h"

#include <cstdint>
#include <vector>

#include "argil/mesh/certificate.h"

#include "common/output.h"

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

Json distance_json(const mesh::DistanceSummary& distance) {
  return {{"max_mm", distance.max_mm},
          {"mean_mm", distance.mean_mm},
          {"rms_mm", distance.rms_mm},
          {"samples", distance.samples}};
}

Json certificate_json(const mesh::Certificate& certificate) {
  // 0 stands for not asked.
  const auto or_null = [](auto asked) { return asked > 0 ? Json(asked) : Json(); };
  Json json;
  json["units"] = "mm";
  json["mesh_to_field"] = distance_json(certificate.error.mesh_to_field);
  json["field_to_mesh"] = distance_json(certificate.error.field_to_mesh);
  json["volume_change"] = certificate.volume_change;
  json["triangles"] = certificate.triangles;
  json["surface_triangles"] = certificate.surface_triangles;
  json["voxel_mm"] = certificate.voxel_mm;
  json["tolerance_voxels"] = certificate.tolerance_voxels;
  json["proven_max_mm"] = or_null(certificate.proven_max_mm);
  json["asked_max_error_mm"] = or_null(certificate.asked_max_error_mm);
  json["asked_triangles"] = or_null(certificate.asked_triangles);
  json["clay_hash"] = hex(certificate.clay_hash);
  return json;
}

const char* path_name(io::RepairPath path) {
  if (path == io::RepairPath::nothing) return "nothing";
  return path == io::RepairPath::local ? "local" : "field";
}

Json changes_json(const io::RepairReport& report) {
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

}  // namespace

Json clay_json(const Clay& clay, const TriangleMesh& surface) {
  const std::vector<LevelStats> levels = clay.level_stats();
  Json json;
  json["levels"] = to_json(levels);
  json["bbox_mm"] = bbox_json(bounds(surface));
  json["volume_mm3"] = signed_volume(surface);
  json["area_mm2"] = surface_area(surface);
  json["hash"] = hex(clay.hash());
  json["bytes"] = total_bytes(levels);
  json["triangles"] = surface.triangles.size();
  json["tolerance_voxels"] = clay.options().tolerance_voxels;
  const auto& edge = clay.options().edge_radius_mm;
  json["edge_radius_mm"] = edge ? Json(*edge) : Json(nullptr);
  return json;
}

Json export_json(const io::ExportReport& report, double seconds) {
  Json json;
  json["triangles"] = report.triangles;
  json["max_error_mm"] = report.max_error_mm;
  json["rms_error_mm"] = report.rms_error_mm;
  json["volume_change"] = report.volume_change;
  json["parts"] = report.parts;
  json["removed_crumbs"] = report.removed_components;
  json["certificate"] = certificate_json(report.certificate);
  json.update(to_json(report.verdict));
  json["seconds"] = seconds;
  return json;
}

Json repair_json(const io::RepairReport& report, std::size_t triangles) {
  Json json = changes_json(report);
  json.update(to_json(report.verdict));
  json["triangles"] = triangles;
  return json;
}

}  // namespace argil::cli
