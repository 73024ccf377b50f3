// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "argil/core/vec3.h"
#include "argil/engine/alpha_image.h"
#include "argil/engine/tool.h"

#include "tool/posed_tool.h"

namespace argil {

/// Heights in mm; least <= most.
struct HeightRange {
  double least = 0.0;
  double most = 0.0;
};

/// One dab of a tool that embosses: how high its image stands over the form that it lies on. The
/// image lies in the plane across the form's mean normal under the dab and is seen along that; its
/// rim falls off as (1 - q^2)^2, and so does what lies far before or behind that plane or faces
/// away. Of AlphaMode::tiled the image lies in the three planes of the coordinates, of which each
/// counts as far as the form faces it.
class AlphaStamp {
 public:
  /// `normal`: unit, outward. `right`: where the image's right side points before it is turned by
  /// its angle, not along the normal. `voxel_mm`: what is finer is averaged.
  AlphaStamp(const PosedTool& tool, const Vec3& normal, const Vec3& right, double voxel_mm);

  /// Over a point of the form that faces `up`, unit.
  double height_mm(const Vec3& foot_mm, const Vec3& up) const noexcept;

  /// Of all points of the form within `radius_mm` of one that faces `up`.
  HeightRange heights_mm(const Vec3& foot_mm, const Vec3& up, double radius_mm) const noexcept;

  const PosedTool& tool() const noexcept { return tool_; }

 private:
  /// A point of the form seen from the middle of the stamp.
  struct Place {
    double right, up, above;  ///< mm
  };
  Place place_of(const Vec3& foot_mm) const noexcept;
  double weight(const Place& place, const Vec3& up) const noexcept;
  double grey(const Vec3& foot_mm, const Place& place, const Vec3& up) const noexcept;
  double tiled_grey(const Vec3& foot_mm, const Vec3& up) const noexcept;

  PosedTool tool_;
  std::shared_ptr<const AlphaImage> image_;
  int layer_ = 0;
  bool is_tiled_;
  Vec3 normal_;
  Vec3 right_;
  Vec3 up_;
  double half_right_mm_;
  double half_up_mm_;
  double rim_mm_;
  double height_mm_;
  double mid_level_;
  // Of tiles.
  double cosine_ = 1.0;
  double sine_ = 0.0;
  double tile_right_mm_ = 1.0;
  double tile_up_mm_ = 1.0;
};

}  // namespace argil
