// SPDX-License-Identifier: GPL-3.0-or-later
#include "operation/moved_level.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "clay/clay_access.h"

namespace argil {
namespace {

/// Farther than so many of their voxels, a level's feet are no better than those of the next
/// coarser one.
constexpr double kFeetReachVoxels = 16.0;
/// Nearer to the surface than this the clay is asked whether feet tell the truth: within walls too
/// thin to have feet, those of others must not.
constexpr double kKnownVoxels = 3.0;
/// By how much a distance and what the clay says there may differ, as a factor.
constexpr double kMostStretch = 1.5;

/// The coarsest level whose voxels are no larger.
int level_for(const LevelStack& stack, double voxel_mm) {
  int level = 0;
  while (level < stack.top() && stack.voxel_mm(level + 1) <= voxel_mm * (1.0 + 1e-9)) ++level;
  return level;
}

}  // namespace

FeetWanted MovedLevel::wanted(const PlacedClay& source, double voxel_mm) {
  const LevelStack& stack = levels_of(source.clay);
  const double band = kHalfWidthVoxels * voxel_mm;
  FeetWanted feet{level_for(stack, voxel_mm), source.placement, {}};
  // What lies nearer than feet count is told by the clay alone, if that is all that is in the band.
  const double near = kOfFeetVoxels * stack.voxel_mm(feet.finest);
  feet.sides = {source.offset_mm > near - band, source.offset_mm < band - near};
  while (feet.finest < stack.top() &&
         std::abs(source.offset_mm) > kFeetReachVoxels * stack.voxel_mm(feet.finest)) {
    ++feet.finest;
  }
  return feet;
}

MovedLevel::MovedLevel(const PlacedClay& source, double voxel_mm, SidesOfFeet feet)
    : stack_(levels_of(source.clay)),
      placement_(source.placement),
      offset_mm_(source.offset_mm),
      voxel_mm_(voxel_mm),
      near_level_(level_for(stack_, voxel_mm)),
      is_in_place_(stays_in_place(placement_)),
      limit_mm_(static_cast<float>(std::abs(offset_mm_) + kHalfWidthVoxels * voxel_mm)),
      is_asked_(wanted(source, voxel_mm).sides),
      scratch_([&stack = stack_] { return Scratch(stack); }) {
  for (const Coord& origin : stack_.sorted_origins(stack_.top())) {
    stored_.expand(openvdb::CoordBBox(origin, origin.offsetBy(kLeafSide - 1)));
  }
  for (std::size_t side = 0; side < 2; ++side) {
    trees_[side] = FeetTree(std::move(feet[side]), stack_);
  }
}

/// Whether nodes of a leaf are near enough to a side's feet to be within the band, and not too
/// near.
MovedLevel::Reach MovedLevel::look(std::size_t side, const Coord& origin,
                                   FeetTree::Found& found) const {
  const double half = 0.5 * (kLeafSide - 1) * voxel_mm_;
  trees_[side].collect(node_mm(origin, voxel_mm_) + Vec3{half, half, half}, half, least_mm(side),
                       limit_mm_, found);
  if (found.is_near) return Reach::all_nearer;
  return found.finest == FeetTree::Found::kNoLevel ? Reach::beyond : Reach::some;
}

Vec3 MovedLevel::taken_back(const Vec3& mm) const noexcept {
  return rotate(conjugate(placement_.orientation), mm - placement_.position_mm);
}

/// Nodes of a side that are nearer to the surface are out of the band.
float MovedLevel::least_mm(std::size_t side) const noexcept {
  const double moved = side == 0 ? offset_mm_ : -offset_mm_;
  return static_cast<float>(moved - kHalfWidthVoxels * voxel_mm_);
}

/// Whether what lies within the source's own band can be in the band that is wanted: also walls and
/// gaps too thin to have feet.
bool MovedLevel::is_near_enough(int level) const noexcept {
  return std::abs(offset_mm_) < kHalfWidthVoxels * (voxel_mm_ + stack_.voxel_mm(level));
}

bool MovedLevel::fill(const Coord& origin, LeafValues& out, bool& detail) const {
  assert(is_leaf_origin(origin));
  Scratch& scratch = scratch_.local();
  bool is_reached = false;
  for (std::size_t side = 0; side < 2; ++side) {
    if (!is_asked_[side]) continue;
    const Reach reach = look(side, origin, scratch.found[side]);
    if (reach == Reach::all_nearer) return false;
    is_reached = is_reached || reach == Reach::some;
  }
  const std::optional<int> stored = stored_level(origin, scratch.reader);
  if (!is_reached && !(stored && is_near_enough(*stored))) return false;
  const int level = stored.value_or(stack_.top());
  read_near(origin, level, scratch);
  const double voxel = stack_.voxel_mm(level);
  const int finest_feet = std::min(scratch.found[0].finest, scratch.found[1].finest);
  detail = std::min(level, finest_feet) <= near_level_;
  std::array<LeafValues, 2> told;
  for (std::size_t side = 0; side < 2; ++side) {
    if (is_asked_[side]) ask(side, voxel, scratch, told[side]);
  }
  join(voxel, scratch.near, told, out);
  return true;
}

/// The finest level, of those that may be read, that the source stores in a leaf; none where no
/// level does.
std::optional<int> MovedLevel::stored_level(const Coord& origin, LevelReader& reader) const {
  const bool is_nested = is_in_place_ && stack_.voxel_mm(near_level_) == voxel_mm_;
  const auto is_stored = [&](int level) {
    if (is_nested) return reader.leaf(level, origin >> (level - near_level_)) != nullptr;
    // Leaves of the source are no smaller than half of this one.
    constexpr std::array<int, 3> kAlong = {0, 4, kLeafSide - 1};
    for (int n = 0; n < 27; ++n) {
      const auto along = [&](int at) { return kAlong[static_cast<std::size_t>(at)]; };
      const Coord node = origin.offsetBy(along(n / 9), along(n / 3 % 3), along(n % 3));
      const Vec3 at = taken_back(node_mm(node, voxel_mm_)) / stack_.voxel_mm(level);
      if (reader.leaf(level, Coord::floor(openvdb::Vec3d(at.x, at.y, at.z))) != nullptr)
        return true;
    }
    return false;
  };
  for (int level = near_level_; level < stack_.count(); ++level) {
    if (is_stored(level)) return level;
  }
  return std::nullopt;
}

/// What a level of the clay says at the nodes of a leaf.
void MovedLevel::read_near(const Coord& origin, int level, Scratch& scratch) const {
  const NodeBox nodes{origin, origin.offsetBy(kLeafSide - 1)};
  const double voxel = stack_.voxel_mm(level);
  if (is_in_place_ && voxel == voxel_mm_) {
    scratch.reader.read(level, nodes, scratch.near);
    return;
  }
  const double ratio = voxel_mm_ / voxel;
  // Where the source has no level as coarse, all but a little of what lies between would be void.
  const bool is_straight = is_in_place_ && ratio < 2.0;
  const NodeBox box =
      is_straight ? resample_support(nodes, ratio) : place_nodes(origin, level, scratch.places);
  scratch.around.resize(box.count());
  if (scratch.reader.read(level, box, scratch.around).is_far) {
    scratch.near.fill(scratch.around.front());
  } else if (is_straight) {
    resample(scratch.around, box, ratio, nodes, static_cast<float>(kCreasedVoxels * voxel),
             scratch.near, scratch.resample);
  } else {
    const std::array<int, 3> sides = box.sides();
    const FieldJob job{scratch.around.data(), {sides[0], sides[1], sides[2]}, {}, 1.0F};
    row_loops().read_cubic(job, scratch.places, scratch.near.data());
  }
}

/// The nodes of a leaf as places among the source's nodes of a level, counted from the lowest of
/// those that Catmull-Rom reads for them, which are returned. Places where the source stores
/// nothing, all of them outside, are put beside what it stores.
NodeBox MovedLevel::place_nodes(const Coord& origin, int level, PointBlock& places) const {
  const double voxel = stack_.voxel_mm(level);
  const Quat back = conjugate(placement_.orientation);
  const Vec3 first = taken_back(node_mm(origin, voxel_mm_)) / voxel;
  const double step = voxel_mm_ / voxel;
  const std::array<Vec3, 3> along = {step * rotate(back, {1.0, 0.0, 0.0}),
                                     step * rotate(back, {0.0, 1.0, 0.0}),
                                     step * rotate(back, {0.0, 0.0, 1.0})};
  const auto place = [&](int i, int j, int k) {
    return first + 1.0 * i * along[0] + 1.0 * j * along[1] + 1.0 * k * along[2];
  };
  const int last = kLeafSide - 1;
  Box3 around;
  for (int corner = 0; corner < 8; ++corner) {
    around.include(place((corner >> 2) * last, (corner >> 1 & 1) * last, (corner & 1) * last));
  }
  const int finer = stack_.top() - level;
  NodeBox box;
  for (int a = 0; a < 3; ++a) {
    const auto axis = static_cast<std::size_t>(a);
    const double low = std::clamp(around.min[axis], std::ldexp(1.0 * stored_.min()[a], finer) - 1.0,
                                  std::ldexp(1.0 * stored_.max()[a] + 1.0, finer) + 1.0);
    const double high =
        std::clamp(around.max[axis], low, std::ldexp(1.0 * stored_.max()[a] + 1.0, finer) + 1.0);
    // One more than the four taps reach, since a place that is counted from the corner may be
    // rounded up.
    box.low[a] = static_cast<int>(std::floor(low)) - 2;
    box.high[a] = static_cast<int>(std::floor(high)) + 3;
  }
  const std::array<int, 3> sides = box.sides();
  const Vec3 corner{1.0 * box.low.x(), 1.0 * box.low.y(), 1.0 * box.low.z()};
  for (int n = 0; n < kLeafNodes; ++n) {
    const Vec3 at = place(n >> 6, n >> 3 & 7, n & 7) - corner;
    const auto within = [&](std::size_t axis) {
      return static_cast<float>(std::clamp(at[axis], 1.0, sides[axis] - 3.0));
    };
    places.x[n] = within(0);
    places.y[n] = within(1);
    places.z[n] = within(2);
  }
  std::fill_n(places.is_asked, kLeafRows, true);
  return box;
}

/// Which blocks of a leaf have nodes on a side that are far enough from the surface to ask feet.
unsigned MovedLevel::asking_blocks(std::size_t side, double voxel, const LeafValues& near) const {
  const auto low = static_cast<float>(kOfLevelVoxels * voxel);
  const float sign = side == 0 ? 1.0F : -1.0F;
  unsigned blocks = 0;
  for (unsigned row = 0; row < kLeafRows; ++row) {
    std::array<bool, 2> is_asking{};
    for (unsigned k = 0; k < kLeafSide; ++k) {
      is_asking[k / 4] |= sign * near[kLeafSide * row + k] > low;
    }
    const unsigned first = 4 * (row >> 5) + 2 * (row >> 2 & 1);
    blocks |= (is_asking[0] ? 1U : 0U) << first | (is_asking[1] ? 2U : 0U) << first;
  }
  return blocks;
}

/// Asks the feet of all levels: the one counts whose point of the surface is the nearest.
void MovedLevel::ask(std::size_t side, double voxel, Scratch& scratch, LeafValues& distance) const {
  constexpr int kBlockSide = LayerJob::kSide;
  const unsigned blocks = asking_blocks(side, voxel, scratch.near);
  for (int block = 0; block < 8; ++block) {
    if ((blocks >> block & 1U) == 0) continue;
    const std::array<int, 3> low = {kBlockSide * (block >> 2), kBlockSide * (block >> 1 & 1),
                                    kBlockSide * (block & 1)};
    std::array<float, LayerJob::kNodes> told;
    ask_block(side, scratch.found[side], low, told);
    for (int row = 0; row < kBlockSide * kBlockSide; ++row) {
      const int node = 64 * (low[0] + row / kBlockSide) + 8 * (low[1] + row % kBlockSide) + low[2];
      std::copy_n(&told[static_cast<std::size_t>(kBlockSide * row)], kBlockSide,
                  &distance[static_cast<std::size_t>(node)]);
    }
  }
}

void MovedLevel::ask_block(std::size_t side, FeetTree::Found& found, const std::array<int, 3>& low,
                           std::array<float, LayerJob::kNodes>& told) const {
  const auto step = static_cast<float>(voxel_mm_);
  std::array<float, 3> first;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    first[axis] = (static_cast<float>(low[axis]) - 0.5F * (kLeafSide - 1)) * step;
  }
  std::array<float, LayerJob::kNodes> way;
  way.fill(limit_mm_);
  told.fill(limit_mm_);
  for (std::size_t level = 0; level < found.lists.size(); ++level) {
    ClusterList& list = found.lists[level];
    if (list.is_empty()) continue;
    const double voxel = stack_.voxel_mm(static_cast<int>(level));
    std::uint64_t labels = 0;
    LayerJob job = list.job_for(first, step, static_cast<float>(kLayerVoxels * voxel),
                                static_cast<float>(kPatchVoxels * voxel), labels);
    job.by_surface = true;
    job.enough = least_mm(side);
    row_loops().lower_to_layer(job, way.data(), told.data());
  }
}

/// Joins what the clay says, at a level of these voxels, and what the feet say.
void MovedLevel::join(double voxel, const LeafValues& near, const std::array<LeafValues, 2>& told,
                      LeafValues& out) const {
  JoinJob job{};
  job.near = near.data();
  for (std::size_t side = 0; side < 2; ++side) {
    job.told[side] = is_asked_[side] ? told[side].data() : nullptr;
  }
  job.low = static_cast<float>(kOfLevelVoxels * voxel);
  job.high = static_cast<float>(kOfFeetVoxels * voxel);
  job.known = static_cast<float>(kKnownVoxels * voxel);
  job.stretch = static_cast<float>(kMostStretch);
  job.limit = limit_mm_;
  job.offset = static_cast<float>(offset_mm_);
  job.band = static_cast<float>(kHalfWidthVoxels * voxel_mm_);
  row_loops().join_told(job, out.data());
}

}  // namespace argil
