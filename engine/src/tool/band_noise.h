// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

#include "argil/core/vec3.h"
#include "argil/engine/tool.h"

namespace argil {

/// A random function of space without any wavelength below the given one, nor any above 10/7 of it:
/// a sum of plane waves of equal amplitude whose directions and phases the seed decides. Mean 0,
/// root mean square 1/3, so that its peaks are about 1; nearly Gaussian, alike in all directions.
///
/// On a plane the wavelengths are longer where waves cross it obliquely: 90 % of the power lies
/// above half the greatest wave number (ActionNoise.LiesWithinItsBand).
///
/// Determinism  same bits on every machine: no library's sine.
/// Cost         about 0.3 us a point.
class BandNoise {
 public:
  /// `wavelength_mm` > 0.
  BandNoise(double wavelength_mm, std::uint32_t seed);

  struct Value {
    double value;
    Vec3 rise;  ///< per mm
  };
  Value at(const Vec3& point_mm) const noexcept;

 private:
  static constexpr std::size_t kWaves = 32;
  struct Wave {
    Vec3 turns_per_mm;
    double turns;
  };
  std::array<Wave, kWaves> waves_;
};

/// The shortest wave that a level holds, in its voxels.
inline constexpr double kLeastNoiseVoxels = 4.0;

/// What a tool asks for, in mm.
inline double noise_wavelength(const Tool& tool) noexcept {
  return tool.wavelength_mm > 0.0 ? tool.wavelength_mm : 0.5 * smallest_radius(tool);
}

}  // namespace argil
