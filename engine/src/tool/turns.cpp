// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool/turns.h"

#include <numbers>

namespace argil {

/// By the series of half the angle, which is a quarter turn at most.
SineCosine of_turns(double turns) noexcept {
  constexpr double kRound = 6755399441055744.0;  // 3 * 2^51: sums with it are whole numbers
  const double part = turns - ((turns + kRound) - kRound);
  const double x = std::numbers::pi * part;
  const double q = x * x;
  const double s =
      x * (1.0 + q * (-1.0 / 6.0 +
                      q * (1.0 / 120.0 +
                           q * (-1.0 / 5040.0 + q * (1.0 / 362880.0 + q * (-1.0 / 39916800.0 +
                                                                           q / 6227020800.0))))));
  const double c =
      1.0 +
      q * (-1.0 / 2.0 +
           q * (1.0 / 24.0 + q * (-1.0 / 720.0 +
                                  q * (1.0 / 40320.0 + q * (-1.0 / 3628800.0 + q / 479001600.0)))));
  return {2.0 * s * c, 1.0 - 2.0 * s * s};
}

}  // namespace argil
