// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/left_out_parts.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "argil/engine/field_sampler.h"

#include "compare/distance_sums.h"

namespace argil::io {
namespace {

/// How far a vertex may be from phi = 0 on its edge, in sides of the cell: where phi is not smooth,
/// as where something is less than a voxel, it is 0.02 from the ends at least (docs/surface.md).
constexpr double kAtEdge = 0.03;

/// Points, to be asked for the nearest: halved by a plane across x, y and z in turn, wherever they
/// lie. J. L. Bentley, Multidimensional Binary Search Trees (1975), without pointers.
class PointTree {
 public:
  explicit PointTree(std::vector<Vec3> points) : points_(std::move(points)) {
    halve(0, points_.size(), 0);
  }
  /// How far the nearest is; `reach` where none is nearer.
  double distance(const Vec3& at, double reach) const {
    double least = reach;
    look(0, points_.size(), 0, at, least);
    return least;
  }

 private:
  /// The middle of each range separates its halves.
  static std::size_t middle(std::size_t begin, std::size_t end) {
    return begin + (end - begin) / 2;
  }

  void halve(std::size_t begin, std::size_t end, std::size_t axis) {
    if (end - begin < 2) return;
    const std::size_t at = middle(begin, end);
    const auto place = [&](std::size_t n) {
      return points_.begin() + static_cast<std::ptrdiff_t>(n);
    };
    std::nth_element(place(begin), place(at), place(end),
                     [axis](const Vec3& a, const Vec3& b) { return a[axis] < b[axis]; });
    halve(begin, at, (axis + 1) % 3);
    halve(at + 1, end, (axis + 1) % 3);
  }
  void look(std::size_t begin, std::size_t end, std::size_t axis, const Vec3& at,
            double& least) const {
    if (begin == end) return;
    const std::size_t split = middle(begin, end);
    least = std::min(least, length(points_[split] - at));
    const double beyond = at[axis] - points_[split][axis];
    const std::size_t next = (axis + 1) % 3;
    const auto look_below = [&] { look(begin, split, next, at, least); };
    const auto look_above = [&] { look(split + 1, end, next, at, least); };
    if (beyond < 0.0) {
      look_below();
      if (-beyond < least) look_above();
    } else {
      look_above();
      if (beyond < least) look_below();
    }
  }

  std::vector<Vec3> points_;
};

/// Those of the points that have one of the tree within reach, in their order. Throws Interrupted.
std::vector<Vec3> near(const PointTree& tree, const std::vector<Vec3>& points, double reach,
                       const Pace& pace) {
  std::vector<std::vector<Vec3>> blocks(block_count(points.size()));
  in_blocks(points.size(), pace, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      if (tree.distance(points[n], reach) < reach)
        blocks[begin / kDistanceBlock].push_back(points[n]);
    }
  });
  std::vector<Vec3> found;
  for (const std::vector<Vec3>& block : blocks) {
    found.insert(found.end(), block.begin(), block.end());
  }
  return found;
}

/// Calls `use(p)` with the place of phi = 0 on each edge of a cell that it passes through.
template <class Use>
void for_each_cut_edge(const SurfaceCell& cell, const Use& use) {
  for (std::size_t corner = 0; corner < 8; ++corner) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t step = std::size_t{4} >> axis;
      if ((corner & step) != 0) continue;
      const double a = cell.corners[corner];
      const double b = cell.corners[corner | step];
      if ((a < 0.0) == (b < 0.0)) continue;
      Vec3 p;
      for (std::size_t k = 0; k < 3; ++k) p[k] = (corner & std::size_t{4} >> k) != 0 ? 1.0 : 0.0;
      p[axis] = a / (a - b);
      use(p);
    }
  }
}

constexpr int kBoxes = LeftOutParts::kBoxes;

std::size_t number_of(int i, int j, int k) {
  return static_cast<std::size_t>((i * kBoxes + j) * kBoxes + k);
}
/// The box that a place is in, and the last one that ends there.
int box_of(double fraction) {
  return std::clamp(static_cast<int>(std::floor(kBoxes * fraction)), 0, kBoxes - 1);
}
int box_before(double fraction) {
  return std::clamp(static_cast<int>(std::ceil(kBoxes * fraction)) - 1, 0, kBoxes - 1);
}

}  // namespace

/// The pieces of phi = 0 in one cell.
class LeftOutParts::Pieces {
 public:
  explicit Pieces(const Trilinear& phi);

  const Boxes& all() const noexcept { return crossed_; }
  /// The boxes of the piece that passes through a place on an edge, and of what they touch.
  Boxes at(const Vec3& place) const;

 private:
  template <class Use>
  static void for_each_touching(std::size_t box, const Use& use);

  Boxes crossed_;
};

LeftOutParts::Pieces::Pieces(const Trilinear& phi) {
  constexpr int kNodes = kBoxes + 1;
  const double rounding = phi.rounding();
  // Bit 0: not outside, bit 1: not inside, where rounding may make it either.
  std::array<std::uint8_t, std::size_t{kNodes} * kNodes * kNodes> signs{};
  const auto node = [](int i, int j, int k) {
    return static_cast<std::size_t>((i * kNodes + j) * kNodes + k);
  };
  for (int n = 0; n < kNodes * kNodes * kNodes; ++n) {
    const Vec3 at{1.0 * (n / (kNodes * kNodes)), 1.0 * (n / kNodes % kNodes), 1.0 * (n % kNodes)};
    const double value = phi.value((1.0 / kBoxes) * at);
    signs[static_cast<std::size_t>(n)] =
        static_cast<std::uint8_t>((value <= rounding ? 1 : 0) | (value >= -rounding ? 2 : 0));
  }
  for (int n = 0; n < kBoxes * kBoxes * kBoxes; ++n) {
    const int i = n / (kBoxes * kBoxes);
    const int j = n / kBoxes % kBoxes;
    const int k = n % kBoxes;
    unsigned both = 0;
    for (int corner = 0; corner < 8; ++corner) {
      both |= signs[node(i + (corner >> 2), j + (corner >> 1 & 1), k + (corner & 1))];
    }
    crossed_[static_cast<std::size_t>(n)] = both == 3;
  }
}

/// The boxes that have a corner in common with this one.
template <class Use>
void LeftOutParts::Pieces::for_each_touching(std::size_t box, const Use& use) {
  const int n = static_cast<int>(box);
  const std::array<int, 3> at{n / (kBoxes * kBoxes), n / kBoxes % kBoxes, n % kBoxes};
  const auto low = [&](std::size_t axis) { return std::max(at[axis] - 1, 0); };
  const auto high = [&](std::size_t axis) { return std::min(at[axis] + 1, kBoxes - 1); };
  for (int i = low(0); i <= high(0); ++i) {
    for (int j = low(1); j <= high(1); ++j) {
      for (int k = low(2); k <= high(2); ++k) use(number_of(i, j, k));
    }
  }
}

LeftOutParts::Boxes LeftOutParts::Pieces::at(const Vec3& place) const {
  const std::size_t first = number_of(box_of(place.x), box_of(place.y), box_of(place.z));
  Boxes piece;
  std::vector<std::size_t> open{first};
  piece.set(first);
  while (!open.empty()) {
    const std::size_t box = open.back();
    open.pop_back();
    for_each_touching(box, [&](std::size_t beside) {
      if (!crossed_[beside] || piece[beside]) return;
      piece.set(beside);
      open.push_back(beside);
    });
  }
  return piece & crossed_;
}

LeftOutParts::LeftOutParts(const TriangleMesh& surface, const TriangleMesh& left_out,
                           const std::vector<SurfaceCell>& cells, double voxel_mm,
                           const Pace& pace) {
  const PointTree left_out_vertices(left_out.positions);
  std::int8_t coarsest = 0;
  for (const SurfaceCell& cell : cells) coarsest = std::max(coarsest, cell.level);
  const double widest = 2.0 * kAtEdge * std::ldexp(voxel_mm, coarsest);
  const PointTree kept_vertices(near(left_out_vertices, surface.positions, widest, pace));
  std::vector<std::vector<Mixed>> blocks(block_count(cells.size()));
  in_blocks(cells.size(), pace, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      const SurfaceCell& cell = cells[c];
      const double side = cell.side_mm(voxel_mm);
      const Vec3 low = cell.low_mm(voxel_mm);
      // No edge of the cell is farther from its middle.
      const double far = (0.5 * std::numbers::sqrt3 + kAtEdge) * side;
      const Vec3 half{0.5 * side, 0.5 * side, 0.5 * side};
      if (left_out_vertices.distance(low + half, far) >= far) continue;
      const auto is_left_out = [&](const Vec3& place) {
        const Vec3 at = low + side * place;
        const double distance = left_out_vertices.distance(at, kAtEdge * side);
        return distance < kAtEdge * side && distance < kept_vertices.distance(at, kAtEdge * side);
      };
      Mixed mixed = mixed_in(cell, is_left_out);
      mixed.cell = static_cast<std::uint32_t>(c);
      if (mixed.left_out.any()) blocks[begin / kDistanceBlock].push_back(mixed);
    }
  });
  for (const std::vector<Mixed>& block : blocks) {
    mixed_.insert(mixed_.end(), block.begin(), block.end());
  }
}

/// `is_left_out` says that of the place of phi = 0 on an edge.
template <class IsLeftOut>
LeftOutParts::Mixed LeftOutParts::mixed_in(const SurfaceCell& cell, const IsLeftOut& is_left_out) {
  std::vector<Vec3> left_out;
  std::vector<Vec3> kept;
  for_each_cut_edge(cell, [&](const Vec3& p) { (is_left_out(p) ? left_out : kept).push_back(p); });
  Mixed mixed;
  if (left_out.empty()) return mixed;
  const Pieces pieces{Trilinear(cell.corners)};
  for (const Vec3& p : left_out) mixed.left_out |= pieces.at(p);
  for (const Vec3& p : kept) mixed.left_out &= ~pieces.at(p);
  mixed.kept = pieces.all() & ~mixed.left_out;
  return mixed;
}

bool LeftOutParts::has_all(std::uint32_t cell, const Vec3& low, double side) const {
  assert(side >= 0.0);
  const auto mixed =
      std::lower_bound(mixed_.begin(), mixed_.end(), cell,
                       [](const Mixed& m, std::uint32_t number) { return m.cell < number; });
  if (mixed == mixed_.end() || mixed->cell != cell) return false;
  std::array<int, 3> first{};
  std::array<int, 3> last{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    first[axis] = box_of(low[axis]);
    last[axis] = std::max(first[axis], box_before(low[axis] + side));
  }
  bool has_any = false;
  for (int i = first[0]; i <= last[0]; ++i) {
    for (int j = first[1]; j <= last[1]; ++j) {
      for (int k = first[2]; k <= last[2]; ++k) {
        const std::size_t box = number_of(i, j, k);
        if (mixed->kept[box]) return false;
        has_any = has_any || mixed->left_out[box];
      }
    }
  }
  return has_any;
}

}  // namespace argil::io
