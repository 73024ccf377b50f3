// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "chart/sheet.h"
#include "stability/cogging.h"
#include "stability/filter.h"
#include "stability/sampled.h"
#include "stability/stiffness.h"
#include "stability/volume.h"
#include "stability/wall.h"

namespace argil::evaluation {

// The charts of stability as gnuplot scripts that carry their data.
Script stiffness_script(const std::vector<StiffnessRow>& rows);
Script wall_script(const std::vector<WallRow>& rows);
Script filter_script(const std::vector<FilterRow>& rows);
Script volume_script(const VolumeResult& result);
Script sampled_script(const SampledResult& result, const std::vector<CoggingRow>& cogging);

}  // namespace argil::evaluation
