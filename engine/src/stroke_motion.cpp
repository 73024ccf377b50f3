// SPDX-License-Identifier: GPL-3.0-or-later
#include "stroke_motion.h"

#include <utility>
#include <vector>

#include "dab_plan.h"
#include "motion.h"
#include "restraint.h"

namespace argil {
namespace {

class AlongStroke final : public Motion {
 public:
  AlongStroke(std::vector<PosedTool> dabs, std::size_t images, Push push, const Mask* mask)
      : images_(images), push_(push), restraint_(mask, bounds_of(dabs)), dabs_(std::move(dabs)) {}

  Vec3 source(const Vec3& point_mm) const override {
    Vec3 at = point_mm;
    for (std::size_t end = dabs_.size(); end > 0; end -= images_) {
      at = restraint_.along(at, -pushes(end - images_, images_, at));
    }
    return at;
  }

  Vec3 image(const Vec3& point_mm) const override {
    Vec3 at = point_mm;
    for (std::size_t first = 0; first < dabs_.size(); first += images_) {
      const Vec3 free =
          pushed_forward(at, [&](const Vec3& y) { return pushes(first, images_, y); });
      at = restraint_.is_free() ? free : restraint_.along(at, free - at);
    }
    return at;
  }

  std::vector<Box3> regions_mm() const override {
    std::vector<Box3> regions;
    for (const PosedTool& dab : dabs_) regions.push_back(dab.bounds_mm());
    return regions;
  }

 private:
  /// Added in pairs, so that the sum is the same with the images in mirrored order.
  Vec3 pushes(std::size_t first, std::size_t count, const Vec3& at) const {
    if (count == 1) return push_(dabs_[first], at);
    const std::size_t half = count / 2;
    return pushes(first, half, at) + pushes(first + half, count - half, at);
  }

  std::size_t images_;
  Push push_;
  Restraint restraint_;
  std::vector<PosedTool> dabs_;
};

}  // namespace

void move_along(EditTarget& target, const Tool& tool, std::span<const Dab> way, std::size_t images,
                Push push) {
  std::vector<PosedTool> dabs;
  for (const Dab& dab : way) dabs.emplace_back(tool, dab);
  const AlongStroke motion(std::move(dabs), images, push, target.stack.mask());
  move_matter(target, motion, level_of_tool(target.stack, smallest_radius(tool)));
}

}  // namespace argil
