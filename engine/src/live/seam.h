// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <unordered_map>
#include <vector>

#include "argil/core/triangle_mesh.h"
#include "argil/engine/display_block.h"

namespace argil {

/// An edge with a surface on its left, seen from outside, and nothing on its right.
struct BorderEdge {
  DisplayVertex from;
  DisplayVertex to;
};

/// The edges of a block's triangles that belong to one of them alone.
std::vector<BorderEdge> border_of(const DisplayBlock& block);

/// The border of a surface that grows and shrinks by blocks: what the borders of two of them share
/// lies inside. Vertices are one where the bits of their positions are.
class Border {
 public:
  void add(const std::vector<BorderEdge>& edges) { count(edges, 1); }
  void remove(const std::vector<BorderEdge>& edges) { count(edges, -1); }

  using Loop = std::vector<DisplayVertex>;  ///< the last goes on to the first
  /// All of it, the surface on the left; the longest first.
  std::vector<Loop> loops() const;

 private:
  /// The ends of an edge, the smaller first.
  using Key = std::array<float, 6>;
  struct KeyHash {
    std::size_t operator()(const Key& key) const noexcept;
  };
  struct Count {
    BorderEdge edge;  ///< as the key has it
    int times = 0;    ///< how often it is there, less how often the other way round
  };
  void count(const std::vector<BorderEdge>& edges, int times);

  std::unordered_map<Key, Count, KeyHash> counts_;  ///< none of 0 times
};

struct SeamMesh {
  std::vector<DisplayVertex> vertices;
  std::vector<Triangle> triangles;
};

/// Triangles that close the gap between two surfaces whose borders run side by side: a strip from
/// each loop of one to the loop of the other within `reach_mm` of it, in the mean, and a lid on
/// each that has none. Both surfaces and these together have no border, whatever the loops are.
SeamMesh seam_between(const Border& one, const Border& other, double reach_mm);

}  // namespace argil
