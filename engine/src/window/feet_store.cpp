// SPDX-License-Identifier: GPL-3.0-or-later
#include "window/feet_store.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace argil {
namespace {

/// Leaves of a level that may be kept outside the window.
constexpr std::size_t kMostKept = 512;
bool do_meet(const NodeBox& a, const NodeBox& b) noexcept {
  for (int axis = 0; axis < 3; ++axis) {
    if (a.high[axis] < b.low[axis] || b.high[axis] < a.low[axis]) return false;
  }
  return true;
}

NodeBox leaf_box(const Coord& origin) noexcept { return {origin, origin.offsetBy(kLeafSide - 1)}; }

/// Of the points of a cluster, in mm; empty when it has none.
Box3 box_of(const ClusterBoxes& boxes, std::size_t cluster, const Vec3& origin_mm) noexcept {
  Box3 box;
  if (boxes.low[0][cluster] > boxes.high[0][cluster]) return box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.min[axis] = origin_mm[axis] + static_cast<double>(boxes.low[axis][cluster]);
    box.max[axis] = origin_mm[axis] + static_cast<double>(boxes.high[axis][cluster]);
  }
  return box;
}

void include(const Box3& other, Box3& box) noexcept {
  if (other.empty()) return;
  box.include(other.min);
  box.include(other.max);
}

/// Whether a cluster has the same points in both, in the same order.
bool is_same(const LayerFeet& a, const LayerFeet& b, std::size_t cluster) noexcept {
  const auto begin = [&](const LayerFeet& layer) {
    return static_cast<std::size_t>(layer.first[cluster]);
  };
  const auto size = static_cast<std::size_t>(a.first[cluster + 1]) - begin(a);
  if (size != static_cast<std::size_t>(b.first[cluster + 1]) - begin(b)) return false;
  for (int field = 0; size > 0 && field < LayerFeet::kFields; ++field) {
    if (!std::equal(a.field(field) + begin(a), a.field(field) + begin(a) + size,
                    b.field(field) + begin(b))) {
      return false;
    }
  }
  return true;
}

void add_changes(const LeafLayers& from, const LeafLayers& to, int level, const Vec3& origin_mm,
                 std::vector<FeetChange>& changes) {
  for (std::size_t side = 0; side < 2; ++side) {
    for (std::size_t cluster = 0; cluster < ClusterBoxes::kClusters; ++cluster) {
      if (is_same(from[side], to[side], cluster)) continue;
      FeetChange change{level, {}, {}};
      for (const LayerFeet* layer : {&from[side], &to[side]}) {
        include(box_of(layer->feet, cluster, origin_mm), change.feet);
        include(box_of(layer->surface, cluster, origin_mm), change.surface);
      }
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
  LeafAndFaces values;
  const LevelReader::Reading reading = read_with_faces(reader, asked.level, asked.origin, values);
  const double voxel = reader.stack().voxel_mm(asked.level);
  LeafLayers found;
  if (!reading.is_far) found = find_layers(values, voxel, asked.is_average);
  if (asked.was_asked) {
    static const LeafLayers kNone;
    add_changes(entry.layers ? *entry.layers : kNone, found, asked.level,
                node_mm(asked.origin, voxel), changes_);
  }
  const bool is_empty = found[0].is_empty() && found[1].is_empty();
  entry.layers = is_empty ? nullptr : std::make_unique<LeafLayers>(std::move(found));
  entry.is_average = asked.is_average;
  entry.is_found = true;
  entry.is_stale = false;
  entry.coarsest = reading.coarsest;
}

/// Most leaves are far from the surface; these take no entry.
const LeafLayers* FeetStore::layers(LevelReader& reader, const Asked& asked) {
  Level& entries = level(asked.level);
  auto found = entries.find(asked.origin);
  if (found == entries.end()) {
    if (reader.is_far(asked.level, asked.origin)) return nullptr;
    found = entries.try_emplace(asked.origin).first;
  }
  Entry& known = found->second;
  if (!known.is_found || known.is_stale || known.is_average != asked.is_average) {
    find(reader, asked, known);
  }
  return known.layers.get();
}

ErrorSum FeetStore::error(LevelReader& reader, int level_number, const Coord& origin) {
  Level& entries = level(level_number);
  auto found = entries.find(origin);
  if (found == entries.end()) {
    if (reader.is_far(level_number, origin)) return {};
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

void FeetStore::note(const std::vector<LeafChange>& changes) {
  for (const LeafChange& change : changes) {
    const NodeBox nodes = changed_nodes_of(change);
    if (nodes.low.x() > nodes.high.x()) continue;
    note_at(change.level, nodes);
    note_at_coarser(change.level, nodes);
    note_at_finer(change.level, nodes);
  }
}

/// Leaves whose nodes, or those next to them, are among the changed ones.
void FeetStore::note_at(int level, const NodeBox& changed) {
  if (static_cast<std::size_t>(level) >= levels_.size()) return;
  Level& entries = levels_[static_cast<std::size_t>(level)];
  const NodeBox near = changed.grown(1);
  for_each_leaf_origin({near.low, near.high}, [&](const Coord& origin) {
    const auto found = entries.find(origin);
    if (found == entries.end()) return;
    found->second.is_stale = true;
    found->second.error.reset();
  });
}

/// A coarser level's error is the difference to finer ones.
void FeetStore::note_at_coarser(int level, const NodeBox& changed) {
  for (auto coarse = static_cast<std::size_t>(level) + 1; coarse < levels_.size(); ++coarse) {
    const int shift = static_cast<int>(coarse) - level;
    for_each_leaf_origin({changed.low >> shift, changed.high >> shift}, [&](const Coord& origin) {
      const auto found = levels_[coarse].find(origin);
      if (found != levels_[coarse].end()) found->second.error.reset();
    });
  }
}

/// What a finer level does not store.
void FeetStore::note_at_finer(int level, const NodeBox& changed) {
  const auto finer_levels = std::min(static_cast<std::size_t>(level), levels_.size());
  for (std::size_t finer = 0; finer < finer_levels; ++finer) {
    const int shift = level - static_cast<int>(finer);
    const NodeBox read = changed.grown(kReadReach);
    const NodeBox nodes{read.low << shift, (read.high.offsetBy(1) << shift).offsetBy(-1)};
    for (auto& [origin, entry] : levels_[finer]) {
      if (entry.coarsest < level || !do_meet(nodes, leaf_box(origin).grown(1))) continue;
      entry.is_stale = true;
      entry.error.reset();
    }
  }
}

void FeetStore::trim(int level, const NodeBox& nodes) {
  if (static_cast<std::size_t>(level) >= levels_.size()) return;
  Level& entries = levels_[static_cast<std::size_t>(level)];
  const NodeBox origins{leaf_origin(nodes.low), leaf_origin(nodes.high)};
  const auto n = NodeBox{origins.low >> 3, origins.high >> 3}.sides();
  const auto inside = static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1]) *
                      static_cast<std::size_t>(n[2]);
  if (entries.size() <= inside + kMostKept) return;
  std::erase_if(entries, [&](const auto& item) { return !do_meet(nodes, leaf_box(item.first)); });
}

void FeetStore::clear() {
  levels_.clear();
  changes_.clear();
}

}  // namespace argil
