// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "chart/panel.h"

namespace argil::cli::chart {

/// Where the definition of the volume force fails, one panel each (docs/forces.md): a field that
/// saturates, a thin sheet, unit gradients on averaged rough matter, a sharp ball on the lattice,
/// work on a closed loop. About two seconds.
std::vector<Panel> force_failures();

}  // namespace argil::cli::chart
