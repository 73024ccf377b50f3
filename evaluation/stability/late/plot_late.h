// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "chart/sheet.h"
#include "stability/late/late.h"

namespace argil::evaluation {

/// Where a carved spring cycles, over its stiffness and the age of what is felt.
Script late_map_script(const LateResult& result);
/// What remedies leave of it on clay, over the age.
Script late_script(const LateResult& result);

}  // namespace argil::evaluation
