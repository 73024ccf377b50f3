// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/project_file.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <fstream>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include <openvdb/tree/LeafManager.h>

#include "argil/io/safe_file.h"

#include "file_bytes.h"
#include "file_seal.h"
#include "hash_text.h"
#include "level_stack.h"
#include "mask.h"
#include "nesting.h"
#include "no_throw.h"
#include "vdb.h"
#include "vdb_read.h"
#include "vdb_write.h"

namespace argil::io {
namespace {

namespace fs = std::filesystem;

constexpr int kPlainFormat = 1;   // written for a clay without a mask; the oldest that is read
constexpr int kMaskedFormat = 2;  // and with one; the newest that is read

// ---- saving ------------------------------------------------------------------------------------

/// Gives the tiles of one node the sign of the field at their middle.
template <class Node>
void sign_tiles_of(Node& node, const LevelStack& levels, int level) {
  const float band = levels.band_mm(level);
  constexpr int kHalfTile = Node::ChildNodeType::DIM / 2;
  for (auto tile = node.beginChildOff(); tile; ++tile) {
    const Coord middle = tile.getCoord().offsetBy(kHalfTile);
    node.addTile(tile.pos(), levels.sample(level, middle) < 0.0F ? -band : band, false);
  }
}

/// The root boxes of `level` (4096 nodes a side) that the whole clay touches.
openvdb::CoordBBox root_boxes(const LevelStack& levels, int level) {
  openvdb::CoordBBox box;
  if (!levels.grid(levels.top()).tree().evalLeafBoundingBox(box)) return box;  // empty
  const int shift = levels.top() - level;
  constexpr int kRootLog = VdbGrid::TreeType::RootNodeType::ChildNodeType::TOTAL;
  return {(box.min() << shift) >> kRootLog, (box.max() << shift) >> kRootLog};
}

/// A copy of a level for other programs: Argil reads only the leaves of a finer level and the
/// coarser one beside them; others take a tile for what it says, so it says inside or outside.
VdbGrid::Ptr with_signed_tiles(const LevelStack& levels, int level) {
  VdbGrid::Ptr copy = levels.grid(level).deepCopy();
  using Upper = VdbGrid::TreeType::RootNodeType::ChildNodeType;
  auto& root = copy->tree().root();
  constexpr std::int64_t kMostBoxes = 64;  // beyond, only boxes that hold leaves are signed
  const openvdb::CoordBBox boxes = root_boxes(levels, level);
  if (!boxes.empty() && static_cast<std::int64_t>(boxes.volume()) <= kMostBoxes) {
    for (auto box = boxes.begin(); box; ++box) {
      const Coord origin = *box << static_cast<int>(Upper::TOTAL);
      if (root.probeConstNode<Upper>(origin) == nullptr) {
        root.addChild(new Upper(origin, levels.band_mm(level), false));
      }
    }
  }
  for (auto upper = root.beginChildOn(); upper; ++upper) {
    sign_tiles_of(*upper, levels, level);
    for (auto lower = upper->beginChildOn(); lower; ++lower) sign_tiles_of(*lower, levels, level);
  }
  return copy;
}

openvdb::MetaMap file_metadata(const Clay& clay) {
  openvdb::MetaMap meta;
  meta.insertMeta("creator", openvdb::StringMetadata("Argil"));
  const int format = clay.has_mask() ? kMaskedFormat : kPlainFormat;
  meta.insertMeta("argil_format", openvdb::Int32Metadata(format));
  meta.insertMeta("argil_units", openvdb::StringMetadata("mm"));
  meta.insertMeta("argil_levels", openvdb::Int32Metadata(clay.levels().count()));
  meta.insertMeta("argil_voxel_mm", openvdb::DoubleMetadata(clay.options().voxel_mm));
  meta.insertMeta("argil_tolerance_voxels",
                  openvdb::DoubleMetadata(clay.options().tolerance_voxels));
  meta.insertMeta("argil_hash", openvdb::StringMetadata(hash_text(clay.hash())));
  return meta;
}

openvdb::GridCPtrVec grids_to_save(const LevelStack& levels) {
  openvdb::GridCPtrVec grids;
  for (int level = 0; level < levels.top(); ++level) {
    grids.push_back(with_signed_tiles(levels, level));
  }
  // The coarsest level's tiles are right already; the clay outlives the save, so nobody owns it.
  grids.push_back(VdbGrid::ConstPtr(&levels.grid(levels.top()), [](const VdbGrid*) {}));
  if (const Mask* mask = levels.mask()) {
    grids.push_back(VdbGrid::ConstPtr(&mask->grid(), [](const VdbGrid*) {}));
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
  if (!complete || levels < 1 || levels > kMostLevels) {
    return refused(file,
                   "lacks a piece of its description (levels, voxel size, tolerance, hash); "
                   "use an older copy");
  }
  if (auto valid = validate_options(header.options); !valid) {
    return refused(file, "says what no clay can be: " + valid.error().message);
  }
  header.levels = levels;
  header.has_mask = format == kMaskedFormat;
  return header;
}

/// Null when there is none of that name.
Result<VdbGrid::Ptr> float_grid(const fs::path& file, const VdbContent& content,
                                const std::string& name) {
  for (const NamedGrid& named : content.grids) {
    if (named.name != name) continue;
    if (named.grid) return named.grid;
    return refused(file, "has a grid '" + name + "' that is not of type float on cubic voxels");
  }
  return VdbGrid::Ptr();
}

/// How far leaves of a level may begin from the origin: where the finest may be, and what coarser
/// ones add to that by their band, by being whole and by standing around finer ones.
int most_node(int level) {
  constexpr int kBeyond = 8 * kLeafSide;
  return std::min(kMaxNode, (kMaxNode >> level) + kBeyond);
}

/// Values are within the band, those on its edge inactive, and places within reach: what edits and
/// queries of a level rely on.
bool is_level(const VdbGrid& grid, float band, int level) {
  std::atomic<bool> is_sound = true;
  const int most = most_node(level);
  openvdb::tree::LeafManager<const VdbTree> leaves(grid.tree());
  leaves.foreach ([&](const VdbLeaf& leaf, std::size_t) {
    const float* values = leaf.buffer().data();
    const Coord& at = leaf.origin();
    bool fits =
        std::min({at.x(), at.y(), at.z()}) >= -most && std::max({at.x(), at.y(), at.z()}) <= most;
    for (openvdb::Index n = 0; n < kLeafNodes; ++n) {
      const float size = std::abs(values[n]);
      fits = fits && size <= band && (size < band) == leaf.isValueOn(n);
    }
    if (!fits) is_sound = false;
  });
  return is_sound;
}

Result<void> take_level(const fs::path& file, const VdbContent& content, LevelStack& levels,
                        int level) {
  const std::string name = levels.grid(level).getName();
  const auto found = float_grid(file, content, name);
  if (!found) return found.error();
  const VdbGrid::Ptr& grid = found.value();
  if (!grid) {
    return refused(file, "has no grid '" + name + "'; it says it has " +
                             std::to_string(levels.count()) + " levels; use an older copy");
  }
  const bool fits = grid->background() == levels.band_mm(level) &&
                    grid->transform() == levels.grid(level).transform();
  if (!fits) return refused(file, "has a grid '" + name + "' of another voxel size than it says");
  if (!is_level(*grid, levels.band_mm(level), level)) {
    return refused(file, "has a grid '" + name +
                             "' with values beyond its band, or out of reach; use an older copy");
  }
  levels.grid(level).setTree(grid->treePtr());
  return {};
}

Result<void> take_mask(const fs::path& file, const VdbContent& content, LevelStack& levels) {
  const auto found = float_grid(file, content, "mask");
  if (!found) return found.error();
  const VdbGrid::Ptr& grid = found.value();
  if (!grid) {
    return refused(file, "has no grid 'mask', which its format holds; use an older copy");
  }
  const double voxel = kMaskVoxels * levels.voxel_mm(0);
  if (const char* fault = fault_of_mask(*grid, voxel)) {
    return refused(file, std::string("has a grid 'mask' ") + fault + "; use an older copy");
  }
  levels.exchange_mask(mask_of(*grid, voxel));
  return {};
}

/// What works on a clay counts on the coarser leaves that a finer one requires.
Result<void> check_nesting(const fs::path& file, const LevelStack& levels) {
  const auto fault = first_nesting_fault(levels);
  if (!fault) return {};
  std::string at = "(" + std::to_string(fault->place.x()) + ", ";
  at.append(std::to_string(fault->place.y())).append(", ");
  at.append(std::to_string(fault->place.z())).append(")");
  const bool alone = fault->kind == NestingFault::Kind::no_parent;
  return refused(file, "has levels that do not nest: the leaf at " + at + " of level " +
                           std::to_string(fault->level) + " lacks " +
                           (alone ? "its parent" : "the parent of a neighbour") + " in level " +
                           std::to_string(fault->level + 1) + "; use an older copy");
}

Result<Clay> clay_of(const fs::path& file, const VdbContent& content) {
  const auto header = read_header(file, content.meta);
  if (!header) return header.error();
  auto levels =
      std::make_unique<LevelStack>(header.value().options.voxel_mm, header.value().levels);
  for (int level = 0; level < levels->count(); ++level) {
    if (auto taken = take_level(file, content, *levels, level); !taken) return taken.error();
  }
  if (header.value().has_mask) {
    if (auto taken = take_mask(file, content, *levels); !taken) return taken.error();
  }
  if (auto nested = check_nesting(file, *levels); !nested) return nested.error();
  Clay clay = Clay::from_levels(std::move(levels), header.value().options);
  if (const std::string hash = hash_text(clay.hash()); hash != header.value().hash) {
    return refused(file, "holds a clay with hash " + hash + " but says " + header.value().hash +
                             "; use an older copy");
  }
  return clay;
}

Result<Clay> read_project(const fs::path& file, std::span<const std::byte> body) {
  openvdb::initialize();
  const auto content = read_vdb(body);
  if (content) return clay_of(file, content.value());
  return refused(file, "cannot be read: it " + content.error().message + "; use an older copy");
}

}  // namespace

Result<void> save_project(const fs::path& file, const Clay& clay) {
  return no_throw(file.string(), [&]() -> Result<void> {
    const openvdb::GridCPtrVec grids = grids_to_save(clay.levels());
    const openvdb::MetaMap meta = file_metadata(clay);
    return replace_file(file, [&](const fs::path& temporary) -> Result<void> {
      if (auto saved = write_vdb(temporary, grids, meta); !saved) return saved;
      return seal_file(temporary);
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
    return read_project(file, body.value());
  });
}

}  // namespace argil::io
