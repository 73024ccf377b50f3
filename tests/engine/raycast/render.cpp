// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/engine/render.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace argil {
namespace {

/// A ball of latitude rings, counter-clockwise seen from outside.
TriangleMesh ball(double radius, const Vec3& center, int rings = 48) {
  TriangleMesh mesh;
  const int around = 2 * rings;
  for (int i = 0; i <= rings; ++i) {
    for (int j = 0; j < around; ++j) {
      const double a = std::numbers::pi * i / rings;
      const double b = 2.0 * std::numbers::pi * j / around;
      const Vec3 n{std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)};
      mesh.positions.push_back(center + radius * n);
      mesh.normals.push_back(n);
    }
  }
  const auto id = [&](int i, int j) { return static_cast<std::uint32_t>(i * around + j % around); };
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < around; ++j) {
      mesh.triangles.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      mesh.triangles.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  }
  return mesh;
}

RenderOptions small_options() {
  RenderOptions options;
  options.width = 320;
  options.height = 240;
  return options;
}

/// Clay is warm, the backdrop and its shadows are nearly grey.
bool is_clay(const Image& image, int row, int column) {
  const std::size_t i = 3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
                             static_cast<std::size_t>(column));
  return image.rgb[i] > image.rgb[i + 2] + 35;
}

struct Extent {
  int top = std::numeric_limits<int>::max(), bottom = -1, left = top, right = -1;
};

Extent clay_extent(const Image& image) {
  Extent e;
  for (int r = 0; r < image.height; ++r) {
    for (int c = 0; c < image.width; ++c) {
      if (!is_clay(image, r, c)) continue;
      e = {std::min(e.top, r), std::max(e.bottom, r), std::min(e.left, c), std::max(e.right, c)};
    }
  }
  return e;
}

std::string error_of(const TriangleMesh& mesh, const RenderOptions& options) {
  const auto image = render(mesh, options);
  return image ? "" : image.error().message;
}

TEST(RenderBall, FillsTheFrameToItsMarginWhereverItLies) {
  for (const Vec3& center : {Vec3{}, Vec3{500.0, -300.0, 80.0}}) {
    const auto image = render(ball(20.0, center), small_options());
    ASSERT_TRUE(image) << image.error().message;
    const Extent e = clay_extent(image.value());
    const double half = 120.0 / 1.16;  // the frame's half height over the margin
    EXPECT_NEAR(e.top, 120.0 - half, 2.0);
    EXPECT_NEAR(e.bottom, 119.0 + half, 2.0);
    EXPECT_NEAR(e.left, 160.0 - half, 2.0);
    EXPECT_NEAR(e.right, 159.0 + half, 2.0);
  }
}

TEST(RenderBall, FillsTheFrameWithTheBoxThatIsAskedFor) {
  // A quarter of the ball's size around its foremost point: the ball reaches beyond all sides but
  // shows its middle.
  RenderOptions options = small_options();
  options.toward = {0.0, -1.0, 0.0};
  const Vec3 center{500.0, -300.0, 80.0};
  options.frame_mm = Box3{center + Vec3{-5.0, -20.0, -5.0}, center + Vec3{5.0, -20.0, 5.0}};
  const auto near = render(ball(20.0, center), options);
  ASSERT_TRUE(near) << near.error().message;
  const Extent all = clay_extent(near.value());
  EXPECT_EQ(all.top, 0);
  EXPECT_EQ(all.right, 319);
  // The box as large as the ball, in its middle plane: as far away as the whole ball asks for, but
  // for what its bulge adds.
  options.frame_mm = Box3{center + Vec3{-20.0, 0.0, -20.0}, center + Vec3{20.0, 0.0, 20.0}};
  const auto whole = render(ball(20.0, center), options);
  ASSERT_TRUE(whole) << whole.error().message;
  const Extent e = clay_extent(whole.value());
  EXPECT_NEAR(e.bottom - e.top, 240.0 / 1.16, 6.0);
  EXPECT_NEAR(0.5 * (e.top + e.bottom), 119.5, 2.0);
}

TEST(RenderBall, LooksTheSameAtAnySize) {
  const auto usual = render(ball(20.0, {}), small_options());
  const auto huge = render(ball(20.0 * 0x1p40, {}), small_options());
  const auto tiny = render(ball(20.0 * 0x1p-40, {}), small_options());
  ASSERT_TRUE(usual && huge && tiny);
  EXPECT_EQ(usual.value().rgb, huge.value().rgb);
  EXPECT_EQ(usual.value().rgb, tiny.value().rgb);
}

TEST(RenderBall, IsLitFromTheUpperLeft) {
  const auto image = render(ball(20.0, {}), small_options());
  ASSERT_TRUE(image);
  const auto red = [&](int row, int column) {
    return image.value().rgb[3U * (row * 320U + column)];
  };
  EXPECT_GT(red(70, 110), red(170, 210) + 40);
}

TEST(RenderBall, DarkensTheGroundBesideIt) {
  const auto image = render(ball(20.0, {}), small_options());
  ASSERT_TRUE(image);
  const auto green = [&](int row, int column) {
    return image.value().rgb[3U * (row * 320U + column) + 1U];
  };
  EXPECT_LT(green(195, 265), green(195, 20) - 20);  // the shadow falls away from the light
}

TEST(RenderBall, IsDarkerWhereItIsHeld) {
  RenderOptions options = small_options();
  options.darkness = [](const Vec3& p) { return p.z > 105.0 ? 1.0 : 0.0; };
  const TriangleMesh mesh = ball(20.0, {300.0, 0.0, 100.0});
  const auto plain = render(mesh, small_options());
  const auto held = render(mesh, options);
  ASSERT_TRUE(plain && held);
  const Extent e = clay_extent(plain.value());
  const int column = (e.left + e.right) / 2;
  const auto red = [&](const Image& image, double share) {
    const int row = e.top + static_cast<int>(share * (e.bottom - e.top));
    return int{image.rgb[static_cast<std::size_t>(3 * (row * image.width + column))]};
  };
  EXPECT_LT(red(held.value(), 0.2), red(plain.value(), 0.2) / 2 + 20);
  EXPECT_EQ(red(held.value(), 0.7), red(plain.value(), 0.7));
}

TEST(RenderBall, ShowsTrianglesInTheirColors) {
  const TriangleMesh mesh = ball(20.0, {300.0, 0.0, 100.0});
  RenderOptions options = small_options();
  for (const Triangle& t : mesh.triangles) {
    options.colors.push_back(mesh.positions[t[0]].z > 105.0 ? Vec3{0.02, 0.02, 0.8} : kClayColor);
  }
  const auto plain = render(mesh, small_options());
  const auto colored = render(mesh, options);
  ASSERT_TRUE(plain && colored);
  const Extent e = clay_extent(plain.value());
  const int column = (e.left + e.right) / 2;
  const auto blueness = [&](const Image& image, double share) {
    const int row = e.top + static_cast<int>(share * (e.bottom - e.top));
    const auto at = static_cast<std::size_t>(3 * (row * image.width + column));
    return int{image.rgb[at + 2]} - int{image.rgb[at]};
  };
  EXPECT_LT(blueness(plain.value(), 0.2), 0);
  EXPECT_GT(blueness(colored.value(), 0.2), 50);
  EXPECT_EQ(blueness(colored.value(), 0.7), blueness(plain.value(), 0.7));
  options.colors.pop_back();
  const auto refused = render(mesh, options);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("colors"), std::string::npos);
}

TEST(RenderBall, HasNoGroundSeenFromBelow) {
  RenderOptions options = small_options();
  options.toward = {0.0, 0.0, -1.0};
  options.up = {0.0, 1.0, 0.0};
  const auto image = render(ball(20.0, {}), options);
  ASSERT_TRUE(image);
  EXPECT_TRUE(is_clay(image.value(), 120, 160));
}

TEST(Render, GivesTheSameBitsForAnyThreadCount) {
  TriangleMesh mesh = ball(20.0, {});
  const TriangleMesh other = ball(9.0, {14.0, -12.0, 12.0});
  const auto offset = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  mesh.normals.insert(mesh.normals.end(), other.normals.begin(), other.normals.end());
  for (const Triangle& t : other.triangles) {
    mesh.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  }
  // So that it shows which of two triangles was met on their common edge.
  RenderOptions options = small_options();
  for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
    options.colors.push_back(n % 2 == 0 ? Vec3{0.9, 0.2, 0.1} : Vec3{0.1, 0.3, 0.9});
  }
  std::vector<std::uint8_t> first;
  for (const std::size_t threads : {1U, 2U, 7U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const auto image = render(mesh, options);
    ASSERT_TRUE(image);
    if (first.empty()) first = image.value().rgb;
    EXPECT_EQ(image.value().rgb, first) << threads << " threads";
  }
}

TEST(Render, UsesFacetsWhereTheMeshHasNoNormals) {
  TriangleMesh mesh = ball(20.0, {}, 6);
  const auto smooth = render(mesh, small_options());
  mesh.normals.clear();
  const auto faceted = render(mesh, small_options());
  ASSERT_TRUE(smooth && faceted);
  EXPECT_NE(smooth.value().rgb, faceted.value().rgb);
}

TEST(Render, RefusesWhatItCannotShow) {
  EXPECT_THAT(error_of({}, {}), testing::HasSubstr("0 triangles"));
  TriangleMesh mesh = ball(1.0, {}, 4);
  mesh.positions[3].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(error_of(mesh, {}), testing::HasSubstr("nan"));
  for (Vec3& p : mesh.positions) p = {1.0, 2.0, 3.0};
  EXPECT_THAT(error_of(mesh, {}), testing::HasSubstr("in one point"));
}

TEST(Render, NamesTheOptionThatIsOutOfRange) {
  const TriangleMesh mesh = ball(1.0, {}, 4);
  const auto error_with = [&](auto change) {
    RenderOptions options = small_options();
    change(options);
    return error_of(mesh, options);
  };
  EXPECT_EQ(error_with([](auto& o) { o.width = 15; }),
            "render option 'width' is 15; it must be 16 to 16384");
  EXPECT_EQ(error_with([](auto& o) { o.height = 16385; }),
            "render option 'height' is 16385; it must be 16 to 16384");
  EXPECT_EQ(error_with([](auto& o) { o.samples = 0; }),
            "render option 'samples' is 0; it must be 1 to 8");
  EXPECT_EQ(error_with([](auto& o) { o.field_of_view_rad = 3.0; }),
            "render option 'field_of_view_rad' is 3; it must be 0.05 to 2");
  EXPECT_THAT(error_with([](auto& o) { o.toward = {}; }), testing::HasSubstr("'toward' is 0,0,0"));
  EXPECT_THAT(error_with([](auto& o) { o.frame_mm = Box3{}; }),
              testing::HasSubstr("'frame_mm' is"));
  EXPECT_THAT(error_with([](auto& o) { o.toward = o.up; }), testing::HasSubstr("not along 'up'"));
}

TEST(RenderProgress, ComesFromTheCallersThreadAndStopsTheWork) {
  const TriangleMesh mesh = ball(20.0, {});
  const auto whole = render(mesh, small_options());
  int asked = 0;
  const auto watched =
      render(mesh, small_options(),
             [&, caller = std::this_thread::get_id()](std::string_view, double fraction) {
               EXPECT_EQ(std::this_thread::get_id(), caller);
               EXPECT_GE(fraction, 0.0);
               EXPECT_LE(fraction, 1.0);
               ++asked;
               return true;
             });
  ASSERT_TRUE(watched) << watched.error().message;
  EXPECT_EQ(watched.value().rgb, whole.value().rgb);
  EXPECT_GT(asked, 0);
  for (int n = 0; n < std::min(asked, 3); ++n) {
    int left = n;
    const auto stopped =
        render(mesh, small_options(), [&](std::string_view, double) { return left-- > 0; });
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().kind, ErrorKind::interrupted);
  }
}

}  // namespace
}  // namespace argil
