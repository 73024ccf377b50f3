// SPDX-License-Identifier: GPL-3.0-or-later
// A force to motor words, over the wire, and back to the force that these motors make.
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "argil/haptics/falcon/falcon_kinematics.h"

#include "falcon/falcon_packet.h"

namespace argil::haptics {
namespace {

int word_on_wire(const FalconPacket& packet, std::size_t leg) {
  int bits = 0;
  for (int n = 3; n >= 0; --n) {
    bits = 16 * bits + (packet[1 + 4 * leg + static_cast<std::size_t>(n)] - 'A');
  }
  return bits < 0x8000 ? bits : bits - 0x10000;
}

/// F = B^T tau, of what the packet says.
Vec3 force_of(const FalconPacket& packet, const std::array<Vec3, 3>& rates, double words_per_nm) {
  Vec3 force;
  for (std::size_t leg = 0; leg < 3; ++leg) {
    force += -1000.0 * word_on_wire(packet, leg) / words_per_nm * rates[leg];
  }
  return force;
}

struct Errors {
  double mean = 0.0;
  double most = 0.0;
};

/// Relative errors of forces of one size in every direction, over the ball of 40 mm.
Errors errors_of(const FalconGeometry& geometry, double force_n) {
  const FalconKinematics kinematics(geometry);
  std::mt19937_64 random(3);
  std::normal_distribution<double> some;
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const auto direction = [&] { return normalized(Vec3{some(random), some(random), some(random)}); };
  constexpr int kTries = 20'000;
  Errors errors;
  for (int n = 0; n < kTries; ++n) {
    const Vec3 place =
        kFalconCenterMm + kFalconUsableRadiusMm * std::cbrt(share(random)) * direction();
    const Vec3 wanted = force_n * direction();
    FalconCommand command;
    command.word = kinematics.motor_words(wanted, place).word;
    const Vec3 given =
        force_of(encode(command), kinematics.rates_of(place).value(), geometry.words_per_nm);
    const double error = length(given - wanted) / force_n;
    errors.mean += error / kTries;
    errors.most = std::max(errors.most, error);
  }
  return errors;
}

/// All of the error is the rounding to whole words, 4 mN at most: 0.1 % of half the largest force,
/// and as much more of smaller ones.
TEST(FalconWords, RenderTheForceThatWasAskedFor) {
  for (const FalconGeometry& geometry : {libnifalcon_geometry(), martin_hillier_geometry()}) {
    const Errors at_1_n = errors_of(geometry, 1.0);
    const Errors at_4_n = errors_of(geometry, 4.0);
    EXPECT_LE(at_4_n.most, 1e-3);
    EXPECT_LE(at_4_n.mean, 4e-4);
    EXPECT_LE(at_1_n.most, 4e-3);
    EXPECT_LE(at_1_n.mean, 1.3e-3);
  }
}

}  // namespace
}  // namespace argil::haptics
