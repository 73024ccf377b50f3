// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/engine/clay.h"

namespace argil::evaluation {

/// The piece that is sculpted: a ball with bumps some half a voxel high and ten wide, which keep
/// the finest level of the clay everywhere. One formula, so that every program and every resolution
/// has the same piece.
struct BumpyBall {
  double radius_mm = 0.0;
  double bump_mm = 0.0;  ///< the voxel that the bumps are measured in

  /// A distance but for the slopes of the bumps: negative inside.
  double distance(const Vec3& p) const noexcept;
  /// Where the ray from the centre in this direction leaves the ball.
  Vec3 surface_point(const Vec3& direction) const noexcept;
};

/// The radius of all balls.
inline constexpr double kBallMm = 50.0;

/// The voxel at which the clay's surface of the ball has so many vertices: a surface that lies in
/// all directions cuts 1.5 lattice edges for each voxel^2 of its area.
double voxel_for(double vertices) noexcept;

Result<Clay> clay_of(const BumpyBall& ball, double voxel_mm);

/// The ball as other programs get it: as many squares as it takes along each edge of a cube, blown
/// up so that angles between them are even. What it lists goes to a file as it stands.
struct QuadBall {
  std::vector<float> positions;     ///< x, y, z of each vertex
  std::vector<std::int32_t> quads;  ///< four corners each, counter-clockwise from outside

  std::int64_t vertices() const noexcept { return static_cast<std::int64_t>(positions.size() / 3); }
};
/// How many squares along an edge of the cube give about so many vertices.
int squares_for(double vertices) noexcept;
/// `squares`: 1 to 1290, which keeps corners within 32 bits as they are numbered.
QuadBall quad_ball(const BumpyBall& ball, int squares);

/// Two triangles for each quad, with these positions in place of the ball's.
TriangleMesh triangles_of(const std::vector<std::int32_t>& quads,
                          const std::vector<Vec3>& positions);

}  // namespace argil::evaluation
