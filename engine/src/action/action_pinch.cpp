// SPDX-License-Identifier: GPL-3.0-or-later
// A push towards the axis through the tool's middle along the surface's normal. Its largest slope
// stays below one half, so that the inverse map exists and a few fixed-point steps find it
// (pushed_forward).
#include <algorithm>
#include <optional>
#include <vector>

#include "action/action.h"
#include "brush/local_plane.h"
#include "brush/masked_displacement.h"
#include "brush/motion.h"
#include "brush/pull.h"
#include "edit/redistance.h"

namespace argil {
namespace {

/// Farthest that matter moves per quarter radius at full strength, in smallest radii.
constexpr double kPinchPerQuarter = 0.05;
/// The largest of r (1 - r^2)^2.
constexpr double kPinchPeak = 0.2862;

class Pinch final : public Motion {
 public:
  Pinch(DabImages images, std::vector<std::optional<LocalPlane>> planes, const Mask* mask)
      : images_(images), planes_(std::move(planes)), displacement_(mask, bounds_of(images)) {
    const PosedTool& tool = images.front();
    inward_ = kPinchPerQuarter * tool.strength() * tool.dab().quarters / kPinchPeak;
  }

  Vec3 source(const Vec3& point_mm) const override {
    return displacement_.along(point_mm, -push(point_mm));
  }
  Vec3 image(const Vec3& point_mm) const override {
    const Vec3 free = pushed_forward(point_mm, [&](const Vec3& at) { return push(at); });
    return displacement_.is_free() ? free : displacement_.along(point_mm, free - point_mm);
  }
  /// Without a mask all nodes of a row at once.
  void sources(const Coord& origin, double voxel_mm, PointBlock& out) const override {
    if (!displacement_.is_free()) return Motion::sources(origin, voxel_mm, out);
    stay(out);
    const Vec3 first = node_mm(origin, voxel_mm);
    for (std::size_t i = 0; i < images_.size(); ++i) {
      if (planes_[i]) row_loops().add_pinch(job_of(i, first, voxel_mm), out);
    }
  }
  std::vector<Box3> regions_mm() const override {
    std::vector<Box3> regions;
    for (const PosedTool& image : images_) regions.push_back(image.bounds_mm());
    return regions;
  }

 private:
  /// What push() says, at nodes that count from `origin_mm`.
  PinchJob job_of(std::size_t image, const Vec3& origin_mm, double voxel_mm) const {
    const PosedTool& tool = images_[image];
    const Vec3 first = (origin_mm - tool.middle_mm()) / voxel_mm;
    PinchJob job{pull_job(tool, PullLaw::falloff, origin_mm, voxel_mm), {}, {}, 0.0F};
    for (std::size_t a = 0; a < 3; ++a) {
      job.first[a] = static_cast<float>(first[a]);
      job.normal[a] = static_cast<float>(planes_[image]->normal[a]);
    }
    job.inward = static_cast<float>(inward_);
    return job;
  }

  Vec3 push(const Vec3& point_mm) const {
    Vec3 sum;
    for (std::size_t i = 0; i < images_.size(); ++i) {
      const double falloff = planes_[i] ? images_[i].falloff(point_mm) : 0.0;
      if (falloff <= 0.0) continue;
      const Vec3& normal = planes_[i]->normal;
      const Vec3 from = point_mm - images_[i].middle_mm();
      const Vec3 beside = from - dot(normal, from) * normal;
      sum -= falloff * (inward_ * beside);
    }
    return sum;
  }

  DabImages images_;
  std::vector<std::optional<LocalPlane>> planes_;
  MaskedDisplacement displacement_;
  double inward_;
};

}  // namespace

void actions::pinch(EditTarget& target, DabImages images, int tool_level) {
  const LevelStack& stack = target.stack;
  // Each image has its own plane: the surface under a mirror image need not be mirrored.
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
