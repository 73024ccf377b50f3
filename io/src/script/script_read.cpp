// SPDX-License-Identifier: GPL-3.0-or-later
// Reading of one line of a stroke script or journal.
#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <limits>

#include "argil/core/hash_text.h"

#include "format/json_fields.h"
#include "script/script_filter.h"
#include "script/script_line.h"
#include "script/script_operation.h"
#include "script/script_outline.h"
#include "script/script_piece.h"

namespace argil::io {
namespace {

Result<StartShape> read_start(const FileLine& where, const Json& json) {
  if (!json.is_object()) return where.key_error("start", "is " + shown(json) + "; must be {...}");
  const Fields fields(where, json, "start.");
  const auto shape = fields.choice("shape", {"ball", "block"});
  if (!shape) return shape.error();
  StartShape start;
  Result<void> read;
  if (shape.value() == 0) {
    read = fields.only({"shape", "radius_mm", "voxel_mm", "tolerance_voxels", "edge_radius_mm"});
    if (read && !fields.has("radius_mm"))
      read = fields.missing("radius_mm", "give the ball's radius");
    if (read) read = fields.positive("radius_mm", start.size_mm.x);
  } else {
    start.kind = StartShape::Kind::block;
    read = fields.only({"shape", "size_mm", "voxel_mm", "tolerance_voxels", "edge_radius_mm"});
    if (read && !fields.has("size_mm")) read = fields.missing("size_mm", "give the three sides");
    if (read) read = fields.positive_triple("size_mm", start.size_mm);
  }
  if (read) read = fields.positive("voxel_mm", start.options.voxel_mm);
  if (read) read = fields.positive("tolerance_voxels", start.options.tolerance_voxels);
  if (read && fields.has("edge_radius_mm")) {
    start.options.edge_radius_mm = 0.0;
    read = fields.number("edge_radius_mm", *start.options.edge_radius_mm);
  }
  if (!read) return read.error();
  return start;
}

Result<ScriptHeader> header_of(const FileLine& where, const Json& json) {
  const Fields fields(where, json);
  if (!fields.has("argil_strokes")) {
    return fields.missing("argil_strokes",
                          "the first line must be a header {\"argil_strokes\":1,...}");
  }
  if (fields.at("argil_strokes") != kScriptVersion) {
    return fields.wrong("argil_strokes", "1, the only version this program reads");
  }
  if (auto known = fields.only({"argil_strokes", "units", "start", "base_hash", "keeps_history"});
      !known) {
    return known.error();
  }
  if (fields.has("units") && fields.at("units") != "mm") return fields.wrong("units", "\"mm\"");
  ScriptHeader header;
  if (fields.has("base_hash")) {
    auto hash = fields.hash("base_hash");
    if (!hash) return hash.error();
    header.base_hash = std::move(hash).value();
  }
  if (fields.has("keeps_history")) {
    if (fields.at("keeps_history") != true) return fields.wrong("keeps_history", "true or absent");
    header.keeps_history = true;
  }
  if (!fields.has("start")) return header;
  auto start = read_start(where, fields.at("start"));
  if (!start) return start.error();
  header.start = start.value();
  return header;
}

/// A ball has one radius, every other shape three half extents. Both at once are refused: one of
/// them would be ignored in silence.
Result<void> read_radii(const Fields& fields, Tool& tool) {
  if (fields.has("radius_mm") && fields.has("radii_mm")) {
    return fields.wrong("radii_mm", "absent when 'radius_mm' is given");
  }
  if (tool.shape != Shape::ball) {
    if (!fields.has("radii_mm")) return fields.missing("radii_mm", "give three half extents in mm");
    return fields.positive_triple("radii_mm", tool.radii_mm);
  }
  if (!fields.has("radius_mm")) return fields.missing("radius_mm", "give the ball's radius in mm");
  auto read = fields.positive("radius_mm", tool.radii_mm.x);
  tool.radii_mm = {tool.radii_mm.x, tool.radii_mm.x, tool.radii_mm.x};
  return read;
}

Result<void> read_mirror(const Fields& fields, Mirror& mirror) {
  constexpr const char* kMust = "a string of x, y and z, each at most once";
  if (!fields.has("symmetry")) return {};
  if (!fields.at("symmetry").is_string()) return fields.wrong("symmetry", kMust);
  for (const char letter : fields.at("symmetry").get_ref<const std::string&>()) {
    bool* plane = letter == 'x'   ? &mirror.x
                  : letter == 'y' ? &mirror.y
                  : letter == 'z' ? &mirror.z
                                  : nullptr;
    if (plane == nullptr || *plane) return fields.wrong("symmetry", kMust);
    *plane = true;
  }
  return {};
}

/// [t, x, y, z] or [t, x, y, z, qw, qx, qy, qz, pressure].
Result<StrokeSample> read_pose(const FileLine& where, const std::string& name, const Json& pose) {
  // Without orientation and pressure, as a mouse or a hand-written script has none.
  constexpr std::size_t kShort = 4;
  constexpr std::size_t kLong = 9;
  const bool fits = pose.is_array() && (pose.size() == kShort || pose.size() == kLong);
  if (!fits ||
      !std::all_of(pose.begin(), pose.end(), [](const Json& n) { return n.is_number(); })) {
    return where.key_error(
        name, "is " + shown(pose) + "; must be 4 or 9 numbers [t,x,y,z(,qw,qx,qy,qz,pressure)]");
  }
  const auto at = [&](std::size_t i) { return pose[i].get<double>(); };
  StrokeSample sample;
  sample.time_s = at(0);
  sample.position_mm = {at(1), at(2), at(3)};
  if (pose.size() == kShort) return sample;
  sample.orientation = {at(4), at(5), at(6), at(7)};
  sample.pressure = at(8);
  if (sample.orientation == Quat{0.0, 0.0, 0.0, 0.0}) {
    return where.key_error(name, "has the quaternion 0,0,0,0; must be 1,0,0,0 for no rotation");
  }
  if (!(sample.pressure >= 0.0 && sample.pressure <= 1.0)) {
    return where.key_error(name, "has the pressure " + shown(pose[8]) + "; must be 0 to 1");
  }
  return sample;
}

Result<void> read_poses(const FileLine& where, const Fields& fields, Stroke& stroke) {
  if (!fields.has("poses")) return fields.missing("poses", "give at least one [t,x,y,z]");
  const Json& poses = fields.at("poses");
  if (!poses.is_array() || poses.empty())
    return fields.wrong("poses", "a list of at least one pose");
  stroke.samples.reserve(poses.size());
  for (const Json& pose : poses) {
    const std::string name = "poses[" + std::to_string(stroke.samples.size()) + "]";
    auto sample = read_pose(where, name, pose);
    if (!sample) return sample.error();
    if (!stroke.samples.empty() && sample.value().time_s < stroke.samples.back().time_s) {
      return where.key_error(name, "has the time " + shown(pose[0]) +
                                       " before the pose ahead of it; " +
                                       "times must not decrease");
    }
    stroke.samples.push_back(sample.value());
  }
  return {};
}

Result<void> read_radial(const Fields& fields, Radial& radial) {
  if (fields.has("radial_symmetry")) {
    constexpr const char* kMust = "a whole number from 1 to 64";
    if (!fields.at("radial_symmetry").is_number_integer())
      return fields.wrong("radial_symmetry", kMust);
    const auto count = fields.at("radial_symmetry").get<std::int64_t>();
    if (count < 1 || count > 64) return fields.wrong("radial_symmetry", kMust);
    radial.count = static_cast<int>(count);
  }
  if (!fields.has("radial_axis")) return {};
  const auto axis = fields.choice("radial_axis", kAxisNames);
  if (!axis) return axis.error();
  radial.axis = axis.value();
  return {};
}

Result<void> read_style(const Fields& fields, StrokeStyle& style) {
  Result<void> read = fields.number("spacing", style.spacing);
  if (read) read = read_mirror(fields, style.mirror);
  if (read) read = read_radial(fields, style.radial);
  if (read) read = fields.number("steady_mm", style.steady_mm);
  if (read) read = fields.number("hold_s", style.hold_s);
  if (read) read = fields.flag("dots", style.has_dots);
  return read;
}

/// What single actions read.
Result<void> read_tool_options(const Fields& fields, Tool& tool) {
  if (fields.has("falloff")) {
    const auto falloff = fields.choice("falloff", kFalloffNames);
    if (!falloff) return falloff.error();
    tool.falloff = static_cast<Falloff>(falloff.value());
  }
  Result<void> read = fields.number("plane_offset", tool.plane_offset);
  if (read) read = fields.number("tip_roundness", tool.tip_roundness);
  if (read) read = fields.number("volume_preservation", tool.volume_preservation);
  if (read) read = fields.number("crease_pinch_factor", tool.crease_pinch_factor);
  if (read) read = fields.number("wavelength_mm", tool.wavelength_mm);
  if (read) read = fields.number("amplitude_mm", tool.amplitude_mm);
  if (read) read = fields.number("mid_level", tool.mid_level);
  if (read) read = fields.number("angle_deg", tool.angle_deg);
  if (read) read = fields.flag("use_rake", tool.use_rake);
  if (read) read = fields.number("tile_mm", tool.tile_mm);
  if (read && fields.has("alpha_mode")) {
    const auto mode = fields.choice("alpha_mode", kAlphaModeNames);
    if (!mode) return mode.error();
    tool.alpha_mode = static_cast<AlphaMode>(mode.value());
  }
  if (!read || !fields.has("seed")) return read;
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
  const Json& seed = fields.at("seed");
  if (!seed.is_number_unsigned() || seed.get<std::uint64_t>() > kMost) {
    return fields.wrong("seed", "a whole number from 0 to 4294967295");
  }
  tool.seed = seed.get<std::uint32_t>();
  return {};
}

/// The mesh that gives a tool its shape; no key for it otherwise.
Result<void> read_tool_mesh(const FileLine& where, const Fields& fields, SolidReader& solids,
                            Tool& tool) {
  if (tool.shape != Shape::mesh) {
    for (const char* key : {"mesh", "mesh_xxh64"}) {
      if (fields.has(key)) return fields.wrong(key, "absent unless 'shape' is \"mesh\"");
    }
    return {};
  }
  const auto name = read_solid_name(fields, "mesh", "mesh_xxh64");
  if (!name) return name.error();
  auto mesh = solids.tool_mesh(name.value());
  if (!mesh) return solid_error(where, "mesh", mesh.error());
  tool.mesh = std::move(mesh).value();
  return {};
}

/// The image that a tool embosses with.
Result<void> read_tool_alpha(const FileLine& where, const Fields& fields, SolidReader& solids,
                             Tool& tool) {
  if (tool.action != Action::emboss) {
    for (const char* key : {"alpha", "alpha_xxh64"}) {
      if (fields.has(key)) return fields.wrong(key, "absent unless 'tool' is \"emboss\"");
    }
    return {};
  }
  if (!fields.has("alpha") && !fields.has("alpha_xxh64")) return {};
  const auto name = read_solid_name(fields, "alpha", "alpha_xxh64");
  if (!name) return name.error();
  auto alpha = solids.alpha(name.value());
  if (!alpha) return solid_error(where, "alpha", alpha.error());
  tool.alpha = std::move(alpha).value();
  return {};
}

Result<Stroke> read_stroke(const FileLine& where, const Json& json, SolidReader& solids) {
  const Fields fields(where, json);
  if (auto known = fields.only({"tool",
                                "shape",
                                "mesh",
                                "mesh_xxh64",
                                "radius_mm",
                                "radii_mm",
                                "strength",
                                "pressure_to_strength",
                                "pressure_to_size",
                                "sharpness",
                                "width",
                                "falloff",
                                "plane_offset",
                                "tip_roundness",
                                "volume_preservation",
                                "crease_pinch_factor",
                                "wavelength_mm",
                                "seed",
                                "alpha",
                                "alpha_xxh64",
                                "alpha_mode",
                                "amplitude_mm",
                                "mid_level",
                                "angle_deg",
                                "use_rake",
                                "tile_mm",
                                "symmetry",
                                "radial_symmetry",
                                "radial_axis",
                                "spacing",
                                "steady_mm",
                                "hold_s",
                                "dots",
                                "poses"});
      !known) {
    return known.error();
  }
  const auto action = fields.choice("tool", kActionNames);
  if (!action) return action.error();
  const auto shape = fields.choice("shape", kShapeNames);
  if (!shape) return shape.error();
  Stroke stroke;
  stroke.tool.action = static_cast<Action>(action.value());
  stroke.tool.shape = static_cast<Shape>(shape.value());
  Result<void> read = read_radii(fields, stroke.tool);
  if (read) read = fields.number("strength", stroke.tool.strength);
  if (read) read = fields.number("pressure_to_strength", stroke.tool.pressure_to_strength);
  if (read) read = fields.number("pressure_to_size", stroke.tool.pressure_to_size);
  if (read) read = fields.number("sharpness", stroke.tool.sharpness);
  if (read) read = fields.number("width", stroke.tool.width);
  if (read) read = read_tool_options(fields, stroke.tool);
  if (read) read = read_style(fields, stroke);
  if (read) read = read_poses(where, fields, stroke);
  if (read) read = read_tool_mesh(where, fields, solids, stroke.tool);
  if (read) read = read_tool_alpha(where, fields, solids, stroke.tool);
  if (!read) return read.error();
  if (auto valid = validate_stroke(stroke); !valid) return where.error(valid.error().message);
  return stroke;
}

Result<HistoryStep> read_history(const FileLine& where, const Json& json) {
  const Fields fields(where, json);
  if (auto known = fields.only({"history"}); !known) return known.error();
  const auto step = fields.choice("history", kHistoryNames);
  if (!step) return step.error();
  return static_cast<HistoryStep>(step.value());
}

Result<MaskEdit> read_mask_edit(const FileLine& where, const Json& json) {
  const Fields fields(where, json);
  if (auto known = fields.only({"mask"}); !known) return known.error();
  const auto edit = fields.choice("mask", kMaskNames);
  if (!edit) return edit.error();
  return static_cast<MaskEdit>(edit.value());
}

Result<HashMark> read_mark(const FileLine& where, const Json& json) {
  const Fields fields(where, json);
  if (auto known = fields.only({"hash", "after", "closed"}); !known) return known.error();
  auto hash = fields.hash("hash");
  if (!hash) return hash.error();
  if (!fields.has("after")) return fields.missing("after", "give the number of steps before it");
  if (!fields.at("after").is_number_unsigned()) return fields.wrong("after", "a whole number");
  if (fields.has("closed") && fields.at("closed") != true) {
    return fields.wrong("closed", "true or absent");
  }
  return HashMark{std::move(hash).value(), fields.at("after").get<std::size_t>(),
                  fields.has("closed")};
}

template <class Kind, class T>
Result<ScriptLine> as_line(Result<T> read) {
  if (!read) return read.error();
  return ScriptLine(Kind(std::move(read).value()));
}

struct Unsealed {
  std::string body;  ///< the line without its seal, which is JSON again
  std::string hash;  ///< of it
  std::string told;  ///< by the seal
};

/// `line` is_sealed.
Unsealed unsealed_line(std::string_view line) {
  assert(is_sealed(line));
  // The seal took the place of the brace; the hash is the 16 digits before the closing
  // quote and brace.
  std::string body = std::string(line.substr(0, line.size() - kLineSealLetters)) + "}";
  std::string hash = hash_text(hash_of_text(body));
  return {std::move(body), std::move(hash), std::string(line.substr(line.size() - 18, 16))};
}

/// `line` without its seal. No seal is no error.
Result<std::string> without_seal(const FileLine& where, std::string_view line) {
  if (!is_sealed(line)) return std::string(line);
  Unsealed read = unsealed_line(line);
  if (read.hash == read.told) return std::move(read.body);
  return where.key_error("xxh64", "is \"" + read.told + "\" but the line has " + read.hash +
                                      "; it is damaged, use what is before it");
}

Result<Json> object_of(const FileLine& where, std::string_view line) {
  const auto body = without_seal(where, line);
  if (!body) return body.error();
  return parse_object(where, body.value());
}

}  // namespace

bool is_blank(std::string_view line) noexcept {
  return line.find_first_not_of(" \t\r") == std::string_view::npos;
}

bool is_sealed(std::string_view line) noexcept {
  return line.size() > kLineSealLetters && line.ends_with("\"}") &&
         line.substr(line.size() - kLineSealLetters).starts_with(kLineSealKey);
}

bool has_whole_seal(std::string_view line) {
  if (!is_sealed(line)) return false;
  const Unsealed read = unsealed_line(line);
  return read.hash == read.told;
}

Result<ScriptHeader> read_header_line(const FileLine& where, std::string_view line) {
  const auto json = object_of(where, line);
  if (!json) return json.error();
  return header_of(where, json.value());
}

Result<ScriptLine> read_script_line(const FileLine& where, std::string_view line,
                                    SolidReader& solids) {
  const auto object = object_of(where, line);
  if (!object) return object.error();
  const Json& json = object.value();
  // Kinds of lines are told apart by a key that no other kind has.
  if (json.contains("history")) return as_line<ScriptStep>(read_history(where, json));
  if (json.contains("operation")) return as_line<ScriptStep>(read_operation(where, json, solids));
  if (json.contains("piece")) return as_line<ScriptStep>(read_piece_edit(where, json, solids));
  if (is_mask_filter(json)) return as_line<ScriptStep>(read_mask_filter(where, json));
  if (is_mask_outline(json)) return as_line<ScriptStep>(read_mask_outline(where, json));
  if (json.contains("mask")) return as_line<ScriptStep>(read_mask_edit(where, json));
  if (json.contains("after")) return as_line<HashMark>(read_mark(where, json));
  return as_line<ScriptStep>(read_stroke(where, json, solids));
}

}  // namespace argil::io
