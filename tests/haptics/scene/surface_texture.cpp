// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene/surface_texture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace argil::haptics {
namespace {

constexpr double kTextureTickS = 1e-3;
constexpr double kPatchStepMm = 0.25;
constexpr double kPatchWaveMm = 2.0;

/// Waves along x on the plane z = 0, about the origin.
SurfaceDetail patch_of_waves(double height_mm) {
  SurfaceDetail detail;
  constexpr double kHalf = 0.5 * (SurfaceDetail::kSide - 1) * kPatchStepMm;
  detail.is_known = true;
  detail.origin_mm = {-kHalf, -kHalf, 0.0};
  detail.step_x_mm = {kPatchStepMm, 0.0, 0.0};
  detail.step_y_mm = {0.0, kPatchStepMm, 0.0};
  detail.normal = {0.0, 0.0, 1.0};
  for (int n = 0; n < SurfaceDetail::kSide * SurfaceDetail::kSide; ++n) {
    const int row = n / SurfaceDetail::kSide;
    const double x = row * kPatchStepMm - kHalf;
    detail.height_mm[static_cast<std::size_t>(n)] =
        static_cast<float>(height_mm * std::sin(2.0 * std::numbers::pi * x / kPatchWaveMm));
  }
  return detail;
}

/// What a slide over the patch felt.
struct TextureFelt {
  double least_n = 0.0;
  double most_n = 0.0;
  double step_n = 0.0;  ///< the largest change in a tick
  int rises = 0;        ///< through 0
};
TextureFelt slide_texture(SurfaceTexture& texture, const SurfaceDetail& detail, double from_mm,
                          double to_mm, double mm_per_s) {
  TextureFelt felt;
  double last = texture.force_n();
  const int ticks = static_cast<int>((to_mm - from_mm) / (mm_per_s * kTextureTickS));
  for (int n = 0; n <= ticks; ++n) {
    texture.tick(detail, {from_mm + n * mm_per_s * kTextureTickS, 0.0, 4.0}, true, kTextureTickS);
    const double now = texture.force_n();
    felt.least_n = std::min(felt.least_n, now);
    felt.most_n = std::max(felt.most_n, now);
    felt.step_n = std::max(felt.step_n, std::abs(now - last));
    felt.rises += last < 0.0 && now >= 0.0 ? 1 : 0;
    last = now;
  }
  return felt;
}

/// 50 mm/s over waves of 2 mm is 25 Hz; three millimetres are one and a half waves.
TEST(SurfaceTexture, VibratesOncePerWaveThatItSlidesOver) {
  SurfaceTexture texture;
  const TextureFelt felt = slide_texture(texture, patch_of_waves(0.05), -3.0, 3.0, 50.0);
  EXPECT_EQ(felt.rises, 3);
  EXPECT_NEAR(felt.most_n, 0.05, 0.01);  // 1 N/mm
  EXPECT_NEAR(felt.least_n, -0.05, 0.01);
}

TEST(SurfaceTexture, IsNeverStrongerThanItsBoundNorThanThePush) {
  SurfaceTexture texture;
  const SurfaceDetail detail = patch_of_waves(1.0);
  double most = 0.0;
  for (int n = 0; n < 120; ++n) {
    texture.tick(detail, {-3.0 + 0.05 * n, 0.0, 0.0}, true, kTextureTickS);
    ASSERT_LE(std::abs(texture.force_n()), 0.1);
    most = std::max(most, std::abs(texture.force_n()));
    const Vec3 strong = texture.added_to({0.0, 0.0, 3.0});
    ASSERT_NEAR(strong.z, 3.0 + texture.force_n(), 1e-12);
    const Vec3 weak = texture.added_to({0.0, 0.0, 0.02});
    ASSERT_GE(weak.z, 0.0);
    ASSERT_LE(weak.z, 0.04 + 1e-12);
    ASSERT_EQ(texture.added_to({}), Vec3{});
  }
  EXPECT_EQ(most, 0.1);
}

TEST(SurfaceTexture, IsStillUnderAHandThatRests) {
  SurfaceTexture texture;
  const SurfaceDetail detail = patch_of_waves(0.1);
  slide_texture(texture, detail, -3.0, 0.5, 50.0);
  EXPECT_GT(std::abs(texture.force_n()), 0.02);
  // Wavers as encoders do, within the play.
  for (int n = 0; n < 400; ++n) {
    texture.tick(detail, {0.5 + (n % 2 == 0 ? 0.03 : -0.03), 0.0, 4.0}, true, kTextureTickS);
    if (n > 300) {
      ASSERT_LT(std::abs(texture.force_n()), 1e-3) << n;
    }
  }
}

TEST(SurfaceTexture, BeginsWithoutAStepAndFadesWhereItEnds) {
  SurfaceTexture texture;
  const SurfaceDetail detail = patch_of_waves(0.1);
  texture.tick(detail, {0.5, 0.0, 4.0}, true, kTextureTickS);  // on a crest
  EXPECT_EQ(texture.force_n(), 0.0);
  // Off the patch at its end, and the slide is never rough.
  const TextureFelt felt = slide_texture(texture, detail, 0.5, 8.0, 50.0);
  EXPECT_LT(felt.step_n, 0.025);
  for (int n = 0; n < 300; ++n) texture.tick(detail, {8.0, 0.0, 4.0}, true, kTextureTickS);
  EXPECT_LT(std::abs(texture.force_n()), 1e-3);
}

TEST(SurfaceTexture, FeelsNothingWithoutAContactOrADetail) {
  SurfaceTexture texture;
  SurfaceDetail unknown = patch_of_waves(0.1);
  unknown.is_known = false;
  for (int n = 0; n < 100; ++n) {
    texture.tick(unknown, {-3.0 + 0.05 * n, 0.0, 4.0}, true, kTextureTickS);
    ASSERT_EQ(texture.force_n(), 0.0);
    texture.tick(patch_of_waves(0.1), {-3.0 + 0.05 * n, 0.0, 4.0}, false, kTextureTickS);
    ASSERT_EQ(texture.force_n(), 0.0);
  }
}

/// A jump of the clock or the device is no slide.
TEST(SurfaceTexture, ForgetsMotion) {
  SurfaceTexture texture;
  const SurfaceDetail detail = patch_of_waves(0.1);
  texture.tick(detail, {-0.5, 0.0, 4.0}, true, kTextureTickS);
  texture.forget_motion();
  texture.tick(detail, {0.5, 0.0, 4.0}, true, kTextureTickS);
  EXPECT_EQ(texture.force_n(), 0.0);
}

/// What is slid sideways over waves along x is one height.
TEST(SurfaceTexture, IsQuietAlongTheCrests) {
  SurfaceTexture texture;
  const SurfaceDetail detail = patch_of_waves(0.1);
  for (int n = 0; n <= 100; ++n) {
    texture.tick(detail, {0.5, -2.5 + 0.05 * n, 4.0}, true, kTextureTickS);
    ASSERT_LT(std::abs(texture.force_n()), 5e-3) << n;
  }
}

/// The patch of the next window begins elsewhere, but has the same heights there.
TEST(SurfaceTexture, DoesNotNoticeThatThePatchMoves) {
  SurfaceTexture texture;
  SurfaceTexture moved;
  const SurfaceDetail detail = patch_of_waves(0.05);
  SurfaceDetail next = detail;  // eight steps are a wave: the same heights
  next.origin_mm.x += kPatchWaveMm;
  for (int n = 0; n <= 40; ++n) {
    const Vec3 place{-0.5 + 0.05 * n, 0.0, 4.0};
    texture.tick(detail, place, true, kTextureTickS);
    moved.tick(n < 20 ? detail : next, place, true, kTextureTickS);
    ASSERT_NEAR(texture.force_n(), moved.force_n(), 1e-6) << n;
  }
}

}  // namespace
}  // namespace argil::haptics
