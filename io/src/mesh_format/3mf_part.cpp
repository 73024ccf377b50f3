// SPDX-License-Identifier: GPL-3.0-or-later
// One model part of a 3MF: core specification 1.3 (mesh, components, items, transforms, units, base
// materials) and of the materials extension the groups of colors. An object is one part in one
// color, so that of what is painted triangle by triangle the commonest color stays.
#include "mesh_format/3mf_part.h"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <utility>

#include "format/text_scan.h"
#include "format/xml_text.h"
#include "mesh_format/face_collector.h"

namespace argil::io {
namespace {

std::optional<double> unit_in_mm(std::string_view unit) {
  // The default of the specification.
  if (unit.empty() || unit == "millimeter") return 1.0;
  if (unit == "micron") return 0.001;
  if (unit == "centimeter") return 10.0;
  if (unit == "meter") return 1000.0;
  if (unit == "inch") return 25.4;
  if (unit == "foot") return 304.8;
  return std::nullopt;
}

/// "#RRGGBB", or with two more digits for how opaque it is.
std::optional<Srgb> color_of(std::string_view text) {
  if ((text.size() != 7 && text.size() != 9) || text[0] != '#') return std::nullopt;
  const auto digit = [](char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
  };
  Srgb color;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const int high = digit(text[1 + 2 * channel]);
    const int low = digit(text[2 + 2 * channel]);
    if (high < 0 || low < 0) return std::nullopt;
    color[channel] = static_cast<std::uint8_t>(16 * high + low);
  }
  return color;
}

/// Elements that hold what objects and triangles refer to by number.
bool is_group(std::string_view name) noexcept {
  constexpr std::array<std::string_view, 5> kGroups{"basematerials", "colorgroup", "texture2dgroup",
                                                    "compositematerials", "multiproperties"};
  return std::find(kGroups.begin(), kGroups.end(), name) != kGroups.end();
}

/// A property as objects and triangles name it: a place in a group.
struct Property {
  std::int64_t group = -1;  ///< -1: none
  std::int64_t index = 0;
  auto operator<=>(const Property&) const = default;
};

/// By default the first of its group; -1, which no group has, where it is no number.
std::int64_t index_of(std::string_view text) {
  std::int64_t index = text.empty() ? 0 : -1;
  read_integer(text, index);
  return index;
}

/// The colors of a part, and those that its objects name.
class PartColors {
 public:
  explicit PartColors(FileNotes& notes) : notes_(notes) {}

  void begin_group(const XmlScan& xml);
  void add(std::string_view text);
  void end_group() noexcept { group_ = nullptr; }
  void begin_object(const XmlScan& xml);
  void count_triangle(const XmlScan& xml);
  /// One that names no property of its own.
  void count_plain_triangle();
  /// Of the object that ends.
  std::optional<Srgb> color(const std::string& object);

 private:
  using Group = std::vector<std::optional<Srgb>>;

  std::optional<Srgb> look_up(const Property& property, const std::string& object);

  FileNotes& notes_;
  std::map<std::int64_t, Group> groups_;
  std::set<std::int64_t> others_;  ///< groups of other things than colors
  Group* group_ = nullptr;
  Property of_object_;
  std::map<Property, std::int64_t> triangles_;  ///< how many have it
};

void PartColors::begin_group(const XmlScan& xml) {
  std::int64_t id = 0;
  if (!read_integer(xml.attribute("id"), id)) return;
  const bool has_colors = xml.name() == "basematerials" || xml.name() == "colorgroup";
  if (has_colors) group_ = &(groups_[id] = {});
  if (!has_colors) others_.insert(id);
}

void PartColors::add(std::string_view text) {
  if (group_ == nullptr) return;
  group_->push_back(color_of(text));
  if (!group_->back() && !text.empty()) {
    notes_.add("the color " + in_quotes(text) + " is not of the form #RRGGBB, and is none");
  }
}

void PartColors::begin_object(const XmlScan& xml) {
  of_object_ = {};
  triangles_.clear();
  Property given;
  if (!read_integer(xml.attribute("pid"), given.group)) return;
  given.index = index_of(xml.attribute("pindex"));
  of_object_ = given;
}

void PartColors::count_triangle(const XmlScan& xml) {
  Property property = of_object_;
  const std::string_view index = xml.attribute("p1");
  if (!index.empty()) {
    read_integer(xml.attribute("pid"), property.group);
    property.index = index_of(index);
  }
  if (property.group >= 0) ++triangles_[property];
}

void PartColors::count_plain_triangle() {
  if (of_object_.group >= 0) ++triangles_[of_object_];
}

std::optional<Srgb> PartColors::look_up(const Property& property, const std::string& object) {
  const auto group = groups_.find(property.group);
  if (group == groups_.end()) {
    const bool is_other = others_.count(property.group) > 0;
    notes_.add(object + (is_other ? " has a texture or a mixture of materials, which is left out"
                                  : " refers to the colors " + std::to_string(property.group) +
                                        ", which the file does not have"));
    return std::nullopt;
  }
  const auto count = static_cast<std::int64_t>(group->second.size());
  if (property.index < 0 || property.index >= count) {
    notes_.add(object + " refers to color " + std::to_string(property.index) +
               " (from 0) of only " + std::to_string(count));
    return std::nullopt;
  }
  return group->second[static_cast<std::size_t>(property.index)];
}

std::optional<Srgb> PartColors::color(const std::string& object) {
  std::map<Srgb, std::int64_t> counts;
  for (const auto& [property, triangles] : triangles_) {
    if (const auto color = look_up(property, object)) counts[*color] += triangles;
  }
  triangles_.clear();
  if (counts.empty()) return std::nullopt;
  if (counts.size() > 1) {
    notes_.add(object + " has " + std::to_string(counts.size()) +
               " colors; that of most of its triangles is kept for all of it");
  }
  // Of equal ones the first, in the order of the map.
  return std::max_element(counts.begin(), counts.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

class PartParser {
 public:
  PartParser(XmlScan::TakePiece text, std::string where, FileNotes& notes)
      : xml_(std::move(text)), where_(std::move(where)), colors_(notes) {}

  Result<ModelPart> parse();

 private:
  Result<void> opened();
  void opened_resource();
  Result<void> closed();
  Result<void> required_extensions();
  Result<void> model();
  Result<void> object();
  void pass_plain_elements();
  bool pass_plain_vertex();
  bool pass_plain_triangle();
  Result<void> vertex();
  Result<void> triangle();
  Result<void> close_object();
  Result<ItemPlacement> placement();
  Result<Affine> transform(std::string_view text);
  Error fail(const std::string& message) const { return line_error(where_, xml_.line(), message); }

  XmlScan xml_;
  std::string where_;
  ModelPart part_;
  ModelObject* object_ = nullptr;
  std::int64_t id_ = 0;  ///< of the object
  FaceCollector faces_;
  std::vector<std::int64_t> corners_;
  PartColors colors_;
};

/// What a reader must know to read the part at all. Materials say nothing of shapes, nor did the
/// first draft of volumes; slices, beams and sets of triangles are passed over; `path` is read.
Result<void> PartParser::required_extensions() {
  constexpr std::array<std::string_view, 6> kKnown{"/material/",     "/production/",
                                                   "/slice/",        "/beamlattice/",
                                                   "/trianglesets/", "/volumetric/2015/"};
  std::string_view prefixes = xml_.attribute("requiredextensions");
  for (auto prefix = take_token(prefixes); !prefix.empty(); prefix = take_token(prefixes)) {
    std::string_view space = xml_.attribute(prefix);  // of "xmlns:PREFIX"
    const bool is_known = std::any_of(kKnown.begin(), kKnown.end(), [&](std::string_view known) {
      return space.find(known) != std::string_view::npos;
    });
    if (is_known) continue;
    // Without scheme and host, which say the least.
    const std::size_t host = space.find("://");
    const std::size_t path = host == space.npos ? space.npos : space.find('/', host + 3);
    if (path != space.npos) space.remove_prefix(path + 1);
    return fail("it requires the extension " + in_quotes(space.empty() ? prefix : space) +
                ", which is not read here; export without it");
  }
  return {};
}

Result<void> PartParser::model() {
  if (auto known = required_extensions(); !known) return known;
  const std::optional<double> unit = unit_in_mm(xml_.attribute("unit"));
  if (!unit) return fail("unknown unit " + in_quotes(xml_.attribute("unit")));
  part_.unit_mm = *unit;
  return {};
}

Result<void> PartParser::object() {
  if (!read_integer(xml_.attribute("id"), id_)) return fail("an object has no id");
  object_ = &part_.objects[id_];
  *object_ = {};
  object_->name = plain_name(xml_unescaped(xml_.attribute("name")), Assembly::kLongestName);
  faces_ = {};
  colors_.begin_object(xml_);
  return {};
}

/// Vertices and triangles as most programs write them, nearly all of a file, in a fourth of the
/// time. What is not in order about one is left to next().
void PartParser::pass_plain_elements() {
  while (pass_plain_vertex()) {
  }
  while (pass_plain_triangle()) {
  }
}

bool PartParser::pass_plain_vertex() {
  constexpr XmlScan::PlainForm kForm{"<vertex x=\"", "\" y=\"", "\" z=\"", "\""};
  std::array<std::string_view, 3> values;
  if (!xml_.is_plain(kForm, values)) return false;
  Vec3 point;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!read_number(values[axis], point[axis])) return false;
  }
  if (!is_finite(point)) return false;
  object_->mesh.positions.push_back(point);
  xml_.pass_plain();
  return true;
}

bool PartParser::pass_plain_triangle() {
  constexpr XmlScan::PlainForm kForm{"<triangle v1=\"", "\" v2=\"", "\" v3=\"", "\""};
  std::array<std::string_view, 3> values;
  if (!xml_.is_plain(kForm, values)) return false;
  std::array<std::int64_t, 3> corners{};
  for (std::size_t n = 0; n < 3; ++n) {
    if (!read_integer(values[n], corners[n])) return false;
  }
  if (!faces_.add_triangle(corners, 0)) return false;
  colors_.count_plain_triangle();
  xml_.pass_plain();
  return true;
}

Result<void> PartParser::vertex() {
  Vec3 point;
  if (!read_number(xml_.attribute("x"), point.x) || !read_number(xml_.attribute("y"), point.y) ||
      !read_number(xml_.attribute("z"), point.z)) {
    return fail("a vertex needs the numbers x, y and z; export the file again");
  }
  if (!is_finite(point)) {
    return fail("a coordinate is NaN or infinite; repair the mesh where it was made");
  }
  object_->mesh.positions.push_back(point);
  return {};
}

Result<void> PartParser::triangle() {
  corners_.assign(3, 0);
  if (!read_integer(xml_.attribute("v1"), corners_[0]) ||
      !read_integer(xml_.attribute("v2"), corners_[1]) ||
      !read_integer(xml_.attribute("v3"), corners_[2])) {
    return fail("a triangle needs the whole numbers v1, v2 and v3; export the file again");
  }
  colors_.count_triangle(xml_);
  const std::string problem = faces_.add(corners_, 0);
  return problem.empty() ? Result<void>() : fail(problem);
}

Result<void> PartParser::close_object() {
  const auto count = static_cast<std::int64_t>(object_->mesh.positions.size());
  if (faces_.highest() >= count) {
    return fail("a triangle of this object names vertex " + std::to_string(faces_.highest()) +
                " (from 0) of only " + std::to_string(count) + "; export the file again");
  }
  object_->mesh.triangles = faces_.take(object_->mesh.positions);
  object_->color = colors_.color(object_->name.empty() ? "object " + std::to_string(id_)
                                                       : "'" + object_->name + "'");
  object_ = nullptr;
  return {};
}

Result<Affine> PartParser::transform(std::string_view text) {
  Affine result;
  if (text.empty()) return result;
  for (std::size_t i = 0; i < 12; ++i) {
    if (!read_number(take_token(text), result.rows[i / 3][i % 3])) {
      return fail("a transform needs 12 numbers");
    }
  }
  for (const Vec3& row : result.rows) {
    if (!is_finite(row)) return fail("a transform is NaN or infinite");
  }
  return result;
}

Result<ItemPlacement> PartParser::placement() {
  ItemPlacement placement;
  placement.part = xml_.attribute("path");
  if (!read_integer(xml_.attribute("objectid"), placement.object)) {
    return fail("a component or item has no objectid");
  }
  const Result<Affine> placed = transform(xml_.attribute("transform"));
  if (!placed) return placed.error();
  placement.transform = placed.value();
  return placement;
}

void PartParser::opened_resource() {
  const std::string_view name = xml_.name();
  if (name == "base") colors_.add(xml_.attribute("displaycolor"));
  if (name == "color") colors_.add(xml_.attribute("color"));
  if (is_group(name)) colors_.begin_group(xml_);
}

Result<void> PartParser::opened() {
  const std::string_view name = xml_.name();
  if (name == "model" && xml_.depth() == 1) return model();
  if (name == "object") return object();
  if (object_ != nullptr && name == "vertex") return vertex();
  if (object_ != nullptr && name == "triangle") return triangle();
  if (name == "item" || (object_ != nullptr && name == "component")) {
    Result<ItemPlacement> placed = placement();
    if (!placed) return placed.error();
    (name == "item" ? part_.build : object_->components).push_back(std::move(placed).value());
  } else if (object_ == nullptr) {
    opened_resource();
  }
  return {};
}

Result<void> PartParser::closed() {
  if (object_ != nullptr && xml_.name() == "object") return close_object();
  if (is_group(xml_.name())) colors_.end_group();
  return {};
}

Result<ModelPart> PartParser::parse() {
  for (;;) {
    if (object_ != nullptr) pass_plain_elements();
    Result<void> read;
    switch (xml_.next()) {
      case XmlScan::Event::open:
        read = opened();
        break;
      case XmlScan::Event::close:
        read = closed();
        break;
      case XmlScan::Event::end:
        return std::move(part_);
      case XmlScan::Event::error:
        return fail(xml_.problem() + "; export the file again");
    }
    if (!read) return read.error();
  }
}

}  // namespace

void FileNotes::add(std::string note) {
  if (notes_.size() < kMost) {
    notes_.push_back(std::move(note));
  } else {
    ++left_out_;
  }
}

std::vector<std::string> FileNotes::take() {
  if (left_out_ > 0) notes_.push_back("and " + std::to_string(left_out_) + " more of the kind");
  return std::move(notes_);
}

Result<ModelPart> read_model_part(XmlScan::TakePiece text, const std::string& where,
                                  FileNotes& notes) {
  return PartParser(std::move(text), where, notes).parse();
}

}  // namespace argil::io
