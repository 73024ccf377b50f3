// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "argil/core/vec3.h"
#include "argil/engine/pick.h"

#include "picture/renderer.h"

namespace argil::viewer {

/// A straight line through material, from surface to surface.
struct Chord {
  Vec3 from_mm;
  Vec3 to_mm;
  friend bool operator==(const Chord&, const Chord&) = default;
};

/// The shortest straight line of a slice through the point where a ray meets it, of 60 directions:
/// how thick the material is there, as far as the slice shows it. Nothing where the ray meets no
/// material, or where the line leaves the slice.
/// Accuracy  a hundredth of a value's spacing and 1 - cos(1.5 degrees) of the thickness, where the
///           values are distances.
std::optional<Chord> shortest_chord(const SlicePicture& slice, const Ray& ray);

}  // namespace argil::viewer
