// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool/band_noise.h"

#include <cassert>
#include <cmath>
#include <numbers>

#include "tool/turns.h"

namespace argil {
namespace {

/// S. Vigna's splitmix64: the same numbers on every machine.
class SplitMix {
 public:
  explicit SplitMix(std::uint64_t seed) : state_(seed) {}

  /// Uniform in [0, 1).
  double next() noexcept {
    state_ += 0x9e3779b97f4a7c15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return static_cast<double>((z ^ (z >> 31U)) >> 11U) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

/// Uniform on the sphere, by squares only.
/// Source  G. Marsaglia, "Choosing a point from the surface of a sphere", Ann. Math. Stat. 43
///         (1972).
Vec3 random_direction(SplitMix& random) {
  while (true) {
    const double u = 2.0 * random.next() - 1.0;
    const double v = 2.0 * random.next() - 1.0;
    const double square = u * u + v * v;
    if (square >= 1.0) continue;
    const double root = 2.0 * std::sqrt(1.0 - square);
    return {u * root, v * root, 1.0 - 2.0 * square};
  }
}

}  // namespace

BandNoise::BandNoise(double wavelength_mm, std::uint32_t seed) {
  assert(wavelength_mm > 0.0);
  constexpr double kLeastNumber = 0.7;  // of waves, against the greatest
  SplitMix random(seed);
  for (Wave& wave : waves_) {
    const Vec3 direction = random_direction(random);
    const double number = kLeastNumber + (1.0 - kLeastNumber) * random.next();
    wave = {(number / wavelength_mm) * direction, random.next()};
  }
}

BandNoise::Value BandNoise::at(const Vec3& point_mm) const noexcept {
  double sum = 0.0;
  Vec3 rise;
  for (const Wave& wave : waves_) {
    const SineCosine here = of_turns(dot(wave.turns_per_mm, point_mm) + wave.turns);
    sum += here.cosine;
    rise -= here.sine * wave.turns_per_mm;
  }
  const double amplitude = std::sqrt(2.0 / static_cast<double>(kWaves)) / 3.0;
  return {amplitude * sum, (2.0 * std::numbers::pi * amplitude) * rise};
}

}  // namespace argil
