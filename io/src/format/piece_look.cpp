// SPDX-License-Identifier: GPL-3.0-or-later
// How a piece looks, as keys of a JSON object.
#include "format/piece_look.h"

#include <array>
#include <charconv>
#include <cstdio>
#include <system_error>

namespace argil::io {
namespace {

Result<void> read_color(const Fields& fields, std::optional<Rgb8>& out) {
  constexpr const char* kMust = "\"#rrggbb\", or null for none";
  if (!fields.has("color")) return {};
  const Json& value = fields.at("color");
  out.reset();
  if (value.is_null()) return {};
  if (!value.is_string()) return fields.wrong("color", kMust);
  const auto& text = value.get_ref<const std::string&>();
  if (text.size() != 7 || text[0] != '#') return fields.wrong("color", kMust);
  Rgb8 color{};
  for (std::size_t n = 0; n < color.size(); ++n) {
    const char* at = text.data() + 1 + 2 * n;
    const auto [end, error] = std::from_chars(at, at + 2, color[n], 16);
    if (error != std::errc() || end != at + 2) return fields.wrong("color", kMust);
  }
  out = color;
  return {};
}

}  // namespace

Result<void> read_placement(const Fields& fields, Placement& out) {
  if (auto read = fields.triple("position_mm", out.position_mm); !read) return read;
  constexpr const char* kMust = "a quaternion [w, x, y, z] of any length but zero";
  if (!fields.has("orientation")) return {};
  const Json& value = fields.at("orientation");
  if (!value.is_array() || value.size() != 4) return fields.wrong("orientation", kMust);
  for (const Json& n : value) {
    if (!n.is_number()) return fields.wrong("orientation", kMust);
  }
  out.orientation = {value[0].get<double>(), value[1].get<double>(), value[2].get<double>(),
                     value[3].get<double>()};
  if (out.orientation == Quat{0.0, 0.0, 0.0, 0.0}) return fields.wrong("orientation", kMust);
  return {};
}

void put_placement(OrderedJson& json, const Placement& placement) {
  const Vec3& at = placement.position_mm;
  const Quat& q = placement.orientation;
  json["position_mm"] = {at.x, at.y, at.z};
  json["orientation"] = {q.w, q.x, q.y, q.z};
}

std::string color_text(const Rgb8& color) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", color[0], color[1], color[2]);
  return text.data();
}

void put_look(OrderedJson& json, const PieceLook& look) {
  const PieceLook usual;
  const Placement& at = look.placement;
  if (at.position_mm != Vec3{} || at.orientation != Quat{}) put_placement(json, at);
  if (look.is_visible != usual.is_visible) json["visible"] = look.is_visible;
  if (look.is_locked != usual.is_locked) json["locked"] = look.is_locked;
  if (look.color) json["color"] = color_text(*look.color);
}

Result<void> read_look(const Fields& fields, PieceLook& out) {
  Result<void> read = read_placement(fields, out.placement);
  if (read) read = fields.flag("visible", out.is_visible);
  if (read) read = fields.flag("locked", out.is_locked);
  if (read) read = read_color(fields, out.color);
  return read;
}

}  // namespace argil::io
