// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture/reference_image.h"

#include <algorithm>
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

/// Of an odd side the last row or column is left out, unless it is the only one.
ReferencePixels halved(const ReferencePixels& pixels) {
  constexpr std::size_t kChannels = 4;
  ReferencePixels half{std::max(1, pixels.width / 2), std::max(1, pixels.height / 2), {}};
  half.rgba.reserve(kChannels * static_cast<std::size_t>(half.width) *
                    static_cast<std::size_t>(half.height));
  const auto wide = static_cast<std::size_t>(pixels.width);
  const std::size_t across = pixels.width > 1 ? kChannels : 0;
  const std::size_t down = pixels.height > 1 ? kChannels * wide : 0;
  for (std::size_t y = 0; y < static_cast<std::size_t>(half.height); ++y) {
    const std::uint8_t* at = pixels.rgba.data() + kChannels * 2 * y * wide;
    for (int x = 0; x < half.width; ++x, at += 2 * kChannels) {
      for (std::size_t c = 0; c < kChannels; ++c) {
        const int sum = at[c] + at[c + across] + at[c + down] + at[c + across + down];
        half.rgba.push_back(static_cast<std::uint8_t>((sum + 2) / 4));
      }
    }
  }
  return half;
}

}  // namespace

std::shared_ptr<const ReferencePixels> reduced(std::shared_ptr<const ReferencePixels> pixels,
                                               int most_side) {
  assert(pixels && most_side >= 1);
  while (std::max(pixels->width, pixels->height) > most_side) {
    pixels = std::make_shared<const ReferencePixels>(halved(*pixels));
  }
  return pixels;
}

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
