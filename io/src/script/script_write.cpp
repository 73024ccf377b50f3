// SPDX-License-Identifier: GPL-3.0-or-later
// Writing of one line of a stroke script or journal.
#include <cassert>
#include <cmath>

#include "argil/core/hash_text.h"

#include "format/json_fields.h"
#include "script/script_filter.h"
#include "script/script_line.h"
#include "script/script_operation.h"
#include "script/script_outline.h"
#include "script/script_piece.h"

namespace argil::io {
namespace {

OrderedJson start_json(const StartShape& start) {
  OrderedJson json;
  if (start.kind == StartShape::Kind::ball) {
    json["shape"] = "ball";
    json["radius_mm"] = start.size_mm.x;
  } else {
    json["shape"] = "block";
    json["size_mm"] = {start.size_mm.x, start.size_mm.y, start.size_mm.z};
  }
  json["voxel_mm"] = start.options.voxel_mm;
  json["tolerance_voxels"] = start.options.tolerance_voxels;
  if (start.options.edge_radius_mm) json["edge_radius_mm"] = *start.options.edge_radius_mm;
  return json;
}

OrderedJson pose_json(const StrokeSample& sample) {
  const Vec3& p = sample.position_mm;
  const Quat& q = sample.orientation;
  // A zero's sign would be lost with the short form, so bits decide, not values.
  const bool plain = q == Quat{} && !std::signbit(q.x) && !std::signbit(q.y) &&
                     !std::signbit(q.z) && sample.pressure == 1.0;
  if (plain) return {sample.time_s, p.x, p.y, p.z};
  return {sample.time_s, p.x, p.y, p.z, q.w, q.x, q.y, q.z, sample.pressure};
}

/// What has its usual value is left out: lines stay short.
template <class T>
void put_unless(OrderedJson& json, const char* key, T value, T usual) {
  if (value != usual) json[key] = value;
}

void put_options(OrderedJson& json, const Tool& tool) {
  const Tool usual;
  if (tool.falloff != usual.falloff)
    json["falloff"] = kFalloffNames.at(static_cast<std::size_t>(tool.falloff));
  put_unless(json, "plane_offset", tool.plane_offset, usual.plane_offset);
  put_unless(json, "tip_roundness", tool.tip_roundness, usual.tip_roundness);
  put_unless(json, "volume_preservation", tool.volume_preservation, usual.volume_preservation);
  put_unless(json, "crease_pinch_factor", tool.crease_pinch_factor, usual.crease_pinch_factor);
  put_unless(json, "wavelength_mm", tool.wavelength_mm, usual.wavelength_mm);
  put_unless(json, "seed", tool.seed, usual.seed);
  if (tool.alpha_mode != usual.alpha_mode) {
    json["alpha_mode"] = kAlphaModeNames.at(static_cast<std::size_t>(tool.alpha_mode));
  }
  put_unless(json, "amplitude_mm", tool.amplitude_mm, usual.amplitude_mm);
  put_unless(json, "mid_level", tool.mid_level, usual.mid_level);
  put_unless(json, "angle_deg", tool.angle_deg, usual.angle_deg);
  put_unless(json, "use_rake", tool.use_rake, usual.use_rake);
  put_unless(json, "tile_mm", tool.tile_mm, usual.tile_mm);
}

OrderedJson step_json(const Stroke& stroke, const SolidName& solid) {
  OrderedJson json;
  json["tool"] = kActionNames.at(static_cast<std::size_t>(stroke.tool.action));
  const Vec3& r = stroke.tool.radii_mm;
  json["shape"] = kShapeNames.at(static_cast<std::size_t>(stroke.tool.shape));
  if (stroke.tool.shape == Shape::mesh) {
    json["mesh"] = solid.file;
    if (!solid.hash.empty()) json["mesh_xxh64"] = solid.hash;
  }
  if (stroke.tool.alpha != nullptr) {
    json["alpha"] = solid.file;
    if (!solid.hash.empty()) json["alpha_xxh64"] = solid.hash;
  }
  if (stroke.tool.shape == Shape::ball) {
    json["radius_mm"] = r.x;
  } else {
    json["radii_mm"] = {r.x, r.y, r.z};
  }
  json["strength"] = stroke.tool.strength;
  put_unless(json, "pressure_to_strength", stroke.tool.pressure_to_strength, 1.0);
  put_unless(json, "pressure_to_size", stroke.tool.pressure_to_size, 0.0);
  put_unless(json, "sharpness", stroke.tool.sharpness, 1.0);
  put_unless(json, "width", stroke.tool.width, 0.6);
  put_options(json, stroke.tool);
  std::string planes;
  if (stroke.mirror.x) planes += 'x';
  if (stroke.mirror.y) planes += 'y';
  if (stroke.mirror.z) planes += 'z';
  json["symmetry"] = planes;
  put_unless(json, "radial_symmetry", stroke.radial.count, 1);
  if (stroke.radial.count != 1) json["radial_axis"] = kAxisNames.at(stroke.radial.axis);
  json["spacing"] = stroke.spacing;
  put_unless(json, "steady_mm", stroke.steady_mm, 0.0);
  put_unless(json, "hold_s", stroke.hold_s, 0.0);
  if (stroke.has_dots) json["dots"] = true;
  json["poses"] = OrderedJson::array();
  for (const StrokeSample& sample : stroke.samples) json["poses"].push_back(pose_json(sample));
  return json;
}

OrderedJson step_json(HistoryStep step, const SolidName&) {
  OrderedJson json;
  json["history"] = kHistoryNames.at(static_cast<std::size_t>(step));
  return json;
}

OrderedJson step_json(MaskEdit edit, const SolidName&) {
  OrderedJson json;
  json["mask"] = kMaskNames.at(static_cast<std::size_t>(edit));
  return json;
}

OrderedJson step_json(const MaskFilter& filter, const SolidName&) {
  return mask_filter_json(filter);
}

OrderedJson step_json(const MaskOutline& outline, const SolidName&) {
  return mask_outline_json(outline);
}

OrderedJson step_json(const Operation& operation, const SolidName& solid) {
  return operation_json(operation, solid);
}

OrderedJson step_json(const PieceEdit& edit, const SolidName& solid) {
  return piece_edit_json(edit, solid);
}

}  // namespace

std::string header_line(const ScriptHeader& header) {
  OrderedJson json;
  json["argil_strokes"] = kScriptVersion;
  json["units"] = "mm";
  if (header.start) json["start"] = start_json(*header.start);
  if (!header.base_hash.empty()) json["base_hash"] = header.base_hash;
  if (header.keeps_history) json["keeps_history"] = true;
  return json.dump();
}

std::string step_line(const ScriptStep& step, const SolidName& solid) {
  return std::visit([&](const auto& chosen) { return step_json(chosen, solid).dump(); }, step);
}

std::string mark_line(const HashMark& mark) {
  OrderedJson json;
  json["hash"] = mark.hash;
  json["after"] = mark.after;
  if (mark.is_closing) json["closed"] = true;
  return json.dump();
}

/// The hash is of the line as it came: a reader takes the seal off and hashes what is left.
std::string sealed_line(std::string line) {
  assert(line.size() > 2 && line.front() == '{' && line.back() == '}');
  const std::string hash = hash_text(hash_of_text(line));
  line.pop_back();
  return line.append(kLineSealKey).append(hash).append("\"}");
}

}  // namespace argil::io
