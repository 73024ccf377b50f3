// SPDX-License-Identifier: GPL-3.0-or-later
#include "window/feet_store.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace argil {
namespace {

/// Leaves of a level that may be kept outside the window.
constexpr std::size_t kMostKept = 512;
/// As kReadReach, of a leaf for which no level but the next coarser one was read: its taps' reach.
constexpr int kTapReach = 2;

NodeBox leaf_box(const Coord& origin) noexcept { return {origin, origin.offsetBy(kLeafSide - 1)}; }

/// Whether the n-th foot of a layer is the k-th of another.
bool is_same(const LayerFeet& a, std::size_t n, const LayerFeet& b, std::size_t k) noexcept {
  for (int field = 0; field < LayerFeet::kFields; ++field) {
    if (a.field(field)[n] != b.field(field)[k]) return false;
  }
  return true;
}

/// One of the three values of a foot that begin with `field`.
Vec3 vector_of(const LayerFeet& layer, int field, std::size_t n) noexcept {
  return {static_cast<double>(layer.field(field)[n]),
          static_cast<double>(layer.field(field + 1)[n]),
          static_cast<double>(layer.field(field + 2)[n])};
}

/// Compares a cluster's feet, which are in the order of their nodes; those that fill up are
/// nowhere. Boxes are from the leaf's origin.
void compare_cluster(const LayerFeet& from, const LayerFeet& to, std::size_t cluster,
                     double layer_mm, FeetChange& change) {
  auto next = static_cast<std::size_t>(from.first[cluster]);
  const auto end = static_cast<std::size_t>(from.first[cluster + 1]);
  const auto go = [&](std::size_t until) {
    for (; next < until; ++next) {
      if (from.field(LayerFeet::kX)[next] == kNowhere) continue;
      change.gone.include(vector_of(from, LayerFeet::kX, next));
    }
  };
  for (int foot = to.first[cluster]; foot < to.first[cluster + 1]; ++foot) {
    const auto n = static_cast<std::size_t>(foot);
    if (to.field(LayerFeet::kX)[n] == kNowhere) continue;
    std::size_t found = next;
    while (found < end && !is_same(to, n, from, found)) ++found;
    if (found < end) {
      go(found);
      ++next;
      continue;
    }
    const Vec3 at = vector_of(to, LayerFeet::kX, n);
    change.came.include(at);
    change.surface.include(at - vector_of(to, LayerFeet::kNormalX, n) * layer_mm);
  }
  go(end);
}

void move(Box3& box, const Vec3& by) noexcept {
  if (box.empty()) return;
  box.min = box.min + by;
  box.max = box.max + by;
}

void add_changes(const LeafLayers& from, const LeafLayers& to, int level, const Coord& origin,
                 double voxel_mm, std::vector<FeetChange>& changes) {
  const Vec3 origin_mm = node_mm(origin, voxel_mm);
  for (std::size_t side = 0; side < 2; ++side) {
    for (std::size_t cluster = 0; cluster < ClusterBoxes::kClusters; ++cluster) {
      FeetChange change;
      change.level = level;
      change.label = label_of(level, origin, side, cluster);
      compare_cluster(from[side], to[side], cluster, kLayerVoxels * voxel_mm, change);
      if (change.gone.empty() && change.came.empty()) continue;
      for (Box3* box : {&change.gone, &change.came, &change.surface}) move(*box, origin_mm);
      changes.push_back(change);
    }
  }
}

}  // namespace

NodeBox changed_nodes_of(const LeafChange& change) noexcept {
  if (change.is_whole) return leaf_box(change.origin);
  NodeBox box{change.origin.offsetBy(kLeafSide), change.origin.offsetBy(-1)};
  for (int row = 0; row < 64; ++row) {
    const unsigned bits = change.nodes[static_cast<std::size_t>(row)];
    if (bits == 0) continue;
    const Coord low = change.origin.offsetBy(row >> 3, row & 7, __builtin_ctz(bits));
    const Coord high = change.origin.offsetBy(row >> 3, row & 7, 31 - __builtin_clz(bits));
    box.low = Coord::minComponent(box.low, low);
    box.high = Coord::maxComponent(box.high, high);
  }
  return box;
}

FeetStore::Level& FeetStore::level(int level) {
  assert(level >= 0);
  if (levels_.size() <= static_cast<std::size_t>(level)) {
    levels_.resize(static_cast<std::size_t>(level) + 1);
  }
  return levels_[static_cast<std::size_t>(level)];
}

void FeetStore::find(LevelReader& reader, const Asked& asked, Entry& entry) {
  LevelReader::Reading reading = reader.look(asked.level, asked.origin);
  LeafLayers found;
  if (!reading.is_far) {
    LeafAndFaces values;
    reading = read_with_faces(reader, asked.level, asked.origin, values);
    if (!reading.is_far) {
      found = find_layers(values, reader.stack().voxel_mm(asked.level), asked.is_average);
    }
  }
  const bool is_empty = found[0].is_empty() && found[1].is_empty();
  entry.layers = is_empty ? nullptr : std::make_unique<LeafLayers>(std::move(found));
  entry.is_average = asked.is_average;
  entry.is_found = true;
  entry.is_stale = false;
  entry.coarsest = reading.coarsest;
}

/// Those without any take an entry, too: that they have none may no longer hold.
const LeafLayers* FeetStore::layers(LevelReader& reader, const Asked& asked) {
  Entry& known = level(asked.level).entries[asked.origin];
  if (!known.is_found || known.is_stale || known.is_average != asked.is_average) {
    find(reader, asked, known);
  }
  return known.layers.get();
}

std::vector<FeetChange> FeetStore::refresh(LevelReader& reader, int level_number,
                                           const NodeBox& leaves) {
  std::vector<FeetChange> changes;
  Level& of = level(level_number);
  const double voxel = reader.stack().voxel_mm(level_number);
  static const LeafLayers kNone;
  std::erase_if(of.stale, [&](const Coord& origin) {
    if (!leaves.has(origin >> 3)) return false;
    const auto found = of.entries.find(origin);
    if (found == of.entries.end() || !found->second.is_stale) return true;
    Entry& entry = found->second;
    const std::unique_ptr<LeafLayers> former = std::move(entry.layers);
    find(reader, {level_number, origin, entry.is_average}, entry);
    add_changes(former ? *former : kNone, entry.layers ? *entry.layers : kNone, level_number,
                origin, voxel, changes);
    return true;
  });
  return changes;
}

ErrorSum FeetStore::error(LevelReader& reader, int level_number, const Coord& origin) {
  auto& entries = level(level_number).entries;
  auto found = entries.find(origin);
  if (found == entries.end()) {
    if (reader.look(level_number, origin).is_far) return {};
    found = entries.try_emplace(origin).first;
  }
  Entry& known = found->second;
  if (!known.error) {
    LeafAndFaces values;
    const LevelReader::Reading reading = read_with_faces(reader, level_number, origin, values);
    known.coarsest = std::max(known.coarsest, reading.coarsest);
    known.error = reading.is_far ? ErrorSum{} : leaf_error(reader, level_number, origin, values);
  }
  return *known.error;
}

void FeetStore::forget(Level& level, const Coord& origin, Entry& entry) {
  entry.error.reset();
  if (!entry.is_found || entry.is_stale) return;
  entry.is_stale = true;
  level.stale.push_back(origin);
}

void FeetStore::note(const std::vector<LeafChange>& changes) {
  std::vector<ChangedNodes> changed;
  for (const LeafChange& change : changes) {
    const NodeBox nodes = changed_nodes_of(change);
    if (nodes.low.x() > nodes.high.x()) continue;
    note_at(change.level, nodes);
    note_at_coarser(change.level, nodes);
    changed.push_back({change.level, nodes});
  }
  for (std::size_t finer = 0; finer < levels_.size(); ++finer) {
    note_at_finer(static_cast<int>(finer), changed);
  }
}

/// Leaves whose nodes, or those next to them, are among the changed ones.
void FeetStore::note_at(int level, const NodeBox& changed) {
  if (static_cast<std::size_t>(level) >= levels_.size()) return;
  Level& of = levels_[static_cast<std::size_t>(level)];
  const NodeBox near = changed.grown(1);
  for_each_leaf_origin({near.low, near.high}, [&](const Coord& origin) {
    const auto found = of.entries.find(origin);
    if (found != of.entries.end()) forget(of, origin, found->second);
  });
}

/// A coarser level's error is the difference to finer ones.
void FeetStore::note_at_coarser(int level, const NodeBox& changed) {
  for (auto coarse = static_cast<std::size_t>(level) + 1; coarse < levels_.size(); ++coarse) {
    const int shift = static_cast<int>(coarse) - level;
    auto& entries = levels_[coarse].entries;
    for_each_leaf_origin({changed.low >> shift, changed.high >> shift}, [&](const Coord& origin) {
      const auto found = entries.find(origin);
      if (found != entries.end()) found->second.error.reset();
    });
  }
}

/// What a level does not store, of changes of coarser ones.
void FeetStore::note_at_finer(int finer, const std::vector<ChangedNodes>& changed) {
  struct Reach {
    int level;
    NodeBox nodes;       ///< what may be read of it is about these
    NodeBox next_nodes;  ///< and these where no other level is read
  };
  std::vector<Reach> reaches;
  NodeBox all{Coord::max(), Coord::min()};
  for (const ChangedNodes& change : changed) {
    if (change.level <= finer) continue;
    const int shift = change.level - finer;
    const auto nodes_from = [&](int reach) {
      const NodeBox read = change.nodes.grown(reach);
      return NodeBox{read.low << shift, (read.high.offsetBy(1) << shift).offsetBy(-1)}.grown(1);
    };
    reaches.push_back({change.level, nodes_from(kReadReach), nodes_from(kTapReach)});
    all.low = Coord::minComponent(all.low, reaches.back().nodes.low);
    all.high = Coord::maxComponent(all.high, reaches.back().nodes.high);
  }
  Level& of = levels_[static_cast<std::size_t>(finer)];
  for (auto& [origin, entry] : of.entries) {
    if (entry.coarsest <= finer) continue;
    const NodeBox leaf = leaf_box(origin);
    if (!all.meets(leaf)) continue;
    const bool is_next = entry.coarsest == finer + 1;
    const bool is_concerned = std::ranges::any_of(reaches, [&](const Reach& reach) {
      return reach.level <= entry.coarsest &&
             (is_next ? reach.next_nodes : reach.nodes).meets(leaf);
    });
    if (is_concerned) forget(of, origin, entry);
  }
}

void FeetStore::trim(int level, const NodeBox& nodes) {
  if (static_cast<std::size_t>(level) >= levels_.size()) return;
  auto& entries = levels_[static_cast<std::size_t>(level)].entries;
  const NodeBox origins{leaf_origin(nodes.low), leaf_origin(nodes.high)};
  const std::size_t inside = NodeBox{origins.low >> 3, origins.high >> 3}.count();
  if (entries.size() <= inside + kMostKept) return;
  std::erase_if(entries, [&](const auto& item) { return !nodes.meets(leaf_box(item.first)); });
}

}  // namespace argil
