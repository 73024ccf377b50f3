// SPDX-License-Identifier: GPL-3.0-or-later
// Forward advection of vertices: each dab takes them on from where the dab before left them, so
// that a dab costs the same however long the stroke is.
#include "live/dragged_blocks.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "brush/motion.h"
#include "surface/display_access.h"

namespace argil {
namespace {

/// Motion::image is good to plan by. Each of these steps halves what is left, or better: together
/// they leave some thousandths of it.
constexpr int kRefinements = 2;
/// Over which the map is differenced, in radii: far below what a falloff changes over, far above
/// rounding.
constexpr double kTiltRadii = 1e-4;

Vec3 vec_of_dragged(const std::array<float, 3>& v) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

std::array<float, 3> dragged_to(const Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// Where the matter at a point goes; its own bits where it stays.
Vec3 dragged(const Motion& motion, const Vec3& from) {
  Vec3 to = motion.image(from);
  if (to == from) return from;
  for (int i = 0; i < kRefinements; ++i) to += from - motion.source(to);
  return to;
}

/// The normal of what had `normal` where matter came from and is at `to` now: the gradient of what
/// it measures, which is a function of the source.
Vec3 tilted(const Motion& motion, const Vec3& to, const Vec3& normal, double step_mm) {
  const Vec3 source = motion.source(to);
  Vec3 slope;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Vec3 beside = to;
    beside[axis] += step_mm;
    slope[axis] = dot(normal, motion.source(beside) - source);
  }
  return dot(slope, slope) > 0.0 ? normalized(slope) : normal;
}

bool meets_any(const std::vector<Box3>& regions_mm, const Box3& box_mm) {
  return std::any_of(regions_mm.begin(), regions_mm.end(),
                     [&](const Box3& region) { return region.meets(box_mm); });
}

}  // namespace

DraggedBlocks::DraggedBlocks(const DisplaySurface& shown, const Tool& tool,
                             const StrokeStyle& style, const Mask* mask)
    : shown_(shown),
      tool_(tool),
      mask_(mask),
      push_(drag_push_of(tool.action)),
      feeder_(tool, style) {
  assert(push_ != nullptr);
  for (const BlockId& id : DisplayAccess::drawn(shown)) {
    numbers_.emplace(id, blocks_.size());
    Moved& block = blocks_.emplace_back();
    block.id = id;
    block.bounds_mm = shown.block(id).bounds_mm;
  }
}

void DraggedBlocks::feed(std::span<const StrokeSample> samples) {
  for (const StrokeSample& sample : samples) feeder_.feed(sample, waiting_);
}

void DraggedBlocks::finish() { feeder_.finish(waiting_); }

void DraggedBlocks::drag(const Motion& motion, Moved& block) const {
  if (block.points.empty()) {
    for (const DisplayVertex& vertex : shown_.block(block.id).vertices) {
      block.points.push_back({vec_of_dragged(vertex.position_mm), vec_of_dragged(vertex.normal)});
    }
    const auto vertices = shown_.block(block.id).vertices;
    block.vertices.assign(vertices.begin(), vertices.end());
  }
  const double step_mm = kTiltRadii * smallest_radius(tool_);
  Box3 bounds;
  for (std::size_t i = 0; i < block.points.size(); ++i) {
    Point& point = block.points[i];
    const Vec3 to = dragged(motion, point.place_mm);
    if (to != point.place_mm) {
      point.normal = tilted(motion, to, point.normal, step_mm);
      point.place_mm = to;
      block.vertices[i] = {dragged_to(to), dragged_to(point.normal)};
      block.differs = true;
    }
    bounds.include(point.place_mm);
    bounds.include(vec_of_dragged(block.vertices[i].position_mm));
  }
  block.bounds_mm = bounds;
}

std::int64_t DraggedBlocks::update(BlockLists& lists) {
  const std::size_t images = feeder_.images();
  assert(waiting_.size() % images == 0);
  std::int64_t count = 0;
  // One after the other: what a dab meets is known once the dab before has moved it.
  for (std::size_t first = 0; first < waiting_.size(); first += images) {
    const auto motion = motion_along(posed_along(tool_, std::span(waiting_).subspan(first, images)),
                                     images, *push_, mask_);
    const std::vector<Box3> regions_mm = motion->regions_mm();
    std::vector<std::size_t> met;
    for (std::size_t n = 0; n < blocks_.size(); ++n) {
      if (meets_any(regions_mm, blocks_[n].bounds_mm)) met.push_back(n);
    }
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, met.size()),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                        for (std::size_t n = range.begin(); n < range.end(); ++n) {
                          drag(*motion, blocks_[met[n]]);
                        }
                      });
    count += static_cast<std::int64_t>(met.size());
  }
  waiting_.clear();
  for (Moved& block : blocks_) {
    if (std::exchange(block.differs, false)) lists.changed.push_back(block.id);
  }
  return count;
}

DisplayBlock DraggedBlocks::block(const BlockId& id) const {
  const auto at = numbers_.find(id);
  if (at == numbers_.end() || blocks_[at->second].points.empty()) return shown_.block(id);
  const Moved& moved = blocks_[at->second];
  return {moved.vertices, DisplayAccess::block(shown_, id).triangles, moved.bounds_mm};
}

}  // namespace argil
