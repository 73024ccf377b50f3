// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/force/own_cuts.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace argil::haptics {
namespace {

/// Nodes along one axis that lie within `reach_mm` of a place: from `first` to before `last`.
struct Nodes {
  int first;
  int last;
};
Nodes nodes_near(double origin_mm, double voxel_mm, int count, double place_mm,
                 double reach_mm) noexcept {
  // Clamped before they become whole numbers: the tool may be anywhere.
  const auto index = [&](double mm) {
    return std::clamp((mm - origin_mm) / voxel_mm, 0.0, static_cast<double>(count));
  };
  return {static_cast<int>(std::ceil(index(place_mm - reach_mm))),
          std::min(count, static_cast<int>(std::floor(index(place_mm + reach_mm))) + 1)};
}

/// How long a piece gets, and by how much a tool may leave it before that counts, in radii.
constexpr double kPieceShare = 0.5;
constexpr double kTrembleShare = 0.02;

}  // namespace

OwnCuts::OwnCuts(double radius_mm) noexcept : radius_mm_(radius_mm) { assert(radius_mm >= 0.0); }

double OwnCuts::distance_to(const Piece& piece, const Vec3& place_mm) noexcept {
  const Vec3 along = piece.to_mm - piece.from_mm;
  const double square = dot(along, along);
  const Vec3 p = place_mm - piece.from_mm;
  return length(p - (square > 0.0 ? std::clamp(dot(p, along) / square, 0.0, 1.0) : 0.0) * along);
}

const OwnCuts::Piece& OwnCuts::newest(std::size_t back) const noexcept {
  assert(back < std::min(count_, kMostPieces));
  return pieces_[(count_ - 1 - back) % kMostPieces];
}

/// A piece grows with the tool's way until it is half a radius long: on so little the way is as
/// good as straight, and what is kept spans the age of a late window at the speed of a hand. A tool
/// that trembles within what it has cut begins no new one.
void OwnCuts::move_to(const Vec3& position_mm, double elapsed_s, bool is_cutting) noexcept {
  assert(is_finite(position_mm));
  now_s_ += std::max(0.0, elapsed_s);
  const bool goes_on = is_cutting_ && is_cutting;
  const Vec3 from_mm = goes_on ? last_mm_ : position_mm;
  is_cutting_ = is_cutting && radius_mm_ > 0.0;
  last_mm_ = position_mm;
  if (!is_cutting_) return;
  cutting_s_ = goes_on ? cutting_s_ + std::max(0.0, elapsed_s) : 0.0;
  if (!goes_on) pieces_[count_++ % kMostPieces] = {from_mm, position_mm, 0.0, now_s_};
  Piece& piece = pieces_[(count_ - 1) % kMostPieces];
  piece.radius_mm = radius_mm_ * std::min(1.0, cutting_s_ / kGrowS);
  piece.until_s = now_s_;
  if (distance_to(piece, position_mm) < kTrembleShare * radius_mm_) return;
  const double before_mm = length(piece.to_mm - piece.from_mm);
  const double after_mm = length(position_mm - piece.from_mm);
  if (after_mm > before_mm && after_mm < kPieceShare * radius_mm_) {
    piece.to_mm = position_mm;
  } else {
    pieces_[count_++ % kMostPieces] = {from_mm, position_mm, piece.radius_mm, now_s_};
  }
}

/// Nodes that are as far out as the piece would make them are passed over before the square root.
void OwnCuts::stamp(const Piece& piece, WindowSlot& window, const Vec3& tool_mm,
                    double reach_mm) noexcept {
  const double voxel = window.voxel_mm;
  std::array<Nodes, 3> near{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    near[axis] =
        nodes_near(window.origin_mm[axis], voxel, window.nodes[axis], tool_mm[axis], reach_mm);
  }
  const Vec3 along = piece.to_mm - piece.from_mm;
  const double per_length = dot(along, along) > 0.0 ? 1.0 / dot(along, along) : 0.0;
  const FieldWindowView view = window.view();
  for (int i = near[0].first; i < near[0].last; ++i) {
    for (int j = near[1].first; j < near[1].last; ++j) {
      float* row = window.distance_mm.data() + view.index(i, j, 0);
      for (int k = near[2].first; k < near[2].last; ++k) {
        const Vec3 node{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
        const Vec3 p = window.origin_mm + voxel * node - piece.from_mm;
        const Vec3 off = p - std::clamp(dot(p, along) * per_length, 0.0, 1.0) * along;
        const double deeper_mm = piece.radius_mm - static_cast<double>(row[k]);
        const double square = dot(off, off);
        if (deeper_mm <= 0.0 || deeper_mm * deeper_mm <= square) continue;
        row[k] = std::max(row[k], static_cast<float>(piece.radius_mm - std::sqrt(square)));
      }
    }
  }
}

void OwnCuts::stamp_newest(WindowSlot& window, double reach_mm) const noexcept {
  if (!is_cutting_ || window.sequence == 0) return;
  stamp(newest(0), window, last_mm_, reach_mm);
}

/// From the newest on: what is left out for want of time is what a window most likely has.
void OwnCuts::stamp_all(WindowSlot& window, const Vec3& tool_mm, double reach_mm) const noexcept {
  if (window.sequence == 0) return;
  std::size_t stamped = 0;
  for (std::size_t back = 0; back < std::min(count_, kMostPieces); ++back) {
    const Piece& piece = newest(back);
    if (now_s_ - piece.until_s > kKeptS || stamped == kMostStamped) return;
    // Further off it would only tell how deep clay is that is deep already.
    const double apart_mm =
        std::min(length(piece.from_mm - tool_mm), length(piece.to_mm - tool_mm));
    if (apart_mm > reach_mm + 2.0 * radius_mm_) continue;
    stamp(piece, window, tool_mm, reach_mm);
    ++stamped;
  }
}

}  // namespace argil::haptics
