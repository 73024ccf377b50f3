// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "argil/core/pace.h"
#include "argil/core/triangle_mesh.h"
#include "argil/io/mesh_repair.h"

namespace argil::io {

/// What of the surface `given` is neither within `tolerance_mm` of the result nor inside it.
/// `is_kept` says of which triangles it need not be asked.
///
/// Errors       throws Interrupted where `pace` asks.
/// Determinism  same bits for any number of threads.
/// Threads      any thread; spreads over TBB.
/// Cost         some microseconds a triangle that is not kept, and for each part of the size of the
///              tolerance.
RepairLoss measure_loss(const TriangleMesh& given, const std::vector<bool>& is_kept,
                        const TriangleMesh& result, double tolerance_mm, const Pace& pace);

}  // namespace argil::io
