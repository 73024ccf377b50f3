// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "argil/core/pace.h"
#include "argil/mesh/intersections.h"

namespace argil::mesh {

/// self_intersections for those who have flat_fans(mesh) already.
std::vector<TrianglePair> crossing_pairs(const TriangleMesh& mesh,
                                         const std::vector<std::uint32_t>& left_out,
                                         const std::vector<std::uint8_t>& is_flat,
                                         const Pace& pace);

}  // namespace argil::mesh
