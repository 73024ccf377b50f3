// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture/reference_image.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <utility>

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

constexpr std::size_t kChannels = 4;

/// What a row or column of a level covers of the level before.
struct Covered {
  std::size_t first = 0;
  std::size_t count = 1;
  std::array<float, 3> parts{1.0F, 0.0F, 0.0F};  ///< sum to 1
};

Covered covered_by(std::size_t at, std::size_t size) noexcept {
  const std::size_t half = size / 2;
  if (half == 0) return {};
  assert(at < half);
  if (size % 2 == 0) return {2 * at, 2, {0.5F, 0.5F, 0.0F}};
  const auto part = [size](std::size_t of) {
    return static_cast<float>(of) / static_cast<float>(size);
  };
  return {2 * at, 3, {part(half - at), part(half), part(at + 1)}};
}

/// A row of the half, as wide as before: what it covers of the rows from `at` on.
void take_rows(const std::uint8_t* at, const Covered& down, std::vector<float>& row) {
  std::fill(row.begin(), row.end(), 0.0F);
  for (std::size_t n = 0; n < down.count; ++n, at += row.size()) {
    for (std::size_t k = 0; k < row.size(); ++k) {
      row[k] += down.parts[n] * static_cast<float>(at[k]);
    }
  }
}

/// One channel of a pixel of that row, from the first that it covers.
std::uint8_t mean_of(const float* first, const Covered& across) noexcept {
  float mean = 0.5F;  // rounds
  for (std::size_t n = 0; n < across.count; ++n) mean += across.parts[n] * first[kChannels * n];
  return static_cast<std::uint8_t>(std::min(mean, 255.0F));
}

PixelLevel halved(const PixelLevel& from, const Pace& pace) {
  PixelLevel half{std::max(1, from.width / 2), std::max(1, from.height / 2), {}};
  const auto wide = static_cast<std::size_t>(from.width);
  const auto high = static_cast<std::size_t>(from.height);
  const auto columns = static_cast<std::size_t>(half.width);
  const auto rows = static_cast<std::size_t>(half.height);
  half.rgba.reserve(kChannels * columns * rows);
  std::vector<float> row(kChannels * wide);
  for (std::size_t y = 0; y < rows; ++y) {
    pace.at(static_cast<double>(y) / static_cast<double>(rows));
    const Covered down = covered_by(y, high);
    take_rows(from.rgba.data() + down.first * row.size(), down, row);
    for (std::size_t x = 0; x < columns; ++x) {
      const Covered across = covered_by(x, wide);
      const float* first = row.data() + kChannels * across.first;
      for (std::size_t c = 0; c < kChannels; ++c) half.rgba.push_back(mean_of(first + c, across));
    }
  }
  return half;
}

}  // namespace

std::shared_ptr<const ReferencePixels> with_smaller(int width, int height,
                                                    std::vector<std::uint8_t> rgba,
                                                    const Pace& pace) {
  assert(width > 0 && height > 0);
  assert(rgba.size() ==
         kChannels * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  auto made = std::make_shared<ReferencePixels>();
  made->width = width;
  made->height = height;
  made->rgba = std::move(rgba);
  // Three quarters of what is left with each.
  double begin = 0.0;
  for (const PixelLevel* last = made.get(); last->width > 1 || last->height > 1;
       last = &made->smaller.back()) {
    const double end = 0.25 * begin + 0.75;
    made->smaller.push_back(halved(*last, pace.part(begin, end)));
    begin = end;
  }
  return made;
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
