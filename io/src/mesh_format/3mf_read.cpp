// SPDX-License-Identifier: GPL-3.0-or-later
// 3MF: a ZIP archive whose model parts hold meshes, components that place other objects, and the
// build: what is to be printed, and where. Read here: core specification 1.3 (mesh, components,
// items, transforms, units) and the production extension's `path` to other parts; materials,
// beams and slices are passed over.
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "format/text_scan.h"
#include "format/xml_scan.h"
#include "format/zip_read.h"
#include "mesh_format/face_collector.h"
#include "mesh_format/mesh_read.h"

namespace argil::io {
namespace {

// Components may place each other: without limits a few lines ask for 2^60 placements, or go round
// in a circle.
constexpr std::size_t kMostPlacements = 1'000'000;
constexpr int kDeepest = 64;

/// What is read of an archive, unpacked: so much, and so many times its size. Models in text take
/// a fifth to a twentieth of their bytes; what packs far better holds nothing that is printed.
constexpr std::uint64_t kUnpackedBytes = 128 << 20;
constexpr std::uint64_t kUnpackedTimes = 64;

/// Row vectors, as in the specification: p' = p * rows[0..2] + rows[3].
struct Transform {
  std::array<Vec3, 4> rows{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{}};

  Vec3 turned(const Vec3& p) const noexcept {
    return p.x * rows[0] + p.y * rows[1] + p.z * rows[2];
  }
  Vec3 applied(const Vec3& p) const noexcept { return turned(p) + rows[3]; }
  /// First this, then `outer`.
  Transform then(const Transform& outer) const noexcept {
    return {{outer.turned(rows[0]), outer.turned(rows[1]), outer.turned(rows[2]),
             outer.applied(rows[3])}};
  }
  bool mirrors() const noexcept { return dot(rows[0], cross(rows[1], rows[2])) < 0.0; }
};

/// An object placed by a component or a build item.
struct ItemPlacement {
  std::string part;  ///< of the archive; empty: the one it is written in
  std::int64_t object = 0;
  Transform transform;
};

struct Object {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  std::vector<ItemPlacement> components;
};

struct ModelPart {
  double unit_mm = 1.0;
  std::map<std::int64_t, Object> objects;
  std::vector<ItemPlacement> build;
};

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

/// Reads one model part.
class PartParser {
 public:
  PartParser(XmlScan::TakePiece text, std::string where)
      : xml_(std::move(text)), where_(std::move(where)) {}

  Result<ModelPart> parse();

 private:
  Result<void> opened();
  Result<void> required_extensions();
  Result<void> model();
  Result<void> object();
  Result<void> vertex();
  Result<void> triangle();
  Result<void> close_object();
  Result<ItemPlacement> placement();
  Result<Transform> transform(std::string_view text);
  Error fail(const std::string& message) const { return line_error(where_, xml_.line(), message); }

  XmlScan xml_;
  std::string where_;
  ModelPart part_;
  Object* object_ = nullptr;
  FaceCollector faces_;
  std::vector<std::int64_t> corners_;
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
  std::int64_t id = 0;
  if (!read_integer(xml_.attribute("id"), id)) return fail("an object has no id");
  object_ = &part_.objects[id];
  *object_ = {};
  faces_ = {};
  return {};
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
  object_->positions.push_back(point);
  return {};
}

Result<void> PartParser::triangle() {
  corners_.assign(3, 0);
  if (!read_integer(xml_.attribute("v1"), corners_[0]) ||
      !read_integer(xml_.attribute("v2"), corners_[1]) ||
      !read_integer(xml_.attribute("v3"), corners_[2])) {
    return fail("a triangle needs the whole numbers v1, v2 and v3; export the file again");
  }
  const std::string problem = faces_.add(corners_, 0);
  return problem.empty() ? Result<void>() : fail(problem);
}

Result<void> PartParser::close_object() {
  const auto count = static_cast<std::int64_t>(object_->positions.size());
  if (faces_.highest() >= count) {
    return fail("a triangle of this object names vertex " + std::to_string(faces_.highest()) +
                " (from 0) of only " + std::to_string(count) + "; export the file again");
  }
  object_->triangles = faces_.take(object_->positions);
  object_ = nullptr;
  return {};
}

Result<Transform> PartParser::transform(std::string_view text) {
  Transform result;
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
  const Result<Transform> placed = transform(xml_.attribute("transform"));
  if (!placed) return placed.error();
  placement.transform = placed.value();
  return placement;
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
  }
  return {};
}

Result<ModelPart> PartParser::parse() {
  for (;;) {
    Result<void> read;
    switch (xml_.next()) {
      case XmlScan::Event::open:
        read = opened();
        break;
      case XmlScan::Event::close:
        if (object_ != nullptr && xml_.name() == "object") read = close_object();
        break;
      case XmlScan::Event::end:
        return std::move(part_);
      case XmlScan::Event::error:
        return fail(xml_.problem() + "; export the file again");
    }
    if (!read) return read.error();
  }
}

/// The archive: finds parts, reads each once, and puts the build together.
class Package {
 public:
  Package(std::span<const std::byte> bytes, const std::string& name, StatedUnit& unit)
      : bytes_(bytes), name_(name), unit_(unit) {}

  Result<TriangleMesh> parse();

 private:
  const ZipEntry* find(std::string_view part) const noexcept;
  Result<ZipContent> open(const ZipEntry& entry);
  Result<std::string> root_part();
  Result<const ModelPart*> part(const std::string& path);
  Result<void> place(const std::string& from, const ItemPlacement& placement,
                     const Transform& outer, int depth);
  Result<void> append(const std::string& part, std::int64_t id, const Object& object,
                      const Transform& transform, double unit_mm);
  Error fail(const std::string& message) const {
    return {ErrorKind::bad_input, name_ + ": " + message};
  }

  std::span<const std::byte> bytes_;
  const std::string& name_;
  StatedUnit& unit_;
  std::vector<ZipEntry> entries_;
  std::map<std::string, ModelPart> parts_;
  TriangleMesh mesh_;
  std::size_t placements_ = 0;
  std::uint64_t unpacked_ = 0;  ///< bytes of what was opened
};

const ZipEntry* Package::find(std::string_view part) const noexcept {
  // Part names begin with a slash, names in a ZIP archive do not.
  if (part.starts_with('/')) part.remove_prefix(1);
  for (const ZipEntry& entry : entries_) {
    if (entry.name == part) return &entry;
  }
  return nullptr;
}

Result<ZipContent> Package::open(const ZipEntry& entry) {
  const std::uint64_t most = kUnpackedBytes + kUnpackedTimes * bytes_.size();
  if (entry.bytes > most - unpacked_) {
    constexpr std::uint64_t kMega = 1'000'000;
    return fail(in_quotes(entry.name) + " unpacks to " + std::to_string(entry.bytes / kMega) +
                " MB, and of an archive of this size at most " + std::to_string(most / kMega) +
                " MB are read; export the file again, or split it");
  }
  Result<ZipContent> content = ZipContent::open(bytes_, entry, name_);
  if (content) unpacked_ += entry.bytes;
  return content;
}

/// The start part named by the package's relationships.
Result<std::string> Package::root_part() {
  const ZipEntry* entry = find("_rels/.rels");
  if (entry == nullptr) return fail("it is a ZIP archive but not a 3MF: '_rels/.rels' is missing");
  Result<ZipContent> content = open(*entry);
  if (!content) return content.error();
  XmlScan xml([&](std::string& text) { return content.value().take(text); });
  for (XmlScan::Event event = xml.next(); event != XmlScan::Event::end; event = xml.next()) {
    if (auto whole = content.value().check(); !whole) return whole.error();
    if (event == XmlScan::Event::error) return fail("'_rels/.rels' is damaged: " + xml.problem());
    if (event == XmlScan::Event::open && xml.name() == "Relationship" &&
        xml.attribute("Type").ends_with("/3dmodel")) {
      return std::string(xml.attribute("Target"));
    }
  }
  return fail("'_rels/.rels' names no 3D model; export the file again");
}

Result<const ModelPart*> Package::part(const std::string& path) {
  if (const auto known = parts_.find(path); known != parts_.end()) return &known->second;
  const ZipEntry* entry = find(path);
  if (entry == nullptr) return fail("the model part " + in_quotes(path) + " is missing");
  Result<ZipContent> content = open(*entry);
  if (!content) return content.error();
  const auto take = [&](std::string& text) { return content.value().take(text); };
  // A damaged archive looks like bad XML, so its own check is asked first.
  Result<ModelPart> read = PartParser(take, name_ + ": " + entry->name).parse();
  if (auto whole = content.value().check(); !whole) return whole.error();
  if (!read) return read.error();
  return &(parts_[path] = std::move(read).value());
}

Result<void> Package::append(const std::string& part, std::int64_t id, const Object& object,
                             const Transform& transform, double unit_mm) {
  if (object.triangles.size() > kMostPlaced - mesh_.triangles.size() ||
      object.positions.size() > kMostPlaced - mesh_.positions.size()) {
    return fail("its placed objects have more than " + std::to_string(kMostPlaced) +
                " triangles or vertices; split it");
  }
  const auto base = static_cast<std::uint32_t>(mesh_.positions.size());
  for (std::size_t v = 0; v < object.positions.size(); ++v) {
    mesh_.positions.push_back(transform.applied(object.positions[v]) * unit_mm);
    const std::string problem = position_problem(mesh_.positions.back());
    if (problem.empty()) continue;
    return fail(part + ": vertex " + std::to_string(v) + " (from 0) of object " +
                std::to_string(id) + ", as it is placed: " + problem);
  }
  // A mirrored object would face inward.
  const bool mirrored = transform.mirrors();
  for (const Triangle& t : object.triangles) {
    mesh_.triangles.push_back(
        {base + t[0], base + t[mirrored ? 2 : 1], base + t[mirrored ? 1 : 2]});
  }
  return {};
}

Result<void> Package::place(const std::string& from, const ItemPlacement& placement,
                            const Transform& outer, int depth) {
  if (depth > kDeepest || ++placements_ > kMostPlacements) {
    return fail("its components place one another without end, or more than " +
                std::to_string(kMostPlacements) + " times");
  }
  const std::string path = placement.part.empty() ? from : placement.part;
  const Result<const ModelPart*> home = part(path);
  if (!home) return home.error();
  const auto found = home.value()->objects.find(placement.object);
  if (found == home.value()->objects.end()) {
    return fail("object " + std::to_string(placement.object) + " is missing from " +
                in_quotes(path) + "; export the file again");
  }
  const Transform transform = placement.transform.then(outer);
  const Object& object = found->second;
  const double unit_mm = unit_.instead_mm.value_or(home.value()->unit_mm);
  auto added = append(path, placement.object, object, transform, unit_mm);
  if (!added) return added;
  for (const ItemPlacement& component : object.components) {
    if (Result<void> placed = place(path, component, transform, depth + 1); !placed) return placed;
  }
  return {};
}

Result<TriangleMesh> Package::parse() {
  Result<std::vector<ZipEntry>> directory = zip_directory(bytes_, name_);
  if (!directory) return directory.error();
  entries_ = std::move(directory).value();
  const Result<std::string> root = root_part();
  if (!root) return root.error();
  const Result<const ModelPart*> model = part(root.value());
  if (!model) return model.error();
  unit_.mm = model.value()->unit_mm;
  for (const ItemPlacement& item : model.value()->build) {
    if (Result<void> placed = place(root.value(), item, {}, 0); !placed) return placed.error();
  }
  if (mesh_.triangles.empty()) return no_triangles(name_);
  return std::move(mesh_);
}

}  // namespace

Result<TriangleMesh> parse_3mf(std::span<const std::byte> bytes, const std::string& name) {
  StatedUnit unit;
  return parse_3mf_in(bytes, name, unit);
}

Result<TriangleMesh> parse_3mf_in(std::span<const std::byte> bytes, const std::string& name,
                                  StatedUnit& unit) {
  return Package(bytes, name, unit).parse();
}

}  // namespace argil::io
