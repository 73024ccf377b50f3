// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/block_proof.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "compare/triangle_question.h"

namespace argil::io {
namespace {

/// Of the bound: pieces so small are not cut any more.
constexpr double kLeastPiece = 0.02;

}  // namespace

BlockProof::BlockProof(ExtractedSurface& surface, double bound_mm, const Pace& pace)
    : surface_(surface),
      bound_mm_(bound_mm),
      voxel_mm_(surface.voxel_mm()),
      samplers_(surface.clay()) {
  assert(bound_mm > 0.0);
  surface.prepare(pace.part(0.0, 0.9));
  sheets_.emplace(surface.mesh(), surface.cells(), voxel_mm_, pace.part(0.9, 1.0));
}

class BlockProof::CellQuestion {
 public:
  /// `looks_far` also where no triangle in sight is near enough.
  CellQuestion(const BlockProof& proof, std::uint32_t cell, mesh::NearTriangles& mesh,
               bool looks_far)
      : proof_(proof),
        cell_(cell),
        looks_far_(looks_far),
        low_mm_(proof.surface_.cells()[cell].low_mm(proof.voxel_mm_)),
        side_mm_(proof.surface_.cells()[cell].side_mm(proof.voxel_mm_)),
        phi_(proof.surface_.cells()[cell].corners),
        mesh_(mesh) {}

  /// Of the box from `low` to `low + side`, as fractions of the cell.
  bool is_near(const Vec3& low, double side) const {
    if (side < 1.0 && !may_have_zero(low, side)) return true;
    const double half = 0.5 * side;
    const Vec3 at = low_mm_ + side_mm_ * (low + Vec3{half, half, half});
    const double reach = std::numbers::sqrt3 * half * side_mm_;
    const double bound = proof_.bound_mm_;
    const mesh::SurfacePiece piece = piece_of(low, side);
    if (mesh_.covers(piece, bound)) return true;
    // The search notes the triangle that it relies on by this very comparison.
    const double enough = bound - reach;
    double distance = mesh_.distance_mm(at, enough);
    if (distance <= enough || mesh_.covers(piece, bound)) return true;
    const bool is_least = reach <= kLeastPiece * bound;
    // Where all of the box seems to lie beyond, a wider search tells.
    if (is_least || distance - reach > bound) {
      if (!looks_far_) return false;
      distance = mesh_.distance_far_mm(at, enough);
      if (distance <= enough) return true;
      if (is_least || distance - reach > bound) return is_left_out(low, side);
    }
    for (int octant = 0; octant < 8; ++octant) {
      const Vec3 shift{half * (octant >> 2), half * (octant >> 1 & 1), half * (octant & 1)};
      if (!is_near(low + shift, half)) return false;
    }
    return true;
  }

 private:
  /// phi about the middle of the box, as fractions u of the cell from there, is linear but for
  /// u.x u.y (cxy + z cxyz), the like for other axes and u.x u.y u.z cxyz.
  mesh::SurfacePiece piece_of(const Vec3& low, double side) const {
    const double half = 0.5 * side;
    const Vec3 at = low + Vec3{half, half, half};
    const double across = std::abs(phi_.cxy + at.z * phi_.cxyz) +
                          std::abs(phi_.cxz + at.y * phi_.cxyz) +
                          std::abs(phi_.cyz + at.x * phi_.cxyz);
    mesh::SurfacePiece piece;
    piece.middle_mm = low_mm_ + side_mm_ * at;
    piece.half_side_mm = half * side_mm_;
    piece.phi_mm = phi_.value(at);
    piece.gradient = phi_.slope(at) / side_mm_;
    piece.bend_mm = half * half * (across + half * std::abs(phi_.cxyz)) + phi_.rounding();
    return piece;
  }

  bool may_have_zero(const Vec3& low, double side) const {
    bool is_inside = false;
    bool is_outside = false;
    const double rounding = phi_.rounding();
    for (int corner = 0; corner < 8; ++corner) {
      const double value = phi_.value(
          low + side * Vec3{1.0 * (corner >> 2), 1.0 * (corner >> 1 & 1), 1.0 * (corner & 1)});
      is_inside = is_inside || value <= rounding;
      is_outside = is_outside || value >= -rounding;
    }
    return is_inside && is_outside;
  }

  bool is_left_out(const Vec3& low, double side) const {
    return proof_.surface_.is_left_out(cell_, low, side);
  }

  const BlockProof& proof_;
  std::uint32_t cell_;
  bool looks_far_;
  Vec3 low_mm_;
  double side_mm_;
  Trilinear phi_;
  mesh::NearTriangles& mesh_;
};

bool BlockProof::is_near(std::uint32_t cell, mesh::NearTriangles& mesh) const {
  return CellQuestion(*this, cell, mesh, true).is_near({}, 1.0);
}

bool BlockProof::is_near_at_once(std::uint32_t cell, mesh::NearTriangles& mesh) const {
  return CellQuestion(*this, cell, mesh, false).is_near({}, 1.0);
}

void BlockProof::ask_triangles(std::span<const mesh::Corners> triangles,
                               std::span<std::uint8_t> is_near) const {
  assert(triangles.size() == is_near.size());
  SamplerPool::Lent lent(samplers_);
  TriangleQuestion question(bound_mm_, voxel_mm_, lent.sampler());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    is_near[t] = question.is_near(triangles[t]) ? 1 : 0;
  }
}

}  // namespace argil::io
