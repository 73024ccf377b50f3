// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string_view>

#include <openvdb/math/Transform.h>

#include "argil/engine/operation.h"

namespace argil::io {

/// Cubic voxels, placed: a plain scale where they are neither turned nor moved. `placement` has a
/// quaternion of unit length, `voxel_mm` is kLeastVoxelMm at least.
openvdb::math::Transform::Ptr grid_transform(double voxel_mm, const Placement& placement);

/// How many bytes of a file the map of that name takes; nothing for one that cubic voxels have not.
std::optional<std::size_t> map_bytes(std::string_view name);

/// The map of cubic voxels that was written with these bytes, without its name; null where they say
/// anything else: numbers that are not finite, voxels that are no cubes or too small to be, or
/// numbers that do not follow from the others.
openvdb::math::Transform::Ptr read_map(std::string_view name, std::string_view bytes);

}  // namespace argil::io
