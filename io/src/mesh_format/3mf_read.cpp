// SPDX-License-Identifier: GPL-3.0-or-later
// 3MF: a ZIP archive whose model parts hold meshes, components that place other objects, and the
// build: what is to be printed, and where. Read here: core specification 1.3 (mesh, components,
// items, transforms, units), the colors of the materials extension, the production extension's
// `path` to other parts, and what slicers say of objects beside the model; beams and slices are
// passed over.
#include <array>
#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "argil/mesh/bodies.h"

#include "format/text_scan.h"
#include "format/xml_scan.h"
#include "format/zip_read.h"
#include "mesh_format/3mf_names.h"
#include "mesh_format/3mf_part.h"
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

/// The archive: finds parts, reads each once, and puts the build together.
class Package {
 public:
  Package(std::span<const std::byte> bytes, const std::string& name, StatedUnit& unit,
          FileNotes& notes)
      : bytes_(bytes), name_(name), unit_(unit), notes_(notes) {}

  Result<Assembly> parse();

 private:
  /// A model part, and which object of the assembly each of its objects became.
  struct Part {
    ModelPart model;
    double unit_mm = 1.0;
    std::map<std::int64_t, std::vector<std::size_t>> objects;
  };
  using Named = std::pair<const std::string, Part>;

  const ZipEntry* find(std::string_view part) const noexcept;
  Result<ZipContent> open(const ZipEntry& entry);
  Result<std::string> root_part();
  Result<Named*> part(const std::string& path);
  void read_names();
  Result<void> read_names_of(const ZipEntry& entry);
  const SlicerObject* slicer_object(const Named& home, std::int64_t id) const;
  Result<void> add_item(Named& root, const ItemPlacement& build);
  Result<void> place(const Named& from, const ItemPlacement& placement, const Affine& outer,
                     int depth);
  Result<void> place_components(const Named& home, std::int64_t id, const Affine& to_mm, int depth);
  Result<void> place_meshes(Named& home, std::int64_t id, ModelObject& object, const Affine& to_mm);
  Result<void> place_mesh(const Named& home, std::int64_t id, std::size_t object,
                          const Affine& to_mm);
  const std::vector<std::size_t>& objects_of(Named& home, std::int64_t id, ModelObject& object);
  void add_parted(const SlicerObject& slicer, const std::string& name, ModelObject& object,
                  std::vector<std::size_t>& made);
  void note_left_out(const std::string& part, const std::string& object) {
    notes_.add("'" + part + "' of '" + object +
               "' is a modifier or blocker of the slicer and no part: left out");
  }
  std::size_t add_object(std::string name, std::optional<Srgb> color, TriangleMesh mesh);
  Error fail(const std::string& message) const {
    return {ErrorKind::bad_input, name_ + ": " + message};
  }

  std::span<const std::byte> bytes_;
  const std::string& name_;
  StatedUnit& unit_;
  FileNotes& notes_;
  std::vector<ZipEntry> entries_;
  std::map<std::string, Part> parts_;
  std::string root_;
  SlicerObjects slicer_;  ///< of the root part
  Assembly assembly_;
  std::string component_name_;  ///< that the slicer has for what is being placed
  std::size_t placements_ = 0;
  std::size_t triangles_ = 0;  ///< of all placements
  std::size_t vertices_ = 0;
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

Result<Package::Named*> Package::part(const std::string& path) {
  if (const auto known = parts_.find(path); known != parts_.end()) return &*known;
  const ZipEntry* entry = find(path);
  if (entry == nullptr) return fail("the model part " + in_quotes(path) + " is missing");
  Result<ZipContent> content = open(*entry);
  if (!content) return content.error();
  const auto take = [&](std::string& text) { return content.value().take(text); };
  // A damaged archive looks like bad XML, so its own check is asked first.
  Result<ModelPart> read = read_model_part(take, name_ + ": " + entry->name, notes_);
  if (auto whole = content.value().check(); !whole) return whole.error();
  if (!read) return read.error();
  Part part;
  part.model = std::move(read).value();
  part.unit_mm = unit_.instead_mm.value_or(part.model.unit_mm);
  return &*parts_.emplace(path, std::move(part)).first;
}

/// Names are worth less than what they are of: where they are damaged, the parts go without.
void Package::read_names() {
  for (const char* file : {"Metadata/Slic3r_PE_model.config", "Metadata/model_settings.config"}) {
    const ZipEntry* entry = find(file);
    if (entry == nullptr) continue;
    if (const Result<void> read = read_names_of(*entry); !read) {
      slicer_.clear();
      notes_.add("the slicer's names in '" + entry->name + "' cannot be read (" +
                 read.error().message + ")");
    }
    return;
  }
}

Result<void> Package::read_names_of(const ZipEntry& entry) {
  Result<ZipContent> content = open(entry);
  if (!content) return content.error();
  auto read = read_slicer_objects([&](std::string& text) { return content.value().take(text); });
  if (auto whole = content.value().check(); !whole) return whole;
  if (!read) return read.error();
  slicer_ = std::move(read).value();
  return {};
}

/// Nothing where the slicer has nothing to say of it.
const SlicerObject* Package::slicer_object(const Named& home, std::int64_t id) const {
  const auto found = slicer_.find(id);
  return home.first == root_ && found != slicer_.end() ? &found->second : nullptr;
}

std::size_t Package::add_object(std::string name, std::optional<Srgb> color, TriangleMesh mesh) {
  assembly_.objects.push_back({std::move(name), color, std::move(mesh)});
  return assembly_.objects.size() - 1;
}

/// What the slicer had merged into one mesh.
void Package::add_parted(const SlicerObject& slicer, const std::string& name, ModelObject& object,
                         std::vector<std::size_t>& made) {
  std::vector<std::uint32_t> part_of;
  for (std::size_t p = 0; p < slicer.ranges.size(); ++p) {
    part_of.resize(static_cast<std::size_t>(slicer.ranges[p].last_triangle) + 1,
                   static_cast<std::uint32_t>(p));
  }
  std::vector<TriangleMesh> meshes = mesh::split_mesh(object.mesh, part_of);
  object.mesh = {};
  for (std::size_t p = 0; p < meshes.size(); ++p) {
    const SlicerPart& part = slicer.ranges[p];
    if (part.is_printed) {
      made.push_back(
          add_object(part.name.empty() ? name : part.name, object.color, std::move(meshes[p])));
    } else {
      note_left_out(part.name, name);
    }
  }
}

/// Of an object's own mesh, once.
const std::vector<std::size_t>& Package::objects_of(Named& home, std::int64_t id,
                                                    ModelObject& object) {
  const auto [known, is_new] = home.second.objects.try_emplace(id);
  std::vector<std::size_t>& made = known->second;
  if (!is_new || object.mesh.triangles.empty()) return made;
  for (Vec3& p : object.mesh.positions) p *= home.second.unit_mm;
  const SlicerObject* slicer = slicer_object(home, id);
  std::string name = object.name.empty() ? component_name_ : object.name;
  if (name.empty() && slicer != nullptr) name = slicer->name;
  if (slicer != nullptr && slicer->ranges.size() == 1 && name.empty())
    name = slicer->ranges[0].name;
  if (slicer != nullptr && slicer->ranges.size() > 1) {
    if (covers_triangles(*slicer, object.mesh.triangles.size())) {
      add_parted(*slicer, name, object, made);
      return made;
    }
    notes_.add("the slicer's parts of '" + name + "' do not fit its triangles: it stays one part");
  }
  made.push_back(add_object(std::move(name), object.color, std::move(object.mesh)));
  return made;
}

Result<void> Package::place_mesh(const Named& home, std::int64_t id, std::size_t object,
                                 const Affine& to_mm) {
  const TriangleMesh& mesh = assembly_.objects[object].mesh;
  if (mesh.triangles.size() > kMostPlaced - triangles_ ||
      mesh.positions.size() > kMostPlaced - vertices_) {
    return fail("its placed objects have more than " + std::to_string(kMostPlaced) +
                " triangles or vertices; split it");
  }
  triangles_ += mesh.triangles.size();
  vertices_ += mesh.positions.size();
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const std::string problem = position_problem(to_mm.applied(mesh.positions[v]));
    if (problem.empty()) continue;
    return fail(home.first + ": vertex " + std::to_string(v) + " (from 0) of object " +
                std::to_string(id) + ", as it is placed: " + problem);
  }
  assembly_.items.back().placements.push_back({object, to_mm});
  return {};
}

Result<void> Package::place_meshes(Named& home, std::int64_t id, ModelObject& object,
                                   const Affine& to_mm) {
  for (const std::size_t made : objects_of(home, id, object)) {
    if (Result<void> placed = place_mesh(home, id, made, to_mm); !placed) return placed;
  }
  return {};
}

Result<void> Package::place_components(const Named& home, std::int64_t id, const Affine& to_mm,
                                       int depth) {
  const SlicerObject* slicer = slicer_object(home, id);
  for (const ItemPlacement& component : home.second.model.objects.at(id).components) {
    component_name_.clear();
    if (slicer != nullptr) {
      const auto known = slicer->components.find(component.object);
      const bool is_known = known != slicer->components.end();
      if (is_known && !known->second.is_printed) {
        note_left_out(known->second.name, slicer->name);
        continue;
      }
      if (is_known) component_name_ = known->second.name;
    }
    if (Result<void> placed = place(home, component, to_mm, depth); !placed) return placed;
  }
  return {};
}

Result<void> Package::place(const Named& from, const ItemPlacement& placement, const Affine& outer,
                            int depth) {
  if (depth > kDeepest || ++placements_ > kMostPlacements) {
    return fail("its components place one another without end, or more than " +
                std::to_string(kMostPlacements) + " times");
  }
  const std::string path = placement.part.empty() ? from.first : placement.part;
  const Result<Named*> home = part(path);
  if (!home) return home.error();
  auto& objects = home.value()->second.model.objects;
  const auto found = objects.find(placement.object);
  if (found == objects.end()) {
    return fail("object " + std::to_string(placement.object) + " is missing from " +
                in_quotes(path) + "; export the file again");
  }
  Affine own = placement.transform;
  own.rows[3] *= from.second.unit_mm;
  const Affine to_mm = own.then(outer);
  auto placed = place_meshes(*home.value(), placement.object, found->second, to_mm);
  if (!placed) return placed;
  return place_components(*home.value(), placement.object, to_mm, depth + 1);
}

Result<void> Package::add_item(Named& root, const ItemPlacement& build) {
  assembly_.items.emplace_back();
  component_name_.clear();
  if (Result<void> placed = place(root, build, {}, 0); !placed) return placed;
  AssemblyItem& item = assembly_.items.back();
  if (item.placements.empty()) {
    assembly_.items.pop_back();
    return {};
  }
  Named& home = *part(build.part.empty() ? root.first : build.part).value();
  const ModelObject& object = home.second.model.objects.at(build.object);
  if (object.components.empty() && item.placements.size() == 1) return {};
  const SlicerObject* slicer = slicer_object(home, build.object);
  item.name = object.name.empty() && slicer != nullptr ? slicer->name : object.name;
  return {};
}

Result<Assembly> Package::parse() {
  Result<std::vector<ZipEntry>> directory = zip_directory(bytes_, name_);
  if (!directory) return directory.error();
  entries_ = std::move(directory).value();
  Result<std::string> root = root_part();
  if (!root) return root.error();
  root_ = std::move(root).value();
  const Result<Named*> model = part(root_);
  if (!model) return model.error();
  unit_.mm = model.value()->second.model.unit_mm;
  read_names();
  for (const ItemPlacement& item : model.value()->second.model.build) {
    if (Result<void> added = add_item(*model.value(), item); !added) return added.error();
  }
  if (triangles_ == 0) return no_triangles(name_);
  return std::move(assembly_);
}

}  // namespace

Result<ThreemfAssembly> parse_3mf(std::span<const std::byte> bytes, const std::string& name,
                                  StatedUnit& unit) {
  FileNotes notes;
  Result<Assembly> assembly = Package(bytes, name, unit, notes).parse();
  if (!assembly) return assembly.error();
  return ThreemfAssembly{std::move(assembly).value(), notes.take()};
}

}  // namespace argil::io
