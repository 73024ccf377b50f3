// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace argil {

// This header is read by code for several instruction sets: no functions here.

/// How what a dab does falls off from its middle, where it is 1, to its rim, where all but
/// `constant` are 0. With p = 1 - rho and rho the distance from the middle in radii:
enum class Falloff {
  smooth,          ///< (1 - rho^2)^2
  smoother,        ///< p^3 (6 p^2 - 15 p + 10)
  sphere,          ///< sqrt(1 - rho^2)
  root,            ///< sqrt(p)
  sharp,           ///< p^2
  linear,          ///< p
  sharper,         ///< p^4
  inverse_square,  ///< 1 - rho^2
  constant         ///< 1
};

}  // namespace argil
