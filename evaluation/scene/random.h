// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cassert>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "argil/core/vec3.h"

namespace argil::evaluation {

/// Random numbers that are the same everywhere, as those of <random>'s distributions are not.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// Evenly between the two; `high` itself never comes.
  double between(double low, double high) {
    assert(low <= high);
    constexpr double kScale = 0x1p-53;
    return low + (high - low) * kScale * static_cast<double>(engine_() >> 11);
  }

  Vec3 direction() {
    const double z = between(-1.0, 1.0);
    const double turn = between(0.0, 2.0 * std::numbers::pi);
    const double ring = std::sqrt(1.0 - z * z);
    return {ring * std::cos(turn), ring * std::sin(turn), z};
  }

  /// Every orientation is as likely as any.
  /// Source  K. Shoemake, "Uniform random rotations", Graphics Gems III (1992).
  Quat orientation() {
    const double pi = std::numbers::pi;
    const double u = between(0.0, 1.0);
    const double a = between(0.0, 2.0 * pi);
    const double b = between(0.0, 2.0 * pi);
    const double s = std::sqrt(1.0 - u);
    const double t = std::sqrt(u);
    return {s * std::sin(a), s * std::cos(a), t * std::sin(b), t * std::cos(b)};
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace argil::evaluation
