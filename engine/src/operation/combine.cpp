// SPDX-License-Identifier: GPL-3.0-or-later
// Minimum or maximum of two distances, level by level. Planning goes from the coarsest level down
// and asks only around leaves that exist, that the solid asks for, or where both surfaces were near
// on the coarser level (a crease, which needs finer leaves than either). Coincident surfaces leave
// layers of one node between them, which are closed. Edges are rounded as those of dabs are
// (edit/edge_rounding.h).
#include "operation/combine.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "edit/edge_rounding.h"
#include "edit/prune.h"
#include "edit/restriction.h"
#include "field/leaf_finder.h"
#include "field/nesting.h"
#include "field/parallel.h"
#include "field/prolongation.h"

namespace argil {
namespace {

using openvdb::CoordBBox;
using Origins = std::vector<Coord>;

/// Surfaces that pass a node this close, in voxels, count as passing through it: the thickness that
/// import too takes for none.
constexpr float kCoincident = 0.05F;
/// What lies beside a node to both sides at least this far on the other side, in voxels, leaves a
/// single layer at the node.
constexpr float kLayer = 0.25F;

/// A solid and what is done with it.
struct CombineJob {
  const Solid& solid;
  CombineKind kind;
  double edge_radius_mm;

  /// The Boolean operation on two distances.
  float combined(float clay, float other) const noexcept {
    switch (kind) {
      case CombineKind::unite:
        return std::min(clay, other);
      case CombineKind::subtract:
        return std::max(clay, -other);
      case CombineKind::intersect:
        break;
    }
    return std::max(clay, other);
  }
  /// The same at the nodes of a leaf.
  void combine_nodes(const float* clay, const LeafValues& other, LeafValues& now) const noexcept;
  /// -1 where the air is what the edit cuts.
  float clay_side() const noexcept { return kind == CombineKind::unite ? -1.0F : 1.0F; }
  /// Of the body that is kept with the clay, or of the air.
  float other_side() const noexcept { return kind == CombineKind::intersect ? 1.0F : -1.0F; }
  Side side_of(const LevelStack& stack, int level, const Coord& origin) const {
    const auto band = static_cast<double>(stack.band_mm(level));
    return solid.side_of(level, origin, std::max(band, 2.0 * edge_radius_mm));
  }
  /// Of the body that is kept with the clay, or with the air, `other` of the solid at the nodes.
  LeafValues kept(const LeafValues& other) const noexcept {
    LeafValues values;
    for (std::size_t n = 0; n < kLeafNodes; ++n) values[n] = other_side() * other[n];
    return values;
  }
  /// The clay of a leaf combined with the solid's values, edges rounded. `values` as
  /// gather_before() has it.
  template <class Values>
  void combine_leaf(const LevelStack& stack, int level, const Coord& origin, const float* clay,
                    const LeafValues& other, const Values& values, LeafValues& now) const;
  /// Whether rounding may change a leaf.
  bool has_edge(double voxel_mm, const float* clay, const LeafValues& other) const {
    return edge_radius_mm > 0.0 &&
           EdgeLeaf{clay_side(), kept(other), voxel_mm, edge_radius_mm}.is_near_any(clay);
  }
  /// How the solid's distance rises over a node.
  Vec3 rise_at(const LevelStack& stack, int level, const Coord& node) const;
};

/// A loop for each kind, so that compilers make them of whole registers.
void CombineJob::combine_nodes(const float* clay, const LeafValues& other,
                               LeafValues& now) const noexcept {
  switch (kind) {
    case CombineKind::unite:
      for (std::size_t n = 0; n < kLeafNodes; ++n) now[n] = std::min(clay[n], other[n]);
      return;
    case CombineKind::subtract:
      for (std::size_t n = 0; n < kLeafNodes; ++n) now[n] = std::max(clay[n], -other[n]);
      return;
    case CombineKind::intersect:
      for (std::size_t n = 0; n < kLeafNodes; ++n) now[n] = std::max(clay[n], other[n]);
      return;
  }
}

/// Whether both are nearer than that to some node of a leaf.
bool any_near(const float* clay, const LeafValues& other, float near) noexcept {
  unsigned any = 0;
  for (std::size_t n = 0; n < kLeafNodes; ++n) {
    any |= (std::abs(clay[n]) < near) & (std::abs(other[n]) < near) ? 1U : 0U;
  }
  return any != 0;
}

bool any_differs(const float* a, const LeafValues& b) noexcept {
  unsigned any = 0;
  for (std::size_t n = 0; n < kLeafNodes; ++n) any |= a[n] != b[n] ? 1U : 0U;
  return any != 0;
}

template <class Values>
void CombineJob::combine_leaf(const LevelStack& stack, int level, const Coord& origin,
                              const float* clay, const LeafValues& other, const Values& values,
                              LeafValues& now) const {
  const float band = stack.band_mm(level);
  combine_nodes(clay, other, now);
  if (has_edge(stack.voxel_mm(level), clay, other)) {
    LeafValues far = other;
    for (std::size_t n = 0; n < kLeafNodes; ++n) {
      if (is_within_band(stack, level, edge_radius_mm) || std::abs(far[n]) < 0.99F * band) continue;
      far[n] = solid.beyond_band(level, node_of(origin, n));
    }
    HaloBlock around;
    gather_before(stack, level, origin, clay, edge_radius_mm, values, around);
    const auto slope = [&](std::size_t n) {
      return static_cast<double>(other_side()) * rise_at(stack, level, node_of(origin, n));
    };
    round_edge({clay_side(), kept(far), stack.voxel_mm(level), edge_radius_mm}, around, slope, now);
  }
  clamp_to(band, now);
}

Vec3 CombineJob::rise_at(const LevelStack& stack, int level, const Coord& node) const {
  const bool is_within = is_within_band(stack, level, edge_radius_mm);
  const auto value = [&](const Coord& at) {
    return static_cast<double>(is_within ? solid.at(level, at) : solid.beyond_band(level, at));
  };
  Vec3 rise;
  for (int a = 0; a < 3; ++a) {
    Coord low = node;
    Coord high = node;
    --low[a];
    ++high[a];
    rise[static_cast<std::size_t>(a)] = value(high) - value(low);
  }
  return rise;
}

/// Where the solid leaves the clay as it is.
Side side_without_effect(CombineKind kind) {
  return kind == CombineKind::intersect ? Side::inside : Side::outside;
}

/// Where the result is constant, whatever the clay has there: clay of a union, air else.
Side side_of_constant(CombineKind kind) {
  return kind == CombineKind::intersect ? Side::outside : Side::inside;
}
float constant_of(CombineKind kind, float band) {
  return kind == CombineKind::unite ? -band : band;
}

void sort_unique(Origins& origins) {
  std::sort(origins.begin(), origins.end());
  origins.erase(std::unique(origins.begin(), origins.end()), origins.end());
}

/// Finds the leaves that a combination changes or needs, from the coarsest level down.
class CombinePlan {
 public:
  CombinePlan(const LevelStack& stack, const CombineJob& job, double tolerance_mm)
      : stack_(stack), job_(job), tolerance_mm_(tolerance_mm) {}

  /// False when `progress` asked to stop.
  bool run(Edit& edit, const Progress& progress);

 private:
  enum Verdict : std::uint8_t { kNo = 0, kWanted = 1, kCrease = 2 };

  Origins stored_origins(int level) const;
  Origins candidates(int level, const Origins& detailed) const;
  Origins top_origins() const;
  bool changes_tile(int level, const Coord& origin) const {
    return level == stack_.top() && stack_.grid(level).tree().getValue(origin) !=
                                        constant_of(job_.kind, stack_.band_mm(level));
  }
  std::uint8_t judge(int level, const Coord& origin, bool is_detailed) const;
  CoarseNodes coarse_after(int level, const Coord& origin) const;

  const LevelStack& stack_;
  const CombineJob& job_;
  double tolerance_mm_;
  Origins creases_;  ///< of the next coarser level: where both surfaces are near
};

/// All leaves where the coarsest level may change, stored or not.
Origins CombinePlan::top_origins() const {
  CoordBBox box;
  for (const Coord& origin : stack_.sorted_origins(stack_.top())) {
    box.expand(CoordBBox(origin, origin.offsetBy(kLeafSide - 1)));
  }
  const auto solid = job_.solid.top_nodes();
  if (job_.kind == CombineKind::unite && solid) box.expand(*solid);
  Origins origins;
  for_each_leaf_origin(box, [&](const Coord& origin) { origins.push_back(origin); });
  return origins;
}

/// The stored leaves that the solid may change: of one that ends, those within the nodes that it
/// and its band are within.
Origins CombinePlan::stored_origins(int level) const {
  const auto solid = job_.solid.top_nodes();
  if (job_.kind == CombineKind::intersect || !solid) return stack_.sorted_origins(level);
  if (solid->empty()) return {};
  const int finer = stack_.top() - level;
  const Coord low = solid->min() << finer;
  const Coord high = ((solid->max() + Coord(1)) << finer) - Coord(1);
  const CoordBBox leaves(low >> 3, high >> 3);
  if (leaves.volume() > stack_.grid(level).tree().leafCount()) {
    Origins origins = stack_.sorted_origins(level);
    std::erase_if(origins, [&](const Coord& origin) { return !leaves.isInside(origin >> 3); });
    return origins;
  }
  Origins origins;
  LeafFinder stored(stack_, level);
  for_each_leaf_origin({low, high}, [&](const Coord& origin) {
    if (stored.has_leaf(origin)) origins.push_back(origin);
  });
  return origins;
}

Origins CombinePlan::candidates(int level, const Origins& detailed) const {
  if (level == stack_.top()) return top_origins();
  Origins origins = stored_origins(level);
  origins.insert(origins.end(), detailed.begin(), detailed.end());
  for (const Coord& crease : creases_) {
    const Coord first = (crease << 1).offsetBy(-kLeafSide);
    for_each_leaf_origin({first, first.offsetBy(3 * kLeafSide - 1)},
                         [&](const Coord& origin) { origins.push_back(origin); });
  }
  sort_unique(origins);
  return origins;
}

/// What the next coarser level will hold around a finer leaf.
CoarseNodes CombinePlan::coarse_after(int level, const Coord& origin) const {
  assert(level < stack_.top());
  CoarseNodes nodes = coarse_nodes(stack_, level + 1, origin);
  const CoarseNodes other = job_.solid.coarse(level + 1, origin);
  const float band = stack_.band_mm(level + 1);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    nodes[n] = job_.combined(std::clamp(nodes[n], -band, band), other[n]);
  }
  return nodes;
}

std::uint8_t CombinePlan::judge(int level, const Coord& origin, bool is_detailed) const {
  const Side side = job_.side_of(stack_, level, origin);
  if (side == side_without_effect(job_.kind)) return kNo;
  const VdbLeaf* leaf = stack_.leaf(level, origin);
  if (side == side_of_constant(job_.kind)) {
    return leaf != nullptr || changes_tile(level, origin) ? kWanted : kNo;
  }
  LeafValues clay;
  if (leaf != nullptr) {
    std::copy_n(leaf->buffer().data(), kLeafNodes, clay.begin());
  } else {
    prolong_leaf(stack_, level, origin, clay);
  }
  LeafValues other;
  job_.solid.fill(level, origin, other);
  const bool has_edge = job_.has_edge(stack_.voxel_mm(level), clay.data(), other);
  const float near = 2.0F * static_cast<float>(stack_.voxel_mm(level));
  LeafValues now;
  job_.combine_nodes(clay.data(), other, now);
  const bool meet = has_edge || any_near(clay.data(), other, near);
  // Or may: rounding is left to the edit.
  const bool differs = has_edge || any_differs(clay.data(), now);
  const auto crease = static_cast<std::uint8_t>(meet ? kCrease : kNo);
  if (!differs) return crease;
  const auto wanted = static_cast<std::uint8_t>(crease | kWanted);
  if (leaf != nullptr || level == stack_.top()) return wanted;
  if (has_edge) {
    LeafFinder stored(stack_, level);
    job_.combine_leaf(
        stack_, level, origin, clay.data(), other,
        [&](const Coord& at) { return stored.values(at); }, now);
  }
  if (!has_band(now.data(), stack_.band_mm(level))) return crease;
  if (is_detailed) return wanted;
  return coarser_misses(now.data(), coarse_after(level, origin),
                        coarsening_criterion(stack_, level, tolerance_mm_))
             ? wanted
             : crease;
}

bool CombinePlan::run(Edit& edit, const Progress& progress) {
  for (int level = stack_.top(); level >= 0; --level) {
    const double done = static_cast<double>(stack_.top() - level) / stack_.count();
    if (progress && !progress("plan", done)) return false;
    const Origins detailed = job_.solid.detailed_origins(level);
    assert(are_sorted_origins(detailed));
    const Origins origins = candidates(level, detailed);
    std::vector<std::uint8_t> verdict(origins.size());
    for_each_leaf(origins.size(), [&](std::size_t n) {
      verdict[n] = judge(level, origins[n],
                         std::binary_search(detailed.begin(), detailed.end(), origins[n]));
    });
    creases_.clear();
    for (std::size_t n = 0; n < origins.size(); ++n) {
      if ((verdict[n] & kWanted) != 0) edit.want(level, origins[n]);
      if ((verdict[n] & kCrease) != 0) creases_.push_back(origins[n]);
    }
  }
  return true;
}

/// A node that both surfaces pass.
struct Coincidence {
  std::size_t leaf = 0;
  int node = 0;
};

/// Writes the combination into the leaves of a level; returns the nodes that both surfaces pass.
std::vector<Coincidence> stamp_solid(LevelEdit& level, const CombineJob& job) {
  auto& leaves = level.leaves();
  const float near = kCoincident * static_cast<float>(level.voxel_mm());
  std::vector<std::vector<int>> met(leaves.size());
  for_each_leaf(leaves.size(), [&](std::size_t n) {
    LeafEdit& leaf = leaves[n];
    const Side side = job.side_of(level.stack(), level.level(), leaf.origin);
    if (side == side_without_effect(job.kind)) return;
    if (side == side_of_constant(job.kind)) {
      std::fill_n(leaf.write(), kLeafNodes, constant_of(job.kind, level.band_mm()));
      return;
    }
    LeafValues other;
    job.solid.fill(level.level(), leaf.origin, other);
    LeafValues now;
    LevelEdit::Reader reader(level);
    job.combine_leaf(
        level.stack(), level.level(), leaf.origin, leaf.before(), other,
        [&](const Coord& at) { return reader.filled_before(at); }, now);
    if (any_near(leaf.before(), other, near)) {
      for (std::size_t i = 0; i < kLeafNodes; ++i) {
        if (std::abs(leaf.before()[i]) < near && std::abs(other[i]) < near) {
          met[n].push_back(static_cast<int>(i));
        }
      }
    }
    leaf.write_all(now);
  });
  std::vector<Coincidence> all;
  for (std::size_t n = 0; n < met.size(); ++n) {
    for (const int node : met[n]) all.push_back({n, node});
  }
  return all;
}

/// Whether a node is the single layer between what lies on its other side.
bool is_single_layer(const LevelEdit& level, const Coord& node, float value) {
  const float least = kLayer * static_cast<float>(level.voxel_mm());
  const float side = value < 0.0F ? 1.0F : -1.0F;
  for (int axis = 0; axis < 3; ++axis) {
    Coord below = node;
    Coord above = node;
    below[axis] -= 1;
    above[axis] += 1;
    if (side * level.now(below) > least && side * level.now(above) > least) return true;
  }
  return false;
}

/// Closes gaps of a single layer between coincident surfaces, and takes such sheets away.
void close_layers(LevelEdit& level, const std::vector<Coincidence>& met) {
  auto& leaves = level.leaves();
  const float little = kCoincident * static_cast<float>(level.voxel_mm());
  std::vector<std::uint8_t> flips(met.size(), 0);
  for_each_leaf(met.size(), [&](std::size_t n) {
    const LeafEdit& leaf = leaves[met[n].leaf];
    const int i = met[n].node;
    flips[n] = is_single_layer(level, leaf.origin.offsetBy(i >> 6, (i >> 3) & 7, i & 7),
                               leaf.now()[static_cast<std::size_t>(i)])
                   ? 1
                   : 0;
  });
  for (std::size_t n = 0; n < met.size(); ++n) {
    if (flips[n] == 0) continue;
    float& value = leaves[met[n].leaf].write()[met[n].node];
    value = value < 0.0F ? little : -little;
  }
}

/// Level by level from the finest, each coarser one then restricted from it.
void stamp_all(Edit& edit, const CombineJob& job) {
  for (int n = 0; n < edit.count(); ++n) {
    LevelEdit& level = edit.level(n);
    close_layers(level, stamp_solid(level, job));
    level.mark_changes();
    if (n == 0) continue;
    restrict_edit(edit.level(n - 1), level, RestrictedLeaves::touched);
    level.mark_changes();
  }
}

bool any_negative(const float* values) {
  return std::any_of(values, values + kLeafNodes, [](float value) { return value < 0.0F; });
}

/// Whether something is inside after the edit.
bool leaves_something(Edit& edit, const LevelStack& stack) {
  for (int n = 0; n < stack.count(); ++n) {
    const LevelEdit& level = edit.level(n);
    for (const LeafEdit& leaf : level.leaves()) {
      if (leaf.present && any_negative(leaf.now())) return true;
    }
    for (auto leaf = stack.grid(n).tree().cbeginLeaf(); leaf; ++leaf) {
      if (level.find(leaf->origin()) == nullptr && any_negative(leaf->buffer().data())) return true;
    }
  }
  return false;
}

}  // namespace

bool has_inside(const LevelStack& stack) {
  for (int n = 0; n < stack.count(); ++n) {
    for (auto leaf = stack.grid(n).tree().cbeginLeaf(); leaf; ++leaf) {
      if (any_negative(leaf->buffer().data())) return true;
    }
  }
  return false;
}

Combined combine(EditTarget& target, const Solid& solid, CombineKind kind,
                 const Progress& progress) {
  assert(target.sink && target.tolerance_mm > 0.0);
  Edit edit(target);
  const double edge_mm =
      edge_radius(target.stack, 0, target.edge_radius_mm, std::numeric_limits<double>::infinity());
  const CombineJob job{solid, kind, std::min(edge_mm, widest_edge(target.stack))};
  CombinePlan plan(target.stack, job, target.tolerance_mm);
  if (!plan.run(edit, progress)) return Combined::interrupted;
  edit.load();
  if (progress && !progress("combine", 0.0)) return Combined::interrupted;
  stamp_all(edit, job);
  edit.prune();
  if (!leaves_something(edit, target.stack)) return Combined::empty;
  if (progress && !progress("combine", 0.5)) return Combined::interrupted;
  edit.commit();
  return Combined::done;
}

}  // namespace argil
