// SPDX-License-Identifier: GPL-3.0-or-later
// The pushes of all dabs of a stroke, one after the other, make one map of space; matter is moved
// by that map once, from the clay as it was when the stroke began. Most leaves are within reach of
// few dabs.
#include "brush/stroke_motion.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "brush/dab_plan.h"
#include "brush/form_field.h"
#include "brush/masked_displacement.h"
#include "brush/motion.h"
#include "brush/pull.h"

namespace argil {
namespace {

class AlongStroke final : public Motion {
 public:
  AlongStroke(std::vector<PosedTool> dabs, std::size_t images, const Push& push, const Mask* mask)
      : images_(images),
        push_(push),
        displacement_(mask, bounds_of(dabs)),
        dabs_(std::move(dabs)) {}

  Vec3 source(const Vec3& point_mm) const override {
    Vec3 at = point_mm;
    for (std::size_t end = dabs_.size(); end > 0; end -= images_) {
      const std::size_t first = end - images_;
      if (reaches(first, at)) at = displacement_.along(at, -push_of(first, at));
    }
    return at;
  }

  Vec3 image(const Vec3& point_mm) const override {
    Vec3 at = point_mm;
    for (std::size_t first = 0; first < dabs_.size(); first += images_) {
      const Vec3 free = pushed_forward(
          at, [&](const Vec3& y) { return reaches(first, y) ? push_of(first, y) : Vec3{}; });
      at = displacement_.is_free() ? free : displacement_.along(at, free - at);
    }
    return at;
  }

  /// All nodes of a row at once, where no mask and no meeting images say otherwise.
  void sources(const Coord& origin, double voxel_mm, PointBlock& out) const override {
    std::vector<std::size_t> pushing;
    const bool is_plain = find_pushing(origin, voxel_mm, pushing);
    if (!is_plain && !pushing.empty()) return Motion::sources(origin, voxel_mm, out);
    stay(out);
    const Vec3 first = node_mm(origin, voxel_mm);
    for (const std::size_t dab : pushing) {
      row_loops().add_drag(job_of(dabs_[dab], first, voxel_mm), out);
    }
  }

  std::vector<Box3> regions_mm() const override { return boxes_around(dabs_, images_).boxes_mm; }

 private:
  struct Pushed {
    Vec3 push;
    double falloff = 0.0;
  };

  /// Added in pairs, so that the sum is the same with the images in mirrored order.
  Pushed pushed_by(std::size_t first, std::size_t count, const Vec3& at) const {
    if (count == 1) return {push_.at(first, dabs_[first], at), dabs_[first].falloff(at)};
    const std::size_t half = count / 2;
    const Pushed a = pushed_by(first, half, at);
    const Pushed b = pushed_by(first + half, count - half, at);
    return {a.push + b.push, a.falloff + b.falloff};
  }

  /// Of a dab and its images. Where they meet, on a plane of symmetry, each moves its part: added
  /// up, they would take it twice as far as the hand goes.
  Vec3 push_of(std::size_t first, const Vec3& at) const {
    if (images_ == 1) return push_.at(first, dabs_[first], at);
    const Pushed all = pushed_by(first, images_, at);
    return all.push / std::max(1.0, all.falloff);
  }

  /// Whether a dab or an image of it may push at a point: what is outside their boxes stays.
  bool reaches(std::size_t first, const Vec3& at) const {
    return std::any_of(dabs_.begin() + static_cast<std::ptrdiff_t>(first),
                       dabs_.begin() + static_cast<std::ptrdiff_t>(first + images_),
                       [&](const PosedTool& dab) {
                         return dab.bounds_mm().meets({at, at});
                       });
  }

  /// The farthest that a dab pushes.
  static double most_mm(const PosedTool& tool) {
    const Dab& dab = tool.dab();
    const Vec3& radii = tool.radii_mm();
    return std::abs(tool.strength()) * length(dab.at.position_mm - dab.from.position_mm) *
           std::max({radii.x, radii.y, radii.z}) / tool.smallest_radius_mm();
  }

  /// Dabs and images that may push sources of the nodes of a leaf, the last first. Returns whether
  /// add_drag does what they do.
  bool find_pushing(const Coord& origin, double voxel_mm, std::vector<std::size_t>& out) const {
    bool is_plain = push_.way(dabs_.front()).has_value() && displacement_.is_free();
    const double side = (kLeafSide - 1) * voxel_mm;
    const Vec3 low = node_mm(origin, voxel_mm);
    Box3 within{low, low + Vec3{side, side, side}};  // all sources so far
    for (std::size_t end = dabs_.size(); end > 0; end -= images_) {
      const std::size_t before = out.size();
      double most = 0.0;
      for (std::size_t n = end - images_; n < end; ++n) {
        if (dabs_[n].smallest_radius_mm() <= 0.0) continue;  // without pressure it pushes nothing
        if (!dabs_[n].bounds_mm().meets(within)) continue;
        out.push_back(n);
        most = std::max(most, most_mm(dabs_[n]));
      }
      if (out.size() == before) continue;
      is_plain = is_plain && out.size() == before + 1;
      const Vec3 margin{most, most, most};
      within = {within.min - margin, within.max + margin};
    }
    return is_plain;
  }

  DragJob job_of(const PosedTool& tool, const Vec3& origin_mm, double voxel_mm) const {
    DragJob job{pull_job(tool, PullLaw::falloff, origin_mm, voxel_mm), {}};
    const Vec3 way = *push_.way(tool) / voxel_mm;
    for (std::size_t a = 0; a < 3; ++a) job.shift[a] = static_cast<float>(way[a]);
    return job;
  }

  std::size_t images_;
  const Push& push_;
  MaskedDisplacement displacement_;
  std::vector<PosedTool> dabs_;
};

}  // namespace

std::vector<PosedTool> posed_along(const Tool& tool, std::span<const Dab> path) {
  std::vector<PosedTool> dabs;
  for (const Dab& dab : path) dabs.emplace_back(tool, dab);
  return dabs;
}

std::unique_ptr<const Motion> motion_along(std::vector<PosedTool> dabs, std::size_t images,
                                           const Push& push, const Mask* mask) {
  assert(images > 0 && !dabs.empty() && dabs.size() % images == 0);
  return std::make_unique<AlongStroke>(std::move(dabs), images, push, mask);
}

void move_along(EditTarget& target, std::vector<PosedTool> dabs, std::size_t images, int tool_level,
                const Push& push) {
  assert(images > 0 && !dabs.empty() && dabs.size() % images == 0);
  std::vector<Box3> reached;
  for (const PosedTool& dab : dabs) reached.push_back(dab.bounds_mm());
  const AlongStroke motion(std::move(dabs), images, push, target.stack.mask());
  move_matter(target, motion, tool_level);
  if (target.redistance_queue != nullptr) flush_queue(target, reached);
}

}  // namespace argil
