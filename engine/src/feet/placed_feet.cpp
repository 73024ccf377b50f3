// SPDX-License-Identifier: GPL-3.0-or-later
// Which level speaks for a foot is decided by the point of the surface below it: the foot itself
// may lie in a leaf of another level. Where two sides of the surface are as near, a foot of a
// coarser level takes something of both; it stands for neither, and is left out.
#include "feet/placed_feet.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include <tbb/parallel_for.h>

#include "field/leaf_finder.h"
#include "field/nesting.h"

namespace argil {
namespace {

/// How far beside its own places a level speaks too, in its voxels, so that nothing falls between
/// two levels.
constexpr double kStripVoxels = 0.25;
constexpr int kOctant = kLeafSide / 2;
// Where two sides of the surface are as near, a foot takes something of both and stands for
// neither.
/// How far from 0 the field may be at the point of the surface below a foot, in voxels: at sharp
/// corners the level has lost about half a voxel.
constexpr double kAstrayVoxels = 0.6;
/// The cosine that normal and gradient have at least half way to that point: they are the same all
/// along a normal, above sharp edges too.
constexpr double kLeastCosine = 0.93;

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
    out.first[cluster + 1] = out.first[cluster] + (count + kRowNodes - 1) / kRowNodes * kRowNodes;
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

/// Where a level speaks for the surface: where it is stored and no finer one may speak.
class SpokenFor {
 public:
  /// `is_finest`: no finer level may speak at all.
  SpokenFor(const LevelStack& stack, int level, bool is_finest)
      : own_(stack, level),
        finer_(stack, std::max(level - 1, 0)),
        is_finest_(is_finest || level == 0) {}

  enum class Part { none, some, all };

  /// Whether some point of the strip around a place, in nodes of the level, is.
  bool near(const Vec3& place) { return within(place, place) != Part::none; }

  /// How much is of the octants that the strip around a box meets.
  Part within(const Vec3& lowest, const Vec3& highest) {
    const auto octant = [](double at) { return static_cast<int>(std::floor(at / kOctant)); };
    const Vec3 strip{kStripVoxels, kStripVoxels, kStripVoxels};
    const Vec3 low = lowest - strip;
    const Vec3 high = highest + strip;
    bool any = false;
    bool all = true;
    for (int x = octant(low.x); x <= octant(high.x); ++x) {
      for (int y = octant(low.y); y <= octant(high.y); ++y) {
        for (int z = octant(low.z); z <= octant(high.z); ++z) {
          const Coord at(x, y, z);
          const bool is = own_.has_leaf(at << 2) && (is_finest_ || !finer_.has_leaf(at << 3));
          any = any || is;
          all = all && is;
          if (any && !all) return Part::some;
        }
      }
    }
    return any ? Part::all : Part::none;
  }

 private:
  LeafFinder own_;
  LeafFinder finer_;
  bool is_finest_;
};

Vec3 as_vec3(const Coord& at) noexcept { return {1.0 * at.x(), 1.0 * at.y(), 1.0 * at.z()}; }

/// Of one leaf.
using SideFeet = std::array<PlacedFeet, 2>;

/// Of one level.
class LevelFeet {
 public:
  LevelFeet(const LevelStack& stack, int level, bool is_finest, const FeetWanted& wanted)
      : reader_(stack),
        level_(level),
        voxel_(stack.voxel_mm(level)),
        placement_(wanted.placement),
        sides_(wanted.sides),
        spoken_for_(stack, level, is_finest) {}

  /// Both sides of one leaf, stored or not.
  SideFeet of_leaf(const Coord& origin);

 private:
  struct Cell {
    double value = 0.0;
    Vec3 slope;  ///< in mm a node
  };
  std::optional<Cell> cell_at(const Vec3& place);
  bool is_astray(const Vec3& surface, const Vec3& normal, double side);
  SpokenFor::Part below(const Coord& origin, const PointBox& surface_mm);

  LevelReader reader_;
  int level_;
  double voxel_;
  const Placement& placement_;
  std::array<bool, 2> sides_;
  SpokenFor spoken_for_;
};

/// The field between the nodes around a place, in nodes, as far as they are stored.
std::optional<LevelFeet::Cell> LevelFeet::cell_at(const Vec3& place) {
  const Coord low = Coord::floor(openvdb::Vec3d(place.x, place.y, place.z));
  const Coord in_leaf = low & (kLeafSide - 1);
  const bool is_in_one = std::max({in_leaf.x(), in_leaf.y(), in_leaf.z()}) < kLeafSide - 1;
  std::array<double, 8> corner;
  const VdbLeaf* leaf = reader_.leaf(level_, low);
  for (int n = 0; n < 8; ++n) {
    const Coord node = low.offsetBy(n >> 2, n >> 1 & 1, n & 1);
    if (!is_in_one) leaf = reader_.leaf(level_, node);
    if (leaf == nullptr) return std::nullopt;
    corner[static_cast<std::size_t>(n)] = static_cast<double>(values_of(*leaf)[leaf_offset(node)]);
  }
  const Vec3 up = place - as_vec3(low);
  const auto mix = [](double from, double to, double part) { return from + part * (to - from); };
  std::array<double, 4> along_x;  // of the four edges
  std::array<double, 4> slope_x;
  for (std::size_t n = 0; n < 4; ++n) {
    along_x[n] = mix(corner[n], corner[4 + n], up.x);
    slope_x[n] = corner[4 + n] - corner[n];
  }
  const std::array<double, 2> along_y = {mix(along_x[0], along_x[2], up.y),
                                         mix(along_x[1], along_x[3], up.y)};
  Cell cell;
  cell.value = mix(along_y[0], along_y[1], up.z);
  cell.slope = {mix(mix(slope_x[0], slope_x[2], up.y), mix(slope_x[1], slope_x[3], up.y), up.z),
                mix(along_x[2] - along_x[0], along_x[3] - along_x[1], up.z),
                along_y[1] - along_y[0]};
  return cell;
}

/// Whether the level, where it is stored, says that a foot stands for no point of the surface. Of
/// the finest none does: there the crease between two sides is sharp, and find_layers() sees it.
bool LevelFeet::is_astray(const Vec3& surface, const Vec3& normal, double side) {
  if (level_ == 0) return false;
  const std::optional<Cell> below = cell_at(surface);
  if (below && std::abs(below->value) > kAstrayVoxels * voxel_) return true;
  const std::optional<Cell> half_way = cell_at(surface + (0.5 * kLayerVoxels) * normal);
  return half_way && side * dot(half_way->slope, normal) < kLeastCosine * length(half_way->slope);
}

/// How much of what lies below the feet of a leaf the level speaks for.
SpokenFor::Part LevelFeet::below(const Coord& origin, const PointBox& surface_mm) {
  constexpr double kFloatRounding = 1e-3;  // of places, in nodes
  Box3 box;
  for (const auto& corner : {surface_mm.low, surface_mm.high}) {
    const Vec3 off{static_cast<double>(corner[0]), static_cast<double>(corner[1]),
                   static_cast<double>(corner[2])};
    box.include(as_vec3(origin) + off / voxel_);
  }
  const Vec3 wider{kFloatRounding, kFloatRounding, kFloatRounding};
  return spoken_for_.within(box.min - wider, box.max + wider);
}

SideFeet LevelFeet::of_leaf(const Coord& origin) {
  SideFeet out;
  if (reader_.look(level_, origin).is_far) return out;
  LeafAndFaces values;
  if (read_with_faces(reader_, level_, origin, values).is_far) return out;
  const bool is_average = level_ > 0 && has_child(reader_.stack(), level_, origin);
  LeafLayers layers = find_layers(values, voxel_, is_average, sides_);
  for (std::size_t side = 0; side < 2; ++side) {
    LayerFeet& layer = layers[side];
    if (layer.is_empty()) continue;
    const SpokenFor::Part spoken = below(origin, layer.all_surface);
    if (spoken == SpokenFor::Part::none) continue;
    const bool is_whole = spoken == SpokenFor::Part::all;
    out[side].level = level_;
    out[side].origin_mm =
        rotate(placement_.orientation, node_mm(origin, voxel_)) + placement_.position_mm;
    if (is_whole && level_ == 0 && placement_.orientation == Quat{}) {
      out[side].layer = std::move(layer);
      continue;
    }
    out[side].layer = FeetSieve(layer).kept(
        kLayerVoxels * voxel_, placement_.orientation, [&](const Vec3& place, const Vec3& normal) {
          const Vec3 surface = as_vec3(origin) + place / voxel_ - kLayerVoxels * normal;
          return (is_whole || spoken_for_.near(surface)) &&
                 !is_astray(surface, normal, side == 0 ? 1.0 : -1.0);
        });
  }
  return out;
}

/// The leaves of a level and those beside them, sorted: a foot for the surface in one may lie in
/// the other.
std::vector<Coord> leaves_and_neighbours(const LevelStack& stack, int level) {
  std::vector<Coord> all;
  LeafFinder stored(stack, level);
  for (const Coord& origin : stack.sorted_origins(level)) {
    all.push_back(origin);
    for (int n = 0; n < 27; ++n) {
      const Coord beside = origin + (Coord(n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1) << 3);
      if (!stored.has_leaf(beside)) all.push_back(beside);
    }
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace

std::optional<SidesOfFeet> placed_feet(const LevelStack& stack, const FeetWanted& wanted,
                                       const Progress& progress) {
  assert(stack.is_level(wanted.finest));
  constexpr std::size_t kAtOnce = 64;
  constexpr std::size_t kPerReport = 128 * kAtOnce;
  SidesOfFeet out;
  for (int level = wanted.finest; level < stack.count(); ++level) {
    const std::vector<Coord> origins = leaves_and_neighbours(stack, level);
    for (std::size_t begin = 0; begin < origins.size(); begin += kPerReport) {
      const double done = static_cast<double>(begin) / static_cast<double>(origins.size());
      if (progress && !progress("surface", done)) return std::nullopt;
      const std::size_t count = std::min(kPerReport, origins.size() - begin);
      std::vector<SideFeet> made(count);
      tbb::parallel_for(std::size_t{0}, (count + kAtOnce - 1) / kAtOnce, [&](std::size_t chunk) {
        LevelFeet feet(stack, level, level == wanted.finest, wanted);
        const std::size_t end = std::min(count, (chunk + 1) * kAtOnce);
        for (std::size_t n = chunk * kAtOnce; n < end; ++n) {
          made[n] = feet.of_leaf(origins[begin + n]);
        }
      });
      for (SideFeet& sides : made) {
        for (std::size_t side = 0; side < 2; ++side) {
          if (!sides[side].layer.is_empty()) out[side].push_back(std::move(sides[side]));
        }
      }
    }
  }
  return out;
}

}  // namespace argil
