// SPDX-License-Identifier: GPL-3.0-or-later
// Which triangles bound which solid, and whose each leaf is: most leaves lie in reach of one part
// alone and are taken as they are.
#include "operation/split_levels.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include <openvdb/tools/SignedFloodFill.h>

#include "argil/engine/mesh_distance.h"

#include "edit/prune.h"
#include "edit/redistance.h"
#include "field/mask.h"
#include "field/nesting.h"
#include "field/parallel.h"
#include "operation/combine.h"
#include "operation/prepared_operation.h"

namespace argil {
namespace {

constexpr std::uint32_t kNoShell = std::numeric_limits<std::uint32_t>::max();

/// A node of a coarser level is an average over its neighbours, which lie so far away at most: as
/// near as that to another part's half of the gap it holds some of that part's distances.
constexpr double kGapVoxels = 3.5;

// ---- solids of a surface -----------------------------------------------------------------------

/// Sets that are joined step by step; each is called by its least member.
class JoinedSets {
 public:
  explicit JoinedSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }
  std::uint32_t root(std::uint32_t n) {
    while (parent_[n] != n) {
      parent_[n] = parent_[parent_[n]];
      n = parent_[n];
    }
    return n;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

/// A connected part of the surface: an outer shell, or a cavity, whose volume is negative.
struct Shell {
  double volume_mm3 = 0.0;
  Box3 box;
  std::uint32_t rightmost = 0;  ///< the vertex with the largest x
  std::vector<std::uint32_t> triangles;
};

/// Whether a point lies left of the way from a to b, seen along -x: the same for both triangles
/// that share the edge, since the ends are taken in one order.
bool is_left(const Vec3& a, const Vec3& b, const Vec3& p) {
  const bool is_turned = b.y < a.y || (b.y == a.y && b.z < a.z);
  const Vec3& from = is_turned ? b : a;
  const Vec3& to = is_turned ? a : b;
  const double area = (to.y - from.y) * (p.z - from.z) - (to.z - from.z) * (p.y - from.y);
  return is_turned ? area <= 0.0 : area >= 0.0;
}

/// Where a line along x through a point meets a triangle; nothing beside it or along it.
std::optional<double> x_on(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
  const bool first = is_left(a, b, p);
  const bool second = is_left(b, c, p);
  const bool third = is_left(c, a, p);
  const bool is_in =
      (first && second && third) || (is_left(b, a, p) && is_left(c, b, p) && is_left(a, c, p));
  const Vec3 normal = cross(b - a, c - a);
  if (!is_in || normal.x == 0.0) return std::nullopt;
  return a.x - (normal.y * (p.y - a.y) + normal.z * (p.z - a.z)) / normal.x;
}

class ShellList {
 public:
  explicit ShellList(const TriangleMesh& surface);
  /// Joins each cavity with the solid that it is in.
  JoinedSets joined() const;
  const std::vector<Shell>& shells() const noexcept { return shells_; }

 private:
  std::uint32_t first_hit(std::uint32_t cavity) const;

  const TriangleMesh& surface_;
  std::vector<Shell> shells_;
};

ShellList::ShellList(const TriangleMesh& surface) : surface_(surface) {
  JoinedSets sets(surface.positions.size());
  for (const Triangle& t : surface.triangles) {
    sets.join(t[0], t[1]);
    sets.join(t[0], t[2]);
  }
  std::vector<std::uint32_t> number(surface.positions.size(), kNoShell);
  for (std::size_t n = 0; n < surface.triangles.size(); ++n) {
    const Triangle& t = surface.triangles[n];
    std::uint32_t& shell = number[sets.root(t[0])];
    if (shell == kNoShell) {
      shell = static_cast<std::uint32_t>(shells_.size());
      shells_.emplace_back().rightmost = t[0];
    }
    Shell& own = shells_[shell];
    own.triangles.push_back(static_cast<std::uint32_t>(n));
    const Vec3& a = surface.positions[t[0]];
    const Vec3& b = surface.positions[t[1]];
    const Vec3& c = surface.positions[t[2]];
    own.volume_mm3 += dot(a, cross(b, c)) / 6.0;
    for (const std::uint32_t corner : t) {
      own.box.include(surface.positions[corner]);
      if (surface.positions[corner].x > surface.positions[own.rightmost].x) own.rightmost = corner;
    }
  }
}

/// What a line meets that goes to the right from a cavity's rightmost vertex: it runs through the
/// solid there, and so to where that ends.
std::uint32_t ShellList::first_hit(std::uint32_t cavity) const {
  const Vec3& from = surface_.positions[shells_[cavity].rightmost];
  double nearest = std::numeric_limits<double>::infinity();
  std::uint32_t hit = kNoShell;
  for (std::uint32_t n = 0; n < shells_.size(); ++n) {
    const Box3& box = shells_[n].box;
    const bool is_beside = n == cavity || box.max.x < from.x || box.min.y > from.y ||
                           box.max.y < from.y || box.min.z > from.z || box.max.z < from.z;
    if (is_beside) continue;
    for (const std::uint32_t triangle : shells_[n].triangles) {
      const Triangle& t = surface_.triangles[triangle];
      const auto x =
          x_on(surface_.positions[t[0]], surface_.positions[t[1]], surface_.positions[t[2]], from);
      if (!x || *x < from.x || *x >= nearest) continue;
      nearest = *x;
      hit = n;
    }
  }
  return hit;
}

JoinedSets ShellList::joined() const {
  JoinedSets solids(shells_.size());
  for (std::uint32_t n = 0; n < shells_.size(); ++n) {
    if (shells_[n].volume_mm3 >= 0.0) continue;
    const std::uint32_t around = first_hit(n);
    if (around != kNoShell) solids.join(n, around);
  }
  return solids;
}

// ---- leaves ------------------------------------------------------------------------------------

/// Which parts lie in reach of a place, and how far.
class PartFinder {
 public:
  PartFinder(const TriangleMesh& surface, const std::vector<std::uint32_t>& part_of,
             std::size_t count)
      : part_of_(part_of),
        boxes_(count),
        triangles_(count),
        all_(surface.positions, surface.triangles) {
    for (std::size_t n = 0; n < part_of.size(); ++n) {
      assert(part_of[n] < count);
      triangles_[part_of[n]].push_back(surface.triangles[n]);
      for (const std::uint32_t corner : surface.triangles[n]) {
        boxes_[part_of[n]].include(surface.positions[corner]);
      }
    }
    for (const std::vector<Triangle>& own : triangles_) {
      parts_.push_back(std::make_unique<MeshDistance>(surface.positions, own));
    }
  }

  /// Those with a triangle within `reach_mm`, in their order.
  std::vector<std::uint32_t> near(const Vec3& p, double reach_mm) const {
    std::vector<std::uint32_t> found;
    for (std::uint32_t n = 0; n < parts_.size(); ++n) {
      if (!is_box_near(boxes_[n], p, reach_mm)) continue;
      if (parts_[n]->closest(p, reach_mm).triangle != kNoTriangle) found.push_back(n);
    }
    return found;
  }
  /// Whose surface is the nearest. `hint`: as of MeshDistance, and what was found.
  std::uint32_t owner(const Vec3& p, std::uint32_t& hint) const {
    hint = all_.closest(p, std::numeric_limits<double>::infinity(), hint).triangle;
    assert(hint != kNoTriangle);
    return part_of_[hint];
  }
  double distance(std::uint32_t part, const Vec3& p, double most_mm) const {
    return parts_[part]->closest(p, most_mm).distance;
  }

 private:
  static bool is_box_near(const Box3& box, const Vec3& p, double reach_mm) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (p[axis] < box.min[axis] - reach_mm || p[axis] > box.max[axis] + reach_mm) return false;
    }
    return true;
  }

  const std::vector<std::uint32_t>& part_of_;
  std::vector<Box3> boxes_;
  std::vector<std::vector<Triangle>> triangles_;
  MeshDistance all_;
  std::vector<std::unique_ptr<MeshDistance>> parts_;
};

/// A leaf as one part has it.
struct PartLeaf {
  std::uint32_t part = 0;
  LeafValues values;
};

class LevelSplitter {
 public:
  LevelSplitter(const LevelStack& from, const PartFinder& parts) : from_(from), parts_(parts) {}

  /// Of each part that has one there.
  std::vector<PartLeaf> leaves_of(int level, const Coord& origin) const;

 private:
  const LevelStack& from_;
  const PartFinder& parts_;
};

std::vector<PartLeaf> LevelSplitter::leaves_of(int level, const Coord& origin) const {
  const double voxel = from_.voxel_mm(level);
  const float band = from_.band_mm(level);
  const float* values = values_of(*from_.leaf(level, origin));
  const double half = 0.5 * (kLeafSide - 1) * voxel;
  const Vec3 middle = node_mm(origin, voxel) + Vec3{half, half, half};
  std::vector<std::uint32_t> near =
      parts_.near(middle, std::sqrt(3.0) * half + static_cast<double>(band));
  std::uint32_t hint = kNoTriangle;
  if (near.empty()) near.push_back(parts_.owner(middle, hint));
  std::vector<PartLeaf> leaves(near.size());
  for (std::size_t n = 0; n < near.size(); ++n) {
    leaves[n].part = near[n];
    std::copy_n(values, kLeafNodes, leaves[n].values.begin());
  }
  if (near.size() == 1) return leaves;
  for (int n = 0; n < kLeafNodes; ++n) {
    const Vec3 p = node_mm(origin.offsetBy(n >> 6, n >> 3 & 7, n & 7), voxel);
    const std::uint32_t owner = parts_.owner(p, hint);
    const double reach = std::abs(static_cast<double>(values[n])) + kGapVoxels * voxel;
    const bool is_mixed = values[n] > 0.0F && std::any_of(near.begin(), near.end(), [&](auto part) {
                            return part != owner && parts_.distance(part, p, reach) < reach;
                          });
    for (PartLeaf& leaf : leaves) {
      if (leaf.part == owner && !is_mixed) continue;
      // Whoever is in a solid is nearest to that solid's own surface: this is outside.
      leaf.values[static_cast<std::size_t>(n)] =
          static_cast<float>(parts_.distance(leaf.part, p, static_cast<double>(band)));
    }
  }
  std::erase_if(leaves,
                [band](const PartLeaf& leaf) { return !has_band(leaf.values.data(), band); });
  return leaves;
}

/// False: asked to stop.
bool split_level(const LevelStack& from, const PartFinder& parts, int level,
                 std::vector<std::unique_ptr<LevelStack>>& to, const Progress& progress) {
  constexpr std::size_t kLeavesAtOnce = 1024;
  const LevelSplitter splitter(from, parts);
  const std::vector<Coord> origins = from.sorted_origins(level);
  for (std::size_t begin = 0; begin < origins.size(); begin += kLeavesAtOnce) {
    const double done = static_cast<double>(begin) / static_cast<double>(origins.size());
    if (progress && !progress("split", done)) return false;
    const std::size_t count = std::min(kLeavesAtOnce, origins.size() - begin);
    std::vector<std::vector<PartLeaf>> leaves(count);
    for_each_leaf(
        count, [&](std::size_t n) { leaves[n] = splitter.leaves_of(level, origins[begin + n]); });
    for (std::size_t n = 0; n < count; ++n) {
      for (const PartLeaf& leaf : leaves[n]) {
        to[leaf.part]->set_leaf(level, origins[begin + n], leaf.values.data());
      }
    }
  }
  return true;
}

/// As good as levels that strokes leave. False: asked to stop.
bool finish_levels(const LevelStack& from, double tolerance_mm, LevelStack& levels,
                   const Progress& progress) {
  openvdb::tools::signedFloodFill(levels.grid(levels.top()).tree());
  for (int level = 0; level <= levels.top(); ++level) {
    drop_bandless(levels, level);
    if (level < levels.top()) prune_level(levels, level, tolerance_mm);
  }
  if (!redistance_levels(levels, tolerance_mm, progress)) return false;
  if (from.mask() != nullptr) {
    levels.exchange_mask(from.mask()->copy());
    levels.drop_mask_of_nothing();
  }
  return true;
}

}  // namespace

SurfaceSolids solids_of(const TriangleMesh& surface) {
  const ShellList list(surface);
  const std::vector<Shell>& shells = list.shells();
  JoinedSets joined = list.joined();
  std::map<std::uint32_t, double> volumes;  // by the first shell of each
  for (std::uint32_t n = 0; n < shells.size(); ++n) volumes[joined.root(n)] += shells[n].volume_mm3;
  std::vector<std::pair<std::uint32_t, double>> order(volumes.begin(), volumes.end());
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  SurfaceSolids solids;
  std::vector<std::uint32_t> number(shells.size(), kNoShell);
  for (const auto& [root, volume] : order) {
    number[root] = static_cast<std::uint32_t>(solids.volume_mm3.size());
    solids.volume_mm3.push_back(volume);
  }
  solids.of_triangle.resize(surface.triangles.size());
  for (std::uint32_t n = 0; n < shells.size(); ++n) {
    for (const std::uint32_t triangle : shells[n].triangles) {
      solids.of_triangle[triangle] = number[joined.root(n)];
    }
  }
  return solids;
}

Result<std::vector<std::unique_ptr<LevelStack>>> split_levels(
    const LevelStack& from, const TriangleMesh& surface, const std::vector<std::uint32_t>& part_of,
    std::size_t count, double tolerance_mm, const Progress& progress) {
  assert(part_of.size() == surface.triangles.size() && count > 0);
  const PartFinder parts(surface, part_of, count);
  std::vector<std::unique_ptr<LevelStack>> levels;
  for (std::size_t n = 0; n < count; ++n) {
    levels.push_back(std::make_unique<LevelStack>(from.voxel_mm(0), from.count()));
  }
  for (int level = from.top(); level >= 0; --level) {
    if (!split_level(from, parts, level, levels, progress)) return operation_interrupted();
  }
  for (const std::unique_ptr<LevelStack>& own : levels) {
    if (!finish_levels(from, tolerance_mm, *own, progress)) return operation_interrupted();
    if (has_inside(*own)) continue;
    return bad_operation(
        "a part of the clay is thinner than its voxels hold by itself; smooth it away, or resample "
        "the clay finer");
  }
  return levels;
}

}  // namespace argil
