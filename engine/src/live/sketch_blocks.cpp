// SPDX-License-Identifier: GPL-3.0-or-later
#include "live/sketch_blocks.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

#include "clay/clay_access.h"
#include "field/parallel.h"
#include "surface/display_access.h"

namespace argil {
namespace {

/// Nodes farther from both surfaces are no end of an edge that one of them crosses.
constexpr float kNearVoxels = 1.25F;
/// Values that differ by less move no surface that anybody sees.
constexpr float kSameVoxels = 0.04F;
/// How far the two sides of a seam may lie apart, in the mean.
constexpr double kSeamVoxels = 2.0;
/// Of the seam's block, which no leaf has.
constexpr std::array<std::int32_t, 3> kSeamOrigin{1, 1, 1};

/// What of a change moves the surface: its nodes near the surface, before or now, or on its other
/// side, whose values differ. Nothing where there are none.
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
    const bool is_near = std::min(std::abs(was), std::abs(is)) <= kNearVoxels * voxel;
    if (!is_near && (was < 0.0F) == (is < 0.0F)) continue;
    if (is_there && std::abs(is - was) <= kSameVoxels * voxel) continue;
    is_seen = true;
    seen.nodes[n / 8] = static_cast<std::uint8_t>(seen.nodes[n / 8] | 1U << (n % 8));
  }
  if (!is_seen) return std::nullopt;
  return seen;
}

/// The octants around nodes of a leaf, three along each axis from the one before it on: bit 9 i + 3
/// j
/// + k.
std::uint32_t octants_around(const NodeRows& nodes) {
  // Which of the three the cells below and above a node lie in, by its coordinate.
  constexpr std::array<std::uint32_t, 8> kAlong{0b011, 0b010, 0b010, 0b010,
                                                0b110, 0b100, 0b100, 0b100};
  std::uint32_t around = 0;
  for (std::size_t row = 0; row < nodes.size(); ++row) {
    std::uint32_t along_z = 0;
    for (std::size_t z = 0; z < 8; ++z) {
      if ((nodes[row] >> z & 1U) != 0) along_z |= kAlong[z];
    }
    if (along_z == 0) continue;
    for (std::uint32_t n = 0; n < 9; ++n) {
      const bool is_around =
          (kAlong[row / 8] >> (n / 3) & 1U) != 0 && (kAlong[row % 8] >> (n % 3) & 1U) != 0;
      if (is_around) around |= along_z << (3 * n);
    }
  }
  return around;
}

/// The octant of a leaf that a cell of it lies in.
std::uint8_t octant_of(const Coord& cell) {
  return static_cast<std::uint8_t>(
      1U << (4 * (cell.x() >> 2 & 1) + 2 * (cell.y() >> 2 & 1) + (cell.z() >> 2 & 1)));
}

/// The triangles of a block whose middles lie in some octants of its leaf.
SeamMesh part_in(const DisplayBlock& block, double voxel_mm, std::uint8_t octants) {
  constexpr auto kUnused = static_cast<std::uint32_t>(-1);
  SeamMesh part;
  std::vector<std::uint32_t> number(block.vertices.size(), kUnused);
  for (const Triangle& t : block.triangles) {
    Coord cell;
    for (std::size_t a = 0; a < 3; ++a) {
      double sum = 0.0;
      for (const std::uint32_t v : t) sum += static_cast<double>(block.vertices[v].position_mm[a]);
      cell[static_cast<int>(a)] = static_cast<int>(std::floor(sum / (3.0 * voxel_mm)));
    }
    if ((octant_of(cell) & octants) == 0) continue;
    Triangle kept{};
    for (std::size_t i = 0; i < 3; ++i) {
      std::uint32_t& n = number[t[i]];
      if (n == kUnused) {
        n = static_cast<std::uint32_t>(part.vertices.size());
        part.vertices.push_back(block.vertices[t[i]]);
      }
      kept[i] = n;
    }
    part.triangles.push_back(kept);
  }
  return part;
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

SketchBlocks::Octants SketchBlocks::taken_of(const LeafKey& at) const {
  return has_all_ ? kAllOctants : taken_[static_cast<std::size_t>(at.level)].get(at.origin);
}

/// A leaf gives octants that it has not given yet, and with them the clay's blocks in them.
void SketchBlocks::take(const LeafKey& at, Octants octants, std::vector<BlockId>& given) {
  static const std::vector<BlockId> kNoBlocks;
  const std::size_t group = by_leaf_.group_of(at);
  const std::vector<BlockId>& blocks =
      group < by_leaf_.groups().size() ? by_leaf_.groups()[group].blocks : kNoBlocks;
  const auto is_as_coarse = [&](const BlockId& id) { return id.level >= by_leaf_.level(); };
  // What the clay draws with the same leaf is not to be divided.
  if (std::any_of(blocks.begin(), blocks.end(), is_as_coarse)) octants = kAllOctants;
  Octants& taken = taken_[static_cast<std::size_t>(at.level)].at(at.origin);
  const auto more = static_cast<Octants>(octants & ~taken);
  if (more == 0) return;
  taken = static_cast<Octants>(taken | more);
  fresh_.push_back(at);
  for (const BlockId& id : blocks) {
    const Coord cell = leaf_of(id).origin >> std::max(0, by_leaf_.level() - id.level);
    if (more == kAllOctants || (octant_of(cell) & more) != 0) given.push_back(id);
  }
}

/// The clay gives up the blocks of octants that see a change of the surface.
void SketchBlocks::take_places(const std::vector<LeafChange>& changes, BlockLists& lists) {
  fresh_.clear();
  const LevelStack& now = levels_of(now_);
  std::vector<LeafChange> finest = seen_parts(changes, levels_of(before_), now);
  const auto coarser_ones = std::partition(
      finest.begin(), finest.end(), [](const LeafChange& change) { return change.level == 0; });
  const std::vector<LeafChange> coarse(coarser_ones, finest.end());
  finest.erase(coarser_ones, finest.end());
  std::vector<BlockId> given;
  const auto take_seeing = [&](const std::vector<LeafChange>& parts, std::size_t from) {
    const auto seeing = leaves_that_see(now, parts);
    for (std::size_t level = from; level < seeing.size(); ++level) {
      seeing[level].for_each([&](const Coord& origin, std::uint8_t) {
        take({static_cast<int>(level), origin}, kAllOctants, given);
      });
    }
  };
  take_seeing(coarse, 0);
  take_seeing(finest, 1);
  for (const LeafChange& part : finest) {
    const std::uint32_t around = octants_around(part.nodes);
    for (int n = 0; n < 27; ++n) {
      if ((around >> n & 1U) == 0) continue;
      const Coord cell = part.origin + Coord(4 * (n / 9) - 4, 4 * (n / 3 % 3) - 4, 4 * (n % 3) - 4);
      take({0, leaf_origin(cell)}, octant_of(cell), given);
    }
    // A leaf that came or went: its place is drawn by another level.
    if (part.is_whole) take(part.where(), kAllOctants, given);
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
    for (const BlockId& id : group.blocks) {
      const Coord cell = leaf_of(id).origin >> std::max(0, by_leaf_.level() - id.level);
      if ((taken_of(group.around) & octant_of(cell)) == 0) lists.gone.push_back(id);
    }
  }
  for (const auto& [id, drawn] : drawn_) lists.gone.push_back(id);
  has_all_ = true;
  drawn_.clear();
  of_sketch_ = {};
  of_clay_ = {};
}

/// Draws the blocks of these leaves as they are now, as far as they are taken.
void SketchBlocks::draw(const std::vector<LeafKey>& places, BlockLists& lists) {
  struct Job {
    BlockId id;
    Drawn drawn;
  };
  std::vector<Job> jobs;
  for (const LeafKey& at : places) {
    const Octants octants = taken_of(at);
    if (octants != 0) jobs.push_back({name_of(at), {{}, octants, {}}});
  }
  const double voxel_mm = levels_of(now_).voxel_mm(0);
  for_each_leaf(jobs.size(), [&](std::size_t n) {
    auto& [id, drawn] = jobs[n];
    // Those of coarser levels are always whole.
    if (drawn.octants != kAllOctants) drawn.part = part_in(sketched(id), voxel_mm, drawn.octants);
    drawn.border = border_of(shown_as(id, drawn));
  });
  for (auto& [id, drawn] : jobs) {
    erase(id, lists);
    if (shown_as(id, drawn).triangles.empty()) continue;
    lists.changed.push_back(id);
    of_sketch_.add(drawn.border);
    drawn_.emplace(id, std::move(drawn));
  }
}

DisplayBlock SketchBlocks::shown_as(const BlockId& id, const Drawn& drawn) const {
  DisplayBlock block = sketched(id);
  if (drawn.octants == kAllOctants) return block;
  return {drawn.part.vertices, drawn.part.triangles, block.bounds_mm};
}

void SketchBlocks::erase(const BlockId& id, BlockLists& lists) {
  const auto found = drawn_.find(id);
  if (found == drawn_.end()) return;
  of_sketch_.remove(found->second.border);
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
  if (id.origin != kSeamOrigin) {
    const auto found = drawn_.find(id);
    return found == drawn_.end() ? DisplayBlock{} : shown_as(id, found->second);
  }
  DisplayBlock block{seam_.vertices, seam_.triangles, {}};
  for (const DisplayVertex& v : seam_.vertices) {
    block.bounds_mm.include({static_cast<double>(v.position_mm[0]),
                             static_cast<double>(v.position_mm[1]),
                             static_cast<double>(v.position_mm[2])});
  }
  return block;
}

}  // namespace argil
