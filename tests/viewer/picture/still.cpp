// SPDX-License-Identifier: GPL-3.0-or-later
// A still is what its parts add up to: against a picture that is a formula of the ray.
#include "picture/still.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <gtest/gtest.h>

namespace argil::viewer {
namespace {

/// Which way a lens looks through a place of its picture, x and y from -1 to 1: in units of the
/// camera's own axes.
std::pair<double, double> slope_at(const Lens& lens, double x, double y) {
  return {x * lens.tan_x + lens.shift_x, y * lens.tan_y + lens.shift_y};
}

/// Soft enough that an average over a pixel is its middle's.
std::array<double, 3> color_of(const std::pair<double, double>& slope) {
  const auto wave = [](double a) { return 0.5 + 0.5 * std::sin(a); };
  return {wave(9.0 * slope.first), wave(7.0 * slope.second),
          wave(5.0 * (slope.first + slope.second))};
}

Image drawn(const Lens& lens, int width, int height) {
  Image image{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto slope =
          slope_at(lens, 2.0 * (x + 0.5) / width - 1.0, 1.0 - 2.0 * (y + 0.5) / height);
      for (const double c : color_of(slope)) {
        image.rgb.push_back(static_cast<std::uint8_t>(std::lround(255.0 * c)));
      }
    }
  }
  return image;
}

Image made(const StillOptions& options, const Lens& window, int width, int height) {
  Still still(options, window, width, height);
  double last = -1.0;
  while (!still.is_done()) {
    EXPECT_GT(still.fraction(), last);
    last = still.fraction();
    const auto [bottom, top] = still.rows();
    EXPECT_LT(bottom, top);
    still.take(drawn(still.lens(), width, height));
  }
  return std::move(still).image();
}

int largest_difference(const Image& a, const Image& b) {
  EXPECT_EQ(a.rgb.size(), b.rgb.size());
  int most = 0;
  for (std::size_t n = 0; n < std::min(a.rgb.size(), b.rgb.size()); ++n) {
    most = std::max(most, std::abs(int{a.rgb[n]} - int{b.rgb[n]}));
  }
  return most;
}

Lens window_lens(bool is_parallel) {
  Camera camera;
  camera.resize(160, 120);
  camera.set_parallel(is_parallel);
  Lens lens = camera.lens({});
  if (is_parallel) {  // so that slopes are of one order
    lens.tan_x = 0.4;
    lens.tan_y = 0.3;
  }
  return lens;
}

TEST(StillPictures, AreTheWindowsLargerWithoutASeam) {
  for (const bool is_parallel : {false, true}) {
    const Lens window = window_lens(is_parallel);
    for (const StillOptions& options : {StillOptions{160, 120, 1}, StillOptions{640, 480, 1},
                                        StillOptions{400, 300, 3}, StillOptions{333, 250, 2}}) {
      SCOPED_TRACE(options.width);
      Lens whole = window;
      whole.tan_x = window.tan_y * options.width / options.height;
      if (options.width * 3 < options.height * 4) {
        whole.tan_x = window.tan_x;
        whole.tan_y = window.tan_x * options.height / options.width;
      }
      const Image wanted = drawn(whole, options.width, options.height);
      EXPECT_LE(largest_difference(made(options, window, 160, 120), wanted), 2);
    }
  }
}

TEST(StillPictures, OfAnotherShapeShowAllOfTheWindowAndMore) {
  const Lens window = window_lens(false);
  Lens wide = window;
  wide.tan_x = 2.0 * window.tan_y;
  EXPECT_LE(largest_difference(made({400, 200, 1}, window, 160, 120), drawn(wide, 400, 200)), 2);
  Lens high = window;
  high.tan_y = 2.0 * window.tan_x;
  EXPECT_LE(largest_difference(made({200, 400, 1}, window, 160, 120), drawn(high, 200, 400)), 2);
}

/// White and black in turns are half the light, and not half the number.
TEST(StillPictures, AverageLight) {
  Still still({16, 16, 2}, window_lens(false), 160, 120);
  while (!still.is_done()) {
    Image part{160, 120, {}};
    for (int n = 0; n < 160 * 120; ++n) {
      const bool is_white = (n % 160 + n / 160) % 2 == 0;
      for (int c = 0; c < 3; ++c) part.rgb.push_back(is_white ? 255 : 0);
    }
    still.take(part);
  }
  const Image image = std::move(still).image();
  EXPECT_EQ(*std::min_element(image.rgb.begin(), image.rgb.end()), 188);
  EXPECT_EQ(*std::max_element(image.rgb.begin(), image.rgb.end()), 188);
}

std::array<double, 4> by_matrix(const Matrix& m, const std::array<double, 4>& v) {
  std::array<double, 4> out{};
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t k = 0; k < 4; ++k) out[row] += static_cast<double>(m[4 * k + row]) * v[k];
  }
  return out;
}

/// Of both kinds of lens: a point is seen in the part where it is seen in the whole.
TEST(StillPictures, APartsLensProjectsAsTheWhole) {
  for (const bool is_parallel : {false, true}) {
    Camera camera;
    camera.set_parallel(is_parallel);
    camera.look_from(normalized(Vec3{0.3, -1.0, 0.5}), {0.0, 0.0, 1.0});
    const Lens lens = camera.lens({{-30, -30, -30}, {30, 30, 30}});
    const Lens part = cropped(cropped(lens, 0.1, 0.9, 0.2, 0.7), 0.25, 0.75, 0.5, 1.0);
    const auto clip = [](const Lens& of, const Vec3& p) {
      const Matrix view = of.view();
      const Matrix projection = of.projection();
      const auto c = by_matrix(projection, by_matrix(view, {p.x, p.y, p.z, 1.0}));
      return Vec3{c[0] / c[3], c[1] / c[3], c[2] / c[3]};
    };
    for (const Vec3& p : {Vec3{3, -7, 11}, Vec3{-20, 4, -9}, Vec3{0, 0, 0}}) {
      const Vec3 whole = clip(lens, p);
      const Vec3 seen = clip(part, p);
      // From 0.3 to 0.7 across, and 0.45 to 0.7 up.
      const double x = (0.5 * (whole.x + 1.0) - 0.3) / 0.4;
      const double y = (0.5 * (whole.y + 1.0) - 0.45) / 0.25;
      EXPECT_NEAR(seen.x, 2.0 * x - 1.0, 1e-4);
      EXPECT_NEAR(seen.y, 2.0 * y - 1.0, 1e-4);
      EXPECT_NEAR(seen.z, whole.z, 1e-5);
    }
  }
}

}  // namespace
}  // namespace argil::viewer
