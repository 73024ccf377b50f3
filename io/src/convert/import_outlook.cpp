// SPDX-License-Identifier: GPL-3.0-or-later
// A level may be left out where its surface would miss the true one by less than the tolerance.
// With voxels of size H the surface is made of chords about H long, and a chord misses an arc by
// (turn) H / 8. The turn of a surface within a cell of side H is the sum of angle times length over
// the edges of the mesh there, divided by H, whether that is one sharp edge or a hundred blunt
// ones: so the sum over 8 is the error. Sums of small cells give those of large ones, and convex
// and concave edges, as of a scanner's noise, cancel.
#include "argil/io/import_outlook.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <utility>

#include "argil/core/pace.h"
#include "argil/mesh/edges.h"
#include "argil/mesh/point_welder.h"
#include "argil/mesh/triangle_geometry.h"

#include "convert/surface_samples.h"

namespace argil::io {
namespace {

constexpr double kFinestCells = 512.0;     // along the longest side
constexpr double kMostSamples = 2e6;       // of the surface
constexpr double kMostSamplesAlong = 2e7;  // where triangles are thin
constexpr std::size_t kMostKept = 4'000'000;
constexpr int kCellsOfALeaf = 2;            // 4 along each side: two halvings of Morton's order
constexpr double kVerticesPerSquare = 1.5;  // edges of a lattice that a plane cuts, on average
constexpr double kLeavesPerSquare = 2.25;   // of their own face: as measured, with the band
constexpr double kBytesPerLeaf = 2144.0;
// Of the nodes above leaves in a tree 5-4-3: sides in voxels, and bytes.
constexpr double kLowerVoxels = 128.0;
constexpr double kLowerBytes = 34.1e3;
constexpr double kUpperVoxels = 4096.0;
constexpr double kUpperBytes = 270.4e3;
// Fitted to the shared models from 128 to 700 voxels along them. Leaves that a chord's error asks
// for hold that much more of the surface than their own part, since their neighbours on the surface
// come with them.
constexpr double kErrorOfTurn = 1.2 / 8.0;
constexpr double kWithNeighbours = 1.2;

constexpr double kBandVoxels = 4.0;
constexpr double kLeastAcross = 16.0;  // voxels of the coarsest level along the longest side

constexpr double square(double x) { return x * x; }

/// What lies in one cell of space.
struct Cell {
  std::uint64_t key = 0;  ///< Morton's: that of the cell twice as large is key >> 3
  double turn = 0.0;      ///< sum of angle times length, convex edges positive
  double area = 0.0;
};

std::uint64_t spread(std::uint64_t bits) {
  assert(bits < (1U << 21));
  bits = (bits | bits << 32) & 0x1f00000000ffffU;
  bits = (bits | bits << 16) & 0x1f0000ff0000ffU;
  bits = (bits | bits << 8) & 0x100f00f00f00f00fU;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3U;
  return (bits | bits << 2) & 0x1249249249249249U;
}

/// Unit, or zero of what has no area.
Vec3 normal_of(const TriangleMesh& mesh, std::size_t triangle) {
  return normalized(mesh::area_normal(mesh::corners_of(mesh, triangle)));
}

/// Collects samples as cells.
class CellGrid {
 public:
  CellGrid(const Vec3& low, double cell) : low_(low), cell_(cell) {}

  void add(const Vec3& at, double turn, double area) {
    const auto index = [&](double x) {
      return spread(static_cast<std::uint64_t>(std::clamp(x / cell_, 0.0, 2e6)));
    };
    const Vec3 from = at - low_;
    const std::uint64_t key = index(from.x) << 2 | index(from.y) << 1 | index(from.z);
    if (!cells_.empty() && cells_.back().key == key) {
      cells_.back().turn += turn;
      cells_.back().area += area;
      return;
    }
    cells_.push_back({key, turn, area});
    if (cells_.size() <= most_kept_) return;
    join();
    // As many again before the next, so that all joins together cost little more than the last.
    most_kept_ = std::max(kMostKept, 2 * cells_.size());
  }

  /// Cells, each once, in the order of their keys.
  std::vector<Cell> take() {
    join();
    return std::move(cells_);
  }

 private:
  void join() {
    std::sort(cells_.begin(), cells_.end(),
              [](const Cell& a, const Cell& b) { return a.key < b.key; });
    std::size_t kept = 0;
    for (std::size_t n = 0; n < cells_.size(); ++n) {
      if (kept > 0 && cells_[kept - 1].key == cells_[n].key) {
        cells_[kept - 1].turn += cells_[n].turn;
        cells_[kept - 1].area += cells_[n].area;
      } else {
        cells_[kept++] = cells_[n];
      }
    }
    cells_.resize(kept);
  }

  Vec3 low_;
  double cell_;
  std::size_t most_kept_ = kMostKept;
  std::vector<Cell> cells_;
};

/// Without what has no area; the corners where the positions are, so that seams of a file do not
/// matter.
TriangleMesh welded(const TriangleMesh& mesh, const Pace& pace) {
  TriangleMesh out;
  mesh::PointWelder welder(out.positions);
  std::vector<std::uint32_t> names;
  names.reserve(mesh.positions.size());
  for (const Vec3& p : mesh.positions) names.push_back(welder.add(p));
  pace.at(0.5);
  out.triangles.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    out.triangles.push_back({names[t[0]], names[t[1]], names[t[2]]});
    if (normal_of(out, out.triangles.size() - 1) == Vec3{}) out.triangles.pop_back();
  }
  return out;
}

/// The turn across an edge between two triangles, along its length.
void add_turn(const TriangleMesh& mesh, const mesh::EdgeTable& edges, mesh::HalfEdge a,
              mesh::HalfEdge b, double cell, CellGrid& grid) {
  const Vec3& from = mesh.positions[edges.from(a)];
  const Vec3 along = mesh.positions[edges.to(a)] - from;
  const Vec3 normal = normal_of(mesh, mesh::triangle_of(a));
  const Vec3 other = normal_of(mesh, mesh::triangle_of(b));
  const double angle = std::atan2(length(cross(normal, other)), dot(normal, other));
  const Vec3& apex = mesh.positions[edges.to(mesh::next_in_triangle(b))];
  const double sign = dot(apex - from, normal) < 0.0 ? 1.0 : -1.0;
  const double turn = sign * angle * length(along);
  if (turn == 0.0) return;
  const int n = samples_along(length(along), cell);
  for (int i = 0; i < n; ++i) grid.add(from + ((i + 0.5) / n) * along, turn / n, 0.0);
}

/// Small enough for every detail, unless the surface or its edges are too long for that.
double finest_cell(const TriangleMesh& mesh, double side, double area) {
  double along = 0.0;
  for (const Triangle& t : mesh.triangles) {
    along += mesh::longest_side(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
  }
  return std::max(
      {side / kFinestCells, std::sqrt(8.0 * area / kMostSamples), along / kMostSamplesAlong});
}

/// Some of the steps are told to `pace`, which may end the work there.
template <class Work>
void for_each_paced(std::size_t count, const Pace& pace, const Work& work) {
  constexpr std::size_t kStep = 1024;
  for (std::size_t n = 0; n < count; ++n) {
    if (n % kStep == 0) pace.at(static_cast<double>(n) / static_cast<double>(count));
    work(n);
  }
}

/// What the mesh has in cells of space, in the order of their keys.
std::vector<Cell> cells_of(const TriangleMesh& given, const Vec3& low, double cell,
                           const Pace& pace) {
  CellGrid grid(low, cell);
  const TriangleMesh mesh = welded(given, pace.part(0.0, 0.3));
  for_each_paced(mesh.triangles.size(), pace.part(0.3, 0.6), [&](std::size_t n) {
    for_each_sample(mesh::corners_of(mesh, n), cell,
                    [&](const Vec3& at, double area) { grid.add(at, 0.0, area); });
  });
  const mesh::EdgeTable edges(mesh);
  for_each_paced(edges.size(), pace.part(0.7, 1.0), [&](std::size_t n) {
    const auto uses = edges.uses(n);
    for (std::size_t k = 1; k < uses.size(); ++k) {
      add_turn(mesh, edges, uses[k - 1], uses[k], cell, grid);
    }
  });
  return grid.take();
}

/// Cells twice as large.
std::vector<Cell> doubled(const std::vector<Cell>& cells) {
  std::vector<Cell> large;
  for (const Cell& cell : cells) {
    if (large.empty() || large.back().key != cell.key >> 3) large.push_back({cell.key >> 3});
    large.back().turn += cell.turn;
    large.back().area += cell.area;
  }
  return large;
}

/// What a leaf holds: the turn of its most bent cell, and its area.
struct BentLeaf {
  double turn = 0.0;
  double area = 0.0;
};

/// The leaves of cells in the order of their keys; the most bent first.
std::vector<BentLeaf> leaves_by_bend(const std::vector<Cell>& cells) {
  std::vector<BentLeaf> leaves;
  std::uint64_t last = ~std::uint64_t{0};
  for (const Cell& each : cells) {
    const std::uint64_t leaf = each.key >> (3 * kCellsOfALeaf);
    if (leaf != last) leaves.emplace_back();
    last = leaf;
    leaves.back().turn = std::max(leaves.back().turn, std::abs(each.turn));
    leaves.back().area += each.area;
  }
  std::sort(leaves.begin(), leaves.end(), [](const BentLeaf& a, const BentLeaf& b) {
    return a.turn != b.turn ? a.turn > b.turn : a.area > b.area;
  });
  return leaves;
}

/// Where a sorted list, least last, exceeds a value: how many.
std::size_t count_above(const std::vector<double>& descending, double value) {
  return static_cast<std::size_t>(std::partition_point(descending.begin(), descending.end(),
                                                       [&](double each) { return each > value; }) -
                                  descending.begin());
}

}  // namespace

ImportOutlook::ImportOutlook(const TriangleMesh& mesh, const Progress& progress)
    : area_(surface_area(mesh)) {
  Box3 box;
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) box.include(mesh.positions[v]);
  }
  const Vec3 size = box.size();
  side_ = std::max({size.x, size.y, size.z});
  if (!(side_ > 0.0 && area_ > 0.0)) return;
  low_ = box.min / side_;
  high_ = box.max / side_;
  const double cell = finest_cell(mesh, side_, area_);
  cell_ = cell / side_;
  const Pace pace(progress, "look at the mesh");
  for (std::vector<Cell> cells = cells_of(mesh, box.min, cell, pace); cells.size() > 1;
       cells = doubled(cells)) {
    Leaves& sorted = leaves_.emplace_back();
    double sum = 0.0;
    for (const BentLeaf& leaf : leaves_by_bend(cells)) {
      sorted.bend.push_back(leaf.turn / side_);
      sorted.area.push_back(sum += leaf.area / area_);
    }
  }
}

/// How much of the area lies in leaves, with cells of this side, that are bent by more than that.
double ImportOutlook::bent_fraction(double cell, double bend) const {
  if (leaves_.empty()) return 0.0;
  const auto at = [&](std::size_t n) {
    const std::size_t count = count_above(leaves_[n].bend, bend);
    return count == 0 ? 0.0 : leaves_[n].area[count - 1];
  };
  const double last = static_cast<double>(leaves_.size() - 1);
  const double place = std::clamp(std::log2(cell / cell_), 0.0, last);
  const auto low = static_cast<std::size_t>(place);
  const std::size_t high = std::min(low + 1, leaves_.size() - 1);
  const double t = place - static_cast<double>(low);
  return (1.0 - t) * at(low) + t * at(high);
}

/// Nodes of the upper kind that a level of such voxels has: they part space at the origin.
double ImportOutlook::upper_nodes(double voxel) const {
  const double side = kUpperVoxels * voxel;
  double count = 1.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double low = low_[axis] - kBandVoxels * voxel;
    const double high = high_[axis] + kBandVoxels * voxel;
    count *= std::floor(high / side) - std::floor(low / side) + 1.0;
  }
  return count;
}

ImportOutlook::Cost ImportOutlook::at(double voxels, double tolerance_voxels) const {
  assert(voxels >= 1.0 && tolerance_voxels > 0.0);
  Cost cost;
  if (leaves_.empty()) return cost;
  const double area = area_ / (side_ * side_);
  // The chords of the next level would miss the surface by more than the tolerance.
  const double bend = tolerance_voxels / (voxels * kErrorOfTurn);
  double finer = 0.0;  // how much of the surface finer levels have
  double needed = 0.0;
  bool is_top = false;
  for (double voxel = 1.0 / voxels; !is_top; voxel *= 2.0) {
    is_top = kLeastAcross * voxel > 0.5;
    needed = is_top ? 1.0 : std::max(needed, bent_fraction(2.0 * voxel, bend));
    const double squares = area / (voxel * voxel);
    const double held = std::min(1.0, kWithNeighbours * needed);
    cost.vertices += kVerticesPerSquare * squares * (held - finer);
    finer = held;
    const double upper = upper_nodes(voxel);
    const double lower =
        upper + kLeavesPerSquare * squares * std::min(1.0, 2.5 * needed) / square(kLowerVoxels);
    cost.bytes += kBytesPerLeaf * kLeavesPerSquare * squares * needed / square(8.0) +
                  kUpperBytes * upper + kLowerBytes * lower;
  }
  return cost;
}

}  // namespace argil::io
