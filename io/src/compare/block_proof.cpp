// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/block_proof.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "argil/mesh/triangle_geometry.h"

namespace argil::io {
namespace {

/// Of the bound: pieces so small are not cut any more.
constexpr double kLeastPiece = 0.02;

}  // namespace

BlockProof::BlockProof(ExtractedSurface& surface, double bound_mm, const Pace& pace)
    : surface_(surface),
      bound_mm_(bound_mm),
      voxel_mm_(surface.voxel_mm()),
      samplers_(surface.clay()),
      slopes_(voxel_mm_) {
  assert(bound_mm > 0.0);
  surface.prepare(pace.part(0.0, 0.9));
  sheets_.emplace(surface.mesh(), surface.cells(), voxel_mm_, pace.part(0.9, 1.0));
}

class BlockProof::CellQuestion {
 public:
  CellQuestion(const BlockProof& proof, std::uint32_t cell, mesh::NearTriangles& mesh)
      : proof_(proof),
        cell_(cell),
        low_mm_(proof.surface_.cells()[cell].low_mm(proof.voxel_mm_)),
        side_mm_(proof.surface_.cells()[cell].side_mm(proof.voxel_mm_)),
        phi_(proof.surface_.cells()[cell].corners),
        mesh_(mesh) {}

  /// Of the box from `low` to `low + side`, as fractions of the cell.
  bool is_near(const Vec3& low, double side) const {
    if (!may_have_zero(low, side)) return true;
    const double half = 0.5 * side;
    const Vec3 at = low_mm_ + side_mm_ * (low + Vec3{half, half, half});
    const double reach = std::numbers::sqrt3 * half * side_mm_;
    const double bound = proof_.bound_mm_;
    double distance = mesh_.distance_mm(at, bound - reach);
    if (distance + reach <= bound) return true;
    const bool is_least = reach <= kLeastPiece * bound;
    // Where all of the box seems to lie beyond, a wider search tells.
    if (is_least || distance - reach > bound) {
      distance = mesh_.distance_far_mm(at, bound - reach);
      if (distance + reach <= bound) return true;
      if (is_least || distance - reach > bound) return is_left_out(low, side);
    }
    for (int octant = 0; octant < 8; ++octant) {
      const Vec3 shift{half * (octant >> 2), half * (octant >> 1 & 1), half * (octant & 1)};
      if (!is_near(low + shift, half)) return false;
    }
    return true;
  }

 private:
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
  Vec3 low_mm_;
  double side_mm_;
  Trilinear phi_;
  mesh::NearTriangles& mesh_;
};

bool BlockProof::is_near(std::uint32_t cell, mesh::NearTriangles& mesh) const {
  return CellQuestion(*this, cell, mesh).is_near({}, 1.0);
}

namespace {

/// Asks for one triangle after another.
class TriangleQuestion {
 public:
  TriangleQuestion(double bound_mm, double voxel_mm, FieldSampler& field, BlockSlopes& slopes)
      : bound_mm_(bound_mm), voxel_mm_(voxel_mm), field_(field), slopes_(slopes) {}

  bool is_near(const mesh::Corners& c) {
    const double side = mesh::longest_side(c);
    if (side <= kWidest * voxel_mm_) {
      const Vec3 at = mesh::middle(c);
      const FieldValue value = field_.value(at);
      // Its own middle beyond: then no smaller piece there is near.
      if (std::abs(value.distance_mm) > bound_mm_) return false;
      const Piece piece = piece_of(c);
      const Slopes slopes = slopes_in(piece);
      if (is_near_by(slopes, c, at, value)) return true;
      const bool is_mixed = slopes.level == Slopes::kMixed;
      if (is_mixed && side <= kWidestMixed * voxel_mm_ && is_near_across(piece, c, at, value)) {
        return true;
      }
      if (side <= voxel_mm_ && is_near_by_corners(piece)) return true;
      if (side <= kLeastPiece * bound_mm_) return false;
    }
    mesh::Corners m;
    for (std::size_t k = 0; k < 3; ++k) m[k] = 0.5 * (c[k] + c[(k + 1) % 3]);
    if (!is_near(m)) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      if (!is_near({c[k], m[k], m[(k + 2) % 3]})) return false;
    }
    return true;
  }

 private:
  static constexpr double kWidest = 6.0;       ///< piece that is asked, in voxels
  static constexpr double kWidestMixed = 2.5;  ///< where levels meet: cell by cell

  /// What a piece of a triangle lies in.
  struct Piece {
    Box3 box;
    CellIndex first;  ///< cell of level 0
    CellIndex last;
  };

  Piece piece_of(const mesh::Corners& c) const {
    Piece piece;
    for (const Vec3& corner : c) piece.box.include(corner);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      piece.first[axis] = static_cast<int>(std::floor(piece.box.min[axis] / voxel_mm_));
      piece.last[axis] = static_cast<int>(std::floor(piece.box.max[axis] / voxel_mm_));
    }
    return piece;
  }

  /// Mostly of a block that was asked for shortly before.
  const Slopes& slopes_of(const CellIndex& block) {
    const auto low = [&](std::size_t axis) { return static_cast<unsigned>(block[axis]) % 8U; };
    Recent& recent = recent_[64U * low(0) + 8U * low(1) + low(2)];
    if (recent.slopes == nullptr || recent.block != block) {
      recent = {block, &slopes_.of(block, field_)};
    }
    return *recent.slopes;
  }

  Slopes slopes_in(const Piece& piece) {
    const CellIndex first = BlockSlopes::block_of(piece.first);
    Slopes all = slopes_of(first);
    for_each_index(first, BlockSlopes::block_of(piece.last),
                   [&](const CellIndex& block) { all.include(slopes_of(block)); });
    return all;
  }

  /// Where phi is of one level it is continuous: no farther from a linear function than slopes that
  /// are not that function's take it.
  bool is_near_by(const Slopes& slopes, const mesh::Corners& c, const Vec3& at,
                  const FieldValue& value) const {
    if (slopes.level == Slopes::kMixed) return false;
    const auto spread = [&](std::size_t axis) {
      return std::max(slopes.range.max[axis] - value.gradient[axis],
                      value.gradient[axis] - slopes.range.min[axis]);
    };
    const Vec3 spreads{spread(0), spread(1), spread(2)};
    double most = 0.0;
    double more = 0.0;
    for (const Vec3& corner : c) {
      const Vec3 offset = corner - at;
      most = std::max(most, std::abs(value.distance_mm + dot(value.gradient, offset)));
      more = std::max(more, std::abs(offset.x) * spreads.x + std::abs(offset.y) * spreads.y +
                                std::abs(offset.z) * spreads.z);
    }
    return most + more <= bound_mm_;
  }

  /// How far phi at most is from a linear function, whatever the levels of the cells: as far as at
  /// corners of the parts of cells in the box, since their difference is linear along each axis.
  bool is_near_across(const Piece& piece, const mesh::Corners& c, const Vec3& at,
                      const FieldValue& value) {
    const auto linear = [&](const Vec3& p) {
      return value.distance_mm + dot(value.gradient, p - at);
    };
    double most = 0.0;
    for (const Vec3& corner : c) most = std::max(most, std::abs(linear(corner)));
    const double enough = bound_mm_ - most;
    return enough > 0.0 && for_each_part_corner(piece, [&](const Vec3& p, double phi) {
             return std::abs(phi - linear(p)) <= enough;
           });
  }

  /// In a box phi is greatest and least at its corners, since it is linear along each axis.
  bool is_near_by_corners(const Piece& piece) {
    return for_each_part_corner(
        piece, [&](const Vec3&, double phi) { return std::abs(phi) <= bound_mm_; });
  }

  /// Calls `is_good(p, phi)` for the corners of the parts of cells that lie in the box, until it
  /// says no; whether it never did.
  template <class IsGood>
  bool for_each_part_corner(const Piece& piece, const IsGood& is_good) {
    bool all_good = true;
    for_each_index(piece.first, piece.last, [&](const CellIndex& index) {
      if (!all_good) return;
      const Vec3 middle = middle_of_cell(index, voxel_mm_);
      const FieldCell cell = field_.cell_at(middle);
      const auto within = [&](const Vec3& p) {
        Vec3 in = p;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const double half = 0.5 * voxel_mm_;
          in[axis] = std::clamp(p[axis], middle[axis] - half, middle[axis] + half);
        }
        return in;
      };
      const Trilinear phi(cell.corners);
      const Vec3 low = within(piece.box.min);
      const Vec3 high = within(piece.box.max);
      for (int corner = 0; corner < 8 && all_good; ++corner) {
        const Vec3 p{(corner & 4) != 0 ? high.x : low.x, (corner & 2) != 0 ? high.y : low.y,
                     (corner & 1) != 0 ? high.z : low.z};
        all_good = is_good(p, phi.value(cell.fraction + cell.per_mm * (p - middle)));
      }
    });
    return all_good;
  }

  double bound_mm_;
  double voxel_mm_;
  FieldSampler& field_;
  BlockSlopes& slopes_;
  struct Recent {
    CellIndex block{};
    const Slopes* slopes = nullptr;
  };
  std::array<Recent, 512> recent_{};
};

}  // namespace

void BlockProof::ask_triangles(std::span<const mesh::Corners> triangles,
                               std::span<std::uint8_t> is_near) const {
  assert(triangles.size() == is_near.size());
  SamplerPool::Lent lent(samplers_);
  TriangleQuestion question(bound_mm_, voxel_mm_, lent.sampler(), slopes_);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    is_near[t] = question.is_near(triangles[t]) ? 1 : 0;
  }
}

}  // namespace argil::io
