// SPDX-License-Identifier: GPL-3.0-or-later
#include "script/script_filter.h"

#include <cmath>

namespace argil::io {
namespace {

constexpr std::string_view kGrowName = "grow";
constexpr std::string_view kShrinkName = "shrink";
constexpr std::string_view kCavityName = "cavity";

/// A distance is positive there: which way it goes is in the name.
Result<MaskFilter> read_grow(const Fields& fields, bool shrinks) {
  if (auto known = fields.only({"mask", "by_mm"}); !known) return known.error();
  if (!fields.has("by_mm")) return fields.missing("by_mm", "give the distance in mm");
  double by_mm = 0.0;
  if (auto read = fields.positive("by_mm", by_mm); !read) return read.error();
  return MaskFilter(MaskGrow{shrinks ? -by_mm : by_mm});
}

Result<MaskFilter> read_cavity(const Fields& fields) {
  if (auto known = fields.only({"mask", "radius_mm", "factor", "inverted"}); !known) {
    return known.error();
  }
  if (!fields.has("radius_mm")) {
    return fields.missing("radius_mm", "give the size of what is found, in mm");
  }
  MaskCavity cavity;
  auto read = fields.positive("radius_mm", cavity.radius_mm);
  if (read) read = fields.number("factor", cavity.factor);
  if (read) read = fields.flag("inverted", cavity.is_inverted);
  if (!read) return read.error();
  return MaskFilter(cavity);
}

OrderedJson filter_json(const MaskGrow& grow) {
  OrderedJson json;
  json["mask"] = grow.by_mm < 0.0 ? kShrinkName : kGrowName;
  json["by_mm"] = std::abs(grow.by_mm);
  return json;
}

OrderedJson filter_json(const MaskCavity& cavity) {
  OrderedJson json;
  json["mask"] = kCavityName;
  json["radius_mm"] = cavity.radius_mm;
  json["factor"] = cavity.factor;
  if (cavity.is_inverted) json["inverted"] = true;
  return json;
}

}  // namespace

bool is_mask_filter(const Json& json) {
  const auto mask = json.find("mask");
  return mask != json.end() && (*mask == kGrowName || *mask == kShrinkName || *mask == kCavityName);
}

Result<MaskFilter> read_mask_filter(const FileLine& where, const Json& json) {
  const Fields fields(where, json);
  const bool is_cavity = fields.at("mask") == kCavityName;
  auto filter =
      is_cavity ? read_cavity(fields) : read_grow(fields, fields.at("mask") == kShrinkName);
  if (!filter) return filter;
  if (auto valid = validate_filter(filter.value()); !valid) {
    return where.error(valid.error().message);
  }
  return filter;
}

OrderedJson mask_filter_json(const MaskFilter& filter) {
  return std::visit([](const auto& chosen) { return filter_json(chosen); }, filter);
}

}  // namespace argil::io
