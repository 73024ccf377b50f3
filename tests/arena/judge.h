// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "argil/core/triangle_mesh.h"

#include "arena/truth.h"

namespace argil::arena {

/// What a result is worth.
struct Judgement {
  bool valid = false;        ///< mesh::check_mesh calls it printable
  bool kept = false;         ///< all below are as the truth asks
  double added = 0.0;        ///< farthest of the result from the truth, of the largest side
  double lost = 0.0;         ///< farthest of the truth from the result, of the largest side
  double volume_off = 0.0;   ///< (volume - of the truth) / of the truth
  std::uint32_t bodies = 0;  ///< where it is valid
  std::string why;           ///< what keeps it from being valid, or kept; "" for nothing
};

/// Distances are exact, from 20 000 points spread evenly over each surface and all vertices.
/// Within `truth.free` nothing is asked. An empty mesh is neither valid nor kept.
Judgement judge(const TriangleMesh& result, const Truth& truth);

/// The same by the right answer that is nearest.
Judgement judge(const TriangleMesh& result, const Broken& broken);

}  // namespace argil::arena
