// SPDX-License-Identifier: GPL-3.0-or-later
// Beyond a layer the field is its distance from the surface plus that from the layer. Points are
// taken from layers and not from the surface itself: where the field was averaged, near kinks, its
// band still knows what its zero lost.
#include "feet/layer_feet.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace argil {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::infinity();
constexpr int kFacesSide = 10;  ///< of a leaf's nodes with one beside them
constexpr std::array<int, 3> kStride = {kFacesSide * kFacesSide, kFacesSide, 1};
/// What averaging over 27 nodes adds, by the square of a voxel and the Laplacian.
constexpr float kAveraged = 1.0F / 12.0F;

/// Of a leaf's node, each from -1 to kLeafSide, in a LeafAndFaces.
constexpr int node_at(int i, int j, int k) noexcept {
  return (i + 1) * kStride[0] + (j + 1) * kStride[1] + k + 1;
}

/// The nodes beside a face of a leaf, face 2 a the low one of axis a, from the leaf they are in, or
/// `none` where there is none.
void set_face(int face, const float* beside, float none, LeafAndFaces& values) {
  constexpr std::array<int, 3> kLeafStride = {64, 8, 1};
  const auto axis = static_cast<std::size_t>(face >> 1);
  const bool is_low = (face & 1) == 0;
  const std::size_t first = axis == 0 ? 1 : 0;
  const std::size_t second = axis == 2 ? 1 : 2;
  const int to = node_at(0, 0, 0) + (is_low ? -1 : kLeafSide) * kStride[axis];
  const int from = is_low ? (kLeafSide - 1) * kLeafStride[axis] : 0;
  for (int i = 0; i < kLeafSide; ++i) {
    for (int j = 0; j < kLeafSide; ++j) {
      float& out = values[static_cast<std::size_t>(to + i * kStride[first] + j * kStride[second])];
      out = beside != nullptr ? beside[from + i * kLeafStride[first] + j * kLeafStride[second]]
                              : none;
    }
  }
}

/// Puts clusters one after the other.
LayerFeet joined(const LayerPoints& points, std::size_t side) {
  LayerFeet layer;
  layer.feet = points.feet[side];
  layer.surface = points.surface[side];
  for (std::size_t n = 0; n < ClusterBoxes::kClusters; ++n) {
    const int filled = (points.count[side][n] + kRowNodes - 1) / kRowNodes * kRowNodes;
    layer.first[n + 1] = layer.first[n] + filled;
  }
  const auto count = static_cast<std::size_t>(layer.count());
  if (count == 0) return layer;
  layer.values.assign(LayerFeet::kFields * count, 0.0F);
  std::fill_n(layer.values.begin(), LayerFeet::kNormalX * count, kNowhere);
  for (std::size_t n = 0; n < ClusterBoxes::kClusters; ++n) {
    if (points.count[side][n] == 0) continue;
    for (std::size_t field = 0; field < LayerFeet::kFields; ++field) {
      std::copy_n(points.values[side][n][field], points.count[side][n],
                  &layer.values[field * count + static_cast<std::size_t>(layer.first[n])]);
    }
    layer.all_feet.include(layer.feet, n);
    layer.all_surface.include(layer.surface, n);
  }
  return layer;
}

}  // namespace

PointBox::PointBox() noexcept {
  low.fill(kUnknown);
  high.fill(-kUnknown);
}

void PointBox::include(const ClusterBoxes& boxes, std::size_t cluster) noexcept {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    low[axis] = std::min(low[axis], boxes.low[axis][cluster]);
    high[axis] = std::max(high[axis], boxes.high[axis][cluster]);
  }
}

std::uint64_t label_of(int level, const Coord& origin, std::size_t side,
                       std::size_t cluster) noexcept {
  // Neighbours differ: their numbers along the axes are spread over the bits.
  const auto along = [&](int axis, unsigned half) {
    return static_cast<unsigned>(origin[axis] >> 2) + half;
  };
  const unsigned number = along(0, static_cast<unsigned>(cluster >> 2)) * 25U +
                          along(1, static_cast<unsigned>(cluster >> 1 & 1)) * 5U +
                          along(2, static_cast<unsigned>(cluster & 1)) +
                          static_cast<unsigned>(level) * 13U + static_cast<unsigned>(side) * 31U;
  return std::uint64_t{1} << (number % 64U);
}

LevelReader::Reading read_with_faces(LevelReader& reader, int level, const Coord& origin,
                                     LeafAndFaces& values) {
  const float band = reader.stack().band_mm(level);
  LeafValues interpolated;
  LevelReader::Reading reading{level, false};
  const float* nodes = nullptr;
  if (const VdbLeaf* leaf = reader.leaf(level, origin)) {
    nodes = values_of(*leaf);
  } else {
    reading = reader.read(level, {origin, origin.offsetBy(kLeafSide - 1)}, interpolated);
    if (reading.is_far) return reading;
    nodes = interpolated.data();
  }
  for (int row = 0; row < kLeafRows; ++row) {
    std::memcpy(&values[static_cast<std::size_t>(node_at(row >> 3, row & 7, 0))],
                nodes + static_cast<std::ptrdiff_t>(row) * kRowNodes, kRowNodes * sizeof(float));
  }
  for (int face = 0; face < 6; ++face) {
    const int axis = face >> 1;
    Coord beside = origin;
    beside[axis] += (face & 1) == 0 ? -1 : kLeafSide;
    const VdbLeaf* leaf = reader.leaf(level, beside);
    set_face(face, leaf != nullptr ? values_of(*leaf) : nullptr, band, values);
  }
  return reading;
}

LeafLayers find_layers(const LeafAndFaces& values, double voxel_mm, bool is_average,
                       const std::array<bool, 2>& wanted) {
  const auto voxel = static_cast<float>(voxel_mm);
  LayerRule rule{};
  rule.voxel = voxel;
  rule.band = static_cast<float>(kHalfWidthVoxels) * voxel;
  rule.layer = static_cast<float>(kLayerVoxels);
  rule.averaged = is_average ? kAveraged * voxel * voxel : 0.0F;
  for (std::size_t side = 0; side < 2; ++side) rule.is_wanted[side] = wanted[side];
  LayerPoints points;
  row_loops().project_to_layers(values.data(), rule, points);
  return {joined(points, 0), joined(points, 1)};
}

}  // namespace argil
