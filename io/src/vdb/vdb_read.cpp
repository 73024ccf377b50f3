// SPDX-License-Identifier: GPL-3.0-or-later
#include "vdb/vdb_read.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>
#include <utility>

#include <blosc.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <zlib.h>

#include "argil/engine/clay.h"
#include "argil/io/safe_file.h"

#include "file/load_bytes.h"
#include "vdb/vdb_layout.h"
#include "vdb/vdb_transform.h"
#include "vdb/vdb_tree.h"

namespace argil::io {
namespace {

using Bytes = std::span<const std::byte>;

// More than any project has, and so few that a wrong count costs nothing.
constexpr std::uint32_t kMostGrids = 25'000;  // of 1000 pieces with all their levels and masks
constexpr std::uint32_t kMostNameBytes = 4096;

/// What a file says that it must not.
struct Fault {
  std::size_t at = 0;
  const char* what = "";
};

/// Takes one field after the other. After a fault everything is zero.
class Cursor {
 public:
  explicit Cursor(Bytes bytes) : bytes_(bytes) {}

  std::size_t at() const noexcept { return at_; }
  std::size_t left() const noexcept { return bytes_.size() - at_; }
  bool is_good() const noexcept { return !fault_; }
  const std::optional<Fault>& fault() const noexcept { return fault_; }

  void fail(const char* what) {
    if (!fault_) fault_ = Fault{at_, what};
  }
  void require(bool is_so, const char* what) {
    if (!is_so) fail(what);
  }

  Bytes take(std::uint64_t size) {
    if (fault_ || size > left()) {
      fail("ends too early");
      return {};
    }
    const Bytes taken = bytes_.subspan(at_, static_cast<std::size_t>(size));
    at_ += taken.size();
    return taken;
  }
  template <class Number>
  Number number() {
    const Bytes taken = take(sizeof(Number));
    return taken.empty() ? Number{} : load<Number>(taken.data());
  }
  std::string text() {
    const auto size = number<std::uint32_t>();
    require(size <= kMostNameBytes, "holds a text that is too long");
    const Bytes taken = take(is_good() ? size : 0);
    return {reinterpret_cast<const char*>(taken.data()), taken.size()};
  }
  void skip_to(std::size_t at) { at_ = at; }

 private:
  Bytes bytes_;
  std::size_t at_ = 0;
  std::optional<Fault> fault_;
};

// ---- values of a node --------------------------------------------------------------------------

constexpr std::uint32_t kCompressions = kZip | kActiveMask | kBlosc;

/// The values of a node as they lie in the file: found, not decompressed.
struct Packed {
  std::size_t at = 0;
  std::uint32_t count = 0;  ///< of numbers in `data`
  float off[2] = {0.0F, 0.0F};
  Bytes choice;  ///< which of the two an inactive value is; empty: the first
  Bytes data;
  bool is_raw = true;
};

/// A bit for each of so many slots or nodes.
template <std::size_t kBits>
using BitMask = std::array<std::uint64_t, kBits / 64>;

template <std::size_t kWords>
bool is_set(const std::array<std::uint64_t, kWords>& mask, std::size_t bit) noexcept {
  return (mask[bit / 64] >> (bit % 64) & 1U) != 0;
}

template <std::size_t kWords>
std::uint32_t count_of(const std::array<std::uint64_t, kWords>& mask) noexcept {
  std::uint32_t count = 0;
  for (const std::uint64_t word : mask) count += static_cast<std::uint32_t>(std::popcount(word));
  return count;
}

template <std::size_t kWords>
void take_mask(Cursor& in, std::array<std::uint64_t, kWords>& mask) {
  const Bytes bytes = in.take(8 * kWords);
  mask = {};
  for (std::size_t n = 0; 8 * n < bytes.size(); ++n) mask[n] = load<std::uint64_t>(bytes, 8 * n);
}

template <std::size_t kWords>
Packed take_values(Cursor& in, std::uint32_t compression,
                   const std::array<std::uint64_t, kWords>& active, float background) {
  constexpr std::uint32_t kValues = 64 * kWords;
  Packed packed;
  packed.at = in.at();
  const auto kind = in.number<std::uint8_t>();
  in.require(kind <= kAll, "says in no known way where values are");
  packed.off[0] = kind == kBackground ? background : -background;
  packed.off[1] = background;
  if (kind == kOneOther || kind == kChosenOneOther || kind == kChosenOfTwo) {
    packed.off[0] = in.number<float>();
  }
  if (kind == kChosenOfTwo) packed.off[1] = in.number<float>();
  if (kind >= kChosenOfBackground && kind <= kChosenOfTwo) packed.choice = in.take(kValues / 8);
  // Then only active values are in the file; the others are one of two.
  const bool is_sparse = (compression & kActiveMask) != 0 && kind != kAll;
  packed.count = is_sparse ? count_of(active) : kValues;
  const std::uint64_t whole = std::uint64_t{4} * packed.count;
  if ((compression & (kBlosc | kZip)) == 0) {
    packed.data = in.take(whole);
    return packed;
  }
  const auto size = in.number<std::int64_t>();
  // OpenVDB writes a negative size where compression would not have made it smaller.
  packed.is_raw = size <= 0;
  if (packed.is_raw) {
    in.require(size == -static_cast<std::int64_t>(whole), "has more or fewer values than nodes");
    packed.data = in.take(whole);
  } else {
    packed.data = in.take(static_cast<std::uint64_t>(size));
  }
  return packed;
}

/// Into as many numbers as the data must hold; false when it holds others.
bool decompress(const Packed& packed, std::uint32_t compression, float* out) {
  const std::size_t whole = sizeof(float) * packed.count;
  if (packed.is_raw) {
    std::memcpy(out, packed.data.data(), whole);
    return true;
  }
  if ((compression & kBlosc) != 0) {
    std::size_t size = 0;
    return blosc_cbuffer_validate(packed.data.data(), packed.data.size(), &size) == 0 &&
           size == whole &&
           blosc_decompress_ctx(packed.data.data(), out, whole, 1) == static_cast<int>(whole);
  }
  auto size = static_cast<uLongf>(whole);
  return uncompress(reinterpret_cast<Bytef*>(out), &size,
                    reinterpret_cast<const Bytef*>(packed.data.data()),
                    static_cast<uLong>(packed.data.size())) == Z_OK &&
         size == whole;
}

/// Puts the active values, which follow one another from `from` on, where they belong, and between
/// them those that are not in the file. One more than those can be read of `from`.
template <std::size_t kWords>
void spread(const Packed& packed, const std::array<std::uint64_t, kWords>& active,
            const float* from, float* out) {
  constexpr std::size_t kRow = 8;
  constexpr unsigned kWhole = 0xff;
  for (std::size_t n = 0; n < 64 * kWords; n += kRow) {
    const auto here = static_cast<unsigned>(active[n / 64] >> (n % 64)) & kWhole;
    if (here == kWhole) {
      std::memcpy(out + n, from, kRow * sizeof(float));
      from += kRow;
      continue;
    }
    const unsigned second =
        packed.choice.empty() ? 0 : std::to_integer<unsigned>(packed.choice[n / kRow]);
    for (unsigned k = 0; k < kRow; ++k) {
      const unsigned is_here = here >> k & 1U;
      const float off = packed.off[second >> k & 1U];
      out[n + k] = is_here != 0 ? *from : off;  // both are read: no branch to guess
      from += is_here;
    }
  }
}

/// Without branches, so that the compiler looks at several at a time.
bool all_finite(const float* values, std::size_t count) {
  constexpr std::uint32_t kExponent = 0x7f800000;
  int others = 0;
  for (std::size_t n = 0; n < count; ++n) {
    others |= (std::bit_cast<std::uint32_t>(values[n]) & kExponent) == kExponent ? 1 : 0;
  }
  return others == 0;
}

/// All values of a node. False when they are not to be had, or are not finite.
template <std::size_t kWords>
bool unpack(const Packed& packed, std::uint32_t compression,
            const std::array<std::uint64_t, kWords>& active, float* out,
            std::vector<float>& scratch) {
  constexpr std::uint32_t kValues = 64 * kWords;
  if (packed.count == kValues) {
    return decompress(packed, compression, out) && all_finite(out, kValues);
  }
  scratch.resize(kValues);  // more than there are active ones
  if (!decompress(packed, compression, scratch.data())) return false;
  spread(packed, active, scratch.data(), out);
  return all_finite(out, kValues);
}

// ---- a tree ------------------------------------------------------------------------------------

class TreeReader {
 public:
  TreeReader(Cursor& in, std::uint32_t compression) : in_(in), compression_(compression) {}

  /// The tree, as far as there was no fault, into what `sink_for(background)` gives; null: nowhere.
  void read(const std::function<LevelSink*(float)>& sink_for);

 private:
  void read_tiles(std::uint32_t count);
  void read_children(std::uint32_t count);
  template <int kSlots>
  void read_branch(const NodeCoord& origin);
  template <int kSlots>
  void read_child(const NodeCoord& origin);
  void read_leaf_mask(const NodeCoord& origin);
  NodeCoord take_origin();
  void find_leaf_values();
  void unpack_leaves();

  Cursor& in_;
  std::uint32_t compression_;
  float background_ = 0.0F;
  LevelSink* sink_ = nullptr;
  std::vector<StoredLeaf> leaves_;  ///< in the file's order
  std::vector<Packed> packed_;      ///< their values
  std::vector<float> scratch_;
};

/// Of a child or tile of the root. They rise, since OpenVDB writes them by their order in a map and
/// reads the values of their leaves in that order again.
NodeCoord TreeReader::take_origin() {
  NodeCoord origin{};
  bool is_aligned = true;
  for (std::int32_t& x : origin) {
    x = in_.number<std::int32_t>();
    is_aligned = is_aligned && (x & (storage::kUpperSide - 1)) == 0;
  }
  in_.require(is_aligned, "has a node that begins between others");
  return origin;
}

void TreeReader::read_tiles(std::uint32_t count) {
  for (std::uint32_t n = 0; n < count && in_.is_good(); ++n) {
    const NodeCoord origin = take_origin();
    const auto value = in_.number<float>();
    const auto is_active = in_.number<std::uint8_t>();
    in_.require(is_active <= 1 && std::isfinite(value), "has a tile without a value");
    if (in_.is_good() && sink_ != nullptr) sink_->add_tile(origin, value, is_active == 1);
  }
}

void TreeReader::read_children(std::uint32_t count) {
  std::optional<NodeCoord> before;
  for (std::uint32_t n = 0; n < count && in_.is_good(); ++n) {
    const NodeCoord origin = take_origin();
    in_.require(!before || *before < origin, "has nodes out of their order");
    if (!in_.is_good()) return;
    before = origin;
    read_branch<storage::kUpperSlots>(origin);
  }
}

/// Masks, tiles and children of a branch, in the file's order.
template <int kSlots>
void TreeReader::read_branch(const NodeCoord& origin) {
  constexpr int kSlotsAlong = kSlots == storage::kUpperSlots ? 32 : 16;
  constexpr int kSlotSide =
      kSlots == storage::kUpperSlots ? storage::kLowerSide : storage::kLeafSide;
  BitMask<kSlots> children;
  BitMask<kSlots> active;
  take_mask(in_, children);
  take_mask(in_, active);
  const Packed packed = take_values(in_, compression_, active, background_);
  if (!in_.is_good()) return;
  std::vector<float> values(kSlots);
  if (!unpack(packed, compression_, active, values.data(), scratch_)) {
    return in_.fail("has values that cannot be decompressed, or are not numbers");
  }
  if (sink_ != nullptr) sink_->add_branch({origin, children, active, values});
  for (int n = 0; n < kSlots && in_.is_good(); ++n) {
    if (!is_set(children, static_cast<std::size_t>(n))) continue;
    read_child<kSlots>({origin[0] + n / (kSlotsAlong * kSlotsAlong) * kSlotSide,
                        origin[1] + n / kSlotsAlong % kSlotsAlong * kSlotSide,
                        origin[2] + n % kSlotsAlong * kSlotSide});
  }
}

template <int kSlots>
void TreeReader::read_child(const NodeCoord& origin) {
  if constexpr (kSlots == storage::kUpperSlots) {
    read_branch<storage::kLowerSlots>(origin);
  } else {
    read_leaf_mask(origin);
  }
}

void TreeReader::read_leaf_mask(const NodeCoord& origin) {
  StoredLeaf leaf{origin, {}};
  take_mask(in_, leaf.active);
  if (in_.is_good()) leaves_.push_back(leaf);
}

void TreeReader::find_leaf_values() {
  packed_.reserve(leaves_.size());
  for (const StoredLeaf& leaf : leaves_) {
    BitMask<storage::kLeafNodes> active;
    take_mask(in_, active);  // once more
    // OpenVDB writes the mask twice, with the topology and with the values.
    in_.require(active == leaf.active, "has a leaf that contradicts itself");
    packed_.push_back(take_values(in_, compression_, active, background_));
    if (!in_.is_good()) return;
  }
}

void TreeReader::unpack_leaves() {
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  constexpr std::size_t kGrain = 64;
  assert(packed_.size() == leaves_.size());
  const std::vector<float*> values =
      sink_ != nullptr ? sink_->add_leaves(leaves_) : std::vector<float*>();
  assert(sink_ == nullptr || values.size() == leaves_.size());
  std::atomic<std::size_t> bad = kNone;
  std::atomic<bool> is_stopped = false;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, leaves_.size(), kGrain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      if (interrupted()) {
                        is_stopped = true;
                        return;
                      }
                      std::vector<float> scratch;
                      std::array<float, storage::kLeafNodes> unwanted;
                      for (std::size_t n = range.begin(); n < range.end(); ++n) {
                        float* const out = sink_ != nullptr ? values[n] : unwanted.data();
                        if (unpack(packed_[n], compression_, leaves_[n].active, out, scratch)) {
                          if (sink_ != nullptr) sink_->leaf_is_filled(n);
                          continue;
                        }
                        // The first in the file's order, whichever thread finds it, so that the
                        // message is always the same.
                        for (auto least = bad.load();
                             n < least && !bad.compare_exchange_weak(least, n);) {
                        }
                      }
                    });
  // Said here too, since the interrupt itself may be forgotten meanwhile.
  in_.require(!is_stopped, "was not read to its end");
  if (bad == kNone) return;
  in_.skip_to(packed_[bad].at);
  in_.fail("has values that cannot be decompressed, or are not numbers");
}

void TreeReader::read(const std::function<LevelSink*(float)>& sink_for) {
  in_.require(in_.number<std::int32_t>() == 1, "has a tree of several buffers");
  background_ = in_.number<float>();
  in_.require(std::isfinite(background_), "has a background that is no number");
  const auto tiles = in_.number<std::uint32_t>();
  const auto children = in_.number<std::uint32_t>();
  if (in_.is_good()) sink_ = sink_for(background_);
  read_tiles(tiles);
  read_children(children);
  if (in_.is_good()) find_leaf_values();
  if (in_.is_good()) unpack_leaves();
}

// ---- a file ------------------------------------------------------------------------------------

/// Of a type that Argil uses; others are left out.
openvdb::Metadata::Ptr metadata_of(const std::string& type, Bytes value) {
  const auto typed = [&]<class T>(T) -> openvdb::Metadata::Ptr {
    if (value.size() != sizeof(T)) return nullptr;
    return std::make_shared<openvdb::TypedMetadata<T>>(load<T>(value.data()));
  };
  if (type == "int32") return typed(std::int32_t{});
  if (type == "int64") return typed(openvdb::Int64{});
  if (type == "float") return typed(float{});
  if (type == "double") return typed(double{});
  if (type != "string") return nullptr;
  return std::make_shared<openvdb::StringMetadata>(
      std::string(reinterpret_cast<const char*>(value.data()), value.size()));
}

openvdb::MetaMap take_metadata(Cursor& in) {
  openvdb::MetaMap meta;
  const auto count = in.number<std::uint32_t>();
  for (std::uint32_t n = 0; n < count && in.is_good(); ++n) {
    const std::string name = in.text();
    const std::string type = in.text();
    const Bytes value = in.take(in.number<std::uint32_t>());
    if (!in.is_good()) break;
    const openvdb::Metadata::Ptr one = metadata_of(type, value);
    if (!one) continue;
    in.require(!name.empty() && !meta[name],
               "names a value of its description twice, or not at all");
    if (in.is_good()) meta.insertMeta(name, *one);
  }
  return meta;
}

/// Of cubic voxels; null for others.
openvdb::math::Transform::Ptr take_transform(Cursor& in) {
  const std::string name = in.text();
  const auto bytes = map_bytes(name);
  if (!bytes) return nullptr;
  const Bytes numbers = in.take(*bytes);
  if (!in.is_good()) return nullptr;
  return read_map(name, {reinterpret_cast<const char*>(numbers.data()), numbers.size()});
}

/// False for a grid with other than cubic voxels, which is passed over.
bool take_grid(Cursor& in, const openvdb::MetaMap& meta, const std::string& name,
               const SinkFor& sink_for) {
  const auto compression = in.number<std::uint32_t>();
  in.require((compression & ~std::uint32_t{kCompressions}) == 0, "is compressed in an unknown way");
  static_cast<void>(take_metadata(in));
  GridHead head{name, take_transform(in), 0.0F};
  if (!in.is_good() || !head.transform) return false;
  TreeReader(in, compression).read([&](float background) {
    head.background = background;
    return sink_for(meta, head);
  });
  return in.is_good();
}

NamedGrid take_named_grid(Cursor& in, const openvdb::MetaMap& meta, const SinkFor& sink_for) {
  NamedGrid named;
  named.name = in.text();
  const std::string type = in.text();
  in.require(in.text().empty(), "has a grid that shares the tree of another");
  const auto begin = in.number<std::uint64_t>();
  static_cast<void>(in.number<std::uint64_t>());  // where its leaves' values are
  const auto end = in.number<std::uint64_t>();
  in.require(begin == in.at() && end >= begin && end - begin <= in.left(),
             "names a position of a grid where none is");
  if (!in.is_good()) return named;
  if (type == VdbGrid::gridType()) {
    named.is_read = take_grid(in, meta, named.name, sink_for);
  }
  if (!in.is_good()) return named;
  in.require(!named.is_read || in.at() == end, "has a grid that ends elsewhere than it says");
  in.skip_to(static_cast<std::size_t>(end));
  return named;
}

void take_header(Cursor& in) {
  in.require(in.number<std::int64_t>() == openvdb::OPENVDB_MAGIC, "does not begin as a VDB");
  in.require(in.number<std::uint32_t>() == kVdbFormat, "is of another format of VDB than 224");
  static_cast<void>(in.number<std::uint64_t>());  // the version of the library, two numbers
  in.require(in.number<std::uint8_t>() == 1, "does not say where its grids are");
  static_cast<void>(in.take(kUuidBytes));
}

}  // namespace

Result<VdbContent> read_vdb(std::span<const std::byte> bytes, const SinkFor& sink_for) {
  Cursor in(bytes);
  VdbContent content;
  take_header(in);
  content.meta = take_metadata(in);
  const auto count = in.number<std::uint32_t>();
  in.require(count <= kMostGrids, "has too many grids");
  for (std::uint32_t n = 0; n < count && in.is_good(); ++n) {
    content.grids.push_back(take_named_grid(in, content.meta, sink_for));
    if (interrupted()) return Error{ErrorKind::interrupted, "was interrupted"};
  }
  if (in.is_good()) return content;
  return Error{ErrorKind::bad_input,
               std::string(in.fault()->what) + " (byte " + std::to_string(in.fault()->at) + ")"};
}

}  // namespace argil::io
