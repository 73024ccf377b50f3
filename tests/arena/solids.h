// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "argil/core/triangle_mesh.h"

namespace argil::arena {

/// A sound solid: closed, two-manifold, outward, nothing crossing, coordinates as floats hold them.
struct Solid {
  std::string name;
  TriangleMesh mesh;
};

/// Boxes, a ball, a ring, a bent pipe and letters.
std::vector<Solid> simple_solids();

/// These, the pebble of the examples and those of the shared models that are there, with at most
/// `most_triangles` each. In the units they came with. `said` hears of each that is missing or not
/// sound.
std::vector<Solid> sound_solids(std::size_t most_triangles,
                                const std::function<void(const std::string&)>& said);

/// A plate with thickness `thickness` (of 100 units), of fine triangles: flat, bent, a bowl.
Solid thin_solid(int variant, double thickness);

/// A tube along a closed curve: point at a time of [0, 1].
using Curve = std::function<Vec3(double)>;
TriangleMesh tube_along(const Curve& curve, double radius, int rings, int segments);

/// A piece of it from one time to another, with flat ends.
TriangleMesh tube_piece(const Curve& curve, double radius, int rings, int segments, int first,
                        int last);

}  // namespace argil::arena
