// SPDX-License-Identifier: GPL-3.0-or-later
// Newton steps along the gradient of the coarse levels, from the vertex as the clay has it: with
// every update anew, so that errors do not add up.
#include "live/moved_blocks.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "argil/engine/field_sampler.h"

#include "clay/clay_access.h"
#include "surface/block_surface.h"
#include "surface/display_access.h"

namespace argil {
namespace {

/// A step leads across the band at most, three voxels: enough for strokes that pile up 36.
constexpr int kMostMoves = 12;
/// What is left of the difference, in voxels: a hundredth of a voxel two levels finer.
constexpr double kGoodMoveVoxels = 2.5e-3;
/// Squared; where the band ends the gradient vanishes.
constexpr double kLeastMoveSteepness = 0.0625;

Vec3 vec_of_drawn(const std::array<float, 3>& v) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

std::array<float, 3> drawn_of(const Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// What FieldSampler::value gives, bit for bit, several times faster for many points that lie in
/// one leaf of level 0 or beside it.
class LeafSampler {
 public:
  explicit LeafSampler(const Clay& clay)
      : stack_(levels_of(clay)), per_mm_(1.0 / stack_.voxel_mm(0)), anywhere_(clay) {}

  /// Points will mostly lie in this leaf of level 0.
  void open(const Coord& origin) {
    first_ = origin.offsetBy(-kLeafSide);
    for (int n = 0; n < kLeaves; ++n) {
      const VdbLeaf* const leaf = stack_.leaf(0, origin_of(n));
      leaves_[static_cast<std::size_t>(n)] = leaf != nullptr ? values_of(*leaf) : nullptr;
    }
    read_ = 0;
  }

  FieldValue value(const Vec3& place) {
    const Vec3 at = per_mm_ * place;
    // A call of std::floor takes as long as the rest.
    const auto low = [](double x) {
      const int towards_zero = static_cast<int>(x);
      return towards_zero - (x < static_cast<double>(towards_zero) ? 1 : 0);
    };
    const Coord node(low(at.x), low(at.y), low(at.z));
    std::array<float, 8> corners;
    if (!read_corners(node - first_, corners)) {
      const FieldValue far = anywhere_.value(place);
      note_far(place, far.voxel_mm);
      return far;
    }
    const Vec3 fraction = at - Vec3{static_cast<double>(node.x()), static_cast<double>(node.y()),
                                    static_cast<double>(node.z())};
    const Trilinear field(corners);
    return {field.value(fraction), per_mm_ * field.slope(fraction), stack_.voxel_mm(0)};
  }

  /// Whether both store the same values of the nodes from `low` to `high`, so that no point between
  /// them moves. Then their leaves count as read.
  bool agrees_with(const LeafSampler& other, const Coord& low, const Coord& high) {
    std::uint32_t passed = 0;
    for (int x = low.x(); x <= high.x(); ++x) {
      for (int y = low.y(); y <= high.y(); ++y) {
        for (int z = low.z(); z <= high.z(); ++z) {
          const Coord node = Coord(x, y, z) - first_;
          const int number = number_of(node);
          const float* const here = values_in(number);
          const float* const there = other.values_in(number);
          if (here == nullptr || there == nullptr) return false;
          const int offset = leaf_offset(node);
          if (here[offset] != there[offset]) return false;
          passed |= 1U << number;
        }
      }
    }
    read_ |= passed;
    return true;
  }

  /// The leaves in whose cells points lay since this was called last, in order.
  std::vector<LeafKey> take_reads() {
    std::vector<LeafKey> reads = std::exchange(far_, {});
    for (int n = 0; n < kLeaves; ++n) {
      if ((read_ >> n & 1U) != 0) reads.push_back({0, origin_of(n)});
    }
    read_ = 0;
    std::sort(reads.begin(), reads.end());
    reads.erase(std::unique(reads.begin(), reads.end()), reads.end());
    return reads;
  }

 private:
  static constexpr int kLeaves = 27;

  Coord origin_of(int n) const {
    return first_.offsetBy(kLeafSide * (n / 9), kLeafSide * (n / 3 % 3), kLeafSide * (n % 3));
  }
  /// Of the leaf that holds a node, counted from the first leaf's; 27 for none of them.
  static int number_of(const Coord& node) {
    constexpr auto kSide = static_cast<unsigned>(3 * kLeafSide);
    for (int axis = 0; axis < 3; ++axis) {
      if (static_cast<unsigned>(node[axis]) >= kSide) return kLeaves;
    }
    return 9 * (node.x() >> 3) + 3 * (node.y() >> 3) + (node.z() >> 3);
  }
  /// The corners of a cell of level 0; false where one of them is not stored there.
  bool read_corners(const Coord& node, std::array<float, 8>& corners) {
    const int here = number_of(node);
    const float* const values = values_in(here);
    if (values == nullptr) return false;
    const auto offset = static_cast<std::size_t>(leaf_offset(node));
    constexpr int kLast = kLeafSide - 1;
    if ((node.x() & 7) < kLast && (node.y() & 7) < kLast && (node.z() & 7) < kLast) {
      for (std::size_t n = 0; n < 8; ++n) {
        corners[n] = values[offset + 64 * (n >> 2) + 8 * (n >> 1 & 1) + (n & 1)];
      }
    } else {
      for (int n = 0; n < 8; ++n) {
        const Coord corner = node.offsetBy(n >> 2, n >> 1 & 1, n & 1);
        const float* const there = values_in(number_of(corner));
        if (there == nullptr) return false;
        corners[static_cast<std::size_t>(n)] = there[leaf_offset(corner)];
      }
    }
    read_ |= 1U << here;
    return true;
  }
  const float* values_in(int number) const {
    return number < kLeaves ? leaves_[static_cast<std::size_t>(number)] : nullptr;
  }
  void note_far(const Vec3& place, double voxel_mm) {
    const int level = static_cast<int>(std::lround(std::log2(voxel_mm * per_mm_)));
    const auto node = [&](double x) { return static_cast<int>(std::floor(x / voxel_mm)); };
    const LeafKey where{level, leaf_origin(Coord(node(place.x), node(place.y), node(place.z)))};
    if (far_.empty() || !(far_.back() == where)) far_.push_back(where);
  }

  const LevelStack& stack_;
  double per_mm_;  ///< cells of level 0
  FieldSampler anywhere_;
  Coord first_;
  std::array<const float*, kLeaves> leaves_{};
  std::uint32_t read_ = 0;  ///< which of these
  std::vector<LeafKey> far_;
};

/// Moves vertices between two clays.
class VertexMover {
 public:
  VertexMover(const Clay& before, const Clay& now) : before_(before), now_(now) {}

  /// The vertices to come lie in this leaf.
  void open(const LeafKey& at) {
    // Of a coarser one any leaf of level 0 will do.
    before_.open(at.origin << at.level);
    now_.open(at.origin << at.level);
  }
  std::vector<LeafKey> take_reads() { return now_.take_reads(); }

  /// Whether no vertex moves of a block with this origin, `steps` levels finer than these are.
  bool is_still(const Coord& origin, int steps) {
    // Vertices lie up to a fraction of its voxels outside.
    const Coord low = origin.offsetBy(-1) >> steps;
    const Coord high = (origin.offsetBy(kLeafSide + 1) >> steps).offsetBy(1);
    return now_.agrees_with(before_, low, high);
  }

  DisplayVertex moved(const DisplayVertex& vertex) {
    const Vec3 start = vec_of_drawn(vertex.position_mm);
    const Vec3 normal = vec_of_drawn(vertex.normal);
    const FieldValue was = before_.value(start);
    FieldValue at = now_.value(start);
    Vec3 place = start;
    for (int i = 0; i < kMostMoves; ++i) {
      const double left = at.distance_mm - was.distance_mm;
      if (std::abs(left) <= kGoodMoveVoxels * at.voxel_mm) break;
      const double steepness = dot(at.gradient, at.gradient);
      place -= steepness < kLeastMoveSteepness ? left * normal : (left / steepness) * at.gradient;
      at = now_.value(place);
    }
    // Also its bits stay, so that blocks which see no change fit to those that do.
    if (place == start) return vertex;
    // The detail's own slope goes with it.
    const Vec3 turned = normal + normalized(at.gradient) - normalized(was.gradient);
    return {drawn_of(place), drawn_of(normalized(turned))};
  }

 private:
  LeafSampler before_;
  LeafSampler now_;
};

/// The vertices of a block `steps` levels finer as they are now, in `to`. Says whether any differs
/// from the clay's.
bool move_block(VertexMover& mover, const DrawnBlock& block, const Coord& origin, int steps,
                std::vector<DisplayVertex>& to) {
  if (steps >= 0 && mover.is_still(origin, steps)) return false;
  bool is_moved = false;
  to.resize(block.vertices.size());
  for (std::size_t i = 0; i < to.size(); ++i) {
    to[i] = mover.moved(block.vertices[i]);
    is_moved = is_moved || to[i] != block.vertices[i];
  }
  return is_moved;
}

}  // namespace

MovedBlocks::MovedBlocks(const DisplaySurface& shown, const Clay& before, const Clay& now,
                         int level)
    : shown_(shown),
      before_(before),
      now_(now),
      by_leaf_(shown, level),
      moves_(by_leaf_.groups().size()) {}

void MovedBlocks::to_do(std::size_t group) {
  if (group == moves_.size() || std::exchange(moves_[group].is_to_do, true)) return;
  jobs_.push_back(group);
  if (!std::exchange(moves_[group].is_followed, true)) followed_.push_back(group);
}

/// Blocks in leaves that see a change, and those whose vertices went where one is seen.
void MovedBlocks::choose(const std::vector<LeafChange>& changes) {
  const auto seeing = leaves_that_see(levels_of(now_), changes);
  for (std::size_t n = 0; n < followed_.size(); ++n) {
    const std::vector<LeafKey>& reads = moves_[followed_[n]].reads;
    const bool is_to_do = std::any_of(reads.begin(), reads.end(), [&](const LeafKey& at) {
      return seeing[static_cast<std::size_t>(at.level)].get(at.origin) != 0;
    });
    if (is_to_do) to_do(followed_[n]);
  }
  for (std::size_t level = 0; level < seeing.size(); ++level) {
    seeing[level].for_each([&](const Coord& origin, std::uint8_t) {
      LeafKey at{static_cast<int>(level), origin};
      // A view may draw the clay coarser than these levels are.
      for (; at.level < static_cast<int>(seeing.size()); ++at.level) {
        to_do(by_leaf_.group_of(at));
        at.origin = leaf_origin(coarser(at.origin));
      }
    });
  }
}

std::int64_t MovedBlocks::update(const std::optional<std::vector<LeafChange>>& changes,
                                 BlockLists& lists) {
  jobs_.clear();
  if (changes) {
    choose(*changes);
  } else {
    for (std::size_t group = 0; group < moves_.size(); ++group) to_do(group);
  }
  const auto work = [&](VertexMover& mover, std::size_t group, std::vector<DisplayVertex>& fresh) {
    const std::vector<BlockId>& blocks = by_leaf_.groups()[group].blocks;
    Moves& moves = moves_[group];
    moves.vertices.resize(blocks.size());
    moves.differs.assign(blocks.size(), false);
    mover.open(by_leaf_.groups()[group].around);
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      const LeafKey at = leaf_of(blocks[i]);
      if (!move_block(mover, DisplayAccess::block(shown_, blocks[i]), at.origin,
                      by_leaf_.level() - at.level, fresh)) {
        fresh.clear();
      }
      moves.differs[i] = fresh != moves.vertices[i];
      if (moves.differs[i]) std::swap(fresh, moves.vertices[i]);
    }
    moves.reads = mover.take_reads();
    moves.is_to_do = false;
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, jobs_.size()),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      VertexMover mover(before_, now_);
                      std::vector<DisplayVertex> fresh;
                      for (std::size_t n = range.begin(); n < range.end(); ++n) {
                        work(mover, jobs_[n], fresh);
                      }
                    });
  std::int64_t count = 0;
  for (const std::size_t group : jobs_) {
    const std::vector<BlockId>& blocks = by_leaf_.groups()[group].blocks;
    count += static_cast<std::int64_t>(blocks.size());
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      if (moves_[group].differs[i]) lists.changed.push_back(blocks[i]);
    }
  }
  return count;
}

DisplayBlock MovedBlocks::block(const BlockId& id) const {
  const std::size_t group = by_leaf_.group_of(by_leaf_.leaf_around(id));
  if (group == moves_.size() || !moves_[group].is_followed) return shown_.block(id);
  const std::vector<BlockId>& blocks = by_leaf_.groups()[group].blocks;
  const auto at =
      static_cast<std::size_t>(std::find(blocks.begin(), blocks.end(), id) - blocks.begin());
  if (at == blocks.size() || moves_[group].vertices[at].empty()) return shown_.block(id);
  DisplayBlock block{moves_[group].vertices[at], DisplayAccess::block(shown_, id).triangles, {}};
  for (const DisplayVertex& vertex : block.vertices) {
    block.bounds_mm.include(vec_of_drawn(vertex.position_mm));
  }
  return block;
}

}  // namespace argil
