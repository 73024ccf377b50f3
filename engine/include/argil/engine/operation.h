// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/core/vec3.h"

namespace argil {

class Clay;

// What can be done to a clay as a whole: Clay::apply(operation). Each is one undo step. A number
// out of the range that stands here is bad_input, with the range for the clay at hand in mm; what
// would leave no clay is refused likewise, and the clay stays as it was. docs/operations.md has
// pictures, accuracy and times.

/// Moves the whole surface along its normal: everything within `distance_mm` of the clay becomes
/// clay (edges and corners come out round), or, where negative, everything within it of the
/// outside is taken away.
struct Offset {
  /// Units mm. Between a twentieth of the finest voxel and the longest side of the clay, in
  /// either direction.
  double distance_mm = 0.0;
};

/// A round hole from the outside into the cavity, for what would stay within when printing. Its
/// line must meet the cavity; it ends there and goes through no second wall.
struct Drain {
  /// On or before the outer surface, however far; a point deep within the clay is refused.
  Vec3 point_mm;
  Vec3 direction;  ///< into the clay, any length but zero
  /// From 2 finest voxels to half the longest side of the clay.
  double radius_mm = 0.0;
};

/// Leaves a wall of this thickness and takes the inside away; the outer surface stays where it was,
/// to a tenth of a voxel, at sharp rims a fifth, but where drains pass it.
struct Hollow {
  /// From 3 finest voxels (resample finer for less) to half the longest side of the clay. Where two
  /// voxels of cavity find no room between two such walls it stays solid; somewhere they must.
  double wall_mm = 0.0;
  /// None leaves the cavity closed.
  std::vector<Drain> drains;
};

/// Takes away what lies on one side of a plane. What is far from the plane keeps its bits
/// (OperationDetail.FarFromACutOrCombinationKeepsItsBits).
struct Cut {
  Vec3 point_mm;               ///< on the plane
  Vec3 normal{0.0, 0.0, 1.0};  ///< any length but zero
  bool keeps_front = false;    ///< keeps the side that the normal points to, else the other
};

enum class CombineKind { unite, subtract, intersect };

/// Where another solid is put: turned about its origin, then moved.
struct Placement {
  Vec3 position_mm;
  Quat orientation;  ///< any length but zero; normalised before use
};

/// Union, difference or intersection with another solid. One of `clay` and `mesh` is given.
///
/// A union may be at most 256 voxels of the clay's coarsest level long: combine the smaller with
/// the larger. The other solid is brought to the voxels of this clay, unless it is a clay with the
/// same voxel that is not turned or moved.
struct Combine {
  CombineKind kind = CombineKind::unite;
  /// Not changed. Detail finer than the voxel of the clay that is edited is lost.
  std::shared_ptr<const Clay> clay;
  std::shared_ptr<const TriangleMesh> mesh;  ///< mm, closed; overlapping parts count as their union
  Placement placement;
};

/// The same clay with another finest voxel. A power of two of the voxel keeps the bits of all
/// levels that stay; any other rebuilds all levels.
struct Resample {
  /// At most the voxel of the clay's coarsest level; as ClayOptions has it, and large enough for
  /// the clay's extent (kMaxNode) and its 24 levels. The one that the clay has is refused.
  double voxel_mm = 0.0;
};

using Operation = std::variant<Offset, Hollow, Cut, Combine, Resample>;

/// What can be done to a clay's mask as a whole: Clay::apply(edit). Strokes of Action::mask paint
/// it; what looks at the surface is a MaskFilter (mask_filter.h).
enum class MaskEdit {
  clear,   ///< nothing is masked
  invert,  ///< what is masked is free and the other way round, in all of space; twice is as before
  blur,    ///< borders become softer: an average over 7 nodes, 14 finest voxels, along each axis
  fill,    ///< everything is masked
  sharpen  ///< borders become half as wide about where they are a half: 2 m - 1/2, from 0 to 1
};

/// What an operation did.
struct OperationReport {
  std::int64_t changed_leaves = 0;  ///< that came, went or hold other values
  bool replaced_levels = false;     ///< all levels were rebuilt (Offset, Resample)
};

}  // namespace argil
