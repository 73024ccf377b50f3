// SPDX-License-Identifier: GPL-3.0-or-later
// The pushes of all dabs of a stroke, one after the other, make one map of space; matter is moved
// by that map once, from the clay as it was when the stroke began.
#include "brush/stroke_motion.h"

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

#include "brush/dab.h"
#include "brush/dab_plan.h"
#include "brush/masked_displacement.h"
#include "brush/motion.h"

namespace argil {
namespace {

class AlongStroke final : public Motion {
 public:
  AlongStroke(std::vector<PosedTool> dabs, std::size_t images, Push push, const Mask* mask)
      : images_(images),
        push_(push),
        displacement_(mask, bounds_of(dabs)),
        dabs_(std::move(dabs)) {}

  Vec3 source(const Vec3& point_mm) const override {
    Vec3 at = point_mm;
    for (std::size_t end = dabs_.size(); end > 0; end -= images_) {
      at = displacement_.along(at, -push_of(end - images_, at));
    }
    return at;
  }

  Vec3 image(const Vec3& point_mm) const override {
    Vec3 at = point_mm;
    for (std::size_t first = 0; first < dabs_.size(); first += images_) {
      const Vec3 free = pushed_forward(at, [&](const Vec3& y) { return push_of(first, y); });
      at = displacement_.is_free() ? free : displacement_.along(at, free - at);
    }
    return at;
  }

  std::vector<Box3> regions_mm() const override {
    std::vector<Box3> regions;
    for (const PosedTool& dab : dabs_) regions.push_back(dab.bounds_mm());
    return regions;
  }

 private:
  struct Pushed {
    Vec3 push;
    double falloff = 0.0;
  };

  /// Added in pairs, so that the sum is the same with the images in mirrored order.
  Pushed pushed_by(std::size_t first, std::size_t count, const Vec3& at) const {
    if (count == 1) return {push_(dabs_[first], at), dabs_[first].falloff(at)};
    const std::size_t half = count / 2;
    const Pushed a = pushed_by(first, half, at);
    const Pushed b = pushed_by(first + half, count - half, at);
    return {a.push + b.push, a.falloff + b.falloff};
  }

  /// Of a dab and its images. Where they meet, on a plane of symmetry, each moves its part: added
  /// up, they would take it twice as far as the hand goes.
  Vec3 push_of(std::size_t first, const Vec3& at) const {
    if (images_ == 1) return push_(dabs_[first], at);
    const Pushed all = pushed_by(first, images_, at);
    return all.push / std::max(1.0, all.falloff);
  }

  std::size_t images_;
  Push push_;
  MaskedDisplacement displacement_;
  std::vector<PosedTool> dabs_;
};

}  // namespace

void move_along(EditTarget& target, const Tool& tool, std::span<const Dab> path, std::size_t images,
                Push push) {
  assert(images > 0 && path.size() % images == 0);
  std::vector<PosedTool> dabs;
  for (const Dab& dab : path) dabs.emplace_back(tool, dab);
  const AlongStroke motion(std::move(dabs), images, push, target.stack.mask());
  move_matter(target, motion, level_of_tool(target.stack, smallest_radius(tool)));
}

}  // namespace argil
