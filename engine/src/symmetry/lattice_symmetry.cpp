// SPDX-License-Identifier: GPL-3.0-or-later
// The group that the generators (reflections, quarter or half turns) make, by closure.
#include "symmetry/lattice_symmetry.h"

#include <algorithm>
#include <cassert>

namespace argil {
namespace {

/// `second` after `first`.
LatticeMap composed(const LatticeMap& first, const LatticeMap& second) {
  LatticeMap both;
  for (std::size_t a = 0; a < 3; ++a) {
    both.axis[a] = first.axis[second.axis[a]];
    both.sign[a] = second.sign[a] * first.sign[second.axis[a]];
  }
  return both;
}

/// A quarter turn about an axis, as a stroke's radial images are turned.
LatticeMap quarter_turn(std::size_t axis) {
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  LatticeMap turn;
  turn.axis[u] = v;
  turn.sign[u] = -1;
  turn.axis[v] = u;
  return turn;
}

std::vector<LatticeMap> generators_of(const Mirror& mirror, const Radial& radial) {
  std::vector<LatticeMap> generators;
  const std::array<bool, 3> planes{mirror.x, mirror.y, mirror.z};
  for (std::size_t a = 0; a < 3; ++a) {
    LatticeMap reflection;
    reflection.sign[a] = -1;
    if (planes[a]) generators.push_back(reflection);
  }
  const LatticeMap turn = quarter_turn(radial.axis);
  if (radial.count % 4 == 0) {
    generators.push_back(turn);
  } else if (radial.count % 2 == 0) {
    generators.push_back(composed(turn, turn));
  }
  return generators;
}

}  // namespace

LatticeSymmetry::LatticeSymmetry(const Mirror& mirror, const Radial& radial) : maps_(1) {
  assert(radial.axis < 3 && radial.count >= 1);
  const std::vector<LatticeMap> generators = generators_of(mirror, radial);
  for (std::size_t n = 0; n < maps_.size(); ++n) {
    for (const LatticeMap& generator : generators) {
      const LatticeMap map = composed(maps_[n], generator);
      if (std::find(maps_.begin(), maps_.end(), map) == maps_.end()) maps_.push_back(map);
    }
  }
  assert(maps_.front() == LatticeMap() && maps_.size() <= 16);  // of a mirrored square prism
}

Coord LatticeSymmetry::representative_node(const Coord& node) const noexcept {
  Coord greatest = node;
  for (const LatticeMap& map : maps_) greatest = std::max(greatest, map.node(node));
  return greatest;
}

Coord LatticeSymmetry::representative_leaf(const Coord& origin) const noexcept {
  Coord greatest = origin;
  for (const LatticeMap& map : maps_) greatest = std::max(greatest, map.leaf(origin));
  return greatest;
}

bool LatticeSymmetry::is_representative_node(const Coord& node) const noexcept {
  return std::none_of(maps_.begin(), maps_.end(),
                      [&](const LatticeMap& map) { return node < map.node(node); });
}

bool LatticeSymmetry::is_representative_leaf(const Coord& origin) const noexcept {
  return std::none_of(maps_.begin(), maps_.end(),
                      [&](const LatticeMap& map) { return origin < map.leaf(origin); });
}

}  // namespace argil
