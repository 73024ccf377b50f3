// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "argil/core/vec3.h"

#include "camera.h"
#include "input_event.h"
#include "renderer.h"

namespace argil::viewer {

/// A place on the surface and its outward normal.
struct SurfaceHit {
  Vec3 point_mm;
  Vec3 normal;
};

/// The surface as it was when a stroke began, as the camera saw it: where a brush goes along
/// without climbing what it has just added. Exact to the pixel; nothing of the clay's thread.
class SurfaceProbe {
 public:
  SurfaceProbe(DepthMap depth, const Camera& camera);

  /// What is seen at a place of the window; its normal is the average over a disc of that radius,
  /// so that a brush follows the form and not its grain. Nothing where there is no clay.
  std::optional<SurfaceHit> at(const Camera::Pixel& pixel, double radius_mm) const;

 private:
  std::optional<double> depth_at(double x, double y) const;
  std::optional<Vec3> place_at(double x, double y) const;

  DepthMap depth_;
  Camera camera_;
};

}  // namespace argil::viewer
