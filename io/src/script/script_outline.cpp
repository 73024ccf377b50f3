// SPDX-License-Identifier: GPL-3.0-or-later
#include "script/script_outline.h"

#include <string>

namespace argil::io {
namespace {

constexpr const char* kOutlineName = "outline";

Result<PicturePoint> read_point(const Fields& fields, const Json& json) {
  const bool is_pair =
      json.is_array() && json.size() == 2 && json[0].is_number() && json[1].is_number();
  if (!is_pair) return fields.wrong("loops", "lists of points [x, y]");
  return PicturePoint{json[0].get<double>(), json[1].get<double>()};
}

Result<void> read_loops(const Fields& fields, MaskOutline& outline) {
  if (!fields.has("loops")) return fields.missing("loops", "give lists of points [x, y]");
  const Json& loops = fields.at("loops");
  if (!loops.is_array()) return fields.wrong("loops", "lists of points [x, y]");
  for (const Json& json : loops) {
    if (!json.is_array()) return fields.wrong("loops", "lists of points [x, y]");
    auto& loop = outline.loops.emplace_back();
    loop.reserve(json.size());
    for (const Json& each : json) {
      const auto point = read_point(fields, each);
      if (!point) return point.error();
      loop.push_back(point.value());
    }
  }
  return {};
}

}  // namespace

bool is_mask_outline(const Json& json) {
  const auto mask = json.find("mask");
  return mask != json.end() && mask->is_string() && *mask == kOutlineName;
}

Result<MaskOutline> read_mask_outline(const FileLine& where, const Json& json) {
  const Fields fields(where, json);
  MaskOutline outline;
  Placement view;
  auto read = fields.only(
      {"mask", "position_mm", "orientation", "parallel", "loops", "frees", "front_only"});
  if (read) read = read_placement(fields, view);
  if (read) read = fields.flag("parallel", outline.view.is_parallel);
  if (read) read = read_loops(fields, outline);
  if (read) read = fields.flag("frees", outline.frees);
  if (read) read = fields.flag("front_only", outline.front_only);
  if (!read) return read.error();
  outline.view.eye_mm = view.position_mm;
  outline.view.orientation = view.orientation;
  if (auto valid = validate_outline(outline); !valid) return where.error(valid.error().message);
  return outline;
}

OrderedJson mask_outline_json(const MaskOutline& outline) {
  OrderedJson json;
  json["mask"] = kOutlineName;
  put_placement(json, {outline.view.eye_mm, outline.view.orientation});
  if (outline.view.is_parallel) json["parallel"] = true;
  json["loops"] = OrderedJson::array();
  for (const auto& loop : outline.loops) {
    OrderedJson points = OrderedJson::array();
    for (const PicturePoint& p : loop) points.push_back({p[0], p[1]});
    json["loops"].push_back(std::move(points));
  }
  if (outline.frees) json["frees"] = true;
  if (outline.front_only) json["front_only"] = true;
  return json;
}

}  // namespace argil::io
