// SPDX-License-Identifier: GPL-3.0-or-later
// Beyond a layer the field is its distance from the surface plus that from the layer. Points are
// taken from layers and not from the surface itself: where the field was averaged, near kinks, its
// band still knows what its zero lost.
#include "window/layer_feet.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>

namespace argil {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::infinity();
constexpr int kSide = 10;  ///< of a leaf's nodes with one beside them
constexpr std::array<int, 3> kStride = {kSide * kSide, kSide, 1};
/// No layer crosses the cube of a node that is farther from it, in voxels: half a diagonal.
constexpr float kFarthest = 0.87F;
/// A gradient below its square is that of a medial sheet.
constexpr float kLeastSquare = 0.25F;
/// The tightest bend that a level can hold, by voxel.
constexpr float kTightest = 0.5F;
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

/// Set by project().
struct Foot {
  std::array<float, 3> place;
  std::array<float, 3> normal;
  float bend;
};

/// Of one node, `at`, `from` the leaf's origin in nodes; false when the layer does not cross its
/// cube.
bool project(const float* at, const std::array<int, 3>& from, float voxel, bool is_average,
             Foot& foot) {
  const float value = *at;
  const float side = value < 0.0F ? -1.0F : 1.0F;
  const float band = static_cast<float>(kHalfWidthVoxels) * voxel;
  const float inverse = 1.0F / voxel;
  float square = 0.0F;
  float reach = 0.0F;
  float sum = 0.0F;
  std::array<float, 3> gradient;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float low = at[-kStride[axis]] - value;
    const float high = at[kStride[axis]] - value;
    // Beyond the band values are cut short, and beyond what is stored not known: straight on.
    const bool is_low = std::abs(at[-kStride[axis]]) < band;
    const bool is_high = std::abs(at[kStride[axis]]) < band;
    gradient[axis] = inverse * (is_low && is_high ? 0.5F * (high - low)
                                                  : (is_low ? -low : (is_high ? high : 0.0F)));
    square += gradient[axis] * gradient[axis];
    reach += std::abs(gradient[axis]);
    sum += is_low && is_high ? low + high : 0.0F;
  }
  const float miss = std::abs(value) - static_cast<float>(kLayerVoxels) * voxel;
  if (square < kLeastSquare || std::abs(miss) > 0.5F * voxel * reach) return false;
  const float laplacian = side * sum * (inverse * inverse);
  const float moved = miss - (is_average ? kAveraged * voxel * voxel * laplacian : 0.0F);
  const float back = side * moved / square;
  const float upward = side / std::sqrt(square);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    foot.place[axis] = static_cast<float>(from[axis]) * voxel - back * gradient[axis];
    foot.normal[axis] = upward * gradient[axis];
  }
  foot.bend = std::clamp(0.5F * laplacian, -kTightest * inverse, kTightest * inverse);
  return true;
}

/// Puts clusters one after the other.
class LayerBuilder {
 public:
  void add(std::size_t cluster, const Foot& foot) noexcept {
    assert(sizes_[cluster] < kMost);
    clusters_[cluster][sizes_[cluster]++] = foot;
  }

  LayerFeet done(float voxel) const {
    LayerFeet layer;
    for (std::size_t n = 0; n < clusters_.size(); ++n) {
      const auto filled = (sizes_[n] + kRowNodes - 1) / kRowNodes * kRowNodes;
      layer.first[n + 1] = layer.first[n] + static_cast<int>(filled);
    }
    const auto count = static_cast<std::size_t>(layer.count());
    layer.values.assign(LayerFeet::kFields * count, 0.0F);
    std::fill_n(layer.values.begin(), LayerFeet::kNormalX * count, kNowhere);
    for (std::size_t n = 0; n < clusters_.size(); ++n) write(n, voxel, layer);
    return layer;
  }

 private:
  void write(std::size_t cluster, float voxel, LayerFeet& layer) const {
    const auto count = static_cast<std::size_t>(layer.count());
    const float down = static_cast<float>(kLayerVoxels) * voxel;
    auto to = static_cast<std::size_t>(layer.first[cluster]);
    for (const Foot& foot : std::span(clusters_[cluster]).first(sizes_[cluster])) {
      std::array<float, 3> below;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        layer.values[axis * count + to] = foot.place[axis];
        layer.values[(LayerFeet::kNormalX + axis) * count + to] = foot.normal[axis];
        below[axis] = foot.place[axis] - down * foot.normal[axis];
      }
      layer.values[LayerFeet::kBend * count + to] = foot.bend;
      layer.feet.include(cluster, foot.place);
      layer.surface.include(cluster, below);
      layer.all_feet.include(foot.place);
      layer.all_surface.include(below);
      ++to;
    }
  }

  static constexpr std::size_t kMost = 64;  ///< the nodes of a cluster
  std::array<std::array<Foot, kMost>, ClusterBoxes::kClusters> clusters_;
  std::array<std::size_t, ClusterBoxes::kClusters> sizes_{};
};

}  // namespace

PointBox::PointBox() noexcept {
  low.fill(kUnknown);
  high.fill(-kUnknown);
}

void PointBox::include(const std::array<float, 3>& point) noexcept {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    low[axis] = std::min(low[axis], point[axis]);
    high[axis] = std::max(high[axis], point[axis]);
  }
}

ClusterBoxes::ClusterBoxes() noexcept {
  for (auto& axis : low) axis.fill(kUnknown);
  for (auto& axis : high) axis.fill(-kUnknown);
}

void ClusterBoxes::include(std::size_t cluster, const std::array<float, 3>& point) noexcept {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    low[axis][cluster] = std::min(low[axis][cluster], point[axis]);
    high[axis][cluster] = std::max(high[axis][cluster], point[axis]);
  }
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

LeafLayers find_layers(const LeafAndFaces& values, double voxel_mm, bool is_average) {
  const auto voxel = static_cast<float>(voxel_mm);
  const float layer = static_cast<float>(kLayerVoxels) * voxel;
  std::array<LayerBuilder, 2> layers;
  for (int i = 0; i < kLeafSide; ++i) {
    for (int j = 0; j < kLeafSide; ++j) {
      for (int k = 0; k < kLeafSide; ++k) {
        const float* at = &values[static_cast<std::size_t>(node_at(i, j, k))];
        Foot foot;
        if (!(std::abs(std::abs(*at) - layer) < kFarthest * voxel) ||
            !project(at, {i, j, k}, voxel, is_average, foot)) {
          continue;
        }
        const auto cluster = static_cast<std::size_t>((i >> 2) * 4 + (j >> 2) * 2 + (k >> 2));
        layers[*at < 0.0F ? 1 : 0].add(cluster, foot);
      }
    }
  }
  return {layers[0].done(voxel), layers[1].done(voxel)};
}

}  // namespace argil
