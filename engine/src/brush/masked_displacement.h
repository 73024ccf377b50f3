// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/vec3.h"

#include "field/mask.h"

namespace argil {

/// What a mask leaves of the displacements of matter within a box; all of them where there is no
/// mask.
///
/// A displacement is followed with the speed 1 - m of where it leads through, in steps so short
/// that the mask changes by less than half in each. So matter on one line keeps its order: before
/// what is masked it is pressed together, and behind it drawn out, however sharp the mask's border
/// (MaskMotion.KeepsTheOrderOfMatter). Scaling whole displacements by 1 - m where they end would
/// fold matter over where the mask changes faster than the displacement is long.
class MaskedDisplacement {
 public:
  MaskedDisplacement(const Mask* mask, const Box3& box_mm);

  bool is_free() const noexcept { return mask_ == nullptr; }

  /// Where what starts at `from` with this displacement ends.
  Vec3 along(const Vec3& from, const Vec3& displacement) const;

 private:
  const Mask* mask_;
  double slope_per_mm_ = 0.0;
};

}  // namespace argil
