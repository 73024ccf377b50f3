// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace argil::haptics {

// The sums of SineNetwork, compiled once for each instruction set. As in force/lattice_sums.h,
// nothing that is included here may define inline functions.

inline constexpr int kSineNetworkInputs = 3;
inline constexpr int kSineNetworkUnits = 16;  ///< of each of the two layers; a multiple of 16

/// Arguments of the sines are in turns. `second` holds the weights of one unit of the first layer
/// together, `second_by_unit` the same numbers those of one unit of the second.
struct SineNetworkWeights {
  float first[kSineNetworkInputs * kSineNetworkUnits];
  float first_bias[kSineNetworkUnits];
  float second[kSineNetworkUnits * kSineNetworkUnits];
  float second_by_unit[kSineNetworkUnits * kSineNetworkUnits];
  float second_bias[kSineNetworkUnits];
  float last[kSineNetworkUnits];
  float last_bias;
};

/// In wavelengths. `place`: x and y from -0.5 to 0.5, z within the slab that was learnt.
struct SineNetworkSums {
  float distance;
  float gradient[kSineNetworkInputs];
};

namespace baseline {
SineNetworkSums sum_sine_network(const SineNetworkWeights& weights, const float* place) noexcept;
}
namespace avx2 {
SineNetworkSums sum_sine_network(const SineNetworkWeights& weights, const float* place) noexcept;
}
namespace avx512 {
SineNetworkSums sum_sine_network(const SineNetworkWeights& weights, const float* place) noexcept;
}

}  // namespace argil::haptics
