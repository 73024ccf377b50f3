// SPDX-License-Identifier: GPL-3.0-or-later
// A mask is a sparse grid of its own: leaves with 8^3 values where it varies, active tiles of a
// leaf's size where it is constant but differs from its background. `count_` counts both, so that a
// mask of nothing is known without a walk over the tree.
#include "field/mask.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <openvdb/tree/ValueAccessor.h>

#include "argil/core/hash.h"

#include "field/dense_block.h"
#include "field/upsample.h"

namespace argil {
namespace {

using openvdb::CoordBBox;
/// One for each call: it need not be told of changes.
using Reader = openvdb::tree::ValueAccessor<const openvdb::FloatTree, false>;

/// To multiples of 2^-20: both m and 1 - m are exact in float then.
float quantized(float value) {
  constexpr double kSteps = 1 << 20;
  return static_cast<float>(std::floor(static_cast<double>(value) * kSteps + 0.5) / kSteps);
}

/// Farther out than any node all places are one: an int does not hold them.
Coord floor_node(const Vec3& point_mm, double voxel_mm) {
  constexpr double kBeyond = 1e9;
  const Vec3 at = point_mm / voxel_mm;
  return Coord::floor(openvdb::Vec3d(std::clamp(at.x, -kBeyond, kBeyond),
                                     std::clamp(at.y, -kBeyond, kBeyond),
                                     std::clamp(at.z, -kBeyond, kBeyond)));
}

/// All nodes that a reading within the box takes part of.
CoordBBox nodes_around(const Box3& box_mm, double voxel_mm) {
  return {floor_node(box_mm.min, voxel_mm), floor_node(box_mm.max, voxel_mm).offsetBy(1)};
}

CoordBBox nodes_of(const Coord& origin) { return {origin, origin.offsetBy(kLeafSide - 1)}; }
NodeBox as_node_box(const CoordBBox& nodes) { return {nodes.min(), nodes.max()}; }

/// The largest difference of neighbours within a leaf.
float steepest_step(const float* values) {
  float most = 0.0F;
  for (int n = 0; n < kLeafNodes; ++n) {
    for (const int stride : {64, 8, 1}) {
      if ((n / stride) % kLeafSide == kLeafSide - 1) continue;
      most = std::max(most, std::abs(values[n + stride] - values[n]));
    }
  }
  return most;
}

bool is_fraction(float value) { return value >= 0.0F && value <= 1.0F; }

}  // namespace

Mask::Mask(double voxel_mm, float elsewhere)
    : voxel_mm_(voxel_mm), grid_(VdbGrid::create(elsewhere)) {
  assert(voxel_mm > 0.0 && is_fraction(elsewhere));
  grid_->setTransform(openvdb::math::Transform::createLinearTransform(voxel_mm));
  grid_->setGridClass(openvdb::GRID_FOG_VOLUME);
  grid_->setName("mask");
}

std::shared_ptr<Mask> Mask::copy() const {
  auto copy = std::make_shared<Mask>(*this);
  copy->grid_ = grid_->deepCopy();
  return copy;
}

std::int64_t Mask::bytes() const {
  constexpr auto kLeafBytes = static_cast<std::int64_t>(sizeof(VdbLeaf) + sizeof(LeafValues));
  constexpr auto kTileBytes = static_cast<std::int64_t>(sizeof(void*));
  return kLeafBytes * static_cast<std::int64_t>(grid_->tree().leafCount()) + kTileBytes * count_;
}

bool Mask::is_kept(const Coord& origin) const { return grid_->tree().isValueOn(origin); }

const float* Mask::leaf(const Coord& origin) const {
  const VdbLeaf* leaf = grid_->tree().probeConstLeaf(origin);
  return leaf != nullptr ? leaf->buffer().data() : nullptr;
}

void Mask::put(const Coord& origin, const LeafValues& values) {
  assert(is_leaf_origin(origin) && std::all_of(values.begin(), values.end(), is_fraction));
  LeafValues kept;
  std::transform(values.begin(), values.end(), kept.begin(), quantized);
  if (std::all_of(kept.begin(), kept.end(), [&](float value) { return value == kept[0]; })) {
    return put(origin, kept[0]);
  }
  if (!is_kept(origin)) ++count_;
  VdbLeaf* leaf = grid_->tree().touchLeaf(origin);
  std::copy(kept.begin(), kept.end(), leaf->buffer().data());
  leaf->setValuesOn();
}

void Mask::put(const Coord& origin, float value) {
  assert(is_leaf_origin(origin) && is_fraction(value));
  const float kept = quantized(value);
  const bool keeps = kept != elsewhere();
  count_ += static_cast<int>(keeps) - static_cast<int>(is_kept(origin));
  grid_->tree().addTile(1, origin, kept, keeps);
}

std::vector<Coord> Mask::sorted_origins() const {
  std::vector<Coord> origins;
  origins.reserve(static_cast<std::size_t>(count_));
  for (auto leaf = grid_->tree().cbeginLeaf(); leaf; ++leaf) origins.push_back(leaf->origin());
  auto tile = grid_->tree().cbeginValueOn();
  tile.setMaxDepth(openvdb::FloatTree::ValueOnCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile) origins.push_back(tile.getCoord());
  std::sort(origins.begin(), origins.end());
  return origins;
}

void Mask::read(const CoordBBox& nodes, std::vector<float>& out) const {
  const Reader reader(grid_->tree());
  for_each_node(as_node_box(nodes),
                [&](const Coord& node) { out.push_back(reader.getValue(node)); });
}

double Mask::at(const Vec3& point_mm) const {
  assert(is_finite(point_mm));
  const Vec3 at = point_mm / voxel_mm_;
  const Coord low = floor_node(point_mm, voxel_mm_);
  const Reader reader(grid_->tree());
  const std::array<double, 3> t{at.x - low.x(), at.y - low.y(), at.z - low.z()};
  const auto first = static_cast<double>(reader.getValue(low));
  double sum = 0.0;
  bool is_constant = true;
  for (int corner = 0; corner < 8; ++corner) {
    const int i = corner >> 2;
    const int j = (corner >> 1) & 1;
    const int k = corner & 1;
    const auto value = static_cast<double>(reader.getValue(low.offsetBy(i, j, k)));
    is_constant = is_constant && value == first;
    sum += (i != 0 ? t[0] : 1.0 - t[0]) * (j != 0 ? t[1] : 1.0 - t[1]) *
           (k != 0 ? t[2] : 1.0 - t[2]) * value;
  }
  // The weights need not add up to 1 in every bit, and 1 must stay 1.
  return is_constant ? first : std::clamp(sum, 0.0, 1.0);
}

bool Mask::at_nodes(int level, const Coord& origin, LeafValues& out) const {
  assert(level >= 0 && is_leaf_origin(origin));
  const Reader reader(grid_->tree());
  bool any = false;
  const auto read = [&](const Coord& node) {
    const float value = reader.getValue(node);
    any = any || value > 0.0F;
    return value;
  };
  if (level == 0) {
    CoarseNodes coarse;
    const Coord low = coarser(origin);
    std::size_t n = 0;
    for_each_node({low, low.offsetBy(4)}, [&](const Coord& node) { coarse[n++] = read(node); });
    if (any) upsample(coarse, out);
    return any;
  }
  std::size_t n = 0;
  for_each_node(as_node_box(nodes_of(origin)),
                [&](const Coord& node) { out[n++] = read(node << (level - 1)); });
  return any;
}

bool Mask::is_zero_in(const Box3& box_mm) const {
  const CoordBBox box = nodes_around(box_mm, voxel_mm_);
  const Reader reader(grid_->tree());
  bool is_zero = true;
  for_each_leaf_origin(box, [&](const Coord& origin) {
    if (!is_zero) return;
    if (reader.probeConstLeaf(origin) == nullptr) {
      is_zero = reader.getValue(origin) == 0.0F;
      return;
    }
    CoordBBox nodes = nodes_of(origin);
    nodes.intersect(box);
    for_each_node(as_node_box(nodes),
                  [&](const Coord& node) { is_zero = is_zero && reader.getValue(node) == 0.0F; });
  });
  return is_zero;
}

double Mask::slope_in(const Box3& box_mm) const {
  const CoordBBox box = nodes_around(box_mm, voxel_mm_);
  float most = 0.0F;
  for (auto leaf = grid_->tree().cbeginLeaf(); leaf; ++leaf) {
    if (!box.hasOverlap(nodes_of(leaf->origin()))) continue;
    most = std::max(most, steepest_step(leaf->buffer().data()));
  }
  return std::sqrt(3.0) * static_cast<double>(most) / voxel_mm_;
}

std::vector<Coord> Mask::steep_leaves(const Box3& box_mm, double slope_per_mm) const {
  std::vector<Coord> origins;
  for_each_leaf_origin(nodes_around(box_mm, voxel_mm_), [&](const Coord& origin) {
    const float* values = leaf(origin);
    if (values == nullptr) return;
    const double slope = static_cast<double>(steepest_step(values)) / voxel_mm_;
    if (slope > slope_per_mm) origins.push_back(origin);
  });
  return origins;
}

std::uint64_t Mask::hash() const {
  Hash64 hash;
  hash.update(std::as_bytes(std::span(&voxel_mm_, 1)));
  const float rest = elsewhere();
  hash.update(std::as_bytes(std::span(&rest, 1)));
  for (const Coord& origin : sorted_origins()) {
    hash.update(std::as_bytes(std::span(origin.data(), 3)));
    const float* values = leaf(origin);
    const float one = constant(origin);
    hash.update(
        std::as_bytes(values != nullptr ? std::span(values, kLeafNodes) : std::span(&one, 1)));
  }
  return hash.digest();
}

/// All leaves of the new lattice that a kept leaf can reach with its interpolation.
std::shared_ptr<Mask> resampled(const Mask& from, double voxel_mm) {
  auto mask = std::make_shared<Mask>(voxel_mm, from.elsewhere());
  std::vector<Coord> origins;
  for (const Coord& origin : from.sorted_origins()) {
    const auto corner = [&](int step) {
      return Vec3{from.voxel_mm() * (origin.x() + step), from.voxel_mm() * (origin.y() + step),
                  from.voxel_mm() * (origin.z() + step)};
    };
    Box3 box;
    box.include(corner(-1));
    box.include(corner(kLeafSide));
    for_each_leaf_origin(nodes_around(box, voxel_mm),
                         [&](const Coord& reached) { origins.push_back(reached); });
  }
  std::sort(origins.begin(), origins.end());
  origins.erase(std::unique(origins.begin(), origins.end()), origins.end());
  for (const Coord& origin : origins) {
    LeafValues values;
    std::size_t n = 0;
    for_each_node(as_node_box(nodes_of(origin)), [&](const Coord& node) {
      const Vec3 at{voxel_mm * node.x(), voxel_mm * node.y(), voxel_mm * node.z()};
      values[n++] = static_cast<float>(from.at(at));
    });
    mask->put(origin, values);
  }
  return mask;
}

std::shared_ptr<Mask> coarsened(const Mask& from, int steps) {
  assert(steps >= 0);
  auto mask = std::make_shared<Mask>(std::ldexp(from.voxel_mm(), steps), from.elsewhere());
  std::vector<Coord> origins = from.sorted_origins();
  for (Coord& origin : origins) origin = leaf_origin(origin >> steps);
  std::sort(origins.begin(), origins.end());
  origins.erase(std::unique(origins.begin(), origins.end()), origins.end());
  for (const Coord& origin : origins) {
    LeafValues values;
    if (from.at_nodes(steps + 1, origin, values)) {
      mask->put(origin, values);
    } else {
      mask->put(origin, 0.0F);
    }
  }
  return mask;
}

/// Tiles must have the size of a leaf: coarser ones would be kept and counted as one.
const char* fault_of_mask(const VdbGrid& grid, double voxel_mm) {
  if (grid.transform() != Mask(voxel_mm, 0.0F).grid().transform()) return "of another voxel size";
  bool fits = grid.background() == 0.0F || grid.background() == 1.0F;
  for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
    const float* values = leaf->buffer().data();
    fits = fits && leaf->isDense() && std::all_of(values, values + kLeafNodes, is_fraction);
  }
  auto tile = grid.tree().cbeginValueOn();
  tile.setMaxDepth(openvdb::FloatTree::ValueOnCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile) {
    fits = fits && is_fraction(*tile) && tile.getBoundingBox().dim() == Coord(kLeafSide);
  }
  return fits ? nullptr : "with values outside 0 to 1";
}

std::shared_ptr<Mask> mask_of(const VdbGrid& grid, double voxel_mm) {
  assert(fault_of_mask(grid, voxel_mm) == nullptr);
  auto mask = std::make_shared<Mask>(voxel_mm, grid.background());
  for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
    LeafValues values;
    std::copy_n(leaf->buffer().data(), kLeafNodes, values.begin());
    mask->put(leaf->origin(), values);
  }
  auto tile = grid.tree().cbeginValueOn();
  tile.setMaxDepth(openvdb::FloatTree::ValueOnCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile) mask->put(tile.getCoord(), *tile);
  return mask;
}

}  // namespace argil
