// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "argil/core/triangle_mesh.h"

namespace argil::arena {

/// A place where nothing says what was there: the surface may be anything within it.
struct FreeBall {
  Vec3 center;
  double radius = 0.0;
};

/// What a right repair of a broken mesh is, as far as anyone can tell from the broken mesh. Lengths
/// are in its unit.
struct Truth {
  TriangleMesh must;  ///< surface that the result must have
  TriangleMesh may;   ///< surface that it may have beside, such as a fin made solid
  double volume = 0.0;
  /// As a fraction of it. More than 0.01 only where the triangles themselves say no better.
  double volume_tolerance = 0.01;
  std::vector<std::uint32_t> bodies{1};  ///< each of these counts is right
  /// How far both surfaces may be apart, as a fraction of the largest side. More than 0.005 only
  /// where the triangles themselves say no better.
  double tolerance = 0.005;
  std::vector<FreeBall> free;
};

/// A broken mesh, named by how it was made.
struct Broken {
  std::string kind;
  std::string model;
  int strength = 1;  ///< from 1
  TriangleMesh mesh;
  Truth truth;
  std::vector<Truth> also;  ///< other right answers, where there are several

  std::string name() const { return kind + "_" + model + "_" + std::to_string(strength); }
};

/// Of the box around what a right repair must have.
double largest_side(const TriangleMesh& mesh);

}  // namespace argil::arena
