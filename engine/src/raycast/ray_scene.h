// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"

namespace argil {

/// Where a ray met the mesh first.
struct RayHit {
  double distance = 0.0;  ///< along the (unit) direction
  Vec3 position;
  Vec3 normal;  ///< unit, toward the ray's origin; interpolated where the mesh has normals
  Vec3 facet;   ///< unit, toward the ray's origin, of the triangle itself
  std::uint32_t triangle = 0;
};

/// Triangles that rays can be asked of (Embree). Asking is thread-safe; answers do not depend on
/// the number of threads, because the tree is built by one (RayScene.IsBuiltByOneThread).
class RayScene {
 public:
  /// `goes_on` is asked now and then with the fraction that is built; empty: always.
  /// Errors  memory when Embree cannot build; interrupted.
  static Result<RayScene> build(const TriangleMesh& mesh,
                                const std::function<bool(double fraction)>& goes_on = {});

  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;
  ~RayScene();

  /// The first hit along the unit `direction`, if any.
  std::optional<RayHit> closest(const Vec3& origin, const Vec3& direction) const;

  /// True when anything is hit along the unit `direction`, however far.
  bool occluded(const Vec3& origin, const Vec3& direction) const;

 private:
  struct State;
  explicit RayScene(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace argil
