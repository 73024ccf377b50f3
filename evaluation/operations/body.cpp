// SPDX-License-Identifier: GPL-3.0-or-later
// The bodies that operations are measured on: meshes by formula, so that the chart needs no file
// and every method gets the same.
#include "operations/body.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <unordered_map>
#include <utility>

#include "argil/engine/mesh_distance.h"

#include "scene/scene.h"

namespace argil::evaluation {
namespace {

/// Of a surface askew to the lattice, whether vertices lie one a cell or one a cut edge.
constexpr double kVerticesPerSquareVoxel = 1.5;

using Lattice = std::array<int, 3>;  // a node of the surface of a box of squares

/// A mesh of the surface of a box of squares, its nodes put where `place` says.
class BoxOfSquares {
 public:
  BoxOfSquares(const Lattice& squares, std::function<Vec3(const Lattice&)> place)
      : squares_(squares), place_(std::move(place)) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      add_face(axis, 0);
      add_face(axis, squares_[axis]);
    }
  }
  TriangleMesh take() { return std::move(mesh_); }

 private:
  void add_face(std::size_t axis, int at) {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    Lattice low{};
    low[axis] = at;
    for (low[u] = 0; low[u] < squares_[u]; ++low[u]) {
      for (low[v] = 0; low[v] < squares_[v]; ++low[v]) {
        Lattice high = low;
        ++high[u];
        ++high[v];
        Lattice beside = low;
        ++beside[u];
        Lattice above = low;
        ++above[v];
        if (at == 0) std::swap(beside, above);  // so that both face outward
        const std::array corners{node(low), node(beside), node(high), node(above)};
        mesh_.triangles.push_back({corners[0], corners[1], corners[2]});
        mesh_.triangles.push_back({corners[0], corners[2], corners[3]});
      }
    }
  }

  std::uint32_t node(const Lattice& at) {
    constexpr int kBits = 21;
    const auto key = static_cast<std::uint64_t>(at[0]) << (2 * kBits) |
                     static_cast<std::uint64_t>(at[1]) << kBits | static_cast<std::uint64_t>(at[2]);
    const auto number = static_cast<std::uint32_t>(mesh_.positions.size());
    const auto [found, is_new] = numbers_.try_emplace(key, number);
    if (is_new) mesh_.positions.push_back(place_(at));
    return found->second;
  }

  Lattice squares_;
  std::function<Vec3(const Lattice&)> place_;
  TriangleMesh mesh_;
  std::unordered_map<std::uint64_t, std::uint32_t> numbers_;
};

/// From -1 to 1 along each axis.
Vec3 within_box(const Lattice& at, const Lattice& squares) {
  Vec3 p;
  for (std::size_t a = 0; a < 3; ++a) p[a] = 2.0 * at[a] / squares[a] - 1.0;
  return p;
}

}  // namespace

Distance distance_to(std::shared_ptr<const TriangleMesh> mesh) {
  auto nearest = std::make_shared<const MeshDistance>(mesh->positions, mesh->triangles);
  return [mesh = std::move(mesh), nearest = std::move(nearest)](const Vec3& p) {
    thread_local std::uint32_t hint = kNoTriangle;
    if (hint >= mesh->triangles.size()) hint = kNoTriangle;  // of another mesh
    const auto found = nearest->closest(p, std::numeric_limits<double>::infinity(), hint);
    hint = found.triangle;
    return found.distance;
  };
}

WorkedBody wavy_body(double million) {
  constexpr double kHeightMm = 0.75 * kVoxelMm;  // of a crest above the ball, and of a trough below
  constexpr double kTurn = 2.0 * std::numbers::pi / (24.0 * kVoxelMm);
  assert(million > 0.0);
  const double vertices = 1e6 * million;
  const double radius =
      kVoxelMm * std::sqrt(vertices / kVerticesPerSquareVoxel / (4.0 * std::numbers::pi));
  // Off the lattice, so that no symmetry of the body is one of the lattice as well.
  const Vec3 center = kVoxelMm * Vec3{0.137, 0.291, 0.423};
  const auto radius_along = [=](const Vec3& direction) {
    const Vec3 p = kTurn * radius * direction;
    return radius + kHeightMm * std::sin(p.x) * std::sin(p.y) * std::sin(p.z);
  };
  const int side = std::max(4, static_cast<int>(std::lround(std::sqrt(vertices / 6.0))));
  const Lattice squares{side, side, side};
  const auto place = [&](const Lattice& at) {
    Vec3 p = within_box(at, squares);
    // Even angles rather than even steps: squares of nearly one size.
    for (std::size_t a = 0; a < 3; ++a) p[a] = std::tan(0.25 * std::numbers::pi * p[a]);
    const Vec3 direction = normalized(p);
    return center + radius_along(direction) * direction;
  };
  auto mesh = std::make_shared<const TriangleMesh>(BoxOfSquares(squares, place).take());
  return {"wavy ball", million, mesh, [=, unsigned_mm = distance_to(mesh)](const Vec3& p) {
            const Vec3 from = p - center;
            return std::copysign(unsigned_mm(p), length(from) - radius_along(normalized(from)));
          }};
}

WorkedBody block_body(double million) {
  assert(million > 0.0);
  const Vec3 sides{1.5, 4.0 / 3.0, 1.0};
  const double unit_area = 2.0 * (sides.x * sides.y + sides.y * sides.z + sides.z * sides.x);
  const double voxels = std::sqrt(1e6 * million / kVerticesPerSquareVoxel / unit_area);
  const Vec3 half = 0.5 * kVoxelMm * voxels * sides;
  const Quat by = normalized(Quat{0.9, 0.3, 0.25, 0.2});
  // As many vertices as the lattice has: squares of its length over the root of 1.5.
  const double across = voxels * std::sqrt(kVerticesPerSquareVoxel);
  Lattice squares{};
  for (std::size_t a = 0; a < 3; ++a) {
    squares[a] = std::max(2, static_cast<int>(std::lround(across * sides[a])));
  }
  const auto place = [&](const Lattice& at) {
    const Vec3 p = within_box(at, squares);
    return rotate(by, {half.x * p.x, half.y * p.y, half.z * p.z});
  };
  auto mesh = std::make_shared<const TriangleMesh>(BoxOfSquares(squares, place).take());
  return {"turned block", million, std::move(mesh), turned(by, box(half, 0.0))};
}

Placement copy_placement(const WorkedBody& body) {
  const Vec3 size = bounds(*body.mesh).size();
  const double reach = 0.35 * std::min({size.x, size.y, size.z});
  return {reach * normalized(Vec3{1.0, 0.7, 0.4}), normalized(Quat{1.0, 0.2, 0.1, 0.3})};
}

TriangleMesh placed(const TriangleMesh& mesh, const Placement& placement) {
  TriangleMesh moved;
  moved.triangles = mesh.triangles;
  moved.positions.reserve(mesh.positions.size());
  for (const Vec3& p : mesh.positions) {
    moved.positions.push_back(placement.position_mm + rotate(placement.orientation, p));
  }
  return moved;
}

Distance placed(Distance distance, const Placement& placement) {
  const Quat back = conjugate(placement.orientation);
  return [=, distance = std::move(distance)](const Vec3& p) {
    return distance(rotate(back, p - placement.position_mm));
  };
}

}  // namespace argil::evaluation
