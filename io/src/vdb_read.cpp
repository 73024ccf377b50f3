// SPDX-License-Identifier: GPL-3.0-or-later
// The layout is that of OpenVDB 10: io/Archive, Grid, Transform, RootNode, InternalNode and
// LeafNode write it one after the other.
#include "vdb_read.h"

#include <algorithm>
#include <atomic>
#include <bit>
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

#include "load_bytes.h"

namespace argil::io {
namespace {

static_assert(std::endian::native == std::endian::little, "files are little-endian");

using Bytes = std::span<const std::byte>;

constexpr std::uint32_t kFormat = 224;
constexpr std::size_t kUuidBytes = 36;
constexpr std::uint32_t kMostGrids = 64;
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

/// What of a node's inactive values is in the file.
enum ValueKind : std::uint8_t {
  kBackground = 0,
  kMinusBackground = 1,
  kOneOther = 2,
  kChosenOfBackground = 3,  ///< by a mask, either sign
  kChosenOneOther = 4,      ///< by a mask, the background or another
  kChosenOfTwo = 5,         ///< by a mask
  kAll = 6,
};

enum Compression : std::uint32_t { kZip = 1, kActiveMask = 2, kBlosc = 4 };
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

template <class Mask>
Mask take_mask(Cursor& in) {
  Mask mask;
  static_assert(Mask::SIZE % 64 == 0);
  const Bytes bytes = in.take(Mask::SIZE / 8);
  for (std::size_t n = 0; 8 * n < bytes.size(); ++n) {
    mask.template getWord<openvdb::Index64>(static_cast<openvdb::Index>(n)) =
        load<openvdb::Index64>(bytes, 8 * n);
  }
  return mask;
}

template <class Mask>
Packed take_values(Cursor& in, std::uint32_t compression, const Mask& active, float background) {
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
  if (kind >= kChosenOfBackground && kind <= kChosenOfTwo) packed.choice = in.take(Mask::SIZE / 8);
  const bool is_sparse = (compression & kActiveMask) != 0 && kind != kAll;
  packed.count = is_sparse ? active.countOn() : Mask::SIZE;
  const std::uint64_t whole = std::uint64_t{4} * packed.count;
  if ((compression & (kBlosc | kZip)) == 0) {
    packed.data = in.take(whole);
    return packed;
  }
  const auto size = in.number<std::int64_t>();
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

/// All values of a node. False when they are not to be had, or are no numbers.
template <class Mask>
bool unpack(const Packed& packed, std::uint32_t compression, const Mask& active, float* out) {
  if (!decompress(packed, compression, out)) return false;
  if (packed.count < Mask::SIZE) {
    // From behind, so that each active value is moved before its place is taken.
    std::uint32_t from = packed.count;
    for (std::uint32_t n = Mask::SIZE; n-- > 0;) {
      if (active.isOn(n)) {
        out[n] = out[--from];
        continue;
      }
      const bool is_second = !packed.choice.empty() &&
                             (std::to_integer<unsigned>(packed.choice[n / 8]) >> (n % 8) & 1U) != 0;
      out[n] = packed.off[is_second ? 1 : 0];
    }
  }
  return std::all_of(out, out + Mask::SIZE, [](float value) { return std::isfinite(value); });
}

// ---- a tree ------------------------------------------------------------------------------------

/// A leaf on its way from the file into the tree.
struct LeafValuesAt {
  VdbLeaf* leaf = nullptr;
  Packed packed;
};

class TreeReader {
 public:
  TreeReader(Cursor& in, std::uint32_t compression) : in_(in), compression_(compression) {}

  /// The tree, as far as there was no fault.
  VdbTree::Ptr read();

 private:
  using UpperMask = VdbUpperNode::NodeMaskType;
  using LowerMask = VdbLowerNode::NodeMaskType;
  using LeafMask = VdbLeaf::NodeMaskType;

  void read_tiles(std::uint32_t count, VdbRoot& root);
  void read_children(std::uint32_t count, VdbRoot& root);
  template <class Node>
  void read_node(Node& node);
  void read_child(VdbUpperNode& node, const Coord& origin);
  void read_child(VdbLowerNode& node, const Coord& origin);
  Coord take_origin();
  void find_leaf_values();
  void unpack_leaves();

  Cursor& in_;
  std::uint32_t compression_;
  float background_ = 0.0F;
  std::vector<LeafValuesAt> leaves_;  ///< in the file's order
};

/// Of a child or tile of the root. They rise, since OpenVDB writes them by their order in a map and
/// reads the values of their leaves in that order again.
Coord TreeReader::take_origin() {
  const auto x = in_.number<std::int32_t>();
  const auto y = in_.number<std::int32_t>();
  const auto z = in_.number<std::int32_t>();
  const Coord origin(x, y, z);
  in_.require((origin & ~(VdbUpperNode::DIM - 1)) == origin,
              "has a node that begins between others");
  return origin;
}

void TreeReader::read_tiles(std::uint32_t count, VdbRoot& root) {
  for (std::uint32_t n = 0; n < count && in_.is_good(); ++n) {
    const Coord origin = take_origin();
    const auto value = in_.number<float>();
    const auto is_active = in_.number<std::uint8_t>();
    in_.require(is_active <= 1 && std::isfinite(value), "has a tile without a value");
    if (in_.is_good()) root.addTile(origin, value, is_active == 1);
  }
}

void TreeReader::read_children(std::uint32_t count, VdbRoot& root) {
  std::optional<Coord> before;
  for (std::uint32_t n = 0; n < count && in_.is_good(); ++n) {
    const Coord origin = take_origin();
    in_.require(!before || *before < origin, "has nodes out of their order");
    if (!in_.is_good()) return;
    before = origin;
    auto node = std::make_unique<VdbUpperNode>(origin, background_, false);
    VdbUpperNode& read = *node;
    root.addChild(node.release());
    read_node(read);
  }
}

/// Masks, tiles and children of an internal node, in the file's order.
template <class Node>
void TreeReader::read_node(Node& node) {
  using Mask = typename Node::NodeMaskType;
  const Mask children = take_mask<Mask>(in_);
  const Mask active = take_mask<Mask>(in_);
  const Packed packed = take_values(in_, compression_, active, background_);
  if (!in_.is_good()) return;
  std::vector<float> values(Node::NUM_VALUES);
  if (!unpack(packed, compression_, active, values.data())) {
    return in_.fail("has values that cannot be decompressed, or are no numbers");
  }
  for (openvdb::Index n = 0; n < Node::NUM_VALUES && in_.is_good(); ++n) {
    if (children.isOn(n)) {
      read_child(node, node.offsetToGlobalCoord(n));
    } else {
      node.addTile(n, values[n], active.isOn(n));
    }
  }
}

void TreeReader::read_child(VdbUpperNode& node, const Coord& origin) {
  auto child = std::make_unique<VdbLowerNode>(origin, background_, false);
  VdbLowerNode& read = *child;
  node.addChild(child.release());
  read_node(read);
}

void TreeReader::read_child(VdbLowerNode& node, const Coord& origin) {
  const auto active = take_mask<LeafMask>(in_);
  if (!in_.is_good()) return;
  auto leaf = std::make_unique<VdbLeaf>(openvdb::PartialCreate(), origin, background_, false);
  leaf->setValueMask(active);
  leaves_.push_back({leaf.get(), {}});
  node.addChild(leaf.release());
}

void TreeReader::find_leaf_values() {
  for (LeafValuesAt& one : leaves_) {
    const auto active = take_mask<LeafMask>(in_);  // once more
    in_.require(active == one.leaf->getValueMask(), "has a leaf that contradicts itself");
    one.packed = take_values(in_, compression_, active, background_);
    if (!in_.is_good()) return;
  }
}

void TreeReader::unpack_leaves() {
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  constexpr std::size_t kGrain = 64;
  std::atomic<std::size_t> bad = kNone;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, leaves_.size(), kGrain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t n = range.begin(); n < range.end(); ++n) {
                        const LeafValuesAt& one = leaves_[n];
                        one.leaf->allocate();
                        if (unpack(one.packed, compression_, one.leaf->getValueMask(),
                                   one.leaf->buffer().data())) {
                          continue;
                        }
                        for (auto least = bad.load();
                             n < least && !bad.compare_exchange_weak(least, n);) {
                        }
                      }
                    });
  if (bad == kNone) return;
  in_.skip_to(leaves_[bad].packed.at);
  in_.fail("has values that cannot be decompressed, or are no numbers");
}

VdbTree::Ptr TreeReader::read() {
  in_.require(in_.number<std::int32_t>() == 1, "has a tree of several buffers");
  background_ = in_.number<float>();
  in_.require(std::isfinite(background_), "has a background that is no number");
  auto tree = std::make_shared<VdbTree>(background_);
  const auto tiles = in_.number<std::uint32_t>();
  const auto children = in_.number<std::uint32_t>();
  read_tiles(tiles, tree->root());
  read_children(children, tree->root());
  if (in_.is_good()) find_leaf_values();
  if (in_.is_good()) unpack_leaves();
  return tree;
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

/// Of cubic voxels, whose map has this one form; null for another.
openvdb::math::Transform::Ptr take_transform(Cursor& in) {
  constexpr std::size_t kNumbers = 15;  // the scale, and what follows from it
  if (in.text() != "UniformScaleMap") return nullptr;
  const Bytes numbers = in.take(kNumbers * sizeof(double));
  if (!in.is_good()) return nullptr;
  const auto voxel = load<double>(numbers.data());
  // OpenVDB throws at less than 1.44e-5; no clay has less than kLeastVoxelMm.
  if (!(voxel >= kLeastVoxelMm && voxel < 1e9)) return nullptr;
  auto transform = openvdb::math::Transform::createLinearTransform(voxel);
  std::ostringstream text;
  transform->write(text);
  const std::string written = text.str();
  const bool is_same = written.size() > numbers.size() &&
                       std::memcmp(written.data() + written.size() - numbers.size(), numbers.data(),
                                   numbers.size()) == 0;
  return is_same ? transform : nullptr;
}

VdbGrid::Ptr take_grid(Cursor& in) {
  const auto compression = in.number<std::uint32_t>();
  in.require((compression & ~std::uint32_t{kCompressions}) == 0, "is compressed in an unknown way");
  openvdb::MetaMap meta = take_metadata(in);
  const openvdb::math::Transform::Ptr transform = take_transform(in);
  if (!in.is_good() || !transform) return nullptr;
  const VdbTree::Ptr tree = TreeReader(in, compression).read();
  if (!in.is_good()) return nullptr;
  VdbGrid::Ptr grid = VdbGrid::create(tree);
  grid->insertMeta(meta);
  grid->setTransform(transform);
  return grid;
}

NamedGrid take_named_grid(Cursor& in) {
  NamedGrid named;
  named.name = in.text();
  const std::string type = in.text();
  in.require(in.text().empty(), "has a grid that shares the tree of another");
  const auto begin = in.number<std::uint64_t>();
  static_cast<void>(in.number<std::uint64_t>());  // where its leaves' values are
  const auto end = in.number<std::uint64_t>();
  in.require(begin == in.at() && end >= begin && end - begin <= in.left(),
             "names a place of a grid where none is");
  if (!in.is_good()) return named;
  if (type == VdbGrid::gridType()) named.grid = take_grid(in);
  if (!in.is_good()) return named;
  in.require(!named.grid || in.at() == end, "has a grid that ends elsewhere than it says");
  in.skip_to(static_cast<std::size_t>(end));
  return named;
}

void take_header(Cursor& in) {
  in.require(in.number<std::int64_t>() == openvdb::OPENVDB_MAGIC, "does not begin as a VDB");
  in.require(in.number<std::uint32_t>() == kFormat, "is of another format of VDB than 224");
  static_cast<void>(in.number<std::uint64_t>());  // the version of the library, two numbers
  in.require(in.number<std::uint8_t>() == 1, "does not say where its grids are");
  static_cast<void>(in.take(kUuidBytes));
}

}  // namespace

Result<VdbContent> read_vdb(std::span<const std::byte> bytes) {
  Cursor in(bytes);
  VdbContent content;
  take_header(in);
  content.meta = take_metadata(in);
  const auto count = in.number<std::uint32_t>();
  in.require(count <= kMostGrids, "has too many grids");
  for (std::uint32_t n = 0; n < count && in.is_good(); ++n) {
    content.grids.push_back(take_named_grid(in));
  }
  if (in.is_good()) return content;
  return Error{ErrorKind::bad_input,
               std::string(in.fault()->what) + " (byte " + std::to_string(in.fault()->at) + ")"};
}

}  // namespace argil::io
