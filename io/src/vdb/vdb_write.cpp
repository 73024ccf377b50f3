// SPDX-License-Identifier: GPL-3.0-or-later
#include "vdb/vdb_write.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <sstream>
#include <vector>

#include <blosc.h>
#include <openvdb/io/Compression.h>
#include <openvdb/math/Transform.h>
#include <openvdb/version.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "argil/io/safe_file.h"

#include "file/file_bytes.h"
#include "vdb/vdb_layout.h"
#include "vdb/vdb_transform.h"
#include "vdb/vdb_tree.h"

namespace argil::io {
namespace {

using Words = std::span<const std::uint64_t>;

constexpr std::uint32_t kCompression = kActiveMask | kBlosc;

template <class Number>
void put(std::string& out, const Number& number) {
  out.append(reinterpret_cast<const char*>(&number), sizeof number);
}
void put_text(std::string& out, const std::string& text) {
  put(out, static_cast<std::uint32_t>(text.size()));
  out.append(text);
}
void put_words(std::string& out, Words words) {
  out.append(reinterpret_cast<const char*>(words.data()), words.size_bytes());
}
template <class Thing>
std::string written(const Thing& thing) {
  std::ostringstream out(std::ios::binary);
  thing(out);
  return std::move(out).str();
}

// ---- values of a node --------------------------------------------------------------------------

/// A node's values, with a bit for each that says whether it is active, or a child.
struct Values {
  Words active;
  Words children;                 ///< empty: none
  std::span<const float> values;  ///< 0 for a child
};

/// The inactive values of a node: where they are no more than two, they are not written one by one.
struct Inactive {
  std::uint8_t kind = kBackground;
  std::array<float, 2> value{};
};

/// Up to three different values, in their order; the third only says that there are more than two.
int different_inactive(const Values& node, std::array<float, 2>& found) {
  int count = 0;
  for (std::size_t word = 0; word < node.active.size(); ++word) {
    const std::uint64_t children = node.children.empty() ? 0 : node.children[word];
    for (std::uint64_t left = ~(node.active[word] | children); left != 0; left &= left - 1) {
      const float value = node.values[64 * word + static_cast<std::size_t>(std::countr_zero(left))];
      if ((count > 0 && value == found[0]) || (count > 1 && value == found[1])) continue;
      if (count == 2) return 3;
      found[static_cast<std::size_t>(count++)] = value;
    }
  }
  return count;
}

/// As OpenVDB's MaskCompress chooses among the ways.
Inactive inactive_of(const Values& node, float background) {
  Inactive inactive{kBackground, {background, background}};
  auto& [first, second] = inactive.value;
  const int count = different_inactive(node, inactive.value);
  if (count > 2) {
    inactive.kind = kAll;
  } else if (count == 1 && first != background) {
    inactive.kind = first == -background ? kMinusBackground : kOneOther;
  } else if (count == 2) {
    if (first == background) std::swap(first, second);
    inactive.kind = second != background   ? kChosenOfTwo
                    : first == -background ? kChosenOfBackground
                                           : kChosenOneOther;
  }
  return inactive;
}

/// Which inactive values are the second of two.
void put_choice(const Values& node, float second, std::string& out) {
  for (std::size_t word = 0; word < node.active.size(); ++word) {
    std::uint64_t chosen = 0;
    for (std::uint64_t left = ~node.active[word]; left != 0; left &= left - 1) {
      const auto bit = static_cast<std::size_t>(std::countr_zero(left));
      if (node.values[64 * word + bit] == second) chosen |= std::uint64_t{1} << bit;
    }
    put(out, chosen);
  }
}

/// The active values of a node, one after the other. One more than those is written to.
std::size_t gather_active(const Values& node, float* out) {
  float* const begin = out;
  for (std::size_t n = 0; n < node.values.size(); n += 8) {
    const auto active = static_cast<unsigned>(node.active[n / 64] >> (n % 64)) & 0xffU;
    if (active == 0) continue;
    for (unsigned k = 0; k < 8; ++k) {
      *out = node.values[n + k];
      out += active >> k & 1U;
    }
  }
  return static_cast<std::size_t>(out - begin);
}

/// Compressed as OpenVDB does, where that makes it smaller; else as it is, with a negative size.
void put_packed(std::span<const float> values, std::string& out) {
  const std::size_t whole = values.size_bytes();
  const std::size_t size_at = out.size();
  put(out, std::int64_t{0});
  const std::size_t data_at = out.size();
  constexpr int kHardest = 9;
  out.resize(data_at + whole + BLOSC_MAX_OVERHEAD);
  const int packed = blosc_compress_ctx(kHardest, BLOSC_SHUFFLE, sizeof(float), whole,
                                        values.data(), out.data() + data_at,
                                        whole + BLOSC_MAX_OVERHEAD, BLOSC_LZ4_COMPNAME, whole, 1);
  auto size = static_cast<std::int64_t>(packed);
  if (size <= 0 || size >= static_cast<std::int64_t>(whole)) {
    if (whole > 0) std::memcpy(out.data() + data_at, values.data(), whole);
    size = -static_cast<std::int64_t>(whole);
  }
  out.resize(data_at + static_cast<std::size_t>(std::abs(size)));
  std::memcpy(out.data() + size_at, &size, sizeof size);
}

void put_values(const Values& node, float background, std::vector<float>& scratch,
                std::string& out) {
  assert(64 * node.active.size() == node.values.size());
  const Inactive inactive = inactive_of(node, background);
  put(out, inactive.kind);
  if (inactive.kind == kAll) return put_packed(node.values, out);
  const bool is_first_told = inactive.kind == kOneOther || inactive.kind == kChosenOneOther;
  if (is_first_told || inactive.kind == kChosenOfTwo) put(out, inactive.value[0]);
  if (inactive.kind == kChosenOfTwo) put(out, inactive.value[1]);
  if (inactive.kind >= kChosenOfBackground) put_choice(node, inactive.value[1], out);
  scratch.resize(node.values.size() + 1);
  put_packed({scratch.data(), gather_active(node, scratch.data())}, out);
}

// ---- a grid ------------------------------------------------------------------------------------

/// Writes down the nodes of a grid that it is shown, and keeps where the leaves are.
class Topology final : public LevelVisitor {
 public:
  explicit Topology(float background) : background_(background) {}

  void see_tile(const NodeCoord& origin, float value, bool is_active) override {
    ++tile_count_;
    if (is_active) note_active_tile(coord_of(origin), storage::kUpperSide);
    put(tiles_, origin);
    put(tiles_, value);
    put(tiles_, static_cast<std::uint8_t>(is_active ? 1 : 0));
  }

  void see_branch(const StoredBranch& branch, std::span<const LeafView> leaves) override {
    if (!branch.is_lower()) {
      ++upper_count_;
      put(nodes_, branch.origin);
    }
    put_words(nodes_, branch.children);
    put_words(nodes_, branch.active);
    put_values({branch.active, branch.children, branch.values}, background_, scratch_, nodes_);
    note_active_tiles(branch);
    for (const LeafView& leaf : leaves) {
      put_words(nodes_, leaf.active);
      note_active(leaf);
    }
    leaves_.insert(leaves_.end(), leaves.begin(), leaves.end());
  }

  /// Of all but the values of leaves.
  std::string bytes() const {
    std::string all;
    put(all, std::int32_t{1});  // one buffer
    put(all, background_);
    put(all, tile_count_);
    put(all, upper_count_);
    return all.append(tiles_).append(nodes_);
  }
  const std::vector<LeafView>& leaves() const noexcept { return leaves_; }
  std::int64_t active_count() const noexcept { return active_count_; }
  const openvdb::CoordBBox& active_box() const noexcept { return active_box_; }

 private:
  void note_active(const LeafView& leaf);
  void note_active_tiles(const StoredBranch& branch);
  void note_active_tile(const Coord& origin, int side) {
    active_count_ += std::int64_t{side} * side * side;
    active_box_.expand(openvdb::CoordBBox::createCube(origin, side));
  }

  float background_;
  std::uint32_t tile_count_ = 0;
  std::uint32_t upper_count_ = 0;
  std::string tiles_;
  std::string nodes_;
  std::vector<LeafView> leaves_;
  std::int64_t active_count_ = 0;
  openvdb::CoordBBox active_box_;
  std::vector<float> scratch_;
};

/// The box of a leaf's active nodes, as the leaf counts them.
openvdb::CoordBBox active_box_of(const LeafView& leaf) {
  openvdb::CoordBBox box;
  std::uint64_t any = 0;  // a bit for each (y, z)
  for (int x = 0; x < storage::kLeafSide; ++x) {
    const std::uint64_t plane = leaf.active[static_cast<std::size_t>(x)];
    if (plane == 0) continue;
    box.expand(Coord(x, 0, 0));
    any |= plane;
  }
  if (any == 0) return {};
  std::uint64_t row = 0;
  for (int y = 0; y < storage::kLeafSide; ++y) row |= any >> (8 * y) & 0xffU;
  return {Coord(box.min().x(), std::countr_zero(any) / 8, std::countr_zero(row)),
          Coord(box.max().x(), 7 - std::countl_zero(any) / 8, 63 - std::countl_zero(row))};
}

void Topology::note_active(const LeafView& leaf) {
  for (const std::uint64_t word : leaf.active) active_count_ += std::popcount(word);
  openvdb::CoordBBox box = active_box_of(leaf);
  if (box.empty()) return;
  box.translate(coord_of(leaf.origin));
  active_box_.expand(box);
}

void Topology::note_active_tiles(const StoredBranch& branch) {
  const int log = branch.is_lower() ? 4 : 5;  // of the slots on a side
  const int side = branch.is_lower() ? storage::kLeafSide : storage::kLowerSide;
  for (std::size_t word = 0; word < branch.active.size(); ++word) {
    for (std::uint64_t left = branch.active[word]; left != 0; left &= left - 1) {
      const int n = static_cast<int>(64 * word) + std::countr_zero(left);
      const int along = (1 << log) - 1;
      const Coord slot(n >> (2 * log), n >> log & along, n & along);
      note_active_tile(
          coord_of(branch.origin) + Coord(side * slot.x(), side * slot.y(), side * slot.z()), side);
    }
  }
}

/// What OpenVDB writes beside a grid, for programs that look before they read it.
openvdb::MetaMap metadata_of(const GridToWrite& grid, const Topology& topology) {
  const openvdb::CoordBBox& box = topology.active_box();
  openvdb::MetaMap meta;
  meta.insertMeta("class",
                  openvdb::StringMetadata(openvdb::GridBase::gridClassToString(grid.grid_class)));
  meta.insertMeta("name", openvdb::StringMetadata(grid.name));
  meta.insertMeta("file_bbox_min", openvdb::Vec3IMetadata(box.min().asVec3i()));
  meta.insertMeta("file_bbox_max", openvdb::Vec3IMetadata(box.max().asVec3i()));
  meta.insertMeta("file_voxel_count", openvdb::Int64Metadata(topology.active_count()));
  meta.insertMeta("file_compression",
                  openvdb::StringMetadata(openvdb::io::compressionToString(kCompression)));
  return meta;
}

// ---- a file ------------------------------------------------------------------------------------

class Writer {
 public:
  explicit Writer(const std::filesystem::path& file) : out_(file) {}

  void write_head(const openvdb::MetaMap& meta, std::uint64_t identity, std::size_t grids);
  void write_grid(const GridToWrite& grid);
  /// Whether there is any sense in going on.
  bool goes_on() noexcept {
    is_stopped_ = is_stopped_ || interrupted();
    return out_.good() && !is_stopped_;
  }
  /// Whether something was left out: the interrupt itself may be forgotten meanwhile.
  bool is_stopped() const noexcept { return is_stopped_; }
  Result<void> close() { return out_.close(); }

 private:
  void write_leaves(const std::vector<LeafView>& leaves, float background);

  OutputFile out_;
  bool is_stopped_ = false;
  std::vector<std::string> pieces_;  ///< of a batch of leaves
};

void Writer::write_head(const openvdb::MetaMap& meta, std::uint64_t identity, std::size_t grids) {
  std::string head;
  put(head, std::int64_t{openvdb::OPENVDB_MAGIC});
  put(head, kVdbFormat);
  put(head, std::uint32_t{openvdb::OPENVDB_LIBRARY_MAJOR_VERSION});
  put(head, std::uint32_t{openvdb::OPENVDB_LIBRARY_MINOR_VERSION});
  put(head, std::uint8_t{1});  // it says where its grids are
  std::array<char, kUuidBytes + 1> uuid{};
  constexpr std::uint64_t kSpread = 0x9e3779b97f4a7c15ULL;
  const std::uint64_t other = identity * kSpread;
  std::snprintf(uuid.data(), uuid.size(), "%08x-%04x-4%03x-8%03x-%012llx",
                static_cast<unsigned>(identity >> 32),
                static_cast<unsigned>(identity >> 16 & 0xffff),
                static_cast<unsigned>(identity >> 4 & 0xfff), static_cast<unsigned>(other >> 52),
                static_cast<unsigned long long>(other & 0xffff'ffff'ffff));
  head.append(uuid.data(), kUuidBytes);
  head.append(written([&](std::ostream& to) { meta.writeMeta(to); }));
  put(head, static_cast<std::uint32_t>(grids));
  out_.write(head);
}

/// In batches, so that what is packed and not yet written stays small.
void Writer::write_leaves(const std::vector<LeafView>& leaves, float background) {
  constexpr std::size_t kPiece = 64;
  constexpr std::size_t kBatch = 64 * kPiece;
  pieces_.resize(kBatch / kPiece);
  for (std::size_t begin = 0; begin < leaves.size() && goes_on(); begin += kBatch) {
    const std::size_t end = std::min(begin + kBatch, leaves.size());
    const std::size_t count = (end - begin + kPiece - 1) / kPiece;
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t n) {
      std::string& piece = pieces_[n];
      std::vector<float> scratch;
      piece.clear();
      const std::size_t last = std::min(begin + (n + 1) * kPiece, end);
      for (std::size_t i = begin + n * kPiece; i < last; ++i) {
        put_words(piece, leaves[i].active);
        put_values({leaves[i].active, {}, {leaves[i].values, storage::kLeafNodes}}, background,
                   scratch, piece);
      }
    });
    for (std::size_t n = 0; n < count; ++n) out_.write(pieces_[n]);
  }
}

void Writer::write_grid(const GridToWrite& grid) {
  Topology topology(grid.background);
  grid.show(topology);
  std::string head;
  put_text(head, grid.name);
  put_text(head, VdbGrid::gridType());
  put_text(head, "");  // it shares the tree of no other
  const std::uint64_t head_at = out_.position();
  const std::uint64_t places_at = head_at + head.size();
  struct Places {
    std::uint64_t grid = 0, leaves = 0, end = 0;
  } places;
  places.grid = places_at + sizeof places;
  put(head, places);  // once more when all are known
  put(head, kCompression);
  const openvdb::MetaMap meta = metadata_of(grid, topology);
  const auto transform = grid_transform(grid.voxel_mm, grid.placement);
  head.append(written([&](std::ostream& to) { meta.writeMeta(to); }));
  head.append(written([&](std::ostream& to) { transform->write(to); }));
  out_.write(head);
  out_.write(topology.bytes());
  places.leaves = out_.position();
  write_leaves(topology.leaves(), grid.background);
  places.end = out_.position();
  out_.seek(places_at);
  out_.write(&places, sizeof places);
  out_.seek(places.end);
}

}  // namespace

Result<void> write_vdb(const std::filesystem::path& file, const openvdb::MetaMap& meta,
                       std::uint64_t identity, std::span<const GridToWrite> grids) {
  Writer writer(file);
  writer.write_head(meta, identity, grids.size());
  for (const GridToWrite& grid : grids) {
    if (writer.goes_on()) writer.write_grid(grid);
  }
  if (auto closed = writer.close(); !closed) return closed;
  if (writer.is_stopped()) return Error{ErrorKind::interrupted, "interrupted while writing"};
  return {};
}

}  // namespace argil::io
