// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/vec3.h"

#include "mask.h"

namespace argil {

/// What a mask leaves of the ways that matter is moved by within a box; all of them where there is
/// no mask.
///
/// A way is gone with the speed 1 - m of where it leads through, in steps so short that the mask
/// changes by less than half in each. So matter on one line keeps its order: before what is held
/// it is pressed together, and behind it drawn out, however sharp the mask's border
/// (MaskMotion.KeepsTheOrderOfMatter). Scaling whole ways by 1 - m where they end would fold
/// matter over where the mask changes faster than the way is long.
class Restraint {
 public:
  Restraint(const Mask* mask, const Box3& box_mm);

  bool is_free() const noexcept { return mask_ == nullptr; }

  /// Where what starts at `from` on this way ends.
  Vec3 along(const Vec3& from, const Vec3& way) const;

 private:
  const Mask* mask_;
  double slope_per_mm_ = 0.0;
};

}  // namespace argil
