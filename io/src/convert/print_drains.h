// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "argil/core/pace.h"
#include "argil/core/result.h"
#include "argil/engine/clay.h"
#include "argil/io/print_preparation.h"

#include "convert/print_frame.h"

namespace argil::io {

/// Less liquid is drops, and less air in a cavity no place for a drain.
inline constexpr double kLeastPocketMm3 = 10.0;
/// A smaller cavity is not worth the holes: where a piece is hollowed, it stays solid.
inline constexpr double kLeastCavityMm3 = 500.0;

/// Pockets are looked for along lines that far apart: so that a drain has three across.
double pocket_pitch_mm(const TriangleMesh& mesh, double drain_radius_mm);

/// By how much of itself a wall may become thicker than asked.
inline constexpr double kMostThicker = 0.1;

/// Hollows a clay that stands on the bed and drills drains until no cavity keeps liquid, in at most
/// four rounds. Returns the holes; what still keeps liquid then, liquid_pockets tells. `wall_mm`
/// becomes the wall: as asked, or somewhat more where that leaves less than half as much film
/// between cavities that the printer cannot print.
///
/// Errors  as Hollow; throws what no_throw catches.
/// Cost    a hollow for each round, up to four times as much where there are films.
Result<std::vector<PrintHole>> hollow_with_drains(Clay& clay, const PrintFrame& frame,
                                                  const PreparationOptions& options,
                                                  double& wall_mm, const Pace& pace);

}  // namespace argil::io
