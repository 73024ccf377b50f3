// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <set>
#include <vector>

#include "argil/core/vec3.h"

#include "field/level_stack.h"

namespace argil::test {

/// The value at a node: its level, its coordinates there, its position in mm.
using NodeField = std::function<float(int level, const Coord& node, const Vec3& at_mm)>;
/// Whether a leaf of a level is wanted at a point; asked for all levels but the coarsest.
using LeafChoice = std::function<bool(int level, const Coord& place)>;

/// A hash of some numbers, the same everywhere, spread over 64 bits.
inline std::uint64_t mixed(std::uint64_t seed, std::uint64_t a, std::uint64_t b = 0,
                           std::uint64_t c = 0, std::uint64_t d = 0) {
  for (const std::uint64_t v : {a, b, c, d}) {
    seed = (seed ^ v) * 0x9e3779b97f4a7c15ULL;
    seed ^= seed >> 29;
    seed *= 0xbf58476d1ce4e5b9ULL;
    seed ^= seed >> 32;
  }
  return seed;
}
/// The same of a node, as a number from 0 to 1.
inline double random_at(std::uint64_t seed, int level, const Coord& n) {
  const auto word = [](int v) { return static_cast<std::uint64_t>(static_cast<std::int64_t>(v)); };
  return static_cast<double>(mixed(seed, word(level), word(n.x()), word(n.y()), word(n.z())) >>
                             11) *
         0x1.0p-53;
}

/// Stacks of levels filled from functions, so that the answer is known.
struct AnalyticStack {
  double voxel_mm = 1.0;  ///< of level 0
  int levels = 1;
  int top_leaves = 2;  ///< the coarsest level fills the cube of 2 * this leaves a side
  NodeField field;
  LeafChoice choose;
  bool balanced = true;  ///< false: a leaf only has a parent, its surroundings may be far coarser

  /// Nodes this near to the cube's faces, in coarsest nodes, are outside, so that surfaces close.
  static constexpr int kMargin = 2;

  bool in_cube(int level, const Coord& place) const {
    const int side = 8 * top_leaves << (levels - 1 - level);
    for (int axis = 0; axis < 3; ++axis) {
      if (place[axis] < -side || place[axis] >= side) return false;
    }
    return true;
  }

  float value(int level, const Coord& node) const {
    const double h = voxel_mm * (1 << level);
    const double reach = (8 * top_leaves - kMargin) * voxel_mm * (1 << (levels - 1));
    const Vec3 at{node.x() * h, node.y() * h, node.z() * h};
    const float v = field(level, node, at);
    const bool near = std::abs(at.x) >= reach || std::abs(at.y) >= reach || std::abs(at.z) >= reach;
    return near ? std::abs(v) + static_cast<float>(0.01 * h) : v;
  }

  void fill_leaf(LevelStack& stack, int level, const Coord& place) const {
    VdbLeaf* leaf = stack.grid(level).tree().touchLeaf(place);
    leaf->setValuesOn();
    float* values = leaf->buffer().data();
    for (int i = 0; i < kLeafNodes; ++i) {
      values[i] = value(level, place + Coord(i >> 6, i >> 3 & 7, i & 7));
    }
  }

  /// Wanted points, and whatever balance needs: around a leaf the next coarser level is there.
  std::vector<std::set<Coord>> places() const {
    std::vector<std::set<Coord>> found(static_cast<std::size_t>(levels));
    for (int level = 0; level < levels; ++level) {
      const int side = 8 * top_leaves << (levels - 1 - level);
      auto& here = found[static_cast<std::size_t>(level)];
      for (int x = -side; x < side; x += 8) {
        for (int y = -side; y < side; y += 8) {
          for (int z = -side; z < side; z += 8) {
            if (level == levels - 1 || choose(level, Coord(x, y, z))) here.insert(Coord(x, y, z));
          }
        }
      }
      if (level > 0) add_support(found, level);
    }
    return found;
  }

  void add_support(std::vector<std::set<Coord>>& found, int level) const {
    for (const Coord& fine : found[static_cast<std::size_t>(level - 1)]) {
      for (int i = balanced ? 0 : 13; i < (balanced ? 27 : 14); ++i) {
        const Coord step(8 * (i / 9 - 1), 8 * (i / 3 % 3 - 1), 8 * (i % 3 - 1));
        const Coord place = leaf_origin(coarser(fine + step));
        if (in_cube(level, place)) found[static_cast<std::size_t>(level)].insert(place);
      }
    }
  }

  LevelStack build() const {
    LevelStack stack(voxel_mm, levels);
    const auto chosen = places();
    for (int level = 0; level < levels; ++level) {
      for (const Coord& place : chosen[static_cast<std::size_t>(level)]) {
        fill_leaf(stack, level, place);
      }
    }
    return stack;
  }
};

inline NodeField ball_field(const Vec3& center, double radius) {
  return [=](int, const Coord&, const Vec3& p) {
    return static_cast<float>(length(p - center) - radius);
  };
}

inline NodeField torus_field(double ring, double tube) {
  return [=](int, const Coord&, const Vec3& p) {
    const double across = std::sqrt(p.x * p.x + p.y * p.y) - ring;
    return static_cast<float>(std::sqrt(across * across + p.z * p.z) - tube);
  };
}

/// Refines points by chance, independent of each other.
inline LeafChoice chosen_by_chance(std::uint64_t seed, double chance) {
  return [=](int level, const Coord& place) { return random_at(seed, level, place) < chance; };
}

}  // namespace argil::test
