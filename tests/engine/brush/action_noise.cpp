// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/engine/clay.h"
#include "argil/engine/pick.h"
#include "argil/engine/surface.h"

#include "support/measure/mesh_topology.h"
#include "support/stroke_maker.h"
#include "tool/band_noise.h"

namespace argil {
namespace {

using testing::IsEmpty;

constexpr double kNoiseVoxel = 0.25;
constexpr double kNoiseRadius = 16.0;
constexpr double kWavelength = 4.0;

Clay noise_slab() {
  return Clay::block({44, 44, 20}, ClayOptions{.voxel_mm = kNoiseVoxel}).value();
}

Stroke noise_stroke(double strength, const std::vector<Vec3>& places) {
  Stroke stroke = stroke_of(Action::noise, kNoiseRadius, strength, places);
  stroke.tool.wavelength_mm = kWavelength;
  stroke.tool.seed = 7;
  return stroke;
}

double roughened_by(const Clay& clay, double x, double y) {
  const auto hit = pick(clay, Ray{{x, y, 50.0}, {0, 0, -1}});
  return hit.ok() && hit.value() ? hit.value()->point_mm.z - 10.0 : std::nan("");
}

/// Heights over a square in the middle, and the part of their power at wave numbers (1/mm) from
/// `low` to `high`, seen through a window that is smooth at its ends.
class HeightSpectrum {
 public:
  explicit HeightSpectrum(const Clay& clay) {
    for (int i = 0; i < kSide; ++i) {
      for (int j = 0; j < kSide; ++j) {
        heights_.push_back(roughened_by(clay, at(i), at(j)) * window(i) * window(j));
      }
    }
    for (int p = -kMost; p <= kMost; ++p) {
      for (int q = -kMost; q <= kMost; ++q) powers_.push_back({number(p, q), power(p, q)});
    }
  }

  double part(double low, double high) const {
    double all = 0.0;
    double within = 0.0;
    for (const auto& [number, power] : powers_) {
      all += power;
      if (number >= low && number <= high) within += power;
    }
    return within / all;
  }

 private:
  static constexpr int kSide = 48;
  static constexpr double kWidth = 20.0;
  static constexpr int kMost = 16;

  static double at(int i) { return kWidth * ((i + 0.5) / kSide - 0.5); }
  static double window(int i) {
    const double s = std::sin(std::numbers::pi * (i + 0.5) / kSide);
    return s * s;
  }
  static double number(int p, int q) { return std::hypot(p, q) / kWidth; }
  double power(int p, int q) const {
    std::complex<double> sum = 0.0;
    for (int i = 0; i < kSide; ++i) {
      for (int j = 0; j < kSide; ++j) {
        const double turns = (p * at(i) + q * at(j)) / kWidth;
        sum += heights_[static_cast<std::size_t>(i * kSide + j)] *
               std::polar(1.0, 2.0 * std::numbers::pi * turns);
      }
    }
    return std::norm(sum);
  }

  struct Power {
    double number;
    double power;
  };
  std::vector<double> heights_;
  std::vector<Power> powers_;
};

/// The window widens each line by 2 / its width.
TEST(ActionNoise, LiesWithinItsBand) {
  Clay clay = noise_slab();
  ASSERT_TRUE(clay.apply(noise_stroke(0.3, {{0, 0, 10}})).ok());
  const HeightSpectrum spectrum(clay);
  constexpr double kMost = 1.0 / kWavelength;
  std::printf("power: %.4f below half the greatest wave number, %.4f above it\n",
              spectrum.part(0.0, 0.5 * kMost), spectrum.part(kMost + 0.1, 10.0));
  EXPECT_LT(spectrum.part(kMost + 0.1, 10.0), 0.01);
  EXPECT_GT(spectrum.part(0.5 * kMost - 0.1, kMost + 0.1), 0.9);
  EXPECT_THAT(clay.validate(), IsEmpty());
  EXPECT_EQ(test::find_mesh_faults(extract_surface(clay)), test::MeshFaults{});
}

/// Heights as the noise itself says, and so alike for dabs that overlap.
TEST(ActionNoise, IsTheNoiseTimesTheFalloff) {
  const BandNoise noise(kWavelength, 7);
  for (const double strength : {0.4, -0.4}) {
    Clay clay = noise_slab();
    ASSERT_TRUE(clay.apply(noise_stroke(strength, {{-2, 0, 10}, {2, 0, 10}})).ok());
    for (double x = -2.0; x <= 2.0; x += 0.37) {
      for (double y = -9.0; y <= 9.0; y += 0.9) {
        const double r = y / kNoiseRadius;
        const double falloff = (1.0 - r * r) * (1.0 - r * r);
        const double expected =
            0.25 * kNoiseRadius * strength * falloff * noise.at({x, y, 10.0}).value;
        EXPECT_NEAR(roughened_by(clay, x, y), expected, 0.35 * kNoiseVoxel) << x << ' ' << y;
      }
    }
  }
}

TEST(ActionNoise, IsNoRougherHoweverOftenItPasses) {
  Clay once = noise_slab();
  Clay thrice = noise_slab();
  ASSERT_TRUE(once.apply(noise_stroke(0.5, {{-4, 0, 10}, {4, 0, 10}})).ok());
  ASSERT_TRUE(
      thrice.apply(noise_stroke(0.5, {{-4, 0, 10}, {4, 0, 10}, {-4, 0, 10}, {4, 0, 10}})).ok());
  for (double x = -8.0; x <= 8.0; x += 0.7) {
    EXPECT_NEAR(roughened_by(thrice, x, 1.0), roughened_by(once, x, 1.0), 0.02 * kNoiseVoxel) << x;
  }
}

TEST(ActionNoise, IsAnotherForAnotherSeedAndTheSameForTheSame) {
  std::vector<std::uint64_t> hashes;
  for (const std::uint32_t seed : {1U, 2U, 1U}) {
    Clay clay = Clay::ball(10.0, ClayOptions{.voxel_mm = 0.4}).value();
    Stroke stroke = stroke_of(Action::noise, 6.0, 0.7, {{10, 0, 0}, {9.5, 3, 0}});
    stroke.tool.seed = seed;
    ASSERT_TRUE(clay.apply(stroke).ok());
    hashes.push_back(clay.hash());
  }
  EXPECT_EQ(hashes[0], hashes[2]);
  EXPECT_NE(hashes[0], hashes[1]);
}

/// What the tool's images make is what turns and mirrors of it would.
TEST(ActionNoise, IsRepeatedByEverySymmetry) {
  Clay clay = Clay::ball(10.0, ClayOptions{.voxel_mm = 0.25}).value();
  Stroke stroke = stroke_of(Action::noise, 3.0, 1.0, {{9, 3, 2}, {9.5, 2, 2}});
  stroke.mirror.y = true;
  stroke.radial = {3, 0};
  ASSERT_TRUE(clay.apply(stroke).ok());
  double most = 0.0;
  double rough = 0.0;
  const double c = -0.5;
  const double s = 0.5 * std::numbers::sqrt3;
  for (const Vec3& v : extract_surface(clay).positions) {
    for (const Vec3& image :
         {Vec3{v.x, -v.y, v.z}, Vec3{v.x, c * v.y - s * v.z, s * v.y + c * v.z}}) {
      most = std::max(most, std::abs(clay.distance_at(image)));
    }
    rough = std::max(rough, std::abs(length(v) - 10.0));
  }
  EXPECT_GT(rough, 0.3);
  EXPECT_LT(most, 0.5 * 0.25) << "half a voxel: a third of a turn leaves the lattice";
}

TEST(BandNoise, HasMeanZeroAndTheRootMeanSquareItSays) {
  for (const std::uint32_t seed : {0U, 1U, 12345U}) {
    const BandNoise noise(2.0, seed);
    double sum = 0.0;
    double squares = 0.0;
    double most = 0.0;
    int count = 0;
    for (double x = 0.0; x < 40.0; x += 1.7) {
      for (double y = 0.0; y < 40.0; y += 1.7) {
        for (double z = 0.0; z < 40.0; z += 1.7, ++count) {
          const BandNoise::Value at = noise.at({x, y, z});
          sum += at.value;
          squares += at.value * at.value;
          most = std::max(most, std::abs(at.value));
        }
      }
    }
    EXPECT_NEAR(sum / count, 0.0, 0.02);
    EXPECT_NEAR(std::sqrt(squares / count), 1.0 / 3.0, 0.02);
    EXPECT_GT(most, 0.9);
    EXPECT_LT(most, 1.7);
  }
}

TEST(BandNoise, RisesAsItsDifferencesDo) {
  const BandNoise noise(3.0, 5);
  for (double t = 0.0; t < 50.0; t += 3.1) {
    const Vec3 at{t, -2.0 * t, 0.3 * t};
    for (std::size_t a = 0; a < 3; ++a) {
      Vec3 step;
      step[a] = 1e-4;
      const double rise = (noise.at(at + step).value - noise.at(at - step).value) / 2e-4;
      EXPECT_NEAR(noise.at(at).rise[a], rise, 1e-4);
    }
  }
}

}  // namespace
}  // namespace argil
