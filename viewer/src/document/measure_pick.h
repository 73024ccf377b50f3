// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "argil/engine/pick.h"
#include "argil/engine/sculpture.h"

#include "picture/renderer.h"

namespace argil::viewer {

/// What a slice leaves to be seen: all p with dot(normal, p) >= offset_mm.
struct SeenHalf {
  Vec3 normal;  ///< unit
  double offset_mm = 0.0;
  friend bool operator==(const SeenHalf&, const SeenHalf&) = default;
};

/// A point on a piece, kept in that piece's frame: it goes where the piece goes.
struct MeasurePoint {
  PieceKey piece = 0;
  Vec3 own_mm;
  Vec3 own_normal;         ///< unit, outward
  bool is_within = false;  ///< picked in the material that a slice shows, not on the surface
  friend bool operator==(const MeasurePoint&, const MeasurePoint&) = default;
};

/// Where is the first point that a ray meets? Of questions with one number only the newest counts.
struct MeasureQuestion {
  std::int64_t number = 0;
  Ray ray;  ///< in the sculpture's frame
  std::optional<SeenHalf> seen = {};
  bool wants_far_side = false;
  double far_enough_mm = 0.0;  ///< given back: of a point that is looked for, less some slack
  /// Does the clay still lie there as it did when this was picked?
  std::optional<MeasurePoint> kept = {};
};

struct MeasureAnswer {
  std::int64_t number = 0;             ///< of the question
  std::optional<MeasurePoint> point;   ///< nothing: the ray meets no clay
  double distance_mm = 0.0;            ///< of the point from the ray's origin
  bool is_on_slice = false;            ///< in the material that a slice shows, not on the surface
  double far_enough_mm = 0.0;          ///< of the question
  std::optional<MeasurePoint> across;  ///< the far side, where it was asked for and there is one
  bool is_kept = true;  ///< false: the clay at MeasureQuestion::kept went away, or covers it
};

/// The same, with the piece's place in the sculpture's list.
struct MeasuredPick {
  std::size_t piece = 0;
  Vec3 own_mm;
  Vec3 own_normal;
  double distance_mm = 0.0;
  bool is_on_slice = false;
};

/// The first point where a ray meets what is seen of the visible pieces: their surface, or the
/// material where a slice cuts them open (its normal is then the slice's, towards the eye).
/// Accuracy  that of argil::pick, of the field itself and not of the triangles that are drawn:
///           1e-4 finest voxels.
/// Threads   the clay's. Cost  that of argil::pick for each visible piece.
std::optional<MeasuredPick> measure_pick(const Sculpture& sculpture, const Ray& ray,
                                         const std::optional<SeenHalf>& seen);

/// How thick the clay is below a point of its surface: where the straight line against the outward
/// normal first leaves it again. Nothing where no material lies below the point, or it is thinner
/// than a hundredth of the finest voxel.
/// Accuracy, threads, cost  as above, of two picks.
std::optional<Vec3> far_side(const Clay& clay, const Vec3& point_mm, const Vec3& normal);

/// Whether the surface still runs through a point that was picked on it, to half a finest voxel;
/// of one in the material of a slice, whether there still is material, to two.
bool is_still_there(const Clay& clay, const MeasurePoint& point);

}  // namespace argil::viewer
