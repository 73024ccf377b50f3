// SPDX-License-Identifier: GPL-3.0-or-later
#include "mask.h"

#include <algorithm>
#include <cmath>

#include <openvdb/tree/ValueAccessor.h>

#include "argil/core/hash.h"

#include "level_block.h"

namespace argil {
namespace {

using openvdb::CoordBBox;
/// One for each call: it need not be told of changes.
using Reader = openvdb::tree::ValueAccessor<const openvdb::FloatTree, false>;

/// Places whose middle lies nearer to the surface than this many finest voxels count node by node:
/// from the middle to a corner are 14.
constexpr double kNearVoxels = 24.0;

float quantized(float value) {
  constexpr double kSteps = 1 << 20;
  return static_cast<float>(std::floor(static_cast<double>(value) * kSteps + 0.5) / kSteps);
}

Coord floor_node(const Vec3& point_mm, double voxel_mm) {
  const Vec3 at = point_mm / voxel_mm;
  return Coord::floor(openvdb::Vec3d(at.x, at.y, at.z));
}

/// All nodes that a reading within the box takes part of.
CoordBBox nodes_around(const Box3& box_mm, double voxel_mm) {
  return {floor_node(box_mm.min, voxel_mm), floor_node(box_mm.max, voxel_mm).offsetBy(1)};
}

CoordBBox nodes_of(const Coord& place) { return {place, place.offsetBy(kLeafSide - 1)}; }
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

bool is_share(float value) { return value >= 0.0F && value <= 1.0F; }

}  // namespace

Mask::Mask(double voxel_mm, float elsewhere)
    : voxel_mm_(voxel_mm), grid_(VdbGrid::create(elsewhere)) {
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

bool Mask::is_kept(const Coord& place) const { return grid_->tree().isValueOn(place); }

const float* Mask::leaf(const Coord& place) const {
  const VdbLeaf* leaf = grid_->tree().probeConstLeaf(place);
  return leaf != nullptr ? leaf->buffer().data() : nullptr;
}

void Mask::put(const Coord& place, const LeafValues& values) {
  LeafValues kept;
  std::transform(values.begin(), values.end(), kept.begin(), quantized);
  if (std::all_of(kept.begin(), kept.end(), [&](float value) { return value == kept[0]; })) {
    return put(place, kept[0]);
  }
  if (!is_kept(place)) ++count_;
  VdbLeaf* leaf = grid_->tree().touchLeaf(place);
  std::copy(kept.begin(), kept.end(), leaf->buffer().data());
  leaf->setValuesOn();
}

void Mask::put(const Coord& place, float value) {
  const float kept = quantized(value);
  const bool keeps = kept != elsewhere();
  count_ += static_cast<int>(keeps) - static_cast<int>(is_kept(place));
  grid_->tree().addTile(1, place, kept, keeps);
}

std::vector<Coord> Mask::sorted_places() const {
  std::vector<Coord> places;
  places.reserve(static_cast<std::size_t>(count_));
  for (auto leaf = grid_->tree().cbeginLeaf(); leaf; ++leaf) places.push_back(leaf->origin());
  auto tile = grid_->tree().cbeginValueOn();
  tile.setMaxDepth(openvdb::FloatTree::ValueOnCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile) places.push_back(tile.getCoord());
  std::sort(places.begin(), places.end());
  return places;
}

void Mask::read(const CoordBBox& nodes, std::vector<float>& out) const {
  const Reader reader(grid_->tree());
  for_each_node(as_node_box(nodes),
                [&](const Coord& node) { out.push_back(reader.getValue(node)); });
}

double Mask::at(const Vec3& point_mm) const {
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

bool Mask::at_nodes(int level, const Coord& place, LeafValues& out) const {
  const Reader reader(grid_->tree());
  bool any = false;
  const auto read = [&](const Coord& node) {
    const float value = reader.getValue(node);
    any = any || value > 0.0F;
    return value;
  };
  if (level == 0) {
    CoarseNodes coarse;
    const Coord low = coarser(place);
    std::size_t n = 0;
    for_each_node({low, low.offsetBy(4)}, [&](const Coord& node) { coarse[n++] = read(node); });
    if (any) upsample(coarse, out);
    return any;
  }
  std::size_t n = 0;
  for_each_node(as_node_box(nodes_of(place)),
                [&](const Coord& node) { out[n++] = read(node << (level - 1)); });
  return any;
}

bool Mask::is_zero_in(const Box3& box_mm) const {
  const CoordBBox box = nodes_around(box_mm, voxel_mm_);
  const Reader reader(grid_->tree());
  bool is_zero = true;
  for_each_place(box, [&](const Coord& place) {
    if (!is_zero) return;
    if (reader.probeConstLeaf(place) == nullptr) {
      is_zero = reader.getValue(place) == 0.0F;
      return;
    }
    CoordBBox nodes = nodes_of(place);
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

std::vector<Coord> Mask::steep_places(const Box3& box_mm, double slope_per_mm) const {
  std::vector<Coord> places;
  for_each_place(nodes_around(box_mm, voxel_mm_), [&](const Coord& place) {
    const float* values = leaf(place);
    if (values == nullptr) return;
    const double slope = static_cast<double>(steepest_step(values)) / voxel_mm_;
    if (slope > slope_per_mm) places.push_back(place);
  });
  return places;
}

std::uint64_t Mask::hash() const {
  Hash64 hash;
  hash.update(std::as_bytes(std::span(&voxel_mm_, 1)));
  const float rest = elsewhere();
  hash.update(std::as_bytes(std::span(&rest, 1)));
  for (const Coord& place : sorted_places()) {
    hash.update(std::as_bytes(std::span(place.data(), 3)));
    const float* values = leaf(place);
    const float one = constant(place);
    hash.update(
        std::as_bytes(values != nullptr ? std::span(values, kLeafNodes) : std::span(&one, 1)));
  }
  return hash.digest();
}

bool is_near_surface(const LevelStack& stack, const Coord& mask_place) {
  const double near = kNearVoxels * stack.voxel_mm(0);
  // Where the coarsest level does not look that far, nothing is known to be far.
  if (static_cast<double>(stack.band_mm(stack.top())) < near) return true;
  const Coord middle = mask_place.offsetBy(kLeafSide / 2);
  static_assert(kMaskVoxels == 2);
  const float distance = stack.node_value(0, middle << 1);
  return std::abs(static_cast<double>(distance)) < near;
}

std::shared_ptr<Mask> resampled(const Mask& from, double voxel_mm) {
  auto mask = std::make_shared<Mask>(voxel_mm, from.elsewhere());
  std::vector<Coord> places;
  for (const Coord& place : from.sorted_places()) {
    const auto corner = [&](int step) {
      return Vec3{from.voxel_mm() * (place.x() + step), from.voxel_mm() * (place.y() + step),
                  from.voxel_mm() * (place.z() + step)};
    };
    Box3 box;
    box.include(corner(-1));
    box.include(corner(kLeafSide));
    for_each_place(nodes_around(box, voxel_mm),
                   [&](const Coord& reached) { places.push_back(reached); });
  }
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  for (const Coord& place : places) {
    LeafValues values;
    std::size_t n = 0;
    for_each_node(as_node_box(nodes_of(place)), [&](const Coord& node) {
      const Vec3 at{voxel_mm * node.x(), voxel_mm * node.y(), voxel_mm * node.z()};
      values[n++] = static_cast<float>(from.at(at));
    });
    mask->put(place, values);
  }
  return mask;
}

std::shared_ptr<Mask> coarsened(const Mask& from, int steps) {
  auto mask = std::make_shared<Mask>(std::ldexp(from.voxel_mm(), steps), from.elsewhere());
  std::vector<Coord> places = from.sorted_places();
  for (Coord& place : places) place = place_of(place >> steps);
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  for (const Coord& place : places) {
    LeafValues values;
    if (from.at_nodes(steps + 1, place, values)) {
      mask->put(place, values);
    } else {
      mask->put(place, 0.0F);
    }
  }
  return mask;
}

const char* fault_of_mask(const VdbGrid& grid, double voxel_mm) {
  if (grid.transform() != Mask(voxel_mm, 0.0F).grid().transform()) return "of another voxel size";
  bool fits = grid.background() == 0.0F || grid.background() == 1.0F;
  for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
    const float* values = leaf->buffer().data();
    fits = fits && leaf->isDense() && std::all_of(values, values + kLeafNodes, is_share);
  }
  auto tile = grid.tree().cbeginValueOn();
  tile.setMaxDepth(openvdb::FloatTree::ValueOnCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile) {
    fits = fits && is_share(*tile) && tile.getBoundingBox().dim() == Coord(kLeafSide);
  }
  return fits ? nullptr : "that holds no shares from 0 to 1";
}

std::shared_ptr<Mask> mask_of(const VdbGrid& grid, double voxel_mm) {
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
