// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "brush/displace.h"
#include "brush/local_plane.h"
#include "edit/level_edit.h"

namespace argil {

/// From where a surface is drawn to a plane, and where that lies.
struct PlaneRule {
  enum class Side { below = -1, both = 0, above = 1 };
  Side side = Side::both;
  double raise = 0.0;   ///< of the plane above the one that fits, in smallest radii
  double weight = 1.0;  ///< the part of the distance that is covered at full pull, 0 to 1
};

/// Of each image the plane that fits the surface under it, raised; none where there is no surface.
struct FacedPlane {
  LocalPlane plane;
  LocalField facing;  ///< the cosine between surface and plane, about
};
using FacedPlanes = std::vector<std::optional<FacedPlane>>;

/// `raise`: as in PlaneRule. To the level as the edit has it now.
FacedPlanes fit_planes(const LevelEdit& level, DabImages images, double raise);

/// Draws the surface under each image to its plane, as far as it faces as the plane does: the back
/// of a thin wall stays.
class PlaneLaw : public MoveLaw {
 public:
  PlaneLaw(std::shared_ptr<const FacedPlanes> planes, const PlaneRule& rule, DisplaceStep step)
      : planes_(std::move(planes)), rule_(rule), step_(step) {}

  void moves(std::size_t image, const LeafFeet& feet, LeafMoves& out) const override;

 private:
  PlaneJob job_of(const LocalPlane& plane, const LeafFeet& feet) const;

  std::shared_ptr<const FacedPlanes> planes_;
  PlaneRule rule_;
  DisplaceStep step_;
};

}  // namespace argil
