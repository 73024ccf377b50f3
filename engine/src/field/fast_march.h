// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace argil {

/// A dense block on which a distance is extended. Node (i, j, k) is at (i * n[1] + j) * n[2] + k.
struct MarchBlock {
  enum State : std::uint8_t {
    kFixed,    ///< value given; a source
    kUnknown,  ///< value wanted; its sign (of `value`, +-0 counting as positive) is given
    kWall,     ///< neither read nor written
  };
  std::array<int, 3> n{};
  float voxel = 1.0F;               ///< spacing, same unit as the values
  std::vector<float> value;         ///< signed, negative inside
  std::vector<std::uint8_t> state;  ///< a State for each node
};

/// Solves |grad phi| = 1 outward from the fixed nodes into the unknown ones, each keeping its sign;
/// where a neighbour has the other sign its signed value is used as it stands.
///
/// Returns      number of nodes solved. Unknown nodes that no front reaches within `limit` get
///              +-limit; no result exceeds it.
/// Accuracy     second order upwind where two known nodes stand in a row, else first:
///              FastMarch.SecondOrderOnBall holds p95 to 0.02 voxel.
/// Determinism  sequential; ties broken by node index, so same bits always.
/// Threads      any; reentrant (allocates).
/// Cost         0.25 us per solved node of a block of 65^3, 0.7 us at 129^3 (out of cache).
/// Source       J. Sethian, "Fast marching methods", SIAM Review 41 (1999), with the second-order
///              one-sided differences of its section 2.4.
std::int64_t fast_march(MarchBlock& block, float limit);

}  // namespace argil
