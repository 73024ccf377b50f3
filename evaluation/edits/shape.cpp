// SPDX-License-Identifier: GPL-3.0-or-later
// One ball for all: as a clay from a formula, and as a mesh of even squares projected onto it.
#include "edits/shape.h"

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <unordered_map>

namespace argil::evaluation {
namespace {

constexpr double kVerticesPerSquareVoxel = 1.5;

/// A wave of period 1 between -1 and 1, in two parabolas: cheaper than a sine, as smooth.
double bump_wave(double t) {
  const double s = t - std::floor(t) - 0.5;
  return 8.0 * s * (1.0 - 2.0 * std::abs(s));
}

/// Numbers the vertices of the six faces, those of shared edges once.
class QuadBallMaker {
 public:
  QuadBallMaker(const BumpyBall& ball, int squares) : ball_(ball), squares_(squares) {}

  void add_face(std::size_t axis, bool is_far) {
    for (int i = 0; i < squares_; ++i) {
      for (int j = 0; j < squares_; ++j) {
        std::array<std::int32_t, 4> corners{};
        // Seen from outside a far face turns the other way.
        const int a = is_far ? 1 : 0;
        corners[0] = vertex(axis, is_far, i, j);
        corners[1] = vertex(axis, is_far, i + a, j + 1 - a);
        corners[2] = vertex(axis, is_far, i + 1, j + 1);
        corners[3] = vertex(axis, is_far, i + 1 - a, j + a);
        made_.quads.insert(made_.quads.end(), corners.begin(), corners.end());
      }
    }
  }
  QuadBall take() { return std::move(made_); }

 private:
  std::int32_t vertex(std::size_t axis, bool is_far, int i, int j) {
    std::array<int, 3> at{};
    at[axis] = is_far ? squares_ : 0;
    at[(axis + 1) % 3] = i;
    at[(axis + 2) % 3] = j;
    const std::int64_t side = squares_ + 1;
    const auto next = static_cast<std::int32_t>(made_.vertices());
    const auto [found, is_new] = numbers_.try_emplace((at[0] * side + at[1]) * side + at[2], next);
    if (is_new) {
      const Vec3 p = ball_.surface_point({across(at[0]), across(at[1]), across(at[2])});
      for (const double x : {p.x, p.y, p.z}) made_.positions.push_back(static_cast<float>(x));
    }
    return found->second;
  }
  /// From -1 to 1, at even angles seen from the centre.
  double across(int i) const {
    return std::tan(0.25 * std::numbers::pi * (2.0 * i / squares_ - 1.0));
  }

  BumpyBall ball_;
  int squares_;
  QuadBall made_;
  std::unordered_map<std::int64_t, std::int32_t> numbers_;
};

}  // namespace

double BumpyBall::distance(const Vec3& p) const noexcept {
  const double turn = 1.0 / (10.0 * bump_mm);
  // The phases keep the bumps from vanishing at the nodes of coarse levels.
  const double bumps =
      bump_wave(turn * p.x + 0.11) + bump_wave(turn * p.y + 0.17) + bump_wave(turn * p.z + 0.23);
  return length(p) - radius_mm - 0.35 * bump_mm * bumps;
}

Vec3 BumpyBall::surface_point(const Vec3& direction) const noexcept {
  const Vec3 up = normalized(direction);
  Vec3 point = radius_mm * up;
  // Along the ray the distance's slope is 1 give or take the bumps' 0.5: each step halves what is
  // left at least.
  for (int i = 0; i < 30; ++i) point -= distance(point) * up;
  return point;
}

double voxel_for(double vertices) noexcept {
  assert(vertices > 0.0);
  return kBallMm * std::sqrt(4.0 * std::numbers::pi * kVerticesPerSquareVoxel / vertices);
}

Result<Clay> clay_of(const BumpyBall& ball, double voxel_mm) {
  const double half = ball.radius_mm + 2.0 * ball.bump_mm + 2.0 * voxel_mm;
  ClayOptions options;
  options.voxel_mm = voxel_mm;
  return Clay::from_distance([ball](const Vec3& p) { return ball.distance(p); },
                             {{-half, -half, -half}, {half, half, half}}, options);
}

int squares_for(double vertices) noexcept {
  return static_cast<int>(std::lround(std::sqrt((vertices - 2.0) / 6.0)));
}

QuadBall quad_ball(const BumpyBall& ball, int squares) {
  assert(squares > 0 && squares <= 1290);
  QuadBallMaker maker(ball, squares);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    maker.add_face(axis, false);
    maker.add_face(axis, true);
  }
  return maker.take();
}

TriangleMesh triangles_of(const std::vector<std::int32_t>& quads,
                          const std::vector<Vec3>& positions) {
  assert(quads.size() % 4 == 0);
  TriangleMesh mesh;
  mesh.positions = positions;
  mesh.triangles.reserve(quads.size() / 2);
  for (std::size_t at = 0; at < quads.size(); at += 4) {
    const auto corner = [&](std::size_t i) { return static_cast<std::uint32_t>(quads[at + i]); };
    mesh.triangles.push_back({corner(0), corner(1), corner(2)});
    mesh.triangles.push_back({corner(0), corner(2), corner(3)});
  }
  return mesh;
}

}  // namespace argil::evaluation
