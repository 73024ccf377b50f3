// SPDX-License-Identifier: GPL-3.0-or-later
// Operations on the whole clay as lines of a script: reading, writing and judging, kind by kind.
#include "script/script_operation.h"

#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace argil::io {
namespace {

/// In the order that read_operation and `named` count in; combinations last, in the
/// order of CombineKind.
constexpr auto kOperationNames = std::to_array<std::string_view>(
    {"offset", "hollow", "cut", "resample", "union", "difference", "intersection"});
constexpr std::size_t kFirstCombination = 4;
static_assert(static_cast<int>(CombineKind::unite) == 0 &&
              static_cast<int>(CombineKind::intersect) == 2);

// ---- reading -----------------------------------------------------------------------------------

Result<Operation> read_offset(const Fields& fields) {
  Offset offset;
  auto read = fields.only({"operation", "distance_mm"});
  if (read && !fields.has("distance_mm")) {
    read = fields.missing("distance_mm", "give the distance outward, negative for inward");
  }
  if (read) read = fields.number("distance_mm", offset.distance_mm);
  if (!read) return read.error();
  return Operation(offset);
}

Result<Drain> read_drain(const FileLine& where, const std::string& name, const Json& json) {
  if (!json.is_object()) return where.key_error(name, "is " + shown(json) + "; must be {...}");
  const Fields fields(where, json, name + ".");
  Drain drain;
  auto read = fields.only({"point_mm", "direction", "radius_mm"});
  for (const char* key : {"point_mm", "direction", "radius_mm"}) {
    if (read && !fields.has(key)) {
      read = fields.missing(key, "a drain has 'point_mm', 'direction' and 'radius_mm'");
    }
  }
  if (read) read = fields.triple("point_mm", drain.point_mm);
  if (read) read = fields.triple("direction", drain.direction);
  if (read) read = fields.positive("radius_mm", drain.radius_mm);
  if (!read) return read.error();
  return drain;
}

Result<Operation> read_hollow(const FileLine& where, const Fields& fields) {
  Hollow hollow;
  auto read = fields.only({"operation", "wall_mm", "drains"});
  if (read && !fields.has("wall_mm")) read = fields.missing("wall_mm", "give the wall's thickness");
  if (read) read = fields.positive("wall_mm", hollow.wall_mm);
  if (!read) return read.error();
  if (!fields.has("drains")) return Operation(std::move(hollow));
  const Json& drains = fields.at("drains");
  if (!drains.is_array()) return fields.wrong("drains", "a list of drains {...}");
  for (const Json& json : drains) {
    auto drain = read_drain(where, "drains[" + std::to_string(hollow.drains.size()) + "]", json);
    if (!drain) return drain.error();
    hollow.drains.push_back(drain.value());
  }
  return Operation(std::move(hollow));
}

Result<Operation> read_cut(const Fields& fields) {
  Cut cut;
  auto read = fields.only({"operation", "point_mm", "normal", "keeps_front"});
  if (read && !fields.has("point_mm")) read = fields.missing("point_mm", "give a point [x, y, z]");
  if (read && !fields.has("normal")) read = fields.missing("normal", "give a direction [x, y, z]");
  if (read) read = fields.triple("point_mm", cut.point_mm);
  if (read) read = fields.triple("normal", cut.normal);
  if (read) read = fields.flag("keeps_front", cut.keeps_front);
  if (!read) return read.error();
  return Operation(cut);
}

Result<Operation> read_resample(const Fields& fields) {
  Resample resample;
  auto read = fields.only({"operation", "voxel_mm"});
  if (read && !fields.has("voxel_mm")) read = fields.missing("voxel_mm", "give the finest voxel");
  if (read) read = fields.positive("voxel_mm", resample.voxel_mm);
  if (!read) return read.error();
  return Operation(resample);
}

Result<Operation> read_combine(const FileLine& where, const Fields& fields, CombineKind kind,
                               SolidReader& solids) {
  Combine with;
  with.kind = kind;
  auto read = fields.only({"operation", "with", "with_xxh64", "position_mm", "orientation"});
  if (read) read = read_placement(fields, with.placement);
  if (!read) return read.error();
  const auto name = read_solid_name(fields, "with", "with_xxh64");
  if (!name) return name.error();
  auto operand = solids.operand(name.value());
  if (!operand) return solid_error(where, "with", operand.error());
  with.clay = operand.value().clay;
  with.mesh = operand.value().mesh;
  return Operation(std::move(with));
}

// ---- writing -----------------------------------------------------------------------------------

OrderedJson triple(const Vec3& v) { return {v.x, v.y, v.z}; }

OrderedJson named(std::size_t name) {
  OrderedJson json;
  json["operation"] = kOperationNames.at(name);
  return json;
}

OrderedJson json_of(const Offset& offset, const SolidName&) {
  OrderedJson json = named(0);
  json["distance_mm"] = offset.distance_mm;
  return json;
}

OrderedJson json_of(const Hollow& hollow, const SolidName&) {
  OrderedJson json = named(1);
  json["wall_mm"] = hollow.wall_mm;
  for (const Drain& drain : hollow.drains) {
    OrderedJson one;
    one["point_mm"] = triple(drain.point_mm);
    one["direction"] = triple(drain.direction);
    one["radius_mm"] = drain.radius_mm;
    json["drains"].push_back(std::move(one));
  }
  return json;
}

OrderedJson json_of(const Cut& cut, const SolidName&) {
  OrderedJson json = named(2);
  json["point_mm"] = triple(cut.point_mm);
  json["normal"] = triple(cut.normal);
  if (cut.keeps_front) json["keeps_front"] = true;
  return json;
}

OrderedJson json_of(const Resample& resample, const SolidName&) {
  OrderedJson json = named(3);
  json["voxel_mm"] = resample.voxel_mm;
  return json;
}

OrderedJson json_of(const Combine& with, const SolidName& solid) {
  OrderedJson json = named(kFirstCombination + static_cast<std::size_t>(with.kind));
  json["with"] = solid.file;
  if (!solid.hash.empty()) json["with_xxh64"] = solid.hash;
  put_placement(json, with.placement);
  return json;
}

// ---- judging -----------------------------------------------------------------------------------

bool all_finite(const Offset& offset) { return std::isfinite(offset.distance_mm); }
bool all_finite(const Hollow& hollow) {
  bool finite = std::isfinite(hollow.wall_mm);
  for (const Drain& drain : hollow.drains) {
    finite = finite && is_finite(drain.point_mm) && is_finite(drain.direction) &&
             std::isfinite(drain.radius_mm);
  }
  return finite;
}
bool all_finite(const Cut& cut) { return is_finite(cut.point_mm) && is_finite(cut.normal); }
bool all_finite(const Resample& resample) { return std::isfinite(resample.voxel_mm); }
bool all_finite(const Combine& with) {
  const Quat& q = with.placement.orientation;
  return is_finite(with.placement.position_mm) && std::isfinite(q.w) &&
         is_finite(Vec3{q.x, q.y, q.z});
}

}  // namespace

Result<SolidName> read_solid_name(const Fields& fields, const char* key, const char* hash_key) {
  if (!fields.has(key)) return fields.missing(key, "name a file, seen from the script's folder");
  SolidName name;
  const bool is_text = fields.at(key).is_string();
  if (is_text) name.file = fields.at(key).get<std::string>();
  if (name.file.empty() || name.file.find('\0') != std::string::npos) {
    return fields.wrong(key, "the name of a file");
  }
  if (!fields.has(hash_key)) return name;
  auto hash = fields.hash(hash_key);
  if (!hash) return hash.error();
  name.hash = std::move(hash).value();
  return name;
}

Error solid_error(const FileLine& where, const char* key, const Error& error) {
  return {error.kind, where.key_error(key, "cannot be used: " + error.message).message};
}

Result<Operation> read_operation(const FileLine& where, const Json& json, SolidReader& solids) {
  const Fields fields(where, json);
  const auto name = fields.choice("operation", kOperationNames);
  if (!name) return name.error();
  switch (name.value()) {
    case 0:
      return read_offset(fields);
    case 1:
      return read_hollow(where, fields);
    case 2:
      return read_cut(fields);
    case 3:
      return read_resample(fields);
    default:
      return read_combine(where, fields, static_cast<CombineKind>(name.value() - kFirstCombination),
                          solids);
  }
}

OrderedJson operation_json(const Operation& operation, const SolidName& solid) {
  return std::visit([&](const auto& chosen) { return json_of(chosen, solid); }, operation);
}

Result<void> validate_operation(const Operation& operation) {
  const auto* with = std::get_if<Combine>(&operation);
  if (with != nullptr && (with->clay != nullptr) == (with->mesh != nullptr)) {
    return Error{ErrorKind::bad_input,
                 "a combination takes another clay or a mesh; give one of them"};
  }
  if (std::visit([](const auto& chosen) { return all_finite(chosen); }, operation)) return {};
  return Error{ErrorKind::bad_input, "the operation has a number that is not finite; give numbers"};
}

}  // namespace argil::io
