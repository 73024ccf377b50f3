// SPDX-License-Identifier: GPL-3.0-or-later
// A ray goes from region to region (a leaf, or the octant of one that no finer leaf covers), then
// from cell to cell. Along a line the trilinear field of a cell is a cubic, whose zeros lie between
// its turns and are bisected.
#include "raycast/field_ray.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "field/sampling.h"

namespace argil {
namespace {

/// How well a zero is known, in voxels of level 0.
constexpr double kZeroWidth = 1e-10;

double at_corner(const std::array<float, 8>& v, std::size_t corner) noexcept {
  return static_cast<double>(v[corner]);
}

/// k[0] + k[1] s + k[2] s^2 + k[3] s^3.
struct Cubic {
  std::array<double, 4> k{};

  double at(double s) const noexcept { return ((k[3] * s + k[2]) * s + k[1]) * s + k[0]; }

  /// The s in (0, end) where the slope is zero, in order; returns how many.
  std::size_t turns(double end, std::array<double, 3>& out) const noexcept {
    const double a = 3.0 * k[3];
    const double b = k[2];  // half the middle coefficient
    const double c = k[1];
    const double root = b * b - a * c;
    if (!(root >= 0.0)) return 0;
    // The sum that does not cancel, then the other root by their product.
    const double q = -(b + (b < 0.0 ? -std::sqrt(root) : std::sqrt(root)));
    std::array<double, 2> both{q != 0.0 ? c / q : end, a != 0.0 ? q / a : end};
    if (both[0] > both[1]) std::swap(both[0], both[1]);
    std::size_t count = 0;
    for (const double s : both) {
      if (s > 0.0 && s < end) out[count++] = s;
    }
    return count;
  }

  /// The zero in a bracket with a change of sign to inside (< 0) or to outside, from before it.
  double zero_between(double before, double behind, bool is_inside_behind) const noexcept {
    assert(before <= behind);
    while (behind - before > kZeroWidth) {
      const double middle = 0.5 * (before + behind);
      ((at(middle) < 0.0) == is_inside_behind ? behind : before) = middle;
    }
    return before;
  }
};

/// The trilinear values of a cell along the line from `u` (0 to 1 each) in steps of `du`.
Cubic along_line(const std::array<float, 8>& v, const Vec3& u, const Vec3& du) noexcept {
  const double x = at_corner(v, 4) - at_corner(v, 0);
  const double y = at_corner(v, 2) - at_corner(v, 0);
  const double z = at_corner(v, 1) - at_corner(v, 0);
  const double xy = at_corner(v, 6) - at_corner(v, 4) - y;
  const double yz = at_corner(v, 3) - at_corner(v, 2) - z;
  const double xz = at_corner(v, 5) - at_corner(v, 4) - z;
  const double xyz = at_corner(v, 7) - at_corner(v, 6) - (at_corner(v, 5) - at_corner(v, 4)) - yz;
  const double slope_x = x + xy * u.y + xz * u.z + xyz * u.y * u.z;
  const double slope_y = y + xy * u.x + yz * u.z + xyz * u.x * u.z;
  const double slope_z = z + yz * u.y + xz * u.x + xyz * u.x * u.y;
  Cubic f;
  f.k[0] = at_corner(v, 0) + u.x * x + u.y * (y + xy * u.x) +
           u.z * (z + yz * u.y + xz * u.x + xyz * u.x * u.y);
  f.k[1] = slope_x * du.x + slope_y * du.y + slope_z * du.z;
  f.k[2] = (xy + xyz * u.z) * du.x * du.y + (yz + xyz * u.x) * du.y * du.z +
           (xz + xyz * u.y) * du.x * du.z;
  f.k[3] = xyz * du.x * du.y * du.z;
  return f;
}

/// The box of the coarsest leaves: beyond is air. Nothing without any.
std::optional<CellBox> extent_of(const LevelStack& stack) {
  openvdb::CoordBBox nodes;
  if (!stack.grid(stack.top()).tree().evalLeafBoundingBox(nodes)) return std::nullopt;
  return CellBox{nodes.min() << stack.top(), nodes.max().offsetBy(1) << stack.top()};
}

/// A ray that looks for the surface on its path through the levels.
class Search {
 public:
  enum class Side : std::uint8_t { unknown, outside, inside };

  /// Looks for where the ray comes from the other side to the side `wanted`.
  Search(const LevelStack& stack, const RayWalk& walk, Side wanted)
      : stack_(stack), cells_(stack), walk_(walk), wanted_(wanted) {
    // Beyond the coarsest leaves all is air.
    if (walk_.along() > 0.0) side_ = Side::outside;
  }

  std::optional<FieldEntry> run(const CellBox& extent) {
    while (extent.contains(walk_.cell())) {
      const int level = cells_.finest_level(walk_.cell());
      const auto entry = level < 0 ? pass_constant() : pass_region(level);
      if (entry) return entry;
    }
    return std::nullopt;
  }

 private:
  /// Says on which side the ray is now. True when that is the wanted one and it was on the other.
  bool arrives(bool inside) noexcept {
    const Side before = side_;
    side_ = inside ? Side::inside : Side::outside;
    return side_ == wanted_ && before != Side::unknown && before != wanted_;
  }

  /// A coarsest leaf that is not stored: all clay or all air.
  std::optional<FieldEntry> pass_constant() {
    const int top = stack_.top();
    const Coord origin = leaf_origin(walk_.cell() >> top);
    if (arrives(stack_.sample(top, origin) < 0.0F)) return FieldEntry{walk_.along(), top};
    const CellBox box = CellBox::cube(origin << top, kLeafSide << top);
    walk_.leave(box, walk_.exit_of(box));
    return std::nullopt;
  }

  /// The cells around that no finer leaf covers: of an octant, or of a leaf of the finest level.
  std::optional<FieldEntry> pass_region(int level) {
    const int side = level == 0 ? kLeafSide : (kLeafSide / 2) << level;
    const CellBox region = CellBox::cube(walk_.cell() & ~(side - 1), side);
    cells_.open(level, walk_.cell());
    while (region.contains(walk_.cell())) {
      const Coord cell = walk_.cell() >> level;
      const CellBox box = CellBox::cube(cell << level, 1 << level);
      const RayWalk::Exit exit = walk_.exit_of(box);
      if (const auto on = arrival_in_cell(cell, level, exit.along - walk_.along())) {
        return FieldEntry{walk_.along() + *on, level};
      }
      walk_.leave(box, exit);
    }
    return std::nullopt;
  }

  /// How much further on the ray arrives, if it does within `length`, its path in the cell.
  std::optional<double> arrival_in_cell(const Coord& cell, int level, double length) {
    assert(length >= 0.0);
    const std::array<float, 8> v = cells_.corners(cell);
    const auto inside = std::count_if(v.begin(), v.end(), [](float f) { return f < 0.0F; });
    if (inside == 0 || inside == 8) {
      if (arrives(inside != 0)) return 0.0;
      return std::nullopt;
    }
    const double scale = std::ldexp(1.0, -level);
    const Vec3 p = walk_.point() * scale;
    const Vec3 u{std::clamp(p.x - cell.x(), 0.0, 1.0), std::clamp(p.y - cell.y(), 0.0, 1.0),
                 std::clamp(p.z - cell.z(), 0.0, 1.0)};
    const Cubic f = along_line(v, u, walk_.step() * scale);
    if (arrives(f.at(0.0) < 0.0)) return 0.0;
    // Between its turns the cubic has at most one zero.
    std::array<double, 3> ends{};
    const std::size_t turns = f.turns(length, ends);
    ends[turns] = length;
    double from = 0.0;
    for (std::size_t i = 0; i <= turns; ++i) {
      if (arrives(f.at(ends[i]) < 0.0)) {
        return f.zero_between(from, ends[i], wanted_ == Side::inside);
      }
      from = ends[i];
    }
    return std::nullopt;
  }

  const LevelStack& stack_;
  LeafCells cells_;
  RayWalk walk_;
  Side wanted_;
  Side side_ = Side::unknown;
};

/// The part that looking in and looking out have in common.
std::optional<FieldEntry> first_arrival(const LevelStack& stack,
                                        const std::optional<CellBox>& extent, RayWalk walk,
                                        Search::Side wanted) {
  if (!extent || !walk.enter(*extent)) return std::nullopt;
  return Search(stack, walk, wanted).run(*extent);
}

}  // namespace

LeafCells::LeafCells(const LevelStack& stack) : stack_(stack) {
  finders_.reserve(static_cast<std::size_t>(stack.count()));
  for (int level = 0; level < stack.count(); ++level) finders_.emplace_back(stack, level);
}

int LeafCells::finest_level(const Coord& cell) {
  if (region_side_ == 0 || (cell & ~(region_side_ - 1)) != region_low_) {
    region_level_ = look_up_level(cell);
    // An octant of a leaf is refined as a whole or not at all, and so is what no level has.
    const int level = region_level_ < 0 ? stack_.top() : region_level_;
    region_side_ = region_level_ > 0 ? (kLeafSide / 2) << level : kLeafSide << level;
    region_low_ = cell & ~(region_side_ - 1);
  }
  return region_level_;
}

/// Up or down from the level that was found last, since levels are nested.
int LeafCells::look_up_level(const Coord& cell) {
  int level = std::max(region_level_, 0);
  const auto has = [&](int of) { return leaf(of, cell >> of) != nullptr; };
  if (has(level)) {
    while (level > 0 && has(level - 1)) --level;
    return level;
  }
  do {
    if (++level > stack_.top()) return -1;
  } while (!has(level));
  return level;
}

void LeafCells::open(int level, const Coord& cell) {
  const Coord origin = leaf_origin(cell >> level);
  if (level == level_ && origin == leaf_origin_) return;
  level_ = level;
  leaf_origin_ = origin;
  leaves_known_ = 0;
  finer_ = finer_known_ = 0;
}

/// Of the leaf that has this node; null where the level has none there.
const float* LeafCells::values_beyond(const Coord& relative) {
  const Coord beyond = relative >> 3;
  const auto at = static_cast<std::size_t>(beyond.x() << 2 | beyond.y() << 1 | beyond.z());
  assert(at < leaves_.size());
  if ((leaves_known_ >> at & 1U) == 0) {
    const VdbLeaf* found = leaf(level_, leaf_origin_ + relative);
    leaves_[at] = found != nullptr ? values_of(*found) : nullptr;
    leaves_known_ = static_cast<std::uint8_t>(leaves_known_ | 1U << at);
  }
  return leaves_[at];
}

struct LeafCells::Found {
  LeafCells& cells;

  int top() const noexcept { return cells.stack_.top(); }
  const float* values(int level, const Coord& node) const {
    return cells.finders_[static_cast<std::size_t>(level)].values(node);
  }
  float constant(const Coord& node) const { return cells.stack_.grid(top()).tree().getValue(node); }
};

float LeafCells::stored(const Coord& relative) {
  const float* const values = values_beyond(relative);
  if (values != nullptr) return values[leaf_offset(relative)];
  return sample_of(Found{*this}, level_, leaf_origin_ + relative);
}

/// Whether a finer level has the octant with this node.
bool LeafCells::is_finer(const Coord& relative) {
  if (level_ == 0) return false;
  const Coord octant = relative >> 2;
  const auto bit = 1U << static_cast<unsigned>((octant.x() * 3 + octant.y()) * 3 + octant.z());
  if ((finer_known_ & bit) == 0) {
    finer_known_ |= bit;
    if (leaf(level_ - 1, (leaf_origin_ + relative) << 1) != nullptr) finer_ |= bit;
  }
  return (finer_ & bit) != 0;
}

float LeafCells::value(const Coord& relative) {
  if (!is_finer(relative)) return stored(relative);
  const Coord node = leaf_origin_ + relative;
  int finest = level_ - 1;
  while (finest > 0 && leaf(finest - 1, node << (level_ - finest + 1)) != nullptr) --finest;
  const Coord fine = node << (level_ - finest);
  return values_of(*leaf(finest, fine))[leaf_offset(fine)];
}

std::array<float, 8> LeafCells::corners(const Coord& cell) {
  const Coord low = cell - leaf_origin_;
  std::array<float, 8> v;
  // Within the leaf, or where a finer level may have some of it within the octant.
  const int last = level_ == 0 ? kLeafSide - 1 : kLeafSide / 2 - 1;
  const bool is_inner =
      (low.x() & last) != last && (low.y() & last) != last && (low.z() & last) != last;
  if (is_inner) {
    const float* const at = values_beyond(low) + leaf_offset(low);
    for (int corner = 0; corner < 8; ++corner) {
      v[static_cast<std::size_t>(corner)] =
          at[(corner >> 2) * 64 + (corner >> 1 & 1) * 8 + (corner & 1)];
    }
    return v;
  }
  for (int corner = 0; corner < 8; ++corner) {
    v[static_cast<std::size_t>(corner)] =
        value(low.offsetBy(corner >> 2, corner >> 1 & 1, corner & 1));
  }
  return v;
}

void LeafCells::octant(const Coord& low, std::array<float, 125>& values) {
  constexpr int kHalf = kLeafSide / 2;
  const Coord first = low - leaf_origin_;
  assert((first & (kHalf - 1)) == Coord(0, 0, 0));
  // The octant itself and the sides, edges and corner of the seven behind it.
  for (int part = 0; part < 8; ++part) {
    const Coord from(kHalf * (part >> 2), kHalf * (part >> 1 & 1), kHalf * (part & 1));
    const auto end = [](int begin) { return begin == 0 ? kHalf : kHalf + 1; };
    const float* const at =
        part == 0 || !is_finer(first + from) ? values_beyond(first + from) : nullptr;
    for (int i = from.x(); i < end(from.x()); ++i) {
      for (int j = from.y(); j < end(from.y()); ++j) {
        float* const to = &values[static_cast<std::size_t>(25 * i + 5 * j)];
        if (at != nullptr) {
          std::copy(at + leaf_offset(first.offsetBy(i, j, from.z())),
                    at + leaf_offset(first.offsetBy(i, j, from.z())) + (end(from.z()) - from.z()),
                    to + from.z());
          continue;
        }
        for (int k = from.z(); k < end(from.z()); ++k) to[k] = value(first.offsetBy(i, j, k));
      }
    }
  }
}

std::optional<FieldEntry> first_entry(const LevelStack& stack, const Vec3& origin,
                                      const Vec3& direction) {
  assert(is_finite(origin) && is_unit(direction));
  return first_arrival(stack, extent_of(stack), RayWalk(origin, direction), Search::Side::inside);
}

FieldExits::FieldExits(const LevelStack& stack) : stack_(stack), extent_(extent_of(stack)) {}

std::optional<FieldEntry> FieldExits::first(const Vec3& origin, const Vec3& direction) const {
  assert(is_finite(origin) && is_unit(direction));
  return first_arrival(stack_, extent_, RayWalk(origin, direction), Search::Side::outside);
}

}  // namespace argil
