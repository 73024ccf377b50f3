// SPDX-License-Identifier: GPL-3.0-or-later
#include "window/detail_patch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "argil/core/window_channel.h"
#include "argil/engine/window.h"

namespace argil {
namespace {

constexpr double kDetailVoxelMm = 0.25;
constexpr double kDetailWaveMm = 2.0;  // eight voxels
constexpr double kDetailHighMm = 0.1;

/// The phase keeps the waves from vanishing at the nodes of coarse levels.
double wave_turn(double x_mm) { return 2.0 * std::numbers::pi * (x_mm - 0.37) / kDetailWaveMm; }

/// A block whose top, y = 8 mm, is wavy along x.
Clay block_with_wavy_top() {
  ClayOptions options;
  options.voxel_mm = kDetailVoxelMm;
  const auto distance = [](const Vec3& p) {
    const double waves = kDetailHighMm * std::sin(wave_turn(p.x));
    return std::max({std::abs(p.x) - 16.0, std::abs(p.z) - 16.0, -8.0 - p.y, p.y - 8.0 - waves});
  };
  return Clay::from_distance(distance, {{-17.0, -9.0, -17.0}, {17.0, 9.0, 17.0}}, options).value();
}

FieldWindow detail_window(const Clay& clay, const Vec3& center, double voxel_mm) {
  return read_window(clay, {center, voxel_mm, 8.0 * voxel_mm, 8.0 * voxel_mm}, Extension::layers)
      .value();
}

/// How high the waves are in the patch, and what of it is something else, rms away from the edges.
struct FoundWaves {
  double amplitude_mm = 0.0;
  double rest_mm = 0.0;
};
FoundWaves waves_in(const SurfaceDetail& detail) {
  constexpr int kMargin = 4;
  double along_sine = 0.0;
  double along_cosine = 0.0;
  double square = 0.0;
  int count = 0;
  // 24 nodes are three waves whole.
  for (int i = kMargin; i < kMargin + 24; ++i) {
    for (int j = kMargin; j < kMargin + 24; ++j) {
      const Vec3 place = detail.origin_mm + i * detail.step_x_mm + j * detail.step_y_mm;
      const double turn = wave_turn(place.x);
      const double height = static_cast<double>(detail.at(i, j));
      along_sine += 2.0 * height * std::sin(turn);
      along_cosine += 2.0 * height * std::cos(turn);
      square += height * height;
      ++count;
    }
  }
  FoundWaves found;
  found.amplitude_mm = along_sine / count;
  const double waves = 0.5 * (along_sine * along_sine + along_cosine * along_cosine) /
                       (static_cast<double>(count) * count);
  found.rest_mm = std::sqrt(std::max(0.0, square / count - waves));
  return found;
}

/// A Gaussian of 1 mm leaves 0.7 % of waves of 2 mm; what is left is taken off twice.
TEST(DetailPatch, HasTheWavesThatTheWindowLost) {
  const Clay clay = block_with_wavy_top();
  const FieldWindow window = detail_window(clay, {1.3, 9.0, 0.7}, 1.0);
  const SurfaceDetail detail = read_detail(clay, window.view, {1.3, 9.0, 0.7});
  ASSERT_TRUE(detail.is_known);
  EXPECT_GT(detail.normal.y, 0.95);  // of the window, which knows a little of the waves
  EXPECT_NEAR(length(detail.step_x_mm), kDetailVoxelMm, 1e-12);
  EXPECT_NEAR(length(detail.step_y_mm), kDetailVoxelMm, 1e-12);
  EXPECT_NEAR(dot(detail.step_x_mm, detail.step_y_mm), 0.0, 1e-12);
  const FoundWaves found = waves_in(detail);
  EXPECT_NEAR(found.amplitude_mm, kDetailHighMm, 0.1 * kDetailHighMm);
  EXPECT_LT(found.rest_mm, 0.1 * kDetailHighMm);
  RecordProperty("amplitude_um", std::to_string(1e3 * found.amplitude_mm));
  RecordProperty("rest_um", std::to_string(1e3 * found.rest_mm));
}

/// Waves of two millimetres and a window that follows them: what is left is theirs, not ours.
TEST(DetailPatch, LeavesToTheWindowWhatItFollows) {
  const Clay clay = block_with_wavy_top();
  const FieldWindow window = detail_window(clay, {1.3, 9.0, 0.7}, 0.3);
  const SurfaceDetail detail = read_detail(clay, window.view, {1.3, 9.0, 0.7});
  ASSERT_TRUE(detail.is_known);
  // (1 - exp(-2 pi^2 0.3^2 / 2^2))^2 = 0.13
  EXPECT_NEAR(waves_in(detail).amplitude_mm, 0.13 * kDetailHighMm, 0.05 * kDetailHighMm);
}

TEST(DetailPatch, IsFlatOnSmoothClay) {
  ClayOptions options;
  options.voxel_mm = kDetailVoxelMm;
  const Clay clay = Clay::ball(20.0, options).value();
  const Vec3 place = 21.0 * normalized(Vec3{1.0, 2.0, -0.5});
  const FieldWindow window = detail_window(clay, place, 1.0);
  const SurfaceDetail detail = read_detail(clay, window.view, place);
  ASSERT_TRUE(detail.is_known);
  // Not at the edges, where the ball's own bend is all on one side.
  for (int i = 12; i < 20; ++i) {
    for (int j = 12; j < 20; ++j) EXPECT_LT(std::abs(detail.at(i, j)), 0.02) << i << " " << j;
  }
}

TEST(DetailPatch, KnowsNothingWhereTheWindowIsAsFineOrTheSurfaceElsewhere) {
  const Clay clay = block_with_wavy_top();
  const Vec3 place{1.3, 9.0, 0.7};
  const FieldWindow fine = detail_window(clay, place, kDetailVoxelMm);
  EXPECT_FALSE(read_detail(clay, fine.view, place).is_known);
  const FieldWindow coarse = detail_window(clay, place, 1.0);
  EXPECT_TRUE(read_detail(clay, coarse.view, place).is_known);
  EXPECT_FALSE(read_detail(clay, coarse.view, {1.3, 30.0, 0.7}).is_known);
  EXPECT_FALSE(read_detail(clay, coarse.view, {std::nan(""), 9.0, 0.7}).is_known);
}

TEST(DetailPatch, ComesWithTheWindowsThatAskForItAlone) {
  const Clay clay = block_with_wavy_top();
  WindowChannel channel;
  WindowPublisher publisher(channel);
  WindowRequest request{{1.3, 9.0, 0.7}, 1.0, 8.0, 8.0};
  for (const bool wants : {false, true, false, true, false, false}) {
    request.wants_detail = wants;
    ASSERT_TRUE(publisher.publish(clay, request).ok());
    ASSERT_TRUE(channel.fetch());
    EXPECT_EQ(channel.read_slot().detail.is_known, wants);
    // The field, and its seal, are the same.
    EXPECT_EQ(channel.read_slot().checksum, window_checksum(channel.read_slot().view()));
  }
}

}  // namespace
}  // namespace argil
