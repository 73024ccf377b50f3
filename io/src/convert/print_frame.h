// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "argil/core/pace.h"
#include "argil/core/progress.h"
#include "argil/core/triangle_mesh.h"
#include "argil/core/vec3.h"
#include "argil/engine/clay.h"
#include "argil/engine/surface.h"

namespace argil::io {

/// Where a clay stands on the bed, z up. The clay keeps its own frame, so that turning it costs no
/// resampling; what is cut and drilled is brought there.
struct PrintFrame {
  Quat turn;  ///< unit
  Vec3 shift_mm;

  Vec3 to_bed(const Vec3& p) const noexcept { return rotate(turn, p) + shift_mm; }
  Vec3 to_clay(const Vec3& p) const noexcept { return rotate(conjugate(turn), p - shift_mm); }
  Vec3 direction_to_clay(const Vec3& d) const noexcept { return rotate(conjugate(turn), d); }

  TriangleMesh to_bed(TriangleMesh mesh) const {
    for (Vec3& p : mesh.positions) p = to_bed(p);
    mesh.normals.clear();
    return mesh;
  }
  TriangleMesh to_clay(TriangleMesh mesh) const {
    for (Vec3& p : mesh.positions) p = to_clay(p);
    return mesh;
  }
};

/// A pace as Clay::apply wants it, which takes a stop as an answer and not as an exception.
inline Progress answering(const Pace& pace) {
  return [pace](std::string_view, double fraction) {
    try {
      pace.at(fraction);
      return true;
    } catch (const Interrupted&) {
      return false;
    }
  };
}

/// The surface as it stands on the bed.
inline TriangleMesh surface_on_bed(const Clay& clay, const PrintFrame& frame) {
  return frame.to_bed(extract_surface(clay));
}

}  // namespace argil::io
