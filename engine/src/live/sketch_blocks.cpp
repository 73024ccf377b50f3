// SPDX-License-Identifier: GPL-3.0-or-later
#include "live/sketch_blocks.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

#include "clay/clay_access.h"
#include "field/parallel.h"
#include "surface/display_access.h"

namespace argil {
namespace {

/// Nodes farther from both surfaces are no corner of a cell that one of them passes.
constexpr float kNearVoxels = 2.0F;
/// Values that differ by less move no surface that anybody sees.
constexpr float kSameVoxels = 0.02F;
/// How far the two sides of a seam may lie apart, in the mean.
constexpr double kSeamVoxels = 2.0;
/// Of the seam's block, which no leaf has.
constexpr std::array<std::int32_t, 3> kSeamOrigin{1, 1, 1};

/// What of a change moves the surface: its nodes near the surface, before or now, whose values
/// differ. Nothing where there are none.
std::optional<LeafChange> seen_part(const LeafChange& change, const LevelStack& before,
                                    const LevelStack& now) {
  const VdbLeaf* const old_leaf = before.leaf(change.level, change.origin);
  const VdbLeaf* const new_leaf = now.leaf(change.level, change.origin);
  if (old_leaf == nullptr && new_leaf == nullptr) return std::nullopt;
  const auto voxel = static_cast<float>(now.voxel_mm(change.level));
  const bool is_there = old_leaf != nullptr && new_leaf != nullptr;
  LeafChange seen{change.level, change.origin, !is_there, {}, {}};
  bool is_seen = false;
  for (std::size_t n = 0; n < kLeafNodes; ++n) {
    const float was = values_of(old_leaf != nullptr ? *old_leaf : *new_leaf)[n];
    const float is = values_of(new_leaf != nullptr ? *new_leaf : *old_leaf)[n];
    if (std::min(std::abs(was), std::abs(is)) > kNearVoxels * voxel) continue;
    if (is_there && std::abs(is - was) <= kSameVoxels * voxel) continue;
    is_seen = true;
    seen.nodes[n / 8] = static_cast<std::uint8_t>(seen.nodes[n / 8] | 1U << (n % 8));
  }
  if (!is_seen) return std::nullopt;
  return seen;
}

std::vector<LeafChange> seen_parts(const std::vector<LeafChange>& changes, const LevelStack& before,
                                   const LevelStack& now) {
  std::vector<std::optional<LeafChange>> parts(changes.size());
  for_each_leaf(changes.size(),
                [&](std::size_t n) { parts[n] = seen_part(changes[n], before, now); });
  std::vector<LeafChange> seen;
  for (const std::optional<LeafChange>& part : parts) {
    if (part) seen.push_back(*part);
  }
  return seen;
}

}  // namespace

SketchBlocks::SketchBlocks(const DisplaySurface& shown, const Clay& before, const Clay& now,
                           int level)
    : shown_(shown),
      before_(before),
      now_(now),
      by_leaf_(shown, level),
      taken_(static_cast<std::size_t>(levels_of(now).count())) {
  assert(DisplayAccess::coarsest_hidden(shown) < level);
  blocks_.begin_with_changes(levels_of(now));
}

BlockId SketchBlocks::name_of(const LeafKey& at) const {
  return id_of({at.level + by_leaf_.level(), at.origin});
}

DisplayBlock SketchBlocks::sketched(const BlockId& id) const {
  LeafKey at = leaf_of(id);
  at.level -= by_leaf_.level();
  const DrawnBlock* const found = at.level < 0 ? nullptr : blocks_.block(at);
  if (found == nullptr || found->triangles.empty()) return {};
  return found->shown_as(id, std::ldexp(levels_of(now_).voxel_mm(0), -by_leaf_.level()));
}

bool SketchBlocks::is_taken(const LeafKey& at) const {
  return has_all_ || taken_[static_cast<std::size_t>(at.level)].get(at.origin) != 0;
}

/// The clay gives up the blocks of leaves that see a change of the surface.
void SketchBlocks::take_places(const std::vector<LeafChange>& changes, BlockLists& lists) {
  fresh_.clear();
  const LevelStack& now = levels_of(now_);
  const auto seeing = leaves_that_see(now, seen_parts(changes, levels_of(before_), now));
  for (std::size_t level = 0; level < seeing.size(); ++level) {
    seeing[level].for_each([&](const Coord& origin, std::uint8_t) {
      std::uint8_t& taken = taken_[level].at(origin);
      if (std::exchange(taken, std::uint8_t{1}) == 0) {
        fresh_.push_back({static_cast<int>(level), origin});
      }
    });
  }
  std::vector<BlockId> given;
  for (const LeafKey& at : fresh_) {
    const std::size_t group = by_leaf_.group_of(at);
    if (group == by_leaf_.groups().size()) continue;
    const std::vector<BlockId>& blocks = by_leaf_.groups()[group].blocks;
    given.insert(given.end(), blocks.begin(), blocks.end());
  }
  std::vector<Edges> borders(given.size());
  for_each_leaf(given.size(),
                [&](std::size_t n) { borders[n] = border_of(shown_.block(given[n])); });
  for (const Edges& border : borders) of_clay_.remove(border);
  lists.gone.insert(lists.gone.end(), given.begin(), given.end());
}

/// More changed than the clay remembers.
void SketchBlocks::take_all(BlockLists& lists) {
  for (const DrawnByLeaf::Group& group : by_leaf_.groups()) {
    if (is_taken(group.around)) continue;
    lists.gone.insert(lists.gone.end(), group.blocks.begin(), group.blocks.end());
  }
  for (const auto& [id, border] : drawn_) lists.gone.push_back(id);
  has_all_ = true;
  drawn_.clear();
  of_sketch_ = {};
  of_clay_ = {};
}

/// Draws the blocks of these leaves as they are now, if they are taken and have triangles.
void SketchBlocks::draw(const std::vector<LeafKey>& places, BlockLists& lists) {
  std::vector<BlockId> ids;
  for (const LeafKey& at : places) {
    if (is_taken(at)) ids.push_back(name_of(at));
  }
  std::vector<Edges> borders(ids.size());
  for_each_leaf(ids.size(), [&](std::size_t n) { borders[n] = border_of(sketched(ids[n])); });
  for (std::size_t n = 0; n < ids.size(); ++n) {
    erase(ids[n], lists);
    if (sketched(ids[n]).triangles.empty()) continue;
    lists.changed.push_back(ids[n]);
    of_sketch_.add(borders[n]);
    drawn_.emplace(ids[n], std::move(borders[n]));
  }
}

void SketchBlocks::erase(const BlockId& id, BlockLists& lists) {
  const auto found = drawn_.find(id);
  if (found == drawn_.end()) return;
  of_sketch_.remove(found->second);
  lists.gone.push_back(id);
  drawn_.erase(found);
}

void SketchBlocks::close(BlockLists& lists) {
  const BlockId id{by_leaf_.level(), kSeamOrigin};
  const bool was_drawn = !seam_.triangles.empty();
  seam_ = seam_between(of_sketch_, of_clay_, kSeamVoxels * levels_of(now_).voxel_mm(0));
  if (!seam_.triangles.empty()) {
    lists.changed.push_back(id);
  } else if (was_drawn) {
    lists.gone.push_back(id);
  }
}

std::int64_t SketchBlocks::update(const std::optional<std::vector<LeafChange>>& changes,
                                  BlockLists& lists) {
  const LevelStack& now = levels_of(now_);
  std::int64_t extracted = 0;
  std::vector<LeafKey> places;
  if (changes) {
    extracted = blocks_.update(now, *changes);
    if (!has_all_) take_places(*changes, lists);
    // What was made before its place was taken is drawn now, though it did not change.
    places = std::exchange(fresh_, {});
  } else {
    take_all(lists);
    extracted = blocks_.rebuild_all(now);
    for (const auto& [at, block] : blocks_.blocks()) places.push_back(at);
  }
  places.insert(places.end(), blocks_.changed().begin(), blocks_.changed().end());
  for (const LeafKey& at : blocks_.gone()) erase(name_of(at), lists);
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  draw(places, lists);
  close(lists);
  return extracted;
}

DisplayBlock SketchBlocks::block(const BlockId& id) const {
  if (id.origin != kSeamOrigin) return drawn_.contains(id) ? sketched(id) : DisplayBlock{};
  DisplayBlock block{seam_.vertices, seam_.triangles, {}};
  for (const DisplayVertex& v : seam_.vertices) {
    block.bounds_mm.include({static_cast<double>(v.position_mm[0]),
                             static_cast<double>(v.position_mm[1]),
                             static_cast<double>(v.position_mm[2])});
  }
  return block;
}

}  // namespace argil
