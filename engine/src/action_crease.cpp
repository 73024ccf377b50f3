// SPDX-License-Identifier: GPL-3.0-or-later
#include <optional>
#include <vector>

#include "action.h"
#include "local_plane.h"
#include "motion.h"
#include "restraint.h"

namespace argil {
namespace {

/// Farthest that matter moves per quarter radius at full strength, in smallest radii.
constexpr double kPinchPerQuarter = 0.05;
/// The largest of r (1 - r^2)^2.
constexpr double kPeak = 0.2862;

class Pinch final : public Motion {
 public:
  Pinch(DabImages images, std::vector<std::optional<LocalPlane>> planes, const Mask* mask)
      : images_(images), planes_(std::move(planes)), restraint_(mask, bounds_of(images)) {
    const PosedTool& tool = images.front();
    const double share = kPinchPerQuarter * tool.strength() * tool.dab().quarters;
    inward_ = share / kPeak;
    down_mm_ = tool.tool().action == Action::crease ? share * tool.smallest_radius_mm() : 0.0;
  }

  Vec3 source(const Vec3& point_mm) const override {
    return restraint_.along(point_mm, -push(point_mm));
  }
  Vec3 image(const Vec3& point_mm) const override {
    const Vec3 free = pushed_forward(point_mm, [&](const Vec3& at) { return push(at); });
    return restraint_.is_free() ? free : restraint_.along(point_mm, free - point_mm);
  }
  std::vector<Box3> regions_mm() const override {
    std::vector<Box3> regions;
    for (const PosedTool& image : images_) regions.push_back(image.bounds_mm());
    return regions;
  }

 private:
  Vec3 push(const Vec3& point_mm) const {
    Vec3 sum;
    for (std::size_t i = 0; i < images_.size(); ++i) {
      const double falloff = planes_[i] ? images_[i].falloff(point_mm) : 0.0;
      if (falloff <= 0.0) continue;
      const Vec3& normal = planes_[i]->normal;
      const Vec3 from = point_mm - images_[i].middle_mm();
      const Vec3 beside = from - dot(normal, from) * normal;
      sum -= falloff * (inward_ * beside + down_mm_ * normal);
    }
    return sum;
  }

  DabImages images_;
  std::vector<std::optional<LocalPlane>> planes_;
  Restraint restraint_;
  double inward_;
  double down_mm_;
};

}  // namespace

void crease(EditTarget& target, DabImages images, int tool_level) {
  const LevelStack& stack = target.stack;
  std::vector<std::optional<LocalPlane>> planes;
  bool any = false;
  for (const PosedTool& image : images) {
    const openvdb::CoordBBox box = reached_nodes(image.bounds_mm(), stack.voxel_mm(tool_level));
    planes.push_back(plane_under(local_field(stack, tool_level, box), image));
    any = any || planes.back();
  }
  if (any) move_matter(target, Pinch(images, std::move(planes), stack.mask()), tool_level);
}

}  // namespace argil
