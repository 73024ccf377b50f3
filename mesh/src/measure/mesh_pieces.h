// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "argil/core/triangle_mesh.h"
#include "argil/mesh/triangle_geometry.h"

namespace argil::mesh {

/// The triangles of a mesh, long ones in pieces: boxes around pieces are small, and threads share
/// them. Triangles that repeat another are left out: a place with hundreds of them would be asked
/// hundreds of times about hundreds.
class MeshPieces {
 public:
  /// Keeps a reference to `mesh`. Pieces are at most `longest_mm` long, or as long as leaves no
  /// more than `most` of them.
  MeshPieces(const TriangleMesh& mesh, double longest_mm, double most);

  /// Whole triangles first, in their order.
  std::size_t count() const noexcept { return whole_count_ + pieces_.size(); }
  std::uint32_t triangle(std::size_t n) const noexcept {
    if (whole_.empty() && pieces_.empty()) return static_cast<std::uint32_t>(n);
    return n < whole_count_ ? whole_[n] : pieces_[n - whole_count_].triangle;
  }
  Corners corners(std::size_t n) const noexcept {
    return n < whole_count_ ? corners_of(mesh_, triangle(n)) : pieces_[n - whole_count_].corners;
  }
  std::size_t whole_count() const noexcept { return whole_count_; }
  const TriangleMesh& mesh() const noexcept { return mesh_; }

 private:
  struct Piece {
    std::uint32_t triangle;
    Corners corners;
  };

  const TriangleMesh& mesh_;
  std::size_t whole_count_ = 0;
  std::vector<std::uint32_t> whole_;  ///< empty where all are
  std::vector<Piece> pieces_;
};

/// `step_mm`, or as much more as leaves about `most` parts of the mesh's long triangles.
double step_for(const TriangleMesh& mesh, double step_mm, double most);

}  // namespace argil::mesh
