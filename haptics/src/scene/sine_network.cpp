// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene/sine_network.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "scene/sine_network_weights.h"

namespace argil::haptics {
namespace {

SineNetworkSums sum_network(Simd simd, const float* place) noexcept {
#if defined(__x86_64__)
  if (simd == Simd::avx512) return avx512::sum_sine_network(kSineNetworkWeights, place);
  if (simd == Simd::avx2) return avx2::sum_sine_network(kSineNetworkWeights, place);
#endif
  assert(simd == Simd::baseline);
  return baseline::sum_sine_network(kSineNetworkWeights, place);
}

/// What is left of a number of waves after the nearest whole one, -0.5 to 0.5.
float folded(double waves) noexcept { return static_cast<float>(waves - std::floor(waves + 0.5)); }

}  // namespace

SineNetwork::SineNetwork(double wave_mm, Simd simd) noexcept : wave_mm_(wave_mm), simd_(simd) {
  assert(wave_mm > 0.0 && has_simd(simd));
}

SineNetwork::Answer SineNetwork::at(const Vec3& place_mm) const noexcept {
  const double z = place_mm.z / wave_mm_;
  const double inside = std::clamp(z, -kSlab, kSlab);
  const float place[] = {folded(place_mm.x / wave_mm_), folded(place_mm.y / wave_mm_),
                         static_cast<float>(inside)};
  const SineNetworkSums sums = sum_network(simd_, place);
  const auto slope = [&sums](int axis) { return static_cast<double>(sums.gradient[axis]); };
  return {wave_mm_ * (static_cast<double>(sums.distance) + (z - inside)),
          {slope(0), slope(1), z == inside ? slope(2) : 1.0}};
}

std::size_t SineNetwork::bytes() noexcept { return sizeof kSineNetworkWeights; }

}  // namespace argil::haptics
