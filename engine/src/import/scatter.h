// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "argil/engine/clay_options.h"

#include "field/leaf.h"
#include "import/flat_triangle.h"
#include "import/import_input.h"

namespace argil {

/// Distances of a lattice's nodes from a mesh: triangles are scattered into the leaves that they
/// reach, and each leaf lowers the distances of all its nodes triangle by triangle.
///
/// Accuracy     5e-6 voxel of the exact distance, for triangles of any size and shape.
/// Determinism  triangles are taken in their order, by every leaf alone: the same bits for any
///              number of threads and with every instruction set.
/// Threads      `measure` from any; made on all.
/// Cost         30 ns a node within the band where triangles are about as large as voxels; of
///              smaller ones those are left out that cannot be nearest: about a microsecond each.
class Scatter {
 public:
  /// Leaves are taken by bricks of 8^3, so that lists of triangles are short-lived. Keeps a
  /// reference to `input`.
  explicit Scatter(const ImportInput& input);

  std::size_t bricks() const noexcept { return bricks_.size(); }
  /// What a brick costs about, in any unit.
  double work(std::size_t brick) const noexcept;

  /// The leaves of a brick that have a node nearer than the band to a triangle, by origin, with the
  /// squares of the distances of their nodes in voxels, at most that of the band.
  using Take = std::function<void(const Coord& origin, const float* squares)>;
  void measure(std::size_t brick, const Take& take) const;

 private:
  struct Brick {
    Coord origin;  ///< of its first leaf
    std::uint64_t first = 0;
    std::uint64_t count = 0;  ///< of its triangles
  };

  const ImportInput& input_;
  std::vector<Brick> bricks_;             ///< by origin
  std::vector<std::uint32_t> triangles_;  ///< of each brick those that may reach it, in order
};

}  // namespace argil
