// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "argil/core/pace.h"
#include "argil/core/triangle_mesh.h"
#include "argil/io/mesh_repair.h"

namespace argil::io {

/// Of the volume; more than that of RepairLoss::covered_mm3 is too much. Half of kMostShare: which
/// of two sheets was meant is not all that is uncertain there.
inline constexpr double kMostCovered = 0.005;

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

/// What of the surface of the result is farther than `tolerance_mm` from all that was given though
/// that does not tell of a surface there: `facing`, the given triangles turned as the result's,
/// winds around it by less than 1/4 or more than 3/4. A lid on an opening has 1/2; one within what
/// halves enclose together 1, and one over a hollow outside 0. Without `may_close` the distance
/// alone counts. `is_given` says of which triangles of the result it need not be asked.
///
/// Errors, determinism, threads and cost as measure_loss.
RepairGuess measure_guess(const TriangleMesh& facing, const TriangleMesh& result,
                          const std::vector<bool>& is_given, double tolerance_mm, bool may_close,
                          const Pace& pace);

}  // namespace argil::io
