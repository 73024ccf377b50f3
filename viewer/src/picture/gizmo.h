// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>

#include "argil/core/vec3.h"
#include "argil/engine/operation.h"

#include "picture/camera.h"
#include "picture/renderer.h"

namespace argil::viewer {

/// What can be taken hold of: an arrow along each axis of the sculpture, a square across each, a
/// ring around each, and a ring around all of them that faces the eye, which makes larger.
struct GizmoPart {
  enum class Kind { along, across, around, size } kind = Kind::along;
  std::size_t axis = 0;  ///< x, y, z; of `size` always 0
  friend bool operator==(const GizmoPart&, const GizmoPart&) = default;
};

/// Handles around a point by which a piece is moved, turned and scaled, as large on the screen
/// whatever the distance. Lengths are of it: rings 0.85, arrows 0.95 to 1.35, squares 0.3 to 0.5,
/// the ring that scales 1.5.
struct Gizmo {
  Vec3 center_mm;
  double length_mm = 1.0;
};
Gizmo gizmo_at(const Vec3& center_mm, const Camera& camera);
/// All of it.
Box3 bounds_of(const Gizmo& gizmo);

/// What lies under a pixel; nothing beside it. An arrow that points at the eye, and a square or
/// ring that is seen from its edge, cannot be taken hold of.
std::optional<GizmoPart> part_under(const Gizmo& gizmo, const Camera& camera,
                                    const Camera::Pixel& pixel);

/// `chosen` is lit.
void add_gizmo(const Gizmo& gizmo, const Lens& lens, const std::optional<GizmoPart>& chosen,
               Picture& picture);

/// A piece while a handle is held, as the camera saw it when that began.
class GizmoDrag {
 public:
  /// `part`: under the pixel.
  GizmoDrag(const Gizmo& gizmo, const GizmoPart& part, const Camera& camera,
            const Camera::Pixel& pixel, const Placement& before);

  /// The piece's place with the pointer there: what was taken hold of stays under it. `snaps`: in
  /// steps of 1 mm, 15 degrees, and 5 %.
  Placement to(const Camera::Pixel& pixel, bool snaps);
  /// How many times as large it is there, about the gizmo's middle: from 0.01 to 100.
  double factor() const noexcept { return factor_; }

  const GizmoPart& part() const noexcept { return part_; }

 private:
  Vec3 shift_to(const Camera::Pixel& pixel) const;
  double angle_at(const Camera::Pixel& pixel) const;
  double from_middle(const Camera::Pixel& pixel) const;

  Gizmo gizmo_;
  GizmoPart part_;
  Camera camera_;
  Camera::Pixel start_;
  Placement before_;
  double last_deg_ = 0.0;    ///< of the pointer around the axis
  double turned_deg_ = 0.0;  ///< so far, also beyond a whole turn
  double factor_ = 1.0;
};

}  // namespace argil::viewer
