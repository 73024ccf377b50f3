// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "argil/core/vec3.h"

#include "picture/camera.h"
#include "picture/renderer.h"
#include "picture/stereo.h"

namespace argil::viewer {

/// A point on the surface and its outward normal.
struct SurfaceHit {
  Vec3 point_mm;
  Vec3 normal;
};

/// The surface as the camera saw it when a stroke began, in stereo that of the eye in whose half it
/// began: a brush follows it without climbing what it has just added. Exact to the pixel, and
/// independent of the document thread.
class SurfaceProbe {
 public:
  /// `depth`: of that part of the window.
  SurfaceProbe(DepthMap depth, const WindowPart& part);

  /// What is seen at a pixel of the window; its normal is the average over a disc of that radius,
  /// so that a brush follows the form and not its grain. Nothing where there is no clay, and
  /// outside of the part, and where another piece is in front of the active one.
  std::optional<SurfaceHit> at(const Camera::Pixel& pixel, double radius_mm) const;

  /// Whether what is seen at a pixel of the window is another piece than the active one.
  bool is_other_at(const Camera::Pixel& pixel) const;

  /// Where it was seen.
  const WindowPart& part() const noexcept { return part_; }

 private:
  Camera::Pixel in_picture(const Camera::Pixel& pixel) const;
  std::optional<double> depth_at(double x, double y) const;
  std::optional<Vec3> position_at(double x, double y) const;

  DepthMap depth_;
  WindowPart part_;
};

}  // namespace argil::viewer
