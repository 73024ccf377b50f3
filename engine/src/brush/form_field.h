// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "brush/local_field.h"
#include "field/level_stack.h"
#include "tool/posed_tool.h"

namespace argil {

/// The form of the clay under tools as it stands, without detail finer than about half their
/// smallest radius: the field of the level above that of the tools, averaged four times. Its band
/// reaches 3/8 of that radius or more from the surface.
class FormField {
 public:
  /// `dabs` of one tool, at least one; groups of `images` that follow each other. A coarser level
  /// is taken where the band is to be wider, as far as there is one.
  FormField(const LevelStack& stack, std::span<const PosedTool> dabs, std::size_t images,
            double least_band_mm = 0.0);

  /// At a point within the bounds of a dab, or up to 3 voxels beside them: the distance to the form
  /// in bands, -1 to 1, and how it rises per mm; 0 at the rim of the band and beyond.
  struct Place {
    double bands;
    Vec3 rise;
  };
  Place at(std::size_t dab, const Vec3& point_mm) const;

  /// From a point there onto the form, in so many steps; the point as far as it got where the form
  /// is too far to tell the way.
  Vec3 foot_mm(std::size_t dab, const Vec3& point_mm, int steps) const;

  /// Where the normal of the form that leads through a point there leaves it, seen from the point:
  /// along its own normal, which is the same all the way but for what averaging makes of it. A
  /// quarter of the cost of foot_mm.
  struct Foot {
    double bands;   ///< how far the point is from the form, as in Place
    Vec3 point_mm;  ///< on the form
    Vec3 up;        ///< unit; zero where the form is too far to tell
  };
  Foot foot(std::size_t dab, const Vec3& point_mm) const;

  double band_mm() const noexcept { return band_mm_; }

 private:
  double value(const LocalField& field, const Vec3& nodes) const;

  double band_mm_ = 0.0;
  std::vector<LocalField> fields_;
  std::vector<std::size_t> field_of_;  ///< by dab
};

/// Boxes around dabs, of which groups of `images` follow each other, and in which of them each dab
/// is: one box for as many that follow each other as take no more room together than apart.
struct DabBoxes {
  std::vector<Box3> boxes_mm;
  std::vector<std::size_t> box_of;  ///< by dab
};
DabBoxes boxes_around(std::span<const PosedTool> dabs, std::size_t images);

}  // namespace argil
