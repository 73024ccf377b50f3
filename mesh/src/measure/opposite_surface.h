// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "argil/core/vec3.h"

#include "measure/embree.h"
#include "measure/mesh_pieces.h"

namespace argil::mesh {

/// Finds what lies opposite a place of a mesh's surface, through the solid or through the air.
///
/// Threads      one for the constructor; then any.
/// Errors       throws std::bad_alloc.
class OppositeSurface {
 public:
  enum class Through { solid, air };

  /// Keeps a reference to `pieces`, of a mesh whose triangles' vertices exist and are finite.
  OppositeSurface(const MeshPieces& pieces, Through through);

  /// Whether a triangle that faces the other way than one with its back along `way` comes as near
  /// to a point. `way` of unit length.
  bool comes_near(const Vec3& point, double radius_mm, const Vec3& way) const;

  /// The diameter of the ball that touches the surface at `place`, lies along `way` from it, and
  /// touches what lies opposite, to a thousandth; at most `most_mm`.
  double ball_mm(const Vec3& place, const Vec3& way, double most_mm) const;

  /// How far a ray goes. Where only one of two neighbours is cut into pieces it may slip through
  /// between them; no ball does.
  struct Ray {
    double end_mm;  ///< to the first triangle that ends what it goes through
    double
        opposite_mm;  ///< the same where that lies opposite; else infinite, as where there is none
  };
  Ray ray(const Vec3& place, const Vec3& way) const;

 private:
  struct Release {
    void operator()(RTCDevice device) const noexcept { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const noexcept { rtcReleaseScene(scene); }
  };
  struct Smallest;
  struct RayEnd;

  void fill(RTCGeometry geometry) const;
  /// How a triangle faces a ray along `way`.
  enum class Facing { entry, end, opposite };
  Facing facing(std::uint32_t piece, const Vec3& way) const noexcept;
  /// As floats, none too small for rounding.
  float safe_radius(double mm) const noexcept {
    return static_cast<float>(mm * (1.0 + 1e-6) + rounding_);
  }
  RTCPointQuery ball_around(const Vec3& point, double radius_mm) const noexcept;
  void ask(const Vec3& point, Smallest& smallest) const;
  /// The radius of a smaller ball, if anything opposite is in this one.
  std::optional<double> ball_within(const Vec3& place, const Vec3& way, double radius) const;
  static bool on_triangle(RTCPointQueryFunctionArguments* arguments);
  static void on_hit(const RTCFilterFunctionNArguments* arguments);

  const MeshPieces& pieces_;
  double sign_;  ///< of a triangle's normal, so that it points along the way that ends there
  Vec3 center_;
  double rounding_;  ///< how far floats may move a point
  std::unique_ptr<RTCDeviceTy, Release> device_;
  std::unique_ptr<RTCSceneTy, Release> scene_;
};

}  // namespace argil::mesh
