// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cassert>
#include <vector>

#include "argil/engine/stroke.h"

#include "field/leaf.h"

namespace argil {

/// A reflection or a turn about the origin that takes every lattice onto itself.
struct LatticeMap {
  std::array<std::size_t, 3> axis{0, 1, 2};  ///< where each coordinate of an image comes from
  std::array<int, 3> sign{1, 1, 1};

  Coord node(const Coord& at) const noexcept {
    Coord image;
    for (std::size_t a = 0; a < 3; ++a) {
      image[a] = sign[a] * at[static_cast<int>(axis[a])];
    }
    return image;
  }
  /// The origin of the leaf whose cells are the image of a leaf's cells.
  Coord leaf(const Coord& origin) const noexcept {
    assert(is_leaf_origin(origin));
    Coord image;
    for (std::size_t a = 0; a < 3; ++a) {
      const int low = origin[static_cast<int>(axis[a])];
      image[a] = sign[a] > 0 ? low : -low - kLeafSide;
    }
    return image;
  }

  friend bool operator==(const LatticeMap&, const LatticeMap&) noexcept = default;
};

/// All images that a mirror and a radial symmetry make, as far as they map lattice onto lattice:
/// reflections, half turns and quarter turns. One of all images stands for them, so that what is
/// decided for it is decided for all.
class LatticeSymmetry {
 public:
  LatticeSymmetry(const Mirror& mirror, const Radial& radial);

  /// Nothing has an image but itself.
  bool is_none() const noexcept { return maps_.size() == 1; }
  const std::vector<LatticeMap>& maps() const noexcept { return maps_; }

  /// The image with the greatest x, then y, then z.
  Coord representative_node(const Coord& node) const noexcept;
  Coord representative_leaf(const Coord& origin) const noexcept;
  /// Whether it stands for itself; most do not, and that is told by the first few images.
  bool is_representative_node(const Coord& node) const noexcept;
  bool is_representative_leaf(const Coord& origin) const noexcept;

 private:
  std::vector<LatticeMap> maps_;  ///< closed under repetition; the first changes nothing
};

}  // namespace argil
