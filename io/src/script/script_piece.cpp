// SPDX-License-Identifier: GPL-3.0-or-later
// Edits of the list of pieces as lines of a script: reading, writing and judging, kind by kind.
#include "script/script_piece.h"

#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace argil::io {
namespace {

/// In the order of PieceEdit's alternatives; a merge is called by its CombineKind.
constexpr auto kPieceEditNames =
    std::to_array<std::string_view>({"select", "add", "copy", "remove", "change", "place", "scale",
                                     "split", "union", "difference", "intersection"});
constexpr std::size_t kFirstMerge = 8;
static_assert(std::is_same_v<std::variant_alternative_t<4, PieceEdit>, ChangePiece> &&
              std::is_same_v<std::variant_alternative_t<7, PieceEdit>, SplitPiece> &&
              std::is_same_v<std::variant_alternative_t<kFirstMerge, PieceEdit>, MergePiece>);

// ---- reading -----------------------------------------------------------------------------------

Result<void> read_name(const Fields& fields, const char* key, std::string& out) {
  if (!fields.has(key)) return fields.missing(key, "give the name of a piece");
  if (!fields.at(key).is_string()) return fields.wrong(key, "the name of a piece");
  out = fields.at(key).get<std::string>();
  return {};
}

Result<PieceEdit> read_select(const Fields& fields) {
  SelectPiece select;
  auto read = fields.only({"piece", "name"});
  if (read) read = read_name(fields, "name", select.name);
  if (!read) return read.error();
  return PieceEdit(std::move(select));
}

Result<PieceEdit> read_add(const FileLine& where, const Fields& fields, SolidReader& solids) {
  AddPiece add;
  auto read = fields.only({"piece", "name", "of", "of_xxh64", "voxel_mm", "position_mm",
                           "orientation", "visible", "locked", "color"});
  if (read) read = read_name(fields, "name", add.look.name);
  if (read) read = read_look(fields, add.look);
  if (read) read = fields.positive("voxel_mm", add.voxel_mm);
  if (!read) return read.error();
  const auto name = read_solid_name(fields, "of", "of_xxh64");
  if (!name) return name.error();
  auto operand = solids.operand(name.value());
  if (!operand) return solid_error(where, "of", operand.error());
  add.clay = operand.value().clay;
  add.mesh = operand.value().mesh;
  if (add.clay != nullptr && fields.has("voxel_mm")) {
    return fields.wrong("voxel_mm", "absent for a project, which has its own voxels");
  }
  return PieceEdit(std::move(add));
}

Result<PieceEdit> read_copy(const Fields& fields) {
  CopyPiece copy;
  auto read = fields.only({"piece", "name", "copy"});
  if (read) read = read_name(fields, "name", copy.name);
  if (read) read = read_name(fields, "copy", copy.copy);
  if (!read) return read.error();
  return PieceEdit(std::move(copy));
}

Result<PieceEdit> read_remove(const Fields& fields) {
  RemovePiece remove;
  auto read = fields.only({"piece", "name"});
  if (read) read = read_name(fields, "name", remove.name);
  if (!read) return read.error();
  return PieceEdit(std::move(remove));
}

/// A placement is given whole: half of one would keep the other half of who knows what.
Result<PieceEdit> read_change(const Fields& fields) {
  ChangePiece change;
  PieceLook look;
  auto read = fields.only(
      {"piece", "name", "new_name", "position_mm", "orientation", "visible", "locked", "color"});
  if (read) read = read_name(fields, "name", change.name);
  if (read) read = read_look(fields, look);
  if (read && fields.has("new_name")) {
    read = read_name(fields, "new_name", look.name);
    change.new_name = look.name;
  }
  if (!read) return read.error();
  if (fields.has("position_mm") != fields.has("orientation")) {
    return fields.missing(fields.has("orientation") ? "position_mm" : "orientation",
                          "position and orientation are given together");
  }
  if (fields.has("position_mm")) change.placement = look.placement;
  if (fields.has("visible")) change.is_visible = look.is_visible;
  if (fields.has("locked")) change.is_locked = look.is_locked;
  if (fields.has("color")) change.color = look.color;
  return PieceEdit(std::move(change));
}

Result<PlacePieces::Place> read_place(const FileLine& where, const Json& json, std::size_t n) {
  const Fields fields(where, json, "places[" + std::to_string(n) + "].");
  PlacePieces::Place place;
  auto read = fields.only({"name", "position_mm", "orientation"});
  if (read) read = read_name(fields, "name", place.name);
  if (read) read = read_placement(fields, place.placement);
  if (!read) return read.error();
  for (const char* key : {"position_mm", "orientation"}) {
    if (!fields.has(key)) return fields.missing(key, "a place has position and orientation");
  }
  return place;
}

Result<PieceEdit> read_places(const FileLine& where, const Fields& fields) {
  constexpr const char* kMust = "a list of objects with name, position_mm and orientation";
  PlacePieces place;
  if (auto read = fields.only({"piece", "places"}); !read) return read.error();
  if (!fields.has("places")) return fields.missing("places", std::string("give ") + kMust);
  const Json& list = fields.at("places");
  if (!list.is_array() || list.empty()) return fields.wrong("places", kMust);
  for (std::size_t n = 0; n < list.size(); ++n) {
    if (!list[n].is_object()) return fields.wrong("places", kMust);
    auto read = read_place(where, list[n], n);
    if (!read) return read.error();
    place.places.push_back(std::move(read).value());
  }
  return PieceEdit(std::move(place));
}

Result<PieceEdit> read_scale(const Fields& fields) {
  ScalePiece scale;
  auto read = fields.only({"piece", "name", "factor", "about_mm"});
  if (read) read = read_name(fields, "name", scale.name);
  if (read && !fields.has("factor")) read = fields.missing("factor", "2 makes it twice as large");
  if (read) read = fields.positive("factor", scale.factor);
  if (read && fields.has("about_mm")) {
    scale.about_mm.emplace();
    read = fields.triple("about_mm", *scale.about_mm);
  }
  if (!read) return read.error();
  return PieceEdit(std::move(scale));
}

Result<PieceEdit> read_split(const Fields& fields) {
  SplitPiece split;
  auto read = fields.only({"piece", "name", "crumb_share"});
  if (read) read = read_name(fields, "name", split.name);
  if (read) read = fields.number("crumb_share", split.crumb_share);
  if (!read) return read.error();
  return PieceEdit(std::move(split));
}

Result<PieceEdit> read_merge(const Fields& fields, CombineKind kind) {
  MergePiece merge;
  merge.kind = kind;
  auto read = fields.only({"piece", "name", "other", "keeps_other"});
  if (read) read = read_name(fields, "name", merge.name);
  if (read) read = read_name(fields, "other", merge.other);
  if (read) read = fields.flag("keeps_other", merge.keeps_other);
  if (!read) return read.error();
  return PieceEdit(std::move(merge));
}

Result<PieceEdit> read_kind(const FileLine& where, const Fields& fields, std::size_t kind,
                            SolidReader& solids) {
  switch (kind) {
    case 0:
      return read_select(fields);
    case 1:
      return read_add(where, fields, solids);
    case 2:
      return read_copy(fields);
    case 3:
      return read_remove(fields);
    case 4:
      return read_change(fields);
    case 5:
      return read_places(where, fields);
    case 6:
      return read_scale(fields);
    case 7:
      return read_split(fields);
    default:
      return read_merge(fields, static_cast<CombineKind>(kind - kFirstMerge));
  }
}

// ---- writing -----------------------------------------------------------------------------------

OrderedJson color_json(const std::optional<Rgb8>& color) {
  return color ? OrderedJson(color_text(*color)) : OrderedJson(nullptr);
}

void put_edit(OrderedJson& json, const SelectPiece& select, const SolidName&) {
  json["name"] = select.name;
}

void put_edit(OrderedJson& json, const AddPiece& add, const SolidName& solid) {
  json["name"] = add.look.name;
  json["of"] = solid.file;
  if (!solid.hash.empty()) json["of_xxh64"] = solid.hash;
  if (add.clay == nullptr && add.voxel_mm != 0.0) json["voxel_mm"] = add.voxel_mm;
  put_look(json, add.look);
}

void put_edit(OrderedJson& json, const CopyPiece& copy, const SolidName&) {
  json["name"] = copy.name;
  json["copy"] = copy.copy;
}

void put_edit(OrderedJson& json, const RemovePiece& remove, const SolidName&) {
  json["name"] = remove.name;
}

void put_edit(OrderedJson& json, const ChangePiece& change, const SolidName&) {
  json["name"] = change.name;
  if (change.new_name) json["new_name"] = *change.new_name;
  if (change.placement) put_placement(json, *change.placement);
  if (change.is_visible) json["visible"] = *change.is_visible;
  if (change.is_locked) json["locked"] = *change.is_locked;
  if (change.color) json["color"] = color_json(*change.color);
}

void put_edit(OrderedJson& json, const PlacePieces& place, const SolidName&) {
  json["places"] = OrderedJson::array();
  for (const PlacePieces::Place& wanted : place.places) {
    OrderedJson one;
    one["name"] = wanted.name;
    put_placement(one, wanted.placement);
    json["places"].push_back(std::move(one));
  }
}

void put_edit(OrderedJson& json, const ScalePiece& scale, const SolidName&) {
  json["name"] = scale.name;
  json["factor"] = scale.factor;
  if (scale.about_mm) json["about_mm"] = {scale.about_mm->x, scale.about_mm->y, scale.about_mm->z};
}

void put_edit(OrderedJson& json, const SplitPiece& split, const SolidName&) {
  json["name"] = split.name;
  if (split.crumb_share != SplitPiece().crumb_share) json["crumb_share"] = split.crumb_share;
}

void put_edit(OrderedJson& json, const MergePiece& merge, const SolidName&) {
  json["name"] = merge.name;
  json["other"] = merge.other;
  if (merge.keeps_other) json["keeps_other"] = true;
}

/// Of what makes pieces larger, or several of one; how large is a matter of the piece.
Result<void> validate_numbers(const PieceEdit& edit) {
  const auto* scale = std::get_if<ScalePiece>(&edit);
  const bool has_factor = scale == nullptr || (std::isfinite(scale->factor) && scale->factor > 0.0);
  if (!has_factor) {
    return Error{ErrorKind::bad_input, "a piece is scaled by no number; give a factor above 0"};
  }
  if (scale != nullptr && scale->about_mm && !is_in_reach(*scale->about_mm)) {
    return Error{ErrorKind::bad_input,
                 "a piece is scaled about a point beyond 1 km; give a nearer one"};
  }
  const auto* split = std::get_if<SplitPiece>(&edit);
  if (split == nullptr || (split->crumb_share >= 0.0 && split->crumb_share <= 1.0)) return {};
  return Error{ErrorKind::bad_input, "the share of crumbs is no number from 0 to 1"};
}

std::size_t name_index(const PieceEdit& edit) {
  const auto* merge = std::get_if<MergePiece>(&edit);
  return edit.index() + (merge == nullptr ? 0 : static_cast<std::size_t>(merge->kind));
}

}  // namespace

Result<PieceEdit> read_piece_edit(const FileLine& where, const Json& json, SolidReader& solids) {
  const Fields fields(where, json);
  const auto kind = fields.choice("piece", kPieceEditNames);
  if (!kind) return kind.error();
  auto read = read_kind(where, fields, kind.value(), solids);
  if (!read) return read;
  if (auto valid = validate_piece_edit(read.value()); !valid) {
    return where.error(valid.error().message);
  }
  return read;
}

OrderedJson piece_edit_json(const PieceEdit& edit, const SolidName& solid) {
  OrderedJson json;
  json["piece"] = kPieceEditNames.at(name_index(edit));
  std::visit([&](const auto& chosen) { put_edit(json, chosen, solid); }, edit);
  return json;
}

/// The names of pieces that are there are not looked at: one that cannot be is not found.
Result<void> validate_piece_edit(const PieceEdit& edit) {
  PieceLook look;
  if (const auto* add = std::get_if<AddPiece>(&edit)) {
    if ((add->clay != nullptr) == (add->mesh != nullptr)) {
      return Error{ErrorKind::bad_input,
                   "a piece is made of a clay or of a mesh; give one of them"};
    }
    if (!(std::isfinite(add->voxel_mm) && add->voxel_mm >= 0.0)) {
      return Error{ErrorKind::bad_input, "the voxel of a new piece is no length; give one in mm"};
    }
    look = add->look;
  }
  if (const auto* copy = std::get_if<CopyPiece>(&edit)) look.name = copy->copy;
  if (const auto* change = std::get_if<ChangePiece>(&edit)) {
    if (change->new_name) look.name = *change->new_name;
    if (change->placement) look.placement = *change->placement;
  }
  if (const auto* place = std::get_if<PlacePieces>(&edit)) {
    for (const PlacePieces::Place& wanted : place->places) {
      look = {.name = wanted.name, .placement = wanted.placement};
      if (auto valid = validate_look(look); !valid) return valid;
    }
  }
  if (auto sound = validate_numbers(edit); !sound) return sound;
  return validate_look(look);
}

}  // namespace argil::io
