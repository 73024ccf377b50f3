// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "argil/core/vec3.h"

#include "raycast/ray_scene.h"

namespace argil {

// Colours are linear light, 1 = white; Vec3 holds red, green, blue.

/// What a ray from the camera meets.
enum class Seen : unsigned char { background, ground, clay };

/// The light that arrives at a point.
struct Light {
  double key = 0.0;   ///< fraction of the key light's disc that is visible, 0 to 1
  Vec3 sky;           ///< light from the sky and from what hides it, per unit albedo
  double open = 0.0;  ///< fraction of the (cosine weighted) sky that is visible
};

/// Where light comes from and on what the object stands. Lengths in the scene's unit.
struct Studio {
  Vec3 up;   ///< unit
  Vec3 key;  ///< unit, toward the key light's middle
  bool has_ground = false;
  double ground_height = 0.0;  ///< along `up`
  double lift = 0.0;           ///< rays start this far off a surface
};

/// A surface point as shading sees it.
struct SurfacePoint {
  Seen seen = Seen::background;
  Vec3 position;
  Vec3 normal;
  double distance = 0.0;  ///< from the camera
  std::uint32_t triangle = 0;
};

/// What the ray from the camera meets first: clay, ground or nothing.
SurfacePoint trace_camera_ray(const RayScene& scene, const Studio& studio, const Vec3& eye,
                              const Vec3& direction);

/// Light at a point by a fixed pattern of rays. `phase`, 0 to 15, picks one sixteenth of a common
/// low-discrepancy set: a 4 x 4 block of pixels that uses all phases holds the whole set.
Light gather_light(const RayScene& scene, const Studio& studio, const SurfacePoint& point,
                   int phase);

/// The colour of clay seen from `toward_eye` under `light`. `albedo` usually kClayColor, `darkness`
/// 0 to 1.
Vec3 shade_clay(const Studio& studio, const SurfacePoint& point, const Light& light,
                const Vec3& toward_eye, const Vec3& albedo, double darkness);

/// The backdrop's colour, `height` 0 at the bottom of the picture, 1 at the top; and the same where
/// it is ground that the object takes light from.
Vec3 backdrop(double height);
Vec3 shade_ground(const Studio& studio, const Vec3& backdrop_color, const Light& light);

}  // namespace argil
