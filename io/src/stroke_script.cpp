// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/stroke_script.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <set>
#include <string_view>

#include <nlohmann/json.hpp>

#include "argil/io/safe_file.h"

#include "file_bytes.h"
#include "no_throw.h"

namespace argil::io {
namespace {

using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;  // written lines keep the order a person reads them in
using Names = std::initializer_list<std::string_view>;

constexpr int kVersion = 1;

// Names are looked up in the order of these enumerations.
static_assert(static_cast<int>(Action::add) == 0 && static_cast<int>(Action::inflate) == 3);
static_assert(static_cast<int>(Shape::ball) == 0 && static_cast<int>(Shape::ellipsoid) == 1);

/// Where a message points: a line of a file.
struct Place {
  std::string file;
  int line = 0;

  Error error(const std::string& what) const {
    return {ErrorKind::bad_input, file + ":" + std::to_string(line) + ": " + what};
  }
  Error key_error(std::string_view key, const std::string& what) const {
    return error("key '" + std::string(key) + "' " + what);
  }
};

/// Letters to insert, delete or change to get from `a` to `b`.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, change});
    }
  }
  return row[b.size()];
}

std::string_view nearest(std::string_view word, Names known) {
  return *std::min_element(known.begin(), known.end(), [&](auto a, auto b) {
    return edit_distance(word, a) < edit_distance(word, b);
  });
}

std::string quoted_list(Names known) {
  std::string text;
  for (const std::string_view name : known) {
    text += (text.empty() ? "'" : ", '") + std::string(name) + "'";
  }
  return text;
}

/// A value as a message shows it, shortened.
std::string shown(const Json& value) {
  constexpr std::size_t kLongest = 40;
  std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  if (text.size() > kLongest) text = text.substr(0, kLongest) + "...";
  return text;
}

/// One JSON object of the script and the keys it may have.
class Fields {
 public:
  Fields(const Place& place, const Json& object, std::string prefix = {})
      : place_(place), object_(object), prefix_(std::move(prefix)) {}

  Result<void> only(Names known) const {
    for (const auto& [key, value] : object_.items()) {
      if (std::find(known.begin(), known.end(), key) != known.end()) continue;
      return place_.key_error(
          prefix_ + key, "is not known; did you mean '" + std::string(nearest(key, known)) + "'?");
    }
    return {};
  }
  bool has(const char* key) const { return object_.contains(key); }
  const Json& at(const char* key) const { return object_.at(key); }

  Error wrong(const char* key, const std::string& must) const {
    return place_.key_error(prefix_ + key, "is " + shown(object_.at(key)) + "; must be " + must);
  }
  Error missing(const char* key, const std::string& remedy) const {
    return place_.key_error(prefix_ + key, "is missing; " + remedy);
  }

  /// Leaves `out` alone when the key is absent.
  Result<void> number(const char* key, double& out) const {
    if (!has(key)) return {};
    if (!at(key).is_number()) return wrong(key, "a number");
    out = at(key).get<double>();
    return {};
  }
  Result<void> positive(const char* key, double& out) const {
    if (auto read = number(key, out); !read || !has(key)) return read;
    if (!(out > 0.0)) return wrong(key, "greater than 0");
    return {};
  }
  Result<void> positive_triple(const char* key, Vec3& out) const {
    const Json& value = at(key);
    if (!value.is_array() || value.size() != 3) return wrong(key, "three numbers [x, y, z]");
    for (std::size_t a = 0; a < 3; ++a) {
      if (!value[a].is_number()) return wrong(key, "three numbers [x, y, z]");
      out[a] = value[a].get<double>();
      if (!(out[a] > 0.0)) return wrong(key, "three numbers greater than 0");
    }
    return {};
  }
  /// One of `names`, as its index; the key must be there.
  Result<std::size_t> choice(const char* key, Names names) const {
    if (!has(key)) return missing(key, "give one of " + quoted_list(names));
    if (!at(key).is_string()) return wrong(key, "one of " + quoted_list(names));
    const auto& text = at(key).get_ref<const std::string&>();
    const auto found = std::find(names.begin(), names.end(), text);
    if (found == names.end()) return wrong(key, "one of " + quoted_list(names));
    return static_cast<std::size_t>(found - names.begin());
  }

 private:
  const Place& place_;
  const Json& object_;
  std::string prefix_;
};

// ---- reading -----------------------------------------------------------------------------------

/// One line as a JSON object without repeated keys.
Result<Json> parse_object(const Place& place, std::string_view line) {
  std::vector<std::set<std::string>> open;  // keys seen in each object that is not closed yet
  std::string repeated;
  const auto watch = [&](int, Json::parse_event_t event, Json& parsed) {
    if (event == Json::parse_event_t::object_start) open.emplace_back();
    if (event == Json::parse_event_t::object_end) open.pop_back();
    if (event == Json::parse_event_t::key &&
        !open.back().insert(parsed.get<std::string>()).second) {
      repeated = parsed.get<std::string>();
    }
    return true;
  };
  try {
    Json json = Json::parse(line, watch);
    if (!json.is_object())
      return place.error("is " + shown(json) + "; must be a JSON object {...}");
    if (!repeated.empty()) return place.key_error(repeated, "appears twice; keep one of them");
    return json;
  } catch (const Json::parse_error& error) {
    return place.error("column " + std::to_string(error.byte) +
                       ": not JSON; the line must be one complete object {...}");
  } catch (const Json::out_of_range&) {
    return place.error("a number is too large to represent; must be finite");
  }
}

Result<StartShape> read_start(const Place& place, const Json& json) {
  if (!json.is_object()) return place.key_error("start", "is " + shown(json) + "; must be {...}");
  const Fields fields(place, json, "start.");
  const auto shape = fields.choice("shape", {"ball", "block"});
  if (!shape) return shape.error();
  StartShape start;
  Result<void> read;
  if (shape.value() == 0) {
    read = fields.only({"shape", "radius_mm", "voxel_mm", "tolerance_voxels"});
    if (read && !fields.has("radius_mm"))
      read = fields.missing("radius_mm", "give the ball's radius");
    if (read) read = fields.positive("radius_mm", start.size_mm.x);
  } else {
    start.kind = StartShape::Kind::block;
    read = fields.only({"shape", "size_mm", "voxel_mm", "tolerance_voxels"});
    if (read && !fields.has("size_mm")) read = fields.missing("size_mm", "give the three sides");
    if (read) read = fields.positive_triple("size_mm", start.size_mm);
  }
  if (read) read = fields.positive("voxel_mm", start.options.voxel_mm);
  if (read) read = fields.positive("tolerance_voxels", start.options.tolerance_voxels);
  if (!read) return read.error();
  return start;
}

Result<void> read_header(const Place& place, const Json& json, StrokeScript& script) {
  const Fields fields(place, json);
  if (!fields.has("argil_strokes")) {
    return fields.missing("argil_strokes",
                          "the first line must be a header {\"argil_strokes\":1,...}");
  }
  if (fields.at("argil_strokes") != kVersion) {
    return fields.wrong("argil_strokes", "1, the only version this program reads");
  }
  if (auto known = fields.only({"argil_strokes", "units", "start"}); !known) return known;
  if (fields.has("units") && fields.at("units") != "mm") return fields.wrong("units", "\"mm\"");
  if (!fields.has("start")) return {};
  auto start = read_start(place, fields.at("start"));
  if (!start) return start.error();
  script.start = start.value();
  return {};
}

Result<void> read_radii(const Fields& fields, Tool& tool) {
  if (fields.has("radius_mm") && fields.has("radii_mm")) {
    return fields.wrong("radii_mm", "absent when 'radius_mm' is given");
  }
  if (tool.shape == Shape::ellipsoid) {
    if (!fields.has("radii_mm")) return fields.missing("radii_mm", "give three semi-axes in mm");
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
Result<StrokeSample> read_pose(const Place& place, const std::string& name, const Json& pose) {
  constexpr std::size_t kShort = 4;
  constexpr std::size_t kLong = 9;
  const bool fits = pose.is_array() && (pose.size() == kShort || pose.size() == kLong);
  if (!fits ||
      !std::all_of(pose.begin(), pose.end(), [](const Json& n) { return n.is_number(); })) {
    return place.key_error(
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
    return place.key_error(name, "has the quaternion 0,0,0,0; must be 1,0,0,0 for no rotation");
  }
  if (!(sample.pressure >= 0.0 && sample.pressure <= 1.0)) {
    return place.key_error(name, "has the pressure " + shown(pose[8]) + "; must be 0 to 1");
  }
  return sample;
}

Result<void> read_poses(const Place& place, const Fields& fields, Stroke& stroke) {
  if (!fields.has("poses")) return fields.missing("poses", "give at least one [t,x,y,z]");
  const Json& poses = fields.at("poses");
  if (!poses.is_array() || poses.empty())
    return fields.wrong("poses", "a list of at least one pose");
  stroke.samples.reserve(poses.size());
  for (const Json& pose : poses) {
    const std::string name = "poses[" + std::to_string(stroke.samples.size()) + "]";
    auto sample = read_pose(place, name, pose);
    if (!sample) return sample.error();
    if (!stroke.samples.empty() && sample.value().time_s < stroke.samples.back().time_s) {
      return place.key_error(name, "has the time " + shown(pose[0]) +
                                       " before the pose ahead of it; " +
                                       "times must not decrease");
    }
    stroke.samples.push_back(sample.value());
  }
  return {};
}

Result<Stroke> read_stroke(const Place& place, const Json& json) {
  const Fields fields(place, json);
  if (auto known = fields.only(
          {"tool", "shape", "radius_mm", "radii_mm", "strength", "symmetry", "spacing", "poses"});
      !known) {
    return known.error();
  }
  const auto action = fields.choice("tool", {"add", "carve", "smooth", "inflate"});
  if (!action) return action.error();
  const auto shape = fields.choice("shape", {"ball", "ellipsoid"});
  if (!shape) return shape.error();
  Stroke stroke;
  stroke.tool.action = static_cast<Action>(action.value());
  stroke.tool.shape = static_cast<Shape>(shape.value());
  Result<void> read = read_radii(fields, stroke.tool);
  if (read) read = fields.number("strength", stroke.tool.strength);
  if (read) read = fields.number("spacing", stroke.spacing);
  if (read) read = read_mirror(fields, stroke.mirror);
  if (read) read = read_poses(place, fields, stroke);
  if (!read) return read.error();
  if (auto valid = validate_stroke(stroke); !valid) return place.error(valid.error().message);
  return stroke;
}

bool is_blank(std::string_view line) {
  return line.find_first_not_of(" \t\r") == std::string_view::npos;
}

Result<void> read_line(const Place& place, std::string_view line, bool first,
                       StrokeScript& script) {
  auto json = parse_object(place, line);
  if (!json) return json.error();
  if (first) return read_header(place, json.value(), script);
  auto stroke = read_stroke(place, json.value());
  if (!stroke) return stroke.error();
  script.strokes.push_back(std::move(stroke).value());
  return {};
}

Result<StrokeScript> parse_script(const std::string& file, std::string_view text) {
  StrokeScript script;
  Place place{file, 0};
  bool first = true;
  while (!text.empty()) {
    ++place.line;
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (is_blank(line)) continue;
    if (auto read = read_line(place, line, first, script); !read) return read.error();
    first = false;
  }
  if (first) {
    return Error{
        ErrorKind::bad_input,
        file + ": the stroke script is empty; its first line must be {\"argil_strokes\":1}"};
  }
  return script;
}

// ---- writing -----------------------------------------------------------------------------------

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

OrderedJson stroke_json(const Stroke& stroke) {
  static constexpr const char* kActions[] = {"add", "carve", "smooth", "inflate"};
  OrderedJson json;
  json["tool"] = kActions[static_cast<std::size_t>(stroke.tool.action)];
  const Vec3& r = stroke.tool.radii_mm;
  if (stroke.tool.shape == Shape::ball) {
    json["shape"] = "ball";
    json["radius_mm"] = r.x;
  } else {
    json["shape"] = "ellipsoid";
    json["radii_mm"] = {r.x, r.y, r.z};
  }
  json["strength"] = stroke.tool.strength;
  std::string planes;
  if (stroke.mirror.x) planes += 'x';
  if (stroke.mirror.y) planes += 'y';
  if (stroke.mirror.z) planes += 'z';
  json["symmetry"] = planes;
  json["spacing"] = stroke.spacing;
  json["poses"] = OrderedJson::array();
  for (const StrokeSample& sample : stroke.samples) json["poses"].push_back(pose_json(sample));
  return json;
}

/// JSON has no NaN: what could not be read back is refused before anything is written.
Result<void> validate_script(const StrokeScript& script) {
  for (std::size_t i = 0; i < script.strokes.size(); ++i) {
    if (auto valid = validate_stroke(script.strokes[i]); !valid) {
      return Error{ErrorKind::bad_input,
                   "stroke " + std::to_string(i) + ": " + valid.error().message};
    }
  }
  if (script.start && !(is_finite(script.start->size_mm) && script.start->size_mm.x > 0.0)) {
    return Error{ErrorKind::bad_input, "the start shape's size must be finite and greater than 0"};
  }
  return {};
}

std::string script_text(const StrokeScript& script) {
  OrderedJson header;
  header["argil_strokes"] = kVersion;
  header["units"] = "mm";
  if (script.start) header["start"] = start_json(*script.start);
  std::string text = header.dump() + "\n";
  for (const Stroke& stroke : script.strokes) text += stroke_json(stroke).dump() + "\n";
  return text;
}

}  // namespace

Result<StrokeScript> read_stroke_script(const std::filesystem::path& file) {
  return no_throw(file.string(), [&]() -> Result<StrokeScript> {
    const auto bytes = read_file_bytes(file);
    if (!bytes) return bytes.error();
    return parse_script(
        file.string(), {reinterpret_cast<const char*>(bytes.value().data()), bytes.value().size()});
  });
}

Result<void> write_stroke_script(const std::filesystem::path& file, const StrokeScript& script) {
  return no_throw(file.string(), [&]() -> Result<void> {
    if (auto valid = validate_script(script); !valid) return valid;
    return replace_file(file, [&](const std::filesystem::path& temporary) -> Result<void> {
      OutputFile out(temporary);
      out.write(script_text(script));
      return out.close();
    });
  });
}

}  // namespace argil::io
