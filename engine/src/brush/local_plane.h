// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "brush/local_field.h"
#include "tool/posed_tool.h"

namespace argil {

/// The plane through the middle of the surface under the tool, weighted by the falloff, along its
/// mean normal; nothing where the tool has no surface under it. `field` is that of the tool's level
/// and holds the tool and one node around it. Summed in whole numbers: on symmetric clay the planes
/// of mirror images are mirror images to the bit.
std::optional<LocalPlane> plane_under(const LocalField& field, const PosedTool& tool);

}  // namespace argil
