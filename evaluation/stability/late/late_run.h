// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "argil/haptics/analysis/loop_chatter.h"

#include "stability/hold.h"
#include "stability/late/height_law.h"
#include "stability/late/late_case.h"

namespace argil::evaluation {

/// One stroke of a simulated hand on clay as a height (LatePlane). `law` is of the case's tool.
LateFound run_on_plane(const LateCase& what, const HeightLaw& law);

/// The same on real clay (LateBlock); `law` says where the hand rests.
LateFound run_on_clay(const LateCase& what, const HeightLaw& law);

/// Hand and device of a case at a spring; what the tool feels of its material when it presses 3 N,
/// as far as the hand gets of it while it works.
haptics::CarvingLoop carving_loop(const LateCase& what, const HeightLaw& law);

/// tau of a case: what its clay hears every `dab_s`.
double lateness_s(const LateCase& what, double dab_s);

/// Between dabs: of clay as a height, of real clay.
inline constexpr double kPlaneDabS = 1e-3;
inline constexpr double kClayDabS = 5e-3;

/// How long the stroke is, s: at a spring longer, since near its limit a swing grows slowly.
double stroke_s(const LateTool& tool);

}  // namespace argil::evaluation
