// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "edit/edit.h"

namespace argil {

/// How often these leaves, as far as they are there, break what Clay::validate
/// checks. Cost: about that of extracting their surface.
std::int64_t count_faults(const LevelStack& stack, const LeafList& leaves, double tolerance_mm);

}  // namespace argil
