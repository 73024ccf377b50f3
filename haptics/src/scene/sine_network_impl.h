// SPDX-License-Identifier: GPL-3.0-or-later
// Included once by each sine_network_SET.cpp, as force/lattice_sums_impl.h is by its own: no
// standard header, and no step that depends on the width of a register, so that all instruction
// sets give the same bits.
//
// Notation: u the three inputs, h1 and h2 the layers of sines, k1 and k2 their slopes per turn;
// p1 and p2 how fast the distance grows with a unit's argument. Nothing but the inputs depends on
// the place: no branch and no look-up, so every place costs the same.
#if ARGIL_LANES_REGISTER == 64
#include <immintrin.h>
#endif

#include "force/lattice_sums.h"
#include "scene/sine_network_sums.h"

namespace argil::haptics::ARGIL_LANES_SET {
namespace {

constexpr int kRegister = ARGIL_LANES_REGISTER;
#include "force/lattice_lanes.h"

constexpr int kUnits = kSineNetworkUnits;
constexpr int kBlocks = kUnits / kLanes;
static_assert(kUnits % kLanes == 0);
constexpr float kTurn = 6.283185307179586F;

/// All units of a layer.
struct Layer {
  Lanes block[kBlocks];
};

ARGIL_LANES Layer load(const float* from) {
  Layer layer;
  for (int n = 0; n < kBlocks; ++n) {
    layer.block[n] = load_pair(from + n * kLanes, from + n * kLanes + kLanes / 2);
  }
  return layer;
}
ARGIL_LANES void store(const Layer& layer, float* to) {
  __builtin_memcpy(to, &layer, sizeof layer);
}
ARGIL_LANES Layer operator*(const Layer& a, const Layer& b) {
  Layer r;
  for (int n = 0; n < kBlocks; ++n) r.block[n] = a.block[n] * b.block[n];
  return r;
}
/// sum += factor * weights.
ARGIL_LANES void add(const float* weights, float factor, Layer& sum) {
  const Layer row = load(weights);
  for (int n = 0; n < kBlocks; ++n) sum.block[n] += row.block[n] * spread(factor);
}

/// sin(2 pi t) within 3e-7 for |t| < 1000: t less the nearest whole number, and of what is left,
/// r, the zeros at 0 and +-0.5 times a polynomial of r^2, fitted to 2e-9.
ARGIL_LANES Lanes sine_of_turns(const Lanes& t) {
  constexpr float kRounder = 12582912.0F;  // 1.5 * 2^23: no digits are left behind the point
  const Lanes r = t - ((t + spread(kRounder)) - spread(kRounder));
  const Lanes q = r * r;
  constexpr float kFit[] = {25.1327419F,  -64.835823F, 67.0767593F,
                            -38.4984207F, 14.0655050F, -3.19337296F};
  Lanes p = spread(kFit[5]);
  for (int n = 4; n >= 0; --n) p = p * q + spread(kFit[n]);
  return r * (spread(0.25F) - q) * p;
}
/// The sines of a layer's arguments, and their slopes.
ARGIL_LANES void take_sines(const Layer& turns, Layer& sine, Layer& slope) {
  for (int n = 0; n < kBlocks; ++n) {
    sine.block[n] = sine_of_turns(turns.block[n]);
    slope.block[n] = sine_of_turns(turns.block[n] + spread(0.25F)) * spread(kTurn);
  }
}

/// Added up in one order.
ARGIL_LANES float product_sum(const Layer& a, const float* weights) {
  float terms[kUnits];
  store(a * load(weights), terms);
  float sum = 0.0F;
  for (int n = 0; n < kUnits; ++n) sum += terms[n];
  return sum;
}

/// sum + the layer's values times the rows of a square of weights.
ARGIL_LANES void add_all(const Layer& values, const float* weights, Layer& sum) {
  float factors[kUnits];
  store(values, factors);
  for (int n = 0; n < kUnits; ++n) add(weights + n * kUnits, factors[n], sum);
}

}  // namespace

SineNetworkSums sum_sine_network(const SineNetworkWeights& weights, const float* place) noexcept {
  // u = (sin 2 pi x, cos 2 pi y, z), and the slopes of the first two.
  const float turns[kLanes] = {place[0], place[0] + 0.25F, place[1], place[1] + 0.25F};
  const Lanes waves = sine_of_turns(load_pair(turns, turns + kLanes / 2));
  float wave[kLanes];
  __builtin_memcpy(wave, &waves, sizeof wave);
  const float u[kSineNetworkInputs] = {wave[0], wave[3], place[2]};
  const float grow[kSineNetworkInputs] = {kTurn * wave[1], -kTurn * wave[2], 1.0F};

  Layer first = load(weights.first_bias);
  for (int a = 0; a < kSineNetworkInputs; ++a) add(weights.first + a * kUnits, u[a], first);
  Layer h1;
  Layer k1;
  take_sines(first, h1, k1);
  Layer second = load(weights.second_bias);
  add_all(h1, weights.second, second);
  Layer h2;
  Layer k2;
  take_sines(second, h2, k2);

  Layer p1{};
  add_all(k2 * load(weights.last), weights.second_by_unit, p1);
  p1 = p1 * k1;
  SineNetworkSums sums;
  sums.distance = product_sum(h2, weights.last) + weights.last_bias;
  for (int a = 0; a < kSineNetworkInputs; ++a) {
    sums.gradient[a] = product_sum(p1, weights.first + a * kUnits) * grow[a];
  }
  return sums;
}

}  // namespace argil::haptics::ARGIL_LANES_SET
