// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "argil/mesh/decimate.h"

#include "decimate/collapse_mesh.h"

namespace argil::mesh {

/// Looks for near triangles of a mesh from the one found last, from neighbour to neighbour.
class TriangleWalk final : public NearTriangles {
 public:
  /// `mesh` must outlive this, and stay as it is.
  explicit TriangleWalk(const CollapseMesh& mesh) : mesh_(mesh) {}

  /// Begins at a triangle around a vertex, which must be there.
  void begin(std::uint32_t vertex);
  /// Begins at the triangle found last.
  void go_on() { relied_on_.clear(); }
  /// A vertex of the triangle found last.
  std::uint32_t vertex() const noexcept { return mesh_.from(at_); }
  HalfEdge triangle() const noexcept { return at_; }  ///< one of its half-edges
  /// A half-edge of each triangle that was found near enough since the search began.
  const std::vector<HalfEdge>& relied_on() const noexcept { return relied_on_; }

  double distance_mm(const Vec3& point_mm, double enough_mm) override;
  double distance_far_mm(const Vec3& point_mm, double enough_mm) override;
  bool covers(const SurfacePiece& piece, double bound_mm) override;

 private:
  /// The triangle `of` and the planes through it and its sides; made when they are asked for.
  struct Planes {
    HalfEdge of = CollapseMesh::kGone;
    Vec3 normal;
    std::array<Vec3, 3> corners;
    std::array<Vec3, 3> inward;    ///< of unit length, normal to the side from each corner
    std::array<double, 3> wide{};  ///< of these, the sums of their components' sizes
  };

  void look_at_planes();
  double distance_of(const Vec3& point, HalfEdge h) const noexcept;
  bool look_at(const Vec3& point, HalfEdge h) noexcept;
  bool look_across(const Vec3& point) noexcept;
  bool look_around(const Vec3& point) noexcept;
  void rely();

  const CollapseMesh& mesh_;
  HalfEdge at_ = 0;
  double least_ = 0.0;
  std::vector<HalfEdge> relied_on_;
  std::vector<HalfEdge> reached_;
  Planes planes_;
};

/// Looks on several sheets at once, from a triangle of each.
class SheetWalks final : public NearTriangles {
 public:
  /// `mesh` must outlive this, and stay as it is.
  explicit SheetWalks(const CollapseMesh& mesh) : mesh_(mesh) {}

  /// Begins at a vertex of each sheet, which must be there: first at `vertex`.
  void begin(std::uint32_t vertex);
  void begin_also(std::uint32_t vertex);
  /// Begins at the triangle found last on the first sheet alone; false where there is none.
  bool go_on();
  const CollapseMesh& mesh() const noexcept { return mesh_; }
  /// Of the sheets in the order in which they were begun; there is one at least.
  std::span<const TriangleWalk> walks() const noexcept { return {walks_.data(), count_}; }

  double distance_mm(const Vec3& point_mm, double enough_mm) override;
  double distance_far_mm(const Vec3& point_mm, double enough_mm) override;
  bool covers(const SurfacePiece& piece, double bound_mm) override;

 private:
  const CollapseMesh& mesh_;
  std::vector<TriangleWalk> walks_;  ///< with their memory
  std::size_t count_ = 0;
};

}  // namespace argil::mesh
