// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture/reference_image.h"

#include <array>
#include <cassert>
#include <cstddef>

namespace argil::viewer {
namespace {

struct NamedView {
  const char* name;
  const char* title;
  ViewAxes axes;
};
constexpr std::array<NamedView, kStraightViews> kViews{{
    {"front", "Front", {{1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, {0.0, -1.0, 0.0}}},
    {"back", "Back", {{-1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, {0.0, 1.0, 0.0}}},
    {"right", "Right", {{0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}}},
    {"left", "Left", {{0.0, -1.0, 0.0}, {0.0, 0.0, 1.0}, {-1.0, 0.0, 0.0}}},
    {"top", "Top", {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}},
    {"bottom", "Bottom", {{1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, {0.0, 0.0, -1.0}}},
}};

const NamedView& row_of(StraightView view) noexcept {
  const auto at = static_cast<std::size_t>(view);
  assert(at < kViews.size());
  return kViews[at];
}

}  // namespace

const char* title_of(StraightView view) noexcept { return row_of(view).title; }

std::optional<StraightView> view_named(std::string_view name) noexcept {
  for (std::size_t n = 0; n < kViews.size(); ++n) {
    if (name == kViews[n].name) return static_cast<StraightView>(n);
  }
  return std::nullopt;
}

ViewAxes axes_of(StraightView view) noexcept { return row_of(view).axes; }

std::optional<StraightView> straight_view_of(const Lens& lens) noexcept {
  constexpr double kStraight = 1e-3;
  for (std::size_t n = 0; n < kViews.size(); ++n) {
    const ViewAxes& axes = kViews[n].axes;
    const bool is_it =
        length(lens.back - axes.back) < kStraight && length(lens.up - axes.up) < kStraight;
    if (is_it) return static_cast<StraightView>(n);
  }
  return std::nullopt;
}

std::vector<ReferenceMark> marks_of(const std::vector<ReferenceImage>& images,
                                    const std::optional<StraightView>& view) {
  std::vector<ReferenceMark> marks;
  for (const ReferenceImage& image : images) {
    if (!view || image.view != *view || !image.is_visible || !image.pixels) continue;
    assert(image.pixels->width > 0 && image.width_mm > 0.0);
    const ViewAxes axes = axes_of(image.view);
    const double height_mm = image.width_mm * image.pixels->height / image.pixels->width;
    const Vec3 middle = image.right_mm * axes.right + image.up_mm * axes.up;
    const Vec3 along = image.width_mm * axes.right;
    const Vec3 down = -height_mm * axes.up;
    marks.push_back({image.pixels, middle - 0.5 * along - 0.5 * down, along, down, image.opacity,
                     image.is_over});
  }
  return marks;
}

}  // namespace argil::viewer
