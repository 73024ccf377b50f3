// SPDX-License-Identifier: GPL-3.0-or-later
// A leaf's signs from the lattice's winding numbers, then walls: few nodes have reason to doubt
// that the triangle nearest to them is the surface.
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "import/import_field.h"
#include "rows/rows.h"

namespace argil {
namespace {

// How far beyond the nearest point of the triangles the other side is looked for, in voxels: what
// is thinner counts as one surface with both its sides outside.
constexpr double kBeyondVoxels = 0.05;
// At an edge or corner of the input a step beyond may miss a sharp solid. Then both faces of the
// nearest triangle are looked at, this far in from its edge and this far off it.
constexpr double kFromEdgeVoxels = 0.2;
constexpr double kOffFaceVoxels = 0.01;
// A node nearer to a triangle lies on it, which is outside: floats tell no less.
constexpr double kOnTriangleVoxels = 2e-6;
// Of open input a node is clear when w is as near to a whole number: w turns by a quarter over a
// right angle at a straight open edge, so that the edge is then nearer than the membrane.
constexpr double kClear = 0.25;

// What open_fraction() is exact to, twice.
constexpr double kExactTurns = 2e-3;

openvdb::Index32 bit_of(std::size_t node) { return static_cast<openvdb::Index32>(node); }

using RowBits = std::array<std::uint8_t, kLeafRows>;

/// The sides of a leaf's own nodes.
RowBits own_sides(const SidesAround& sides) {
  RowBits own;
  for (std::size_t row = 0; row < own.size(); ++row) {
    const std::size_t at = SidesAround::kSide * (row / kLeafSide + 1) + row % kLeafSide + 1;
    own[row] = static_cast<std::uint8_t>(sides.inside[at] >> 1);
  }
  return own;
}

/// The nodes around which all 26 others that are `known` lie on their side.
RowBits alone_on_their_side(const SidesAround& sides, const SidesAround& known) {
  constexpr std::size_t kSide = SidesAround::kSide;
  // Whether some, and whether all, of three rows along y are inside; then of three planes.
  std::array<unsigned, kSide * kLeafSide> some;
  std::array<unsigned, kSide * kLeafSide> all;
  const auto spread = [](unsigned bits) { return bits | bits << 1 | bits >> 1; };
  for (std::size_t i = 0; i < kSide; ++i) {
    for (std::size_t j = 0; j < kLeafSide; ++j) {
      unsigned inside = 0;
      unsigned outside = 0;
      for (std::size_t n = kSide * i + j; n < kSide * i + j + 3; ++n) {
        inside |= sides.inside[n] & known.inside[n];
        outside |= ~static_cast<unsigned>(sides.inside[n]) & known.inside[n];
      }
      some[kLeafSide * i + j] = spread(inside);
      all[kLeafSide * i + j] = spread(outside);
    }
  }
  RowBits alone;
  for (std::size_t row = 0; row < alone.size(); ++row) {
    const unsigned inside = some[row] | some[row + kLeafSide] | some[row + 2 * kLeafSide];
    const unsigned outside = all[row] | all[row + kLeafSide] | all[row + 2 * kLeafSide];
    alone[row] = static_cast<std::uint8_t>(~(inside & outside) >> 1);
  }
  return alone;
}

const SidesAround& all_known() {
  static const SidesAround known = [] {
    SidesAround bits;
    bits.inside.fill((1U << SidesAround::kSide) - 1);
    return bits;
  }();
  return known;
}

/// A leaf's own nodes only.
const SidesAround& own_known() {
  static const SidesAround known = [] {
    constexpr std::size_t kSide = SidesAround::kSide;
    SidesAround bits;
    for (std::size_t n = 0; n < bits.inside.size(); ++n) {
      const std::size_t i = n / kSide;
      const std::size_t j = n % kSide;
      const bool is_own = i > 0 && j > 0 && i < kSide - 1 && j < kSide - 1;
      bits.inside[n] = is_own ? 0xff << 1 : 0;
    }
    return bits;
  }();
  return known;
}

/// Sides by w where open edges count, told for cubes of nodes at once as far as w changes little
/// over them.
class SidesNearGaps {
 public:
  SidesNearGaps(const ImportSampler& sampler, const Coord& origin, const float* squares,
                ImportLeaf& leaf)
      : sampler_(sampler), first_(sampler.position(origin)), squares_(squares), leaf_(leaf) {
    sides_.inside.fill(0);
    sampler.lattice().numbers(origin, numbers_);
    tell({0, 0, 0}, kLeafSide);
  }
  const SidesAround& sides() const noexcept { return sides_; }

 private:
  Vec3 place(const Coord& low, double beyond) const noexcept {
    const double h = sampler_.voxel();
    return first_ + Vec3{low.x() + beyond, low.y() + beyond, low.z() + beyond} * h;
  }

  void tell(const Coord& low, int side) {
    const double half = 0.5 * (side - 1);
    const Vec3 middle = place(low, half);
    const double fraction = sampler_.open_fraction(middle);
    if (side == 1) {
      const double w = number(low) - fraction;
      set(low, w > 0.5);
      if (w > kClear && w < 1.0 - kClear) bridge(low);
      return;
    }
    constexpr double kSqrt3 = 1.7320508075688773;
    const double change =
        kExactTurns + sampler_.most_change(middle, half * kSqrt3 * sampler_.voxel());
    const double above = std::ceil(fraction) - fraction;  // of w above a whole number
    if (above + change <= kClear || above - change >= 1.0 - kClear) {
      const openvdb::CoordBBox cube(low, low.offsetBy(side - 1));
      for (const Coord& node : cube) set(node, number(node) - fraction > 0.5);
      return;
    }
    if (side > 2 && sampler_.has_many_gaps() && corners_tell(low, side)) return;
    const int part = side / 2;
    for (int n = 0; n < 8; ++n) {
      tell(low.offsetBy(part * (n >> 2), part * (n >> 1 & 1), part * (n & 1)), part);
    }
  }

  /// Where gaps are all over, no bound of the change is of use. But w is harmonic where no triangle
  /// is, so that it is not far from what it is at the corners.
  bool corners_tell(const Coord& low, int side) {
    // Of the corners around any point in a cell one is nearer than that.
    constexpr float kNearestCorner = 0.75F;  // squared, in voxels
    const openvdb::CoordBBox cube(low, low.offsetBy(side - 1));
    for (const Coord& node : cube) {
      if (squares_[leaf_offset(node)] <= kNearestCorner) return false;
    }
    int inside = 0;
    for (int n = 0; n < 8; ++n) {
      const Coord corner =
          low.offsetBy((side - 1) * (n >> 2), (side - 1) * (n >> 1 & 1), (side - 1) * (n & 1));
      const double w = number(corner) - sampler_.open_fraction(place(corner, 0.0));
      if (w > kClear && w < 1.0 - kClear) return false;
      inside += w > 0.5 ? 1 : 0;
    }
    if (inside != 0 && inside != 8) return false;
    for (const Coord& node : cube) set(node, inside == 8);
    return true;
  }

  double number(const Coord& node) const noexcept {
    return numbers_[static_cast<std::size_t>(leaf_offset(node))];
  }
  void set(const Coord& node, bool is_inside) noexcept {
    if (!is_inside) return;
    const int row = SidesAround::kSide * (node.x() + 1) + node.y() + 1;
    sides_.inside[static_cast<std::size_t>(row)] |= static_cast<std::uint16_t>(2U << node.z());
  }
  void bridge(const Coord& node) noexcept {
    ++leaf_.bridged;
    leaf_.unknown.setOn(static_cast<openvdb::Index32>(leaf_offset(node)));
  }

  const ImportSampler& sampler_;
  Vec3 first_;
  const float* squares_;  ///< of distances from triangles, in voxels
  ImportLeaf& leaf_;
  std::array<std::int32_t, kLeafNodes> numbers_;
  SidesAround sides_;
};

/// Whether the two faces of a triangle, near a point on it, lie on different sides of the solid.
bool faces_differ(const ImportSampler& sampler, const Vec3& point, std::uint32_t triangle) {
  assert(triangle != kNoTriangle);
  const ImportInput& input = sampler.input();
  const Triangle& t = input.triangles[triangle];
  const Vec3& a = input.positions[t[0]];
  const Vec3& b = input.positions[t[1]];
  const Vec3& c = input.positions[t[2]];
  const Vec3 inward = (a + b + c) / 3.0 - point;
  const double fraction = std::min(0.5, kFromEdgeVoxels * sampler.voxel() / length(inward));
  const Vec3 from = length(inward) > 0.0 ? point + inward * fraction : point;
  const Vec3 off = normalized(cross(b - a, c - a)) * (kOffFaceVoxels * sampler.voxel());
  return sampler.inside(from + off) != sampler.inside(from - off);
}

/// Whether the nearest triangle of a node is the surface: the other side lies behind it.
bool is_surface(const ImportSampler& sampler, const Vec3& node, bool is_inside,
                const MeshDistance::Closest& nearest) {
  if (nearest.distance > kOnTriangleVoxels * sampler.voxel()) {
    const double step = kBeyondVoxels * sampler.voxel() / nearest.distance;
    if (sampler.inside(nearest.point + (nearest.point - node) * step) != is_inside) return true;
  }
  return faces_differ(sampler, nearest.point, nearest.triangle);
}

/// A node whose nearest triangle is a wall: nothing is known of its distance. One on the wall had
/// no side yet: any point beside it has the right one.
void doubt(const ImportSampler& sampler, std::size_t node, const Vec3& nearest, ImportLeaf& leaf) {
  float& value = leaf.leaf->buffer().data()[node];
  bool is_inside = value < 0.0F;
  if (value == 0.0F) {
    const double e = kBeyondVoxels * sampler.voxel();
    is_inside = sampler.inside(nearest + Vec3{e, e, e});
  }
  const auto band = static_cast<float>(sampler.band());
  value = is_inside ? -band : band;
  leaf.unknown.setOn(bit_of(node));
  leaf.wall = true;
  leaf.doubtful = true;
}

}  // namespace

ImportLeaf signed_leaf(const ImportSampler& sampler, const Coord& origin, const float* squares) {
  assert(is_leaf_origin(origin));
  const auto band = static_cast<float>(sampler.band());
  ImportLeaf made;
  made.leaf = std::make_unique<VdbLeaf>(origin, band, false);
  SidesAround sides;
  const bool is_clear = sampler.is_clear(origin);
  if (is_clear) {
    sampler.lattice().sides_around(origin, sides);
  } else {
    sides = SidesNearGaps(sampler, origin, squares, made).sides();
  }
  const RowBits inside = own_sides(sides);
  float* values = made.leaf->buffer().data();
  row_loops().sign_distances(squares, inside.data(), static_cast<float>(sampler.voxel()), band,
                             static_cast<float>(kOnTriangleVoxels), values);
  const RowBits alone = alone_on_their_side(sides, is_clear ? all_known() : own_known());
  for (std::size_t n = 0; n < kLeafNodes; ++n) {
    constexpr auto kFar = static_cast<float>(kHalfWidthVoxels * kHalfWidthVoxels);
    if (!(squares[n] < kFar)) {
      made.unknown.setOn(bit_of(n));
    } else if (squares[n] < 1.0F && (alone[n / 8] >> n % 8 & 1) != 0) {
      made.suspicious.setOn(bit_of(n));
    }
  }
  return made;
}

ImportLeaf leaf_of_gap(const ImportSampler& sampler, const Coord& origin) {
  std::array<float, kLeafNodes> squares;
  squares.fill(static_cast<float>(kHalfWidthVoxels * kHalfWidthVoxels));
  return signed_leaf(sampler, origin, squares.data());
}

/// Sides are read before any changes: suspicion was told by them.
void ask_walls(const ImportSampler& sampler, const Coord& origin, ImportLeaf& leaf) {
  const auto band = static_cast<float>(sampler.band());
  const float* values = leaf.leaf->buffer().data();
  std::uint32_t hint = kNoTriangle;
  for (std::size_t n = 0; n < kLeafNodes; ++n) {
    const bool is_unknown = leaf.unknown.isOn(bit_of(n));
    if (!(is_unknown ? std::abs(values[n]) < band : leaf.suspicious.isOn(bit_of(n)))) continue;
    const Vec3 place = sampler.position(node_of(origin, n));
    const auto nearest = sampler.distance().closest(place, 1.001 * sampler.band(), hint);
    hint = nearest.triangle;
    if (!is_surface(sampler, place, values[n] < 0.0F, nearest)) {
      doubt(sampler, n, nearest.point, leaf);
    } else if (is_unknown) {
      leaf.doubtful = true;
    }
  }
  leaf.suspicious.setOff();
}

void suspect_all(ImportLeaf& leaf) {
  leaf.suspicious = leaf.unknown;
  leaf.suspicious.toggle();
}

}  // namespace argil
