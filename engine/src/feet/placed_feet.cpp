// SPDX-License-Identifier: GPL-3.0-or-later
// Which level speaks for a foot is decided by the point of the surface below it: the foot itself
// may lie in a leaf of another level.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <utility>

#include <tbb/parallel_for.h>

#include "feet/feet_tree.h"
#include "field/nesting.h"

namespace argil {
namespace {

/// How far beside its own places a level speaks too, in its voxels: what a foot of the finer level
/// may lie off the point of the surface that it is for.
constexpr double kStripVoxels = 1.0;
constexpr int kOctant = kLeafSide / 2;

/// Feet of a leaf one by one, put into the order and the clusters that they had.
class FeetSieve {
 public:
  explicit FeetSieve(const LayerFeet& from) : from_(from) {}

  /// The feet for which keep(place, normal), both as the leaf has them, turned.
  template <class Keep>
  LayerFeet kept(double layer_mm, const Quat& turn, const Keep& keep) {
    for (std::size_t cluster = 0; cluster < ClusterBoxes::kClusters; ++cluster) {
      for (int n = from_.first[cluster]; n < from_.first[cluster + 1]; ++n) {
        if (from_.field(LayerFeet::kX)[n] == kNowhere) continue;
        const Vec3 place = vector_at(LayerFeet::kX, n);
        const Vec3 normal = vector_at(LayerFeet::kNormalX, n);
        if (!keep(place, normal)) continue;
        add(cluster, rotate(turn, place), rotate(turn, normal), from_.field(LayerFeet::kBend)[n]);
      }
    }
    return joined(layer_mm);
  }

 private:
  using Foot = std::array<float, LayerFeet::kFields>;

  Vec3 vector_at(int field, int n) const noexcept {
    return {static_cast<double>(from_.field(field)[n]),
            static_cast<double>(from_.field(field + 1)[n]),
            static_cast<double>(from_.field(field + 2)[n])};
  }
  void add(std::size_t cluster, const Vec3& place, const Vec3& normal, float bend) {
    Foot foot{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      foot[axis] = static_cast<float>(place[axis]);
      foot[3 + axis] = static_cast<float>(normal[axis]);
    }
    foot[LayerFeet::kBend] = bend;
    feet_[cluster].push_back(foot);
  }
  LayerFeet joined(double layer_mm) const;

  const LayerFeet& from_;
  std::array<std::vector<Foot>, ClusterBoxes::kClusters> feet_;
};

LayerFeet FeetSieve::joined(double layer_mm) const {
  LayerFeet out;
  const auto down = static_cast<float>(layer_mm);
  for (std::size_t cluster = 0; cluster < ClusterBoxes::kClusters; ++cluster) {
    const auto count = static_cast<int>(feet_[cluster].size());
    out.first[cluster + 1] =
        out.first[cluster] + (count + kRowNodes - 1) / kRowNodes * kRowNodes;
  }
  const auto count = static_cast<std::size_t>(out.count());
  out.values.assign(LayerFeet::kFields * count, 0.0F);
  std::fill_n(out.values.begin(), static_cast<std::size_t>(LayerFeet::kNormalX) * count, kNowhere);
  for (std::size_t cluster = 0; cluster < ClusterBoxes::kClusters; ++cluster) {
    PointBox around;
    PointBox below;
    for (std::size_t n = 0; n < feet_[cluster].size(); ++n) {
      const Foot& foot = feet_[cluster][n];
      const std::size_t at = static_cast<std::size_t>(out.first[cluster]) + n;
      for (std::size_t field = 0; field < foot.size(); ++field) {
        out.values[field * count + at] = foot[field];
      }
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const float surface = foot[axis] - down * foot[3 + axis];
        around.low[axis] = std::min(around.low[axis], foot[axis]);
        around.high[axis] = std::max(around.high[axis], foot[axis]);
        below.low[axis] = std::min(below.low[axis], surface);
        below.high[axis] = std::max(below.high[axis], surface);
      }
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      out.feet.low[axis][cluster] = around.low[axis];
      out.feet.high[axis][cluster] = around.high[axis];
      out.surface.low[axis][cluster] = below.low[axis];
      out.surface.high[axis][cluster] = below.high[axis];
    }
    if (feet_[cluster].empty()) continue;
    out.all_feet.include(out.feet, cluster);
    out.all_surface.include(out.surface, cluster);
  }
  return out;
}

/// Where a level speaks for the surface, because no finer one may.
class SpokenFor {
 public:
  /// `is_finest`: no finer level may speak at all.
  SpokenFor(const LevelStack& stack, int level, bool is_finest)
      : finer_(stack, std::max(level - 1, 0)), is_everywhere_(is_finest || level == 0) {}

  /// Whether some point of a box, in nodes of the level, with the strip around it is.
  bool some_of(Vec3 low, Vec3 high) {
    if (is_everywhere_) return true;
    const auto octant = [](double at) { return static_cast<int>(std::floor(at / kOctant)); };
    const Vec3 strip{kStripVoxels, kStripVoxels, kStripVoxels};
    low -= strip;
    high += strip;
    for (int x = octant(low.x); x <= octant(high.x); ++x) {
      for (int y = octant(low.y); y <= octant(high.y); ++y) {
        for (int z = octant(low.z); z <= octant(high.z); ++z) {
          if (!finer_.has_leaf(Coord(x, y, z) << 3)) return true;
        }
      }
    }
    return false;
  }
  bool is_everywhere() const noexcept { return is_everywhere_; }

 private:
  LeafFinder finer_;
  bool is_everywhere_;
};

Vec3 as_vec3(const Coord& at) noexcept { return {1.0 * at.x(), 1.0 * at.y(), 1.0 * at.z()}; }

/// Whether a level speaks for all of a leaf's feet, with nothing to be asked one by one.
bool speaks_for_all(const LevelStack& stack, int level, const Coord& origin, bool is_everywhere) {
  if (is_everywhere) return true;
  LeafFinder finer(stack, level - 1);
  return finer.leaves_of_64((origin << 1).offsetBy(-kLeafSide)) == 0;
}

/// Both sides of one leaf.
std::array<PlacedFeet, 2> feet_of_leaf(LevelReader& reader, int level, const Coord& origin,
                                       bool is_finest, const Placement& placement) {
  const LevelStack& stack = reader.stack();
  const double voxel = stack.voxel_mm(level);
  LeafAndFaces values;
  read_with_faces(reader, level, origin, values);
  const bool is_average = level > 0 && has_child(stack, level, origin);
  LeafLayers layers = find_layers(values, voxel, is_average);
  SpokenFor spoken_for(stack, level, is_finest);
  const bool is_turned = placement.orientation != Quat{};
  const bool is_whole =
      !is_turned && speaks_for_all(stack, level, origin, spoken_for.is_everywhere());
  std::array<PlacedFeet, 2> out;
  for (std::size_t side = 0; side < 2; ++side) {
    LayerFeet& layer = layers[side];
    if (layer.is_empty()) continue;
    out[side].level = level;
    out[side].origin_mm =
        rotate(placement.orientation, node_mm(origin, voxel)) + placement.position_mm;
    if (is_whole) {
      out[side].layer = std::move(layer);
      continue;
    }
    out[side].layer = FeetSieve(layer).kept(
        kLayerVoxels * voxel, placement.orientation, [&](const Vec3& place, const Vec3& normal) {
          const Vec3 at = as_vec3(origin) + place / voxel - kLayerVoxels * normal;
          return spoken_for.some_of(at, at);
        });
  }
  return out;
}

}  // namespace

std::array<std::vector<PlacedFeet>, 2> placed_feet(const LevelStack& stack, int finest,
                                                   const Placement& placement) {
  assert(stack.is_level(finest));
  constexpr std::size_t kAtOnce = 64;
  std::array<std::vector<PlacedFeet>, 2> out;
  for (int level = finest; level < stack.count(); ++level) {
    const std::vector<Coord> origins = stack.sorted_origins(level);
    std::vector<std::array<PlacedFeet, 2>> made(origins.size());
    tbb::parallel_for(std::size_t{0}, (origins.size() + kAtOnce - 1) / kAtOnce,
                      [&](std::size_t chunk) {
                        LevelReader reader(stack);
                        const std::size_t end = std::min(origins.size(), (chunk + 1) * kAtOnce);
                        for (std::size_t n = chunk * kAtOnce; n < end; ++n) {
                          made[n] =
                              feet_of_leaf(reader, level, origins[n], level == finest, placement);
                        }
                      });
    for (auto& sides : made) {
      for (std::size_t side = 0; side < 2; ++side) {
        if (!sides[side].layer.is_empty()) out[side].push_back(std::move(sides[side]));
      }
    }
  }
  return out;
}

}  // namespace argil
