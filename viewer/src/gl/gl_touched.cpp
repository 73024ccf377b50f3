// SPDX-License-Identifier: GPL-3.0-or-later
#include "gl/gl_touched.h"

#include <algorithm>
#include <cstdint>

namespace argil::viewer {
namespace {

std::int64_t pixels_of(const PixelRect& area) {
  return std::int64_t{area.width} * std::int64_t{area.height};
}

PixelRect union_of(const PixelRect& a, const PixelRect& b) {
  const int x = std::min(a.x, b.x);
  const int y = std::min(a.y, b.y);
  return {x, y, std::max(a.x + a.width, b.x + b.width) - x,
          std::max(a.y + a.height, b.y + b.height) - y};
}

/// Joins a part with the one that grows least by it, unless it is worth drawing by itself.
void add_area(const PixelRect& area, std::vector<PixelRect>& areas) {
  // A draw costs about as much as so many pixels, whatever it draws.
  constexpr std::int64_t kDrawPixels = 10'000;
  PixelRect* best = nullptr;
  std::int64_t least = 0;
  for (PixelRect& other : areas) {
    const std::int64_t more = pixels_of(union_of(area, other)) - pixels_of(other);
    if (best != nullptr && more >= least) continue;
    best = &other;
    least = more;
  }
  const bool is_apart = best == nullptr || least > pixels_of(area) + kDrawPixels;
  if (is_apart && areas.size() < Touched::kMostAreas) {
    areas.push_back(area);
  } else {
    *best = union_of(*best, area);
  }
}

}  // namespace

void Touched::add(PieceKey piece, const Box3& box_mm) {
  if (boxes_.size() >= kMostBoxes) is_all_ = true;
  if (!is_all_) boxes_.push_back({piece, box_mm});
}

void Touched::clear() noexcept {
  boxes_.clear();
  is_all_ = false;
}

std::vector<PixelRect> Touched::areas_in(const EyeView& eye,
                                         std::span<const PieceView> pieces) const {
  if (is_all_) return {eye.part};
  std::vector<PixelRect> areas;
  const PieceView* view = nullptr;
  for (const auto& [piece, box] : boxes_) {
    // Boxes of a piece follow each other.
    if (view == nullptr || view->piece != piece) {
      const auto found =
          std::find_if(pieces.begin(), pieces.end(),
                       [key = piece](const auto& other) { return other.piece == key; });
      view = found == pieces.end() ? nullptr : &*found;
    }
    if (view == nullptr) continue;
    const PixelRect area = area_of(view->eye, box);
    if (!area.empty()) add_area(area, areas);
  }
  std::int64_t pixels = 0;
  for (const PixelRect& area : areas) pixels += pixels_of(area);
  if (2 * pixels >= pixels_of(eye.part)) return {eye.part};
  return areas;
}

}  // namespace argil::viewer
