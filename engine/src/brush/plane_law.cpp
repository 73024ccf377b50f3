// SPDX-License-Identifier: GPL-3.0-or-later
#include "brush/plane_law.h"

#include <array>
#include <limits>

namespace argil {
namespace {

/// How far the field rises along a normal, per mm, between the nodes beside each; 0 at the rim.
LocalField rises_along(const LocalField& field, const Vec3& normal) {
  LocalField rises{field.box, field.voxel_mm, std::vector<float>(field.value.size(), 0.0F)};
  const Coord dim = field.box.dim();
  const auto rows = static_cast<std::size_t>(dim.z());
  const std::array<std::size_t, 3> stride{static_cast<std::size_t>(dim.y()) * rows, rows, 1};
  std::array<float, 3> weight;
  for (std::size_t a = 0; a < 3; ++a) {
    weight[a] = static_cast<float>(normal[a] / (2.0 * field.voxel_mm));
  }
  for (int i = 1; i + 1 < dim.x(); ++i) {
    for (int j = 1; j + 1 < dim.y(); ++j) {
      const std::size_t first =
          static_cast<std::size_t>(i) * stride[0] + static_cast<std::size_t>(j) * stride[1];
      for (std::size_t n = first + 1; n < first + rows - 1; ++n) {
        const float* at = field.value.data() + n;
        const auto rise = [&](std::size_t a) {
          const auto step = static_cast<std::ptrdiff_t>(stride[a]);
          return weight[a] * (at[step] - at[-step]);
        };
        rises.value[n] = rise(0) + rise(1) + rise(2);
      }
    }
  }
  return rises;
}

}  // namespace

FacedPlanes fit_planes(const LevelEdit& level, DabImages images, double raise) {
  FacedPlanes planes;
  for (const PosedTool& image : images) {
    const LocalField field = local_field(level, image.bounds_mm(), 2);
    std::optional<LocalPlane> plane = plane_under(field, image);
    planes.emplace_back();
    if (!plane) continue;
    plane->center_mm += raise * image.smallest_radius_mm() * plane->normal;
    planes.back() = {*plane, rises_along(field, plane->normal)};
  }
  return planes;
}

void PlaneLaw::moves(std::size_t image, const LeafFeet& feet, LeafMoves& out) const {
  const std::optional<FacedPlane>& faced = (*planes_)[image];
  if (!faced) {
    for_each_pulled(feet, [&](std::size_t n) { out.mm[n] = 0.0F; });
    return;
  }
  read_at_feet(faced->facing, feet, {}, out);
  row_loops().draw_to_plane(job_of(faced->plane, feet), feet.rows, out.mm.data());
}

PlaneJob PlaneLaw::job_of(const LocalPlane& plane, const LeafFeet& feet) const {
  constexpr float kAnywhere = std::numeric_limits<float>::max();
  PlaneJob job{static_cast<float>(plane.distance(feet.origin_mm)),
               {},
               rule_.side == PlaneRule::Side::above ? 0.0F : -kAnywhere,
               rule_.side == PlaneRule::Side::below ? 0.0F : kAnywhere,
               static_cast<float>(rule_.weight),
               static_cast<float>(step_.at),
               static_cast<float>(step_.count)};
  for (std::size_t a = 0; a < 3; ++a) {
    job.along[a] = static_cast<float>(feet.voxel_mm * plane.normal[a]);
  }
  return job;
}

}  // namespace argil
