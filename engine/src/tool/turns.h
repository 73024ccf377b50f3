// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace argil {

struct SineCosine {
  double sine, cosine;
};

/// Of a number of turns, to 1e-8; the same bits on every machine, which a library's sine has not.
SineCosine of_turns(double turns) noexcept;

}  // namespace argil
