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
/// How much a slope falls from one side of a node to the other at a crease, at least.
constexpr float kCreased = 0.25F;
/// Gradients above its square are no mixture of the two sides of a crease.
constexpr float kMixedSquare = 0.9F;
/// Mean curvatures of a layer, by voxel, between which it becomes that of an edge where it bends
/// one way only.
constexpr float kRounded = 0.1F;
constexpr float kEdged = 0.25F;
/// The tightest bend that a level can hold, by voxel: of a layer around an edge.
constexpr float kTightest = 0.57F;
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

/// The slopes of |phi| at one node along each axis, in voxels per voxel.
struct Slopes {
  std::array<float, 3> below;  ///< from the node before
  std::array<float, 3> above;  ///< to the node after
  unsigned creased = 0;        ///< bits of the axes along which it falls off to both sides
};

/// Beyond the band values are cut short, and beyond what is stored not known: straight on.
Slopes slopes_at(const float* at, float side, float inverse, float band) {
  Slopes slopes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float before = at[-kStride[axis]];
    const float after = at[kStride[axis]];
    const float below = side * inverse * (*at - before);
    const float above = side * inverse * (after - *at);
    const bool knows_before = std::abs(before) < band;
    const bool knows_after = std::abs(after) < band;
    slopes.below[axis] = knows_before ? below : (knows_after ? above : 0.0F);
    slopes.above[axis] = knows_after ? above : (knows_before ? below : 0.0F);
    if (below - above > kCreased) slopes.creased |= 1U << axis;
  }
  return slopes;
}

/// The gradient of |phi|. Next to a crease, where the nearest point of the surface jumps, central
/// differences mix the slopes on both of its sides; there it is that of one side: of all choices of
/// one difference along each creased axis the one whose length is nearest to 1.
std::array<float, 3> gradient_of(const Slopes& slopes, unsigned& one_sided) {
  std::array<float, 3> mean;
  float square = 0.0F;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    mean[axis] = 0.5F * (slopes.below[axis] + slopes.above[axis]);
    square += mean[axis] * mean[axis];
  }
  one_sided = 0;
  if (slopes.creased == 0 || square > kMixedSquare) return mean;
  std::array<float, 3> best = mean;
  float least = std::abs(1.0F - square);
  for (unsigned choice = 0; choice < 8; ++choice) {
    if ((choice & ~slopes.creased) != 0) continue;
    std::array<float, 3> gradient = mean;
    float length2 = 0.0F;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if ((slopes.creased >> axis & 1U) != 0) {
        gradient[axis] = (choice >> axis & 1U) != 0 ? slopes.above[axis] : slopes.below[axis];
      }
      length2 += gradient[axis] * gradient[axis];
    }
    if (!(std::abs(1.0F - length2) < least)) continue;
    least = std::abs(1.0F - length2);
    best = gradient;
    one_sided = slopes.creased;
  }
  return best;
}

/// What the greatest curvature of a layer is above the mean one, by voxel, as far as second
/// differences along the axes tell it: theirs is that of mean curvature and of a difference of both
/// curvatures, turned about the normal; a turn that no axis sees counts for nothing. Where the
/// layer bends around an edge, the rays of its points part across the edge: nodes above them lie
/// off the nearest ray in that direction, and the mean would be too flat for all.
float edge_bend(const Slopes& slopes, const std::array<float, 3>& normal, float mean) {
  constexpr float kUnseen = 0.1F;  // keeps apart what is told from what is not
  std::size_t least = 0;
  for (std::size_t axis = 1; axis < 3; ++axis) {
    if (std::abs(normal[axis]) < std::abs(normal[least])) least = axis;
  }
  std::array<float, 3> a;  // a and b span the tangents
  const float scale = 1.0F / std::sqrt(1.0F - normal[least] * normal[least]);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    a[axis] = scale * ((axis == least ? 1.0F : 0.0F) - normal[least] * normal[axis]);
  }
  float uu = kUnseen, uv = 0.0F, vv = kUnseen, ud = 0.0F, vd = 0.0F;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t next = (axis + 1) % 3;
    const std::size_t last = (axis + 2) % 3;
    const float b = normal[next] * a[last] - normal[last] * a[next];
    const float u = a[axis] * a[axis] - b * b;
    const float v = 2.0F * a[axis] * b;
    const float off =
        slopes.above[axis] - slopes.below[axis] - mean * (1.0F - normal[axis] * normal[axis]);
    uu += u * u;
    uv += u * v;
    vv += v * v;
    ud += u * off;
    vd += v * off;
  }
  const float inverse = 1.0F / (uu * vv - uv * uv);
  const float p = inverse * (vv * ud - uv * vd);
  const float q = inverse * (uu * vd - uv * ud);
  const float share = std::min((mean - kRounded) / (kEdged - kRounded), 1.0F);
  return share * std::min(std::sqrt(p * p + q * q), mean);
}

/// Of one node, `at`, `from` the leaf's origin in nodes; false when the layer does not cross its
/// cube.
bool project(const float* at, const std::array<int, 3>& from, float voxel, bool is_average,
             Foot& foot) {
  const float side = *at < 0.0F ? -1.0F : 1.0F;
  const float inverse = 1.0F / voxel;
  const Slopes slopes = slopes_at(at, side, inverse, static_cast<float>(kHalfWidthVoxels) * voxel);
  unsigned one_sided = 0;
  const std::array<float, 3> gradient = gradient_of(slopes, one_sided);
  float square = 0.0F;
  float reach = 0.0F;
  float sum = 0.0F;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    square += gradient[axis] * gradient[axis];
    reach += std::abs(gradient[axis]);
    // A crease is no bend of the layer beside it.
    if ((one_sided >> axis & 1U) == 0) sum += slopes.above[axis] - slopes.below[axis];
  }
  const float miss = std::abs(*at) - static_cast<float>(kLayerVoxels) * voxel;
  if (square < kLeastSquare || std::abs(miss) > 0.5F * voxel * reach) return false;
  const float laplacian = inverse * sum;
  const float moved = miss - (is_average ? kAveraged * voxel * voxel * laplacian : 0.0F);
  const float back = moved / square;
  const float upward = 1.0F / std::sqrt(square);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    foot.place[axis] = static_cast<float>(from[axis]) * voxel - back * gradient[axis];
    foot.normal[axis] = upward * gradient[axis];
  }
  const float mean = 0.5F * sum;
  const float edge = mean <= kRounded ? 0.0F : edge_bend(slopes, foot.normal, mean);
  foot.bend = inverse * std::clamp(mean + edge, -kTightest, kTightest);
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
