// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/result.h"
#include "argil/engine/pick.h"

namespace argil {

/// Whether a ray may be picked with, before anything is computed with its numbers; `voxel_mm` of
/// level 0. Errors  bad_input names what is out of its range.
Result<void> validate_ray(const Ray& ray, double voxel_mm);

/// Of unit length, also where the squares of the components would overflow or vanish. Of a ray that
/// is valid.
Vec3 unit_direction(const Ray& ray) noexcept;

}  // namespace argil
