// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>

#include "argil/core/result.h"
#include "argil/core/vec3.h"
#include "argil/engine/action.h"
#include "argil/engine/falloff.h"

namespace argil {

class AlphaImage;
class ToolMesh;

/// Boxes, capsules and meshes are for stamped actions alone.
enum class Shape { ball, ellipsoid, box, capsule, mesh };

/// Where a tool that embosses sets its image.
enum class AlphaMode {
  space,     ///< once for each dab, and these lie as far apart as the stroke's spacing says
  anchored,  ///< once, where the stroke began; where it is now says how large and how it is turned
  tiled      ///< again and again all over space, seen where the stroke passes
};

/// What a dab does and with which shape.
struct Tool {
  Action action = Action::add;
  Shape shape = Shape::ball;

  /// Half extents in mm along the tool's axes, each > 0 (a clay asks for .05 of its finest voxel)
  /// and at most 20 times the smallest. A ball has three equal ones; a capsule has two equal ones,
  /// x and y, and is at least as long in z. A mesh is scaled to fit within them, its proportions
  /// kept.
  Vec3 radii_mm{1.0, 1.0, 1.0};

  /// 0 < strength <= 1; for actions that are `is_signed` also negative. What 1 does is said at each
  /// row of argil/engine/action_rows.h.
  double strength = 1.0;

  /// How much of strength and size the pressure of a sample (0 to 1) decides: 0 nothing, 1 all, so
  /// that without pressure there is no dab. 0 to 1.
  double pressure_to_strength = 1.0;
  double pressure_to_size = 0.0;

  /// Of actions that have one (ActionInfo::curves); of those that move matter a gentle one.
  Falloff falloff = Falloff::smooth;

  // What single actions read; the others leave it unread, in its range all the same.

  /// Of those that work by a plane (flatten, scrape, fill, clay, clay_strips, trim): how much
  /// farther out it lies, in smallest radii. -2 to 2.
  double plane_offset = 0.0;

  /// Of clay_strips and emboss: the part of the tip's half width over which its sides fall off,
  /// round the corners too: 1 a round tip, less a square one with a step around it. 0.05 to 1.
  double tip_roundness = 0.18;

  /// Of elastic: how much of its volume matter keeps, twice Poisson's ratio: 0 as a sponge, 1 all
  /// of it. 0 to 1.
  double volume_preservation = 1.0;

  /// Of snake_hook: below a half it draws the tail thin, above it swells it; a half does neither. 0
  /// to 1.
  double crease_pinch_factor = 0.5;

  /// Of noise: the shortest wavelength there is, in mm, 0 to 1000; 0: half the smallest radius. No
  /// clay holds one below 4 of its finest voxels: less counts as that. And which of all such
  /// noises.
  double wavelength_mm = 0.0;
  std::uint32_t seed = 0;

  // Of emboss.

  /// The image whose grey is the height; null: white all over. Its larger side spans the tool's
  /// diameter, its proportions are kept. Shared, not copied, with every stroke that uses it.
  std::shared_ptr<const AlphaImage> alpha = nullptr;
  AlphaMode alpha_mode = AlphaMode::space;
  /// How high white stands over black, in mm, 0 to 1000; 0: a quarter of the smallest radius. More
  /// than the smallest radius counts as that. Where pressure changes the size, it changes as much.
  double amplitude_mm = 0.0;
  /// The grey that stays where it is: 0 black, so that all else rises, to 1 white.
  double mid_level = 0.0;
  /// How far the image is turned, counter-clockwise as seen from outside, in degrees, -360 to 360.
  /// At 0 its right side points along the tool's x axis, or as use_rake says.
  double angle_deg = 0.0;
  /// Of AlphaMode::space: the right side points along the stroke.
  bool use_rake = false;
  /// Of AlphaMode::tiled: the larger side of the image, in mm, 0 to 1000; 0: the tool's diameter.
  double tile_mm = 0.0;

  /// The shape of Shape::mesh, else null. Shared, not copied, with every stroke that uses it.
  std::shared_ptr<const ToolMesh> mesh = nullptr;

  /// Of the profile that crease and ridge lay along a stroke; other actions do not read them. How
  /// pointed its middle is, 0 (as round as the falloff of other tools) to 1 (a V as sharp as the
  /// voxels hold), and half its width in smallest radii, 0.3 to 1: a narrower one is as deep, and
  /// its walls would be steeper than voxels hold.
  double sharpness = 1.0;
  double width = 0.6;
};

/// Where a tool is applied.
struct DabPose {
  Vec3 position_mm;
  Quat orientation;       ///< unit length
  double pressure = 1.0;  ///< 0 to 1
};

/// One dab: the tool sweeps from one pose to another. The first of a stroke stays where it is.
struct Dab {
  DabPose from;
  DabPose at;
  bool is_mirrored = false;  ///< an odd number of times
  double quarters = 1.0;     ///< the path it stands for, in quarter radii; 1 where the hand rests
  bool is_joined = false;    ///< one edit with the dab that follows (DabFeeder)
  /// Of an image: the turn about the origin that took the dab here, after a reflection in x where
  /// `is_mirrored`. Unit length.
  Quat turn = {};
};

/// The smallest semi-axis in mm: what the level is chosen by.
inline double smallest_radius(const Tool& tool) noexcept {
  const Vec3& r = tool.radii_mm;
  return r.x < r.y ? (r.x < r.z ? r.x : r.z) : (r.y < r.z ? r.y : r.z);
}
/// The largest one: how far the tool reaches, but for the corners of boxes and meshes.
inline double largest_radius(const Tool& tool) noexcept {
  const Vec3& r = tool.radii_mm;
  return r.x > r.y ? (r.x > r.z ? r.x : r.z) : (r.y > r.z ? r.y : r.z);
}

/// A falloff at rho^2 >= 0; 0 from 1 on.
double fall_off(Falloff falloff, double square) noexcept;

/// Success, or bad_input naming the field of `tool` that is out of its range and the range. NaN is
/// out of every range.
Result<void> validate_tool(const Tool& tool);

/// Signed distance in mm to a box with these half extents about the origin, and to a capsule along
/// z with radius `radii_mm.x` and half length `radii_mm.z`, ends included; negative inside. Both
/// are exact but for rounding, inside too.
double box_distance(const Vec3& point_mm, const Vec3& half_mm) noexcept;
double capsule_distance(const Vec3& point_mm, const Vec3& radii_mm) noexcept;

/// Signed distance in mm from `point_mm`, given in the frame of the tool (its centre at the origin,
/// its axes along x, y, z), to the surface of an ellipsoid; negative inside.
///
/// Accuracy  relative 1e-9 of the largest radius (bisection on the closest-point equation).
/// Cost      a ball one square root; an ellipsoid about 0.2 us.
/// Source    D. Eberly, "Distance from a Point to an Ellipse, an Ellipsoid, or a Hyperellipsoid",
///           2013. Ours takes a Newton step where it stays in the bracket.
double ellipsoid_distance(const Vec3& point_mm, const Vec3& radii_mm) noexcept;

}  // namespace argil
