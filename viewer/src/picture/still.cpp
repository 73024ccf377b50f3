// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture/still.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace argil::viewer {
namespace {

/// Pixels at each side of a part that are drawn and thrown away: what looks at its neighbours
/// (curvature) sees those of the next part.
constexpr int kPartMargin = 8;

/// Light of a value of sRGB, 0 to 1.
std::array<float, 256> light_of_values() {
  std::array<float, 256> light{};
  for (std::size_t n = 0; n < light.size(); ++n) {
    const double c = static_cast<double>(n) / 255.0;
    light[n] = static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
  }
  return light;
}

std::uint8_t value_of_light(float light) {
  const double l = std::clamp(static_cast<double>(light), 0.0, 1.0);
  const double c = l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255.0 * c));
}

/// The lens of a still of that shape: what the window's shows, and more on two sides.
Lens lens_of_shape(const Lens& window, double width_over_height) {
  Lens lens = window;
  const double shown = window.tan_x / window.tan_y;
  if (width_over_height > shown) {
    lens.tan_x = window.tan_y * width_over_height;
  } else {
    lens.tan_y = window.tan_x / width_over_height;
  }
  return lens;
}

}  // namespace

Still::Still(const StillOptions& options, const Lens& window, int part_width, int part_height)
    : options_(options),
      whole_(lens_of_shape(window, static_cast<double>(options.width) / options.height)),
      part_width_(part_width),
      part_height_(part_height),
      step_x_(std::max(1, (part_width - 2 * kPartMargin) / options.samples)),
      step_y_(std::max(1, (part_height - 2 * kPartMargin) / options.samples)),
      across_((options.width + step_x_ - 1) / step_x_),
      down_((options.height + step_y_ - 1) / step_y_),
      finer_(static_cast<double>(options.height) * options.samples / part_height *
             (window.tan_y / whole_.tan_y)),
      image_{options.width, options.height, {}} {
  assert(part_width >= kLeastPartPixels && part_height >= kLeastPartPixels);
  assert(options.width >= StillOptions::kLeastPixels && options.width <= StillOptions::kMostPixels);
  assert(options.samples >= 1 && options.samples <= StillOptions::kMostSamples);
  image_.rgb.resize(std::size_t{3} * static_cast<std::size_t>(options.width) *
                    static_cast<std::size_t>(options.height));
}

double Still::fraction() const noexcept { return static_cast<double>(next_) / count(); }

Still::Corner Still::corner() const noexcept {
  return {(next_ % across_) * step_x_, (next_ / across_) * step_y_};
}

Lens Still::lens() const {
  assert(!is_done());
  const double width = static_cast<double>(options_.width) * options_.samples;
  const double left = (corner().x * options_.samples - kPartMargin) / width;
  const auto [bottom, top] = rows();
  return cropped(whole_, left, left + part_width_ / width, bottom, top);
}

std::pair<double, double> Still::rows() const {
  assert(!is_done());
  const double height = static_cast<double>(options_.height) * options_.samples;
  const double top = 1.0 - (corner().y * options_.samples - kPartMargin) / height;
  return {top - part_height_ / height, top};
}

void Still::take(const Image& part) {
  assert(!is_done() && part.width == part_width_ && part.height == part_height_);
  static const std::array<float, 256> light = light_of_values();
  const auto [left, upper] = corner();
  const int samples = options_.samples;
  const float share = 1.0F / static_cast<float>(samples * samples);
  const int right = std::min(left + step_x_, options_.width);
  const int lower = std::min(upper + step_y_, options_.height);
  for (int y = upper; y < lower; ++y) {
    for (int x = left; x < right; ++x) {
      std::array<float, 3> sum{};
      for (int n = 0; n < samples * samples; ++n) {
        const int column = kPartMargin + (x - left) * samples + n % samples;
        const int row = kPartMargin + (y - upper) * samples + n / samples;
        const std::size_t at = 3 * static_cast<std::size_t>(row * part.width + column);
        for (std::size_t c = 0; c < 3; ++c) sum[c] += light[part.rgb[at + c]];
      }
      const std::size_t to =
          3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(options_.width) +
               static_cast<std::size_t>(x));
      for (std::size_t c = 0; c < 3; ++c) image_.rgb[to + c] = value_of_light(share * sum[c]);
    }
  }
  ++next_;
}

Image Still::image() && {
  assert(is_done());
  return std::move(image_);
}

}  // namespace argil::viewer
