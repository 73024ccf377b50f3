// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "argil/core/triangle_mesh.h"

#include "gl/gl_clay.h"
#include "gl/gl_targets.h"

namespace argil::viewer {

/// What changed of the clay since it was drawn: the parts of a picture that have to be drawn anew.
class Touched {
 public:
  /// Beyond so many all of the picture is drawn: a stroke's dab touches some hundred blocks.
  static constexpr std::size_t kMostBoxes = 8192;
  /// A picture has at most so many parts; a stroke with its mirror images has as many as images.
  static constexpr std::size_t kMostAreas = 8;

  /// A box in the piece's own frame.
  void add(PieceKey piece, const Box3& box_mm);
  void add_all() noexcept { is_all_ = true; }
  void clear() noexcept;
  bool empty() const noexcept { return !is_all_ && boxes_.empty(); }

  /// These parts in an eye's picture, which may overlap: together less than half of it, or the one
  /// that is all of it. `pieces`: as that eye sees them; of others nothing is seen.
  std::vector<PixelRect> areas_in(const EyeView& eye, std::span<const PieceView> pieces) const;

 private:
  struct Place {
    PieceKey piece = 0;
    Box3 box_mm;
  };
  std::vector<Place> boxes_;
  bool is_all_ = false;
};

}  // namespace argil::viewer
