// SPDX-License-Identifier: GPL-3.0-or-later
#include "window/window_tiles.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "clay/clay_access.h"
#include "rows/rows.h"

namespace argil {
namespace {

/// How far into the finer ring a coarser one begins, in its own voxels.
constexpr double kOverlap = 0.25;
/// Two levels are mixed only where both know the distance, in voxels of the finer.
constexpr float kMixedVoxels = 2.5F;
/// More changes than this cost more to follow than a window.
constexpr std::size_t kMostChanges = 1000;
/// Wider than what rounding does to a bound, in voxels of a level.
constexpr double kSlack = 1e-3;

NodeBox nodes_of_tile(const Coord& at) noexcept {
  const Coord low = at << 3;
  return {low, low.offsetBy(TileFrame::kSide - 1)};
}

/// Of a block, x slowest, in its tile.
std::size_t node_in_tile(std::size_t block, std::size_t node) noexcept {
  const std::size_t i = 4 * (block >> 2) + (node >> 4);
  const std::size_t j = 4 * (block >> 1 & 1) + (node >> 2 & 3);
  const std::size_t k = 4 * (block & 1) + (node & 3);
  return 64 * i + 8 * j + k;
}

/// Where a block begins, in nodes of its tile.
Coord block_low(std::size_t block) noexcept {
  const auto n = static_cast<int>(block);
  return {4 * (n >> 2), 4 * (n >> 1 & 1), 4 * (n & 1)};
}

/// The square of the distance between two boxes, 0 where they meet.
double square_between(const Box3& a, const Box3& b) noexcept {
  double square = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double off = std::max({a.min[axis] - b.max[axis], b.min[axis] - a.max[axis], 0.0});
    square += off * off;
  }
  return square;
}

Box3 cube_around(const Vec3& center, double half) noexcept {
  const Vec3 reach{half, half, half};
  return {center - reach, center + reach};
}

bool is_within(const Box3& inner, const Box3& outer) noexcept {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (inner.min[axis] < outer.min[axis] || inner.max[axis] > outer.max[axis]) return false;
  }
  return true;
}

}  // namespace

double WindowTiles::fill(const Clay& clay, const WindowRequest& request, const NodeBox& box,
                         std::span<float> out) {
  assert(out.size() == box.count());
  try {
    LevelReader reader(levels_of(clay));
    follow(clay);
    set_lattice(levels_of(clay), request);
    move_to({box.low >> 3, box.high >> 3});
    place_rings();
    for (const FeetRing& ring : rings_) {
      forget_blocks(feet_.refresh(reader, ring.level, ring.leaves));
    }
    forget_near(reader);
    changes_.clear();
    make_missing(reader, box);
    write(box, out);
    return error_mm(reader, box);
  } catch (...) {
    *this = WindowTiles();
    throw;
  }
}

/// Learns what changed since the last window.
void WindowTiles::follow(const Clay& clay) {
  auto since = identity(clay) == clay_ ? changes_since(clay, revision_) : std::nullopt;
  if (!since || since->size() > kMostChanges) {
    feet_.clear();
    tiles_.clear();
    box_ = {Coord(0, 0, 0), Coord(-1, -1, -1)};
  } else {
    changes_ = std::move(*since);
    feet_.note(changes_);
  }
  clay_ = identity(clay);
  finest_mm_ = levels_of(clay).voxel_mm(0);
  revision_ = revision(clay);
}

void WindowTiles::set_lattice(const LevelStack& stack, const WindowRequest& request) {
  const bool is_same =
      request.voxel_mm == lattice_.voxel_mm && request.depth_mm == lattice_.depth_mm;
  if (is_same && !tiles_.empty()) return;
  tiles_.clear();
  box_ = {Coord(0, 0, 0), Coord(-1, -1, -1)};
  lattice_.levels = choose_level(request.voxel_mm, stack.voxel_mm(0), stack.top());
  lattice_.voxel_mm = request.voxel_mm;
  lattice_.depth_mm = request.depth_mm;
  lattice_.limit_mm = farthest_mm(stack, lattice_.levels, request);
  rings_ = rings_for(stack, lattice_.levels, request);
  collected_.resize(rings_.size());
}

/// Keeps the tiles that the next window has too.
void WindowTiles::move_to(const NodeBox& tiles) {
  std::vector<std::unique_ptr<Tile>> moved(tiles.count());
  const bool has_some = !tiles_.empty();
  std::size_t n = 0;
  for_each_node(tiles, [&](const Coord& at) {
    auto& to = moved[n++];
    to = has_some && box_.has(at) ? std::move(tiles_[index_of(at)]) : std::make_unique<Tile>();
  });
  tiles_ = std::move(moved);
  box_ = tiles;
}

std::size_t WindowTiles::index_of(const Coord& at) const {
  const auto n = box_.sides();
  const Coord from = at - box_.low;
  assert(from.x() >= 0 && from.x() < n[0] && from.y() >= 0 && from.y() < n[1] && from.z() >= 0 &&
         from.z() < n[2]);
  return static_cast<std::size_t>((from.x() * n[1] + from.y()) * n[2] + from.z());
}

/// Puts the rings around all that some tile may ask for.
void WindowTiles::place_rings() {
  const NodeBox nodes{box_.low << 3, (box_.high << 3).offsetBy(kSide - 1)};
  for (FeetRing& ring : rings_) {
    const double ratio = lattice_.voxel_mm / ring.voxel_mm;
    const double reach = ring.reach_mm / ring.voxel_mm + kBelowVoxels + 1.0;
    NodeBox wanted;
    for (int axis = 0; axis < 3; ++axis) {
      wanted.low[axis] = static_cast<int>(std::floor(nodes.low[axis] * ratio - reach));
      wanted.high[axis] = static_cast<int>(std::ceil(nodes.high[axis] * ratio + reach));
    }
    ring.leaves = {wanted.low >> 3, wanted.high >> 3};
    feet_.trim(ring.level, wanted);
  }
}

TileFrame WindowTiles::frame_of(const Coord& at) const {
  const double half = 0.5 * (kSide - 1) * lattice_.voxel_mm;
  return {node_mm(at << 3, lattice_.voxel_mm) + Vec3{half, half, half}, half};
}

/// Half the side of the cube around a tile's centre that the rings before this one speak for.
double WindowTiles::inner_mm(std::size_t ring) const {
  if (ring == 0) return -1.0;
  return 0.5 * (kSide - 1) * lattice_.voxel_mm + rings_[ring - 1].reach_mm -
         kOverlap * rings_[ring].voxel_mm;
}

/// Blocks some of whose nodes were nearest to feet that went or may be to some that came.
void WindowTiles::forget_blocks(const std::vector<FeetChange>& changes) {
  if (changes.empty()) return;
  for_each_node(box_, [&](const Coord& at) {
    Tile& tile = *tiles_[index_of(at)];
    if (tile.made == 0) return;
    const TileFrame frame = frame_of(at);
    for (const FeetChange& change : changes) {
      const auto ring = std::ranges::find(rings_, change.level, &FeetRing::level);
      if (ring == rings_.end()) continue;
      if (!change.gone.empty()) forget_blocks_near(tile, frame, *ring, change.gone, change.label);
      const double inner = inner_mm(static_cast<std::size_t>(ring - rings_.begin()));
      const Box3 left_out = cube_around(frame.center_mm, inner - kSlack * ring->voxel_mm);
      if (change.came.empty() || (inner > 0.0 && is_within(change.surface, left_out))) continue;
      forget_blocks_near(tile, frame, *ring, change.came, ~std::uint64_t{0});
    }
  });
}

/// Blocks with one of these labels some of whose nodes have no foot nearer than a box of feet.
void WindowTiles::forget_blocks_near(Tile& tile, const TileFrame& frame, const FeetRing& ring,
                                     const Box3& feet, std::uint64_t labels) const {
  // The way over a foot is at least its own distance and the layer's; a little more is looked at.
  const double layer = (kLayerVoxels - kSlack) * ring.voxel_mm;
  const double most = static_cast<double>(tile.longest) - layer;
  const Box3 nodes = cube_around(frame.center_mm, frame.half_mm);
  if (most < 0.0 || square_between(nodes, feet) > most * most) return;
  PointBox seen;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    seen.low[axis] = static_cast<float>(feet.min[axis] - frame.center_mm[axis]);
    seen.high[axis] = static_cast<float>(feet.max[axis] - frame.center_mm[axis]);
  }
  const bool is_any = ~labels == 0;
  for (std::size_t block = 0; block < kBlocks; ++block) {
    if ((tile.made >> block & 1U) == 0) continue;
    if (!is_any && (tile.labels[block] & labels) == 0) continue;
    std::array<float, kParts> within;
    for (std::size_t part = 0; part < kParts; ++part) {
      within[part] = tile.bound[block][part] - static_cast<float>(layer);
    }
    if (concerns(within, block, seen)) {
      tile.made = static_cast<std::uint8_t>(tile.made & ~(1U << block));
    }
  }
}

/// Whether feet in a box, seen from the tile's centre, are as near to some part as it says.
bool WindowTiles::concerns(const std::array<float, kParts>& within, std::size_t block,
                           const PointBox& feet) const {
  const auto step = static_cast<float>(lattice_.voxel_mm);
  std::array<float, kParts> squares{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int low_node = block_low(block)[static_cast<int>(axis)];
    const float low = (static_cast<float>(low_node) - 0.5F * (kSide - 1)) * step;
    const unsigned bit = 2U - static_cast<unsigned>(axis);
    std::array<float, 2> off;  // of the lower and the upper two nodes
    for (std::size_t half = 0; half < 2; ++half) {
      const float first = low + 2.0F * static_cast<float>(half) * step;
      off[half] = std::max({feet.low[axis] - (first + step), first - feet.high[axis], 0.0F});
    }
    for (unsigned part = 0; part < kParts; ++part) {
      const float along = off[part >> bit & 1U];
      squares[part] += along * along;
    }
  }
  bool is_concerned = false;
  for (std::size_t part = 0; part < kParts; ++part) {
    is_concerned |= within[part] >= 0.0F && squares[part] <= within[part] * within[part];
  }
  return is_concerned;
}

/// Whether what the levels say at a tile's nodes may have changed.
bool WindowTiles::is_near_touched(const Tile& tile, const TileFrame& frame) const {
  const Box3 nodes = cube_around(frame.center_mm, frame.half_mm);
  const LevelChoice& levels = lattice_.levels;
  return std::ranges::any_of(changes_, [&](const LeafChange& change) {
    if (change.level < levels.finer_level) return false;
    if (change.level > std::max(tile.coarsest, levels.level)) return false;
    const double voxel = std::ldexp(finest_mm_, change.level);
    const NodeBox changed = changed_nodes_of(change);
    const double margin_mm = kReadReach * voxel;
    const Vec3 margin{margin_mm, margin_mm, margin_mm};
    const Box3 read{node_mm(changed.low, voxel) - margin, node_mm(changed.high, voxel) + margin};
    return square_between(nodes, read) == 0.0;
  });
}

/// Reads tiles again where the clay changed, and forgets the blocks that differ.
void WindowTiles::forget_near(LevelReader& reader) {
  if (changes_.empty()) return;
  for_each_node(box_, [&](const Coord& at) {
    Tile& tile = *tiles_[index_of(at)];
    if (!tile.is_read || !is_near_touched(tile, frame_of(at))) return;
    const std::array<float, kNodes> former = tile.near;
    read_near(reader, at, tile);
    for (std::size_t block = 0; block < kBlocks; ++block) {
      for (std::size_t n = 0; n < LayerJob::kNodes; ++n) {
        const std::size_t node = node_in_tile(block, n);
        if (former[node] == tile.near[node]) continue;
        tile.made = static_cast<std::uint8_t>(tile.made & ~(1U << block));
        break;
      }
    }
  });
}

/// What the levels say at a tile's nodes.
void WindowTiles::read_near(LevelReader& reader, const Coord& at, Tile& tile) {
  const LevelChoice& levels = lattice_.levels;
  const NodeBox nodes = nodes_of_tile(at);
  const auto read = [&](int level, std::span<float> out) {
    const double ratio = lattice_.voxel_mm / reader.stack().voxel_mm(level);
    const NodeBox support = resample_support(nodes, ratio);
    support_.resize(support.count());
    const LevelReader::Reading reading = reader.read(level, support, support_);
    if (reading.is_far) {
      std::fill(out.begin(), out.end(),
                std::copysign(reader.stack().band_mm(level), support_.front()));
    } else {
      const auto crease = static_cast<float>(kCreasedVoxels * reader.stack().voxel_mm(level));
      resample(support_, support, ratio, nodes, crease, out, resample_);
    }
    return reading;
  };
  const LevelReader::Reading finer = read(levels.finer_level, tile.near);
  tile.is_read = true;
  tile.is_far = finer.is_far;
  tile.coarsest = finer.coarsest;
  if (levels.finer_fraction == 1.0 || levels.finer_level == levels.level || finer.is_far) return;
  coarser_.resize(kNodes);
  tile.coarsest = std::max(tile.coarsest, read(levels.level, coarser_).coarsest);
  const auto fraction = static_cast<float>(levels.finer_fraction);
  const float mixed =
      kMixedVoxels * static_cast<float>(reader.stack().voxel_mm(levels.finer_level));
  for (std::size_t n = 0; n < kNodes; ++n) {
    if (!(std::abs(tile.near[n]) < mixed)) continue;
    tile.near[n] = fraction * tile.near[n] + (1.0F - fraction) * coarser_[n];
  }
}

/// Makes the blocks that `box` needs and that do not hold.
void WindowTiles::make_missing(LevelReader& reader, const NodeBox& box) {
  std::vector<RingLayers> layers;
  for (const FeetRing& ring : rings_) layers.emplace_back(ring, feet_, reader);
  for_each_node(box_, [&](const Coord& at) {
    Tile& tile = *tiles_[index_of(at)];
    unsigned missing = 0;
    for (std::size_t block = 0; block < kBlocks; ++block) {
      const Coord low = (at << 3) + block_low(block);
      bool is_needed = (tile.made >> block & 1U) == 0;
      for (int axis = 0; axis < 3; ++axis) {
        is_needed = is_needed && low[axis] <= box.high[axis] && low[axis] + 3 >= box.low[axis];
      }
      if (is_needed) missing |= 1U << block;
    }
    if (missing == 0) return;
    if (!tile.is_read) read_near(reader, at, tile);
    make_blocks(layers, at, missing, tile);
  });
}

/// On which sides of the surface a block has nodes that ask a layer: bit 0 outside, 1 inside.
unsigned WindowTiles::sides_of(const Tile& tile, std::size_t block) const {
  if (tile.is_far) return tile.near.front() < 0.0F ? 2 : 1;
  const auto near = static_cast<float>(kOfLevelVoxels * rings_.front().voxel_mm);
  unsigned sides = 0;
  for (std::size_t n = 0; n < LayerJob::kNodes; ++n) {
    const float value = tile.near[node_in_tile(block, n)];
    if (std::abs(value) > near) sides |= value < 0.0F ? 2U : 1U;
  }
  return sides;
}

void WindowTiles::make_blocks(std::vector<RingLayers>& layers, const Coord& at, unsigned blocks,
                              Tile& tile) {
  std::array<unsigned, kBlocks> sides{};
  std::array<unsigned, 2> asking{};
  for (std::size_t block = 0; block < kBlocks; ++block) {
    if ((blocks >> block & 1U) == 0) continue;
    sides[block] = sides_of(tile, block);
    for (std::size_t side = 0; side < 2; ++side) {
      if ((sides[block] >> side & 1U) != 0) asking[side] |= 1U << block;
    }
  }
  for (std::size_t side = 0; side < 2; ++side) {
    if (asking[side] != 0) ask_layers(layers, side, frame_of(at), asking[side]);
  }
  for (std::size_t block = 0; block < kBlocks; ++block) {
    if ((blocks >> block & 1U) != 0) finish_block(block, tile);
  }
  tile.made = static_cast<std::uint8_t>(tile.made | blocks);
}

void WindowTiles::ask_layers(std::vector<RingLayers>& layers, std::size_t side,
                             const TileFrame& frame, unsigned blocks) {
  const auto limit = static_cast<float>(lattice_.limit_mm);
  float bound = limit;
  for (std::size_t n = 0; n < layers.size(); ++n) {
    collected_[n].collect(layers[n], side, frame, inner_mm(n), bound);
  }
  const auto step = static_cast<float>(lattice_.voxel_mm);
  for (std::size_t block = 0; block < kBlocks; ++block) {
    if ((blocks >> block & 1U) == 0) continue;
    BlockWork& work = work_[side][block];
    work.labels = 0;
    work.bound.fill(limit);
    work.distance.fill(limit);
    std::array<float, 3> first;
    for (int axis = 0; axis < 3; ++axis) {
      first[static_cast<std::size_t>(axis)] =
          (static_cast<float>(block_low(block)[axis]) - 0.5F * (kSide - 1)) * step;
    }
    for (TileFeet& feet : collected_) {
      if (feet.is_empty()) continue;
      row_loops().lower_to_layer(feet.job_for(first, step, work.labels), work.bound.data(),
                                 work.distance.data());
    }
  }
}

/// Joins what the levels and the layers say.
void WindowTiles::finish_block(std::size_t block, Tile& tile) const {
  const double voxel = rings_.front().voxel_mm;
  const auto near = static_cast<float>(kOfLevelVoxels * voxel);
  const auto far = static_cast<float>(kOfFeetVoxels * voxel);
  const auto limit = static_cast<float>(lattice_.limit_mm);
  std::array<float, kParts> bound{};
  std::uint64_t labels = 0;
  for (std::size_t n = 0; n < LayerJob::kNodes; ++n) {
    const float value = tile.near[node_in_tile(block, n)];
    const float size = std::abs(value);
    float& out = tile.distance[block][n];
    if (size <= near) {
      out = std::clamp(value, -limit, limit) + 0.0F;  // no -0, which changes take for 0
      continue;
    }
    const BlockWork& work = work_[value < 0.0F ? 1 : 0][block];
    const float share = std::clamp((far - size) / (far - near), 0.0F, 1.0F);
    const float mixed = share * size + (1.0F - share) * work.distance[n];
    out = std::copysign(std::clamp(mixed, std::min(near, limit), limit), value);
    float& longest = bound[(n >> 5 & 1U) * 4 + (n >> 3 & 1U) * 2 + (n >> 1 & 1U)];
    longest = std::max(longest, work.bound[n]);
    labels |= work.labels;
  }
  tile.bound[block] = bound;
  tile.labels[block] = labels;
  tile.longest = std::max(tile.longest, *std::ranges::max_element(bound));
}

/// Of the leaves that the window touches, two levels mixed as its nodes are.
double WindowTiles::error_mm(LevelReader& reader, const NodeBox& box) {
  const auto of_level = [&](int level) {
    const double voxel = reader.stack().voxel_mm(level);
    const NodeBox nodes = resample_support(box, lattice_.voxel_mm / voxel);
    ErrorSum sum;
    for_each_leaf_origin({nodes.low, nodes.high},
                         [&](const Coord& origin) { sum += feet_.error(reader, level, origin); });
    return window_error_mm(sum, voxel);
  };
  const LevelChoice& levels = lattice_.levels;
  const double finer = of_level(levels.finer_level);
  if (levels.finer_level == levels.level || levels.finer_fraction == 1.0) return finer;
  return levels.finer_fraction * finer + (1.0 - levels.finer_fraction) * of_level(levels.level);
}

void WindowTiles::write(const NodeBox& box, std::span<float> out) {
  float* to = out.data();
  for (int x = box.low.x(); x <= box.high.x(); ++x) {
    for (int y = box.low.y(); y <= box.high.y(); ++y) {
      int z = box.low.z();
      while (z <= box.high.z()) {
        const Coord node(x, y, z);
        const Tile& tile = *tiles_[index_of(node >> 3)];
        const Coord in_tile = node & 7;
        const auto block = static_cast<std::size_t>((in_tile.x() >> 2) * 4 +
                                                    (in_tile.y() >> 2) * 2 + (in_tile.z() >> 2));
        const int rest = std::min(4 - (z & 3), box.high.z() - z + 1);
        const float* from =
            tile.distance[block].data() + (in_tile.x() & 3) * 16 + (in_tile.y() & 3) * 4 + (z & 3);
        to = std::copy_n(from, rest, to);
        z += rest;
      }
    }
  }
}

}  // namespace argil
