// SPDX-License-Identifier: GPL-3.0-or-later
// A project is one VDB file with a grid for each level, the finest first, the mask, `argil_*`
// metadata and the seal behind all (file_seal.h). Loading checks seal, header, grids, nesting and
// hash, in this order, and names what is wrong.
#include "argil/io/project_file.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <openvdb/openvdb.h>

#include "argil/core/hash_text.h"
#include "argil/core/no_throw.h"
#include "argil/engine/storage.h"
#include "argil/io/safe_file.h"

#include "file/file_bytes.h"
#include "file/file_seal.h"
#include "vdb/vdb_read.h"
#include "vdb/vdb_write.h"

namespace argil::io {
namespace {

namespace fs = std::filesystem;

constexpr int kPlainFormat = 1;   // written for a clay without a mask; the oldest that is read
constexpr int kMaskedFormat = 2;  // and with one; the newest that is read

constexpr const char* kMaskName = "mask";
std::string level_name(int level) { return "surface_" + std::to_string(level); }

double mask_voxel_mm(double finest_voxel_mm) { return storage::kMaskVoxels * finest_voxel_mm; }

// ---- saving ------------------------------------------------------------------------------------

openvdb::MetaMap file_metadata(const Clay& clay, std::uint64_t hash) {
  openvdb::MetaMap meta;
  meta.insertMeta("creator", openvdb::StringMetadata("Argil"));
  const int format = clay.has_mask() ? kMaskedFormat : kPlainFormat;
  meta.insertMeta("argil_format", openvdb::Int32Metadata(format));
  meta.insertMeta("argil_units", openvdb::StringMetadata("mm"));
  meta.insertMeta("argil_levels", openvdb::Int32Metadata(clay.level_count()));
  meta.insertMeta("argil_voxel_mm", openvdb::DoubleMetadata(clay.options().voxel_mm));
  meta.insertMeta("argil_tolerance_voxels",
                  openvdb::DoubleMetadata(clay.options().tolerance_voxels));
  if (const auto& edge = clay.options().edge_radius_mm) {
    meta.insertMeta("argil_edge_radius_mm", openvdb::DoubleMetadata(*edge));
  }
  meta.insertMeta("argil_hash", openvdb::StringMetadata(hash_text(hash)));
  return meta;
}

std::vector<GridToWrite> grids_to_save(const StoredClay& clay) {
  std::vector<GridToWrite> grids;
  for (int level = 0; level < clay.level_count(); ++level) {
    grids.push_back({level_name(level), openvdb::GRID_LEVEL_SET, clay.voxel_mm(level),
                     clay.band_mm(level),
                     [&clay, level](LevelVisitor& to) { clay.show_level(level, to); }});
  }
  if (clay.has_mask()) {
    grids.push_back({kMaskName, openvdb::GRID_FOG_VOLUME, mask_voxel_mm(clay.voxel_mm(0)),
                     clay.mask_elsewhere(), [&clay](LevelVisitor& to) { clay.show_mask(to); }});
  }
  return grids;
}

// ---- loading -----------------------------------------------------------------------------------

Error refused(const fs::path& file, const std::string& what) {
  return {ErrorKind::bad_input, "'" + file.string() + "' " + what};
}

bool contains_text(std::span<const std::byte> bytes, std::string_view text) {
  const auto* begin = reinterpret_cast<const char*>(bytes.data());
  return std::string_view(begin, bytes.size()).find(text) != std::string_view::npos;
}

constexpr std::array<unsigned char, 8> kVdbMagic{0x20, 0x42, 0x44, 0x56, 0, 0, 0, 0};
constexpr std::size_t kHead = 4096;  // the file's metadata stand at its front

/// What stands before the seal, or why this is no project.
Result<std::span<const std::byte>> checked_bytes(const fs::path& file,
                                                 std::span<const std::byte> bytes) {
  if (bytes.empty()) return refused(file, "is empty; give a project that argil saved (NAME.vdb)");
  const bool vdb = bytes.size() >= kVdbMagic.size() &&
                   std::equal(kVdbMagic.begin(), kVdbMagic.end(), bytes.begin(),
                              [](unsigned char a, std::byte b) { return std::byte{a} == b; });
  if (!vdb) {
    return refused(file,
                   "is not a VDB file; give a project that argil saved, or make one of a mesh "
                   "with 'argil import'");
  }
  if (const auto body = unsealed(bytes)) return *body;
  if (contains_text(bytes.first(std::min(kHead, bytes.size())), "argil_format")) {
    return refused(file, "is damaged: its " + std::to_string(bytes.size()) +
                             " bytes do not match their checksum (cut off, changed, or saved again "
                             "by another program); use an older copy");
  }
  return refused(file,
                 "is a VDB but not a project of Argil, or cut off near its beginning; give a "
                 "file that argil saved");
}

/// What the file says about itself.
struct ProjectHeader {
  ClayOptions options;
  int levels = 0;
  bool has_mask = false;
  std::string hash;
};

template <class T>
bool read_meta(const openvdb::MetaMap& meta, const char* name, T& out) {
  const auto found = meta.getMetadata<openvdb::TypedMetadata<T>>(name);
  if (found) out = found->value();
  return found != nullptr;
}

Result<ProjectHeader> read_header(const fs::path& file, const openvdb::MetaMap& meta) {
  std::int32_t format = 0;
  if (!read_meta(meta, "argil_format", format)) {
    return refused(file, "has no 'argil_format'; give a file that argil saved");
  }
  if (format < kPlainFormat) {
    return refused(file, "has format " + std::to_string(format) +
                             ", which no argil ever wrote; use an older copy");
  }
  if (format > kMaskedFormat) {
    return refused(file, "has format " + std::to_string(format) + " and this program reads up to " +
                             std::to_string(kMaskedFormat) + "; open it with a newer argil");
  }
  ProjectHeader header;
  std::int32_t levels = 0;
  const bool complete =
      read_meta(meta, "argil_levels", levels) &&
      read_meta(meta, "argil_voxel_mm", header.options.voxel_mm) &&
      read_meta(meta, "argil_tolerance_voxels", header.options.tolerance_voxels) &&
      read_meta(meta, "argil_hash", header.hash);
  if (!complete || levels < 1 || levels > storage::kMostLevels) {
    return refused(file,
                   "lacks a piece of its description (levels, voxel size, tolerance, hash); "
                   "use an older copy");
  }
  if (double edge = 0.0; meta["argil_edge_radius_mm"]) {
    if (!read_meta(meta, "argil_edge_radius_mm", edge)) {
      return refused(file, "has an 'argil_edge_radius_mm' that is no number; use an older copy");
    }
    header.options.edge_radius_mm = edge;
  }
  if (auto valid = validate_options(header.options); !valid) {
    return refused(file, "says what no clay can be: " + valid.error().message);
  }
  header.levels = levels;
  header.has_mask = format == kMaskedFormat;
  return header;
}

/// Hands each grid that the file's description promises to the clay that is made of them, and
/// keeps what it learned of it. What is wrong comes out at the end, in one order.
class ProjectReader {
 public:
  explicit ProjectReader(const fs::path& file) : file_(file) {}

  Result<Clay> read(std::span<const std::byte> body);

 private:
  LevelSink* sink_for(const openvdb::MetaMap& meta, const GridHead& head);
  void take_header(const openvdb::MetaMap& meta);
  Result<void> check_grid(const VdbContent& content, const std::string& name) const;
  Result<void> check_level(const VdbContent& content, int level) const;
  Result<void> check_mask(const VdbContent& content) const;
  Result<void> check_nesting() const;
  Result<Clay> finish(const VdbContent& content);

  const fs::path& file_;
  std::optional<Result<ProjectHeader>> header_;
  std::optional<ClayBuilder> builder_;  ///< once the header is sound
  /// Of the first grid of each name: whether it has the voxel size and background that its level
  /// has, so that it was taken.
  std::map<std::string, bool> fits_;
};

void ProjectReader::take_header(const openvdb::MetaMap& meta) {
  if (header_) return;
  header_ = read_header(file_, meta);
  if (!*header_) return;
  const ProjectHeader& header = header_->value();
  builder_.emplace(header.options, header.levels);
}

/// The first grid of a name counts, as far as it fits.
LevelSink* ProjectReader::sink_for(const openvdb::MetaMap& meta, const GridHead& head) {
  take_header(meta);
  if (!builder_) return nullptr;
  const auto [entry, is_first] = fits_.try_emplace(head.name, false);
  if (!is_first) return nullptr;
  bool& fits = entry->second;
  const ProjectHeader& header = header_->value();
  if (header.has_mask && head.name == kMaskName) {
    const auto transform =
        openvdb::math::Transform::createLinearTransform(mask_voxel_mm(header.options.voxel_mm));
    fits = *head.transform == *transform;
    return fits ? &builder_->mask(head.background) : nullptr;
  }
  for (int level = 0; level < header.levels; ++level) {
    if (head.name != level_name(level)) continue;
    const auto transform =
        openvdb::math::Transform::createLinearTransform(builder_->voxel_mm(level));
    fits = head.background == builder_->band_mm(level) && *head.transform == *transform;
    return fits ? &builder_->level(level) : nullptr;
  }
  return nullptr;
}

/// Success where there is a grid of that name that was read; the error names what it is instead.
Result<void> ProjectReader::check_grid(const VdbContent& content, const std::string& name) const {
  for (const NamedGrid& named : content.grids) {
    if (named.name != name) continue;
    if (named.is_read) return {};
    return refused(file_, "has a grid '" + name + "' that is not of type float on cubic voxels");
  }
  if (name == kMaskName) {
    return refused(file_, "has no grid 'mask', which its format holds; use an older copy");
  }
  return refused(file_, "has no grid '" + name + "'; it says it has " +
                            std::to_string(header_->value().levels) + " levels; use an older copy");
}

Result<void> ProjectReader::check_level(const VdbContent& content, int level) const {
  const std::string name = level_name(level);
  if (auto there = check_grid(content, name); !there) return there;
  if (!fits_.at(name)) {
    return refused(file_, "has a grid '" + name + "' of another voxel size than it says");
  }
  if (builder_->is_sound(level)) return {};
  return refused(file_, "has a grid '" + name +
                            "' with values beyond its band, or out of reach; use an older copy");
}

Result<void> ProjectReader::check_mask(const VdbContent& content) const {
  if (auto there = check_grid(content, kMaskName); !there) return there;
  if (!fits_.at(kMaskName)) {
    return refused(file_, "has a grid 'mask' of another voxel size; use an older copy");
  }
  if (builder_->is_mask_sound()) return {};
  return refused(file_, "has a grid 'mask' that holds no fractions from 0 to 1; use an older copy");
}

/// What works on a clay counts on the coarser leaves that a finer one requires.
Result<void> ProjectReader::check_nesting() const {
  const auto problem = builder_->nesting_problem();
  if (!problem) return {};
  std::string at = "(" + std::to_string(problem->origin[0]) + ", ";
  at.append(std::to_string(problem->origin[1])).append(", ");
  at.append(std::to_string(problem->origin[2])).append(")");
  return refused(file_, "has levels that do not nest: the leaf at " + at + " of level " +
                            std::to_string(problem->level) + " lacks " +
                            (problem->lacks_parent ? "its parent" : "the parent of a neighbour") +
                            " in level " + std::to_string(problem->level + 1) +
                            "; use an older copy");
}

Result<Clay> ProjectReader::finish(const VdbContent& content) {
  take_header(content.meta);  // where there is no grid that would have asked for it
  if (!*header_) return header_->error();
  const ProjectHeader& header = header_->value();
  for (int level = 0; level < header.levels; ++level) {
    if (auto sound = check_level(content, level); !sound) return sound.error();
  }
  if (header.has_mask) {
    if (auto sound = check_mask(content); !sound) return sound.error();
  }
  if (auto nested = check_nesting(); !nested) return nested.error();
  assert(builder_.has_value());
  BuiltClay built = std::move(*builder_).finish();
  if (const std::string hash = hash_text(built.hash); hash != header.hash) {
    return refused(file_, "holds a clay with hash " + hash + " but says " + header.hash +
                              "; use an older copy");
  }
  return std::move(built.clay);
}

Result<Clay> ProjectReader::read(std::span<const std::byte> body) {
  const auto content = read_vdb(body, [&](const openvdb::MetaMap& meta, const GridHead& head) {
    return sink_for(meta, head);
  });
  if (content) return finish(content.value());
  if (content.error().kind == ErrorKind::interrupted) {
    return Error{ErrorKind::interrupted, "interrupted while opening '" + file_.string() + "'"};
  }
  return refused(file_, "cannot be read: it " + content.error().message + "; use an older copy");
}

}  // namespace

Result<void> save_project(const fs::path& file, const Clay& clay) {
  return no_throw(file.string(), [&]() -> Result<void> {
    openvdb::initialize();
    const StoredClay stored(clay);
    const std::uint64_t hash = clay.hash();
    return replace_file(file, [&](const fs::path& temporary) -> Result<void> {
      auto saved = write_vdb(temporary, file_metadata(clay, hash), hash, grids_to_save(stored));
      if (saved) return seal_file(temporary);
      if (saved.error().kind != ErrorKind::interrupted) return saved;
      return Error{ErrorKind::interrupted,
                   "interrupted while writing '" + file.string() + "'; it is as it was before"};
    });
  });
}

bool holds_project(const fs::path& file) {
  std::array<char, kHead> head{};
  std::ifstream in(file, std::ios::binary);
  in.read(head.data(), head.size());
  const std::string_view read(head.data(), static_cast<std::size_t>(in.gcount()));
  const auto same = [](unsigned char a, char b) { return a == static_cast<unsigned char>(b); };
  return read.size() > kVdbMagic.size() &&
         std::equal(kVdbMagic.begin(), kVdbMagic.end(), read.begin(), same) &&
         read.find("argil_format") != std::string_view::npos;
}

Result<Clay> load_project(const fs::path& file) {
  return no_throw(file.string(), [&]() -> Result<Clay> {
    const auto bytes = read_file_bytes(file);
    if (!bytes) return bytes.error();
    const auto body = checked_bytes(file, bytes.value());
    if (!body) return body.error();
    openvdb::initialize();
    return ProjectReader(file).read(body.value());
  });
}

}  // namespace argil::io
