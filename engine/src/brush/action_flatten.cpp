// SPDX-License-Identifier: GPL-3.0-or-later
// The plane is fitted again for every dab to the clay as it stands, on the tool's level; all levels
// move towards it by the same law.
#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "brush/action.h"
#include "brush/displace.h"
#include "brush/local_plane.h"

namespace argil {
namespace {

/// How the surface is drawn to the plane.
struct PlaneRule {
  int side;  ///< 1: from above, -1: from below, 0: both
  double weight;
  double edge_radius_mm;  ///< of the edge with what is not drawn
};

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

/// A plane to which the surface is drawn as far as it faces as the plane does: the back of a thin
/// wall stays.
struct FacedPlane {
  LocalPlane plane;
  LocalField facing;  ///< the cosine between them, about
};

/// Draws the surface under each image to the plane that fits it.
class PlaneLaw final : public MoveLaw {
 public:
  PlaneLaw(const LevelEdit& level, DabImages images, const PlaneRule& rule, DisplaceStep step)
      : rule_(rule), step_(step) {
    for (const PosedTool& image : images) {
      const LocalField field = local_field(level, image.bounds_mm(), 2);
      const std::optional<LocalPlane> plane = plane_under(field, image);
      planes_.emplace_back();
      if (plane) planes_.back() = {*plane, rises_along(field, plane->normal)};
    }
  }

  void moves(std::size_t image, const LeafFeet& feet, LeafMoves& out) const override {
    if (!planes_[image]) {
      for_each_pulled(feet, [&](std::size_t n) { out.mm[n] = 0.0F; });
      return;
    }
    read_at_feet(planes_[image]->facing, feet, {}, out);
    row_loops().draw_to_plane(job_of(planes_[image]->plane, feet), feet.rows, out.mm.data());
  }

 private:
  PlaneJob job_of(const LocalPlane& plane, const LeafFeet& feet) const {
    PlaneJob job{static_cast<float>(plane.distance(feet.origin_mm)),
                 {},
                 static_cast<float>(rule_.side),
                 static_cast<float>(rule_.edge_radius_mm),
                 static_cast<float>(rule_.weight),
                 static_cast<float>(step_.at),
                 static_cast<float>(step_.count)};
    for (std::size_t a = 0; a < 3; ++a) {
      job.along[a] = static_cast<float>(feet.voxel_mm * plane.normal[a]);
    }
    return job;
  }

  PlaneRule rule_;
  DisplaceStep step_;
  std::vector<std::optional<FacedPlane>> planes_;
};

/// Draws the surface to the plane that fits it under the tool.
void draw_to_plane(EditTarget& target, DabImages images, int tool_level, int side) {
  // Edges of flat parts are obtuse: with the radius of a rim a ball would touch less than a voxel.
  constexpr double kEdgeVoxels = 3.0;
  const PosedTool& first = images.front();
  const double usual_mm = kEdgeVoxels * target.stack.voxel_mm(tool_level);
  const double edge_mm =
      std::min(target.edge_radius_mm.value_or(usual_mm), 0.5 * first.smallest_radius_mm());
  const PlaneRule rule{side, fraction_of(first), edge_mm};
  displace_in_steps(target, images, tool_level, [&](Edit& edit, DisplaceStep step) {
    return std::make_unique<PlaneLaw>(edit.level(tool_level), images, rule, step);
  });
}

}  // namespace

void actions::flatten(EditTarget& target, DabImages images, int tool_level) {
  draw_to_plane(target, images, tool_level, 0);
}

void actions::scrape(EditTarget& target, DabImages images, int tool_level) {
  draw_to_plane(target, images, tool_level, 1);
}

void actions::fill(EditTarget& target, DabImages images, int tool_level) {
  draw_to_plane(target, images, tool_level, -1);
}

}  // namespace argil
