// SPDX-License-Identifier: GPL-3.0-or-later
#include "combine.h"

#include <algorithm>
#include <cmath>

#include "restriction.h"
#include "retention.h"

namespace argil {
namespace {

using openvdb::CoordBBox;
using Places = std::vector<Coord>;

/// Surfaces that pass a node this close, in voxels, count as passing through it: the thickness that
/// import too takes for none.
constexpr float kCoincident = 0.05F;
/// What lies beside a node to both sides at least this far on the other side, in voxels, leaves a
/// single layer at the node.
constexpr float kLayer = 0.25F;

float combined(CombineKind kind, float clay, float solid) {
  switch (kind) {
    case CombineKind::unite:
      return std::min(clay, solid);
    case CombineKind::subtract:
      return std::max(clay, -solid);
    case CombineKind::intersect:
      break;
  }
  return std::max(clay, solid);
}

/// Where the solid leaves the clay as it is.
Side side_without_effect(CombineKind kind) {
  return kind == CombineKind::intersect ? Side::inside : Side::outside;
}

/// Where the result is constant, whatever the clay holds: clay of a union, air else.
Side side_of_constant(CombineKind kind) {
  return kind == CombineKind::intersect ? Side::outside : Side::inside;
}
float constant_of(CombineKind kind, float band) {
  return kind == CombineKind::unite ? -band : band;
}

void sort_unique(Places& places) {
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
}

/// Finds the leaves that a combination changes or needs, from the coarsest level down.
class CombinePlan {
 public:
  CombinePlan(const LevelStack& stack, const Solid& solid, CombineKind kind, double tolerance_mm)
      : stack_(stack), solid_(solid), kind_(kind), tolerance_mm_(tolerance_mm) {}

  /// False when `progress` asked to stop.
  bool run(Edit& edit, const Progress& progress);

 private:
  enum Verdict : std::uint8_t { kNo = 0, kWanted = 1, kCrease = 2 };

  Places candidates(int level, const Places& detailed) const;
  Places top_places() const;
  bool changes_tile(int level, const Coord& place) const {
    return level == stack_.top() &&
           stack_.grid(level).tree().getValue(place) != constant_of(kind_, stack_.band_mm(level));
  }
  std::uint8_t judge(int level, const Coord& place, bool is_detailed) const;
  CoarseNodes coarse_after(int level, const Coord& place) const;

  const LevelStack& stack_;
  const Solid& solid_;
  CombineKind kind_;
  double tolerance_mm_;
  Places creases_;  ///< of the next coarser level: where both surfaces are near
};

/// All places where the coarsest level may change, its constant ones included.
Places CombinePlan::top_places() const {
  CoordBBox box;
  for (const Coord& place : stack_.sorted_places(stack_.top())) {
    box.expand(CoordBBox(place, place.offsetBy(kLeafSide - 1)));
  }
  const auto solid = solid_.top_nodes();
  if (kind_ == CombineKind::unite && solid) box.expand(*solid);
  Places places;
  for_each_place(box, [&](const Coord& place) { places.push_back(place); });
  return places;
}

Places CombinePlan::candidates(int level, const Places& detailed) const {
  if (level == stack_.top()) return top_places();
  Places places = stack_.sorted_places(level);
  places.insert(places.end(), detailed.begin(), detailed.end());
  for (const Coord& crease : creases_) {
    const Coord first = (crease << 1).offsetBy(-kLeafSide);
    for_each_place({first, first.offsetBy(3 * kLeafSide - 1)},
                   [&](const Coord& place) { places.push_back(place); });
  }
  sort_unique(places);
  return places;
}

/// What the next coarser level will hold around a finer place.
CoarseNodes CombinePlan::coarse_after(int level, const Coord& place) const {
  CoarseNodes nodes = coarse_nodes(stack_, level + 1, place);
  const Coord low = coarser(place);
  const float band = stack_.band_mm(level + 1);
  for (int n = 0; n < 125; ++n) {
    float& value = nodes[static_cast<std::size_t>(n)];
    value = std::clamp(value, -band, band);
    value = combined(kind_, value, solid_.at(level + 1, low.offsetBy(n / 25, n / 5 % 5, n % 5)));
  }
  return nodes;
}

std::uint8_t CombinePlan::judge(int level, const Coord& place, bool is_detailed) const {
  const Side side = solid_.side_of(level, place);
  if (side == side_without_effect(kind_)) return kNo;
  const VdbLeaf* leaf = stack_.leaf(level, place);
  if (side == side_of_constant(kind_)) {
    return leaf != nullptr || changes_tile(level, place) ? kWanted : kNo;
  }
  LeafValues clay;
  if (leaf != nullptr) {
    std::copy_n(leaf->buffer().data(), kLeafNodes, clay.begin());
  } else {
    prolong_leaf(stack_, level, place, clay);
  }
  LeafValues other;
  solid_.fill(level, place, other);
  const float near = 2.0F * static_cast<float>(stack_.voxel_mm(level));
  LeafValues now;
  bool differs = false;
  bool meet = false;
  for (std::size_t n = 0; n < kLeafNodes; ++n) {
    now[n] = combined(kind_, clay[n], other[n]);
    differs |= now[n] != clay[n];
    meet |= (std::abs(clay[n]) < near) & (std::abs(other[n]) < near);
  }
  const auto crease = static_cast<std::uint8_t>(meet ? kCrease : kNo);
  if (!differs) return crease;
  const auto wanted = static_cast<std::uint8_t>(crease | kWanted);
  if (leaf != nullptr || level == stack_.top()) return wanted;
  if (!has_band(now.data(), stack_.band_mm(level))) return crease;
  if (is_detailed) return wanted;
  return coarser_misses(now, coarse_after(level, place),
                        retention_rule(stack_, level, tolerance_mm_))
             ? wanted
             : crease;
}

bool CombinePlan::run(Edit& edit, const Progress& progress) {
  for (int level = stack_.top(); level >= 0; --level) {
    const double done = static_cast<double>(stack_.top() - level) / stack_.count();
    if (progress && !progress("plan", done)) return false;
    const Places detailed = solid_.detailed_places(level);
    const Places places = candidates(level, detailed);
    std::vector<std::uint8_t> verdict(places.size());
    for_each_leaf(places.size(), [&](std::size_t n) {
      verdict[n] =
          judge(level, places[n], std::binary_search(detailed.begin(), detailed.end(), places[n]));
    });
    creases_.clear();
    for (std::size_t n = 0; n < places.size(); ++n) {
      if ((verdict[n] & kWanted) != 0) edit.want(level, places[n]);
      if ((verdict[n] & kCrease) != 0) creases_.push_back(places[n]);
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
std::vector<Coincidence> stamp_solid(LevelEdit& level, const Solid& solid, CombineKind kind) {
  auto& leaves = level.leaves();
  const float near = kCoincident * static_cast<float>(level.voxel_mm());
  std::vector<std::vector<int>> met(leaves.size());
  for_each_leaf(leaves.size(), [&](std::size_t n) {
    LeafEdit& leaf = leaves[n];
    const Side side = solid.side_of(level.level(), leaf.place);
    if (side == side_without_effect(kind)) return;
    if (side == side_of_constant(kind)) {
      leaf.now.fill(constant_of(kind, level.band_mm()));
      return;
    }
    LeafValues other;
    solid.fill(level.level(), leaf.place, other);
    for (std::size_t i = 0; i < kLeafNodes; ++i) {
      leaf.now[i] = combined(kind, leaf.before[i], other[i]);
      if (std::abs(leaf.before[i]) < near && std::abs(other[i]) < near) {
        met[n].push_back(static_cast<int>(i));
      }
    }
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
    flips[n] = is_single_layer(level, leaf.place.offsetBy(i >> 6, (i >> 3) & 7, i & 7),
                               leaf.now[static_cast<std::size_t>(i)])
                   ? 1
                   : 0;
  });
  for (std::size_t n = 0; n < met.size(); ++n) {
    if (flips[n] == 0) continue;
    float& value = leaves[met[n].leaf].now[static_cast<std::size_t>(met[n].node)];
    value = value < 0.0F ? little : -little;
  }
}

void stamp_all(Edit& edit, const Solid& solid, CombineKind kind) {
  for (int n = 0; n < edit.count(); ++n) {
    LevelEdit& level = edit.level(n);
    close_layers(level, stamp_solid(level, solid, kind));
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
      if (leaf.present && any_negative(leaf.now.data())) return true;
    }
    for (auto leaf = stack.grid(n).tree().cbeginLeaf(); leaf; ++leaf) {
      if (level.find(leaf->origin()) == nullptr && any_negative(leaf->buffer().data())) return true;
    }
  }
  return false;
}

/// Passes until nothing strays; each spreads by one leaf at most on one level.
constexpr int kMostPasses = 24;

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
  Edit edit(target);
  CombinePlan plan(target.stack, solid, kind, target.tolerance_mm);
  if (!plan.run(edit, progress)) return Combined::interrupted;
  edit.load();
  if (progress && !progress("combine", 0.0)) return Combined::interrupted;
  stamp_all(edit, solid, kind);
  edit.drop_unneeded();
  if (!leaves_something(edit, target.stack)) return Combined::empty;
  if (progress && !progress("combine", 0.5)) return Combined::interrupted;
  edit.commit();
  return Combined::done;
}

LeafList strayed_among(const LevelStack& stack, const LeafList& leaves) {
  LeafList near;
  near.reserve(7 * leaves.size());
  for (const auto& [level, place] : leaves) {
    near.emplace_back(level, place);
    for (int axis = 0; axis < 3; ++axis) {
      for (const int step : {-kLeafSide, kLeafSide}) {
        Coord beside = place;
        beside[axis] += step;
        near.emplace_back(level, beside);
      }
    }
  }
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  std::vector<std::uint8_t> astray(near.size(), 0);
  for_each_leaf(near.size(), [&](std::size_t n) {
    const auto& [level, place] = near[n];
    astray[n] = stack.has_leaf(level, place) && strays(stack, level, place) ? 1 : 0;
  });
  LeafList found;
  for (std::size_t n = 0; n < near.size(); ++n) {
    if (astray[n] != 0) found.push_back(near[n]);
  }
  return found;
}

bool settle(EditTarget& target, const LeafList& touched, const Progress& progress) {
  LeafList all = touched;
  LeafList changed = touched;
  EditTarget noting{target.stack, target.memory, target.tolerance_mm,
                    [&](const LeafChange& change, const float* values, float tile) {
                      changed.emplace_back(change.level, change.place);
                      target.sink(change, values, tile);
                    },
                    target.free_bytes};
  for (int pass = 0; pass < kMostPasses; ++pass) {
    if (progress && !progress("settle", static_cast<double>(pass) / kMostPasses)) return false;
    const LeafList astray = strayed_among(target.stack, changed);
    if (astray.empty()) break;
    changed.clear();
    renormalise_strayed(noting, astray);
    all.insert(all.end(), changed.begin(), changed.end());
  }
  tidy(target, all);
  return true;
}

}  // namespace argil
