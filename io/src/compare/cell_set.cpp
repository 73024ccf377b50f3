// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/cell_set.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include "argil/engine/field_sampler.h"
#include "argil/mesh/triangle_geometry.h"

#include "compare/distance_sums.h"
#include "compare/surface_cells.h"

namespace argil::io {
namespace {

/// The level and place of a cell in one number, as the extracted surface numbers its edges.
using CellKey = std::uint64_t;
constexpr int kPlaceBits = 19;
constexpr int kMostPlace = 1 << (kPlaceBits - 1);
constexpr CellKey kPlaceMask = (CellKey{1} << kPlaceBits) - 1;

CellKey key_of(const PlacedCell& cell) {
  CellKey key = static_cast<CellKey>(cell.field.level);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double cells = cell.field.per_mm * cell.low_mm[axis];  // whole, but for rounding
    assert(cells > -kMostPlace - 0.5 && cells < kMostPlace - 0.5);
    const auto place = static_cast<int>(cells + std::copysign(0.5, cells));
    key = key << kPlaceBits | (static_cast<CellKey>(place + kMostPlace) & kPlaceMask);
  }
  return key;
}

/// Any bits of this are spread evenly, and no two keys share it.
std::uint64_t spread(CellKey key) noexcept { return key * 0x9E3779B97F4A7C15U; }

/// Triangles in a cell, or the nearest one beside it.
struct CellRun {
  CellKey key = 0;
  std::uint32_t first = 0;
  std::uint32_t count = 1;
  float distance = 0.0F;  ///< from the cell, in sides

  bool is_before(const CellRun& other) const noexcept { return spread(key) < spread(other.key); }

  /// Becomes the better of both, which are of one cell and in the order of their triangles: where
  /// most triangles follow one another, with at most a few of other cells between them.
  void join(const CellRun& behind) noexcept {
    constexpr std::uint32_t kMostBetween = 4;
    constexpr std::uint32_t kMostCount = std::numeric_limits<std::uint16_t>::max();
    if (behind.distance != distance) {
      if (behind.distance < distance) *this = behind;
      return;
    }
    if (distance > 0.0F) return;
    const std::uint32_t end = first + count;
    const std::uint32_t joined = behind.first + behind.count - first;
    if (behind.first >= end && behind.first - end <= kMostBetween && joined <= kMostCount) {
      count = joined;
    } else if (behind.count >= count) {
      *this = behind;
    }
  }
};

/// The cells of one block of triangles.
class BlockCells {
 public:
  BlockCells() : slots_(kSlots, kNothing) {}

  void add(const PlacedCell& cell, std::uint32_t triangle, double distance) {
    const CellRun run{key_of(cell), triangle, 1, static_cast<float>(distance)};
    std::size_t at = spread(run.key) >> (64 - kSlotBits);
    while (slots_[at] != kNothing && runs_[slots_[at]].key != run.key) at = (at + 1) % kSlots;
    if (slots_[at] != kNothing) return runs_[slots_[at]].join(run);
    slots_[at] = static_cast<std::uint32_t>(runs_.size());
    runs_.push_back(run);
  }
  std::vector<CellRun> sorted() && {
    std::sort(runs_.begin(), runs_.end(),
              [](const CellRun& a, const CellRun& b) { return a.is_before(b); });
    runs_.shrink_to_fit();
    return std::move(runs_);
  }

 private:
  /// A triangle has its own cell and at most seven beside it.
  static constexpr int kSlotBits = 15;
  static constexpr std::size_t kSlots = std::size_t{1} << kSlotBits;
  static_assert(8 * kDistanceBlock < kSlots);
  static constexpr std::uint32_t kNothing = 0xffffffff;
  std::vector<std::uint32_t> slots_;
  std::vector<CellRun> runs_;
};

std::vector<CellRun> runs_of_block(const TriangleMesh& surface, const Clay& clay, std::size_t begin,
                                   std::size_t end) {
  const double voxel_mm = clay.options().voxel_mm;
  FieldSampler field(clay);
  BlockCells cells;
  for (std::size_t t = begin; t < end; ++t) {
    const Vec3 at = inward_of(mesh::corners_of(surface, t), voxel_mm);
    const PlacedCell own = placed_cell_at(at, field);
    if (own.side_mm == 0.0) continue;
    const auto triangle = static_cast<std::uint32_t>(t);
    if (is_crossed(own.field)) cells.add(own, triangle, 0.0);
    for_each_crossed_beside(at, own, field, [&](const PlacedCell& cell, double distance) {
      cells.add(cell, triangle, distance);
    });
  }
  return std::move(cells).sorted();
}

constexpr int kShareBits = 8;
constexpr std::size_t kShares = std::size_t{1} << kShareBits;

/// Of all blocks the cells of one share of the keys, each once.
std::vector<CellRun> joined_share(const std::vector<std::vector<CellRun>>& blocks,
                                  std::size_t share) {
  const auto share_of = [](const CellRun& run) { return spread(run.key) >> (64 - kShareBits); };
  std::vector<CellRun> all;
  for (const std::vector<CellRun>& block : blocks) {
    const auto begin = std::partition_point(
        block.begin(), block.end(), [&](const CellRun& run) { return share_of(run) < share; });
    const auto end = std::partition_point(
        begin, block.end(), [&](const CellRun& run) { return share_of(run) == share; });
    all.insert(all.end(), begin, end);
  }
  // Stable: of one cell those of the first block come first.
  std::stable_sort(all.begin(), all.end(),
                   [](const CellRun& a, const CellRun& b) { return a.is_before(b); });
  std::size_t count = 0;
  for (const CellRun& run : all) {
    if (count > 0 && all[count - 1].key == run.key) {
      all[count - 1].join(run);
    } else {
      all[count++] = run;
    }
  }
  all.resize(count);
  return all;
}

/// Each cell once, in the order of their triangles.
std::vector<CellRun> joined(const std::vector<std::vector<CellRun>>& blocks, const Pace& pace) {
  std::vector<std::vector<CellRun>> shares(kShares);
  constexpr std::size_t kBetweenReports = 16;
  for (std::size_t first = 0; first < kShares; first += kBetweenReports) {
    pace.at(static_cast<double>(first) / static_cast<double>(kShares));
    tbb::parallel_for(first, first + kBetweenReports,
                      [&](std::size_t share) { shares[share] = joined_share(blocks, share); });
  }
  std::vector<CellRun> all;
  for (std::vector<CellRun>& share : shares) {
    all.insert(all.end(), share.begin(), share.end());
    share = {};
  }
  tbb::parallel_sort(all.begin(), all.end(), [](const CellRun& a, const CellRun& b) {
    return a.first != b.first ? a.first < b.first : a.key < b.key;
  });
  return all;
}

SurfaceCell cell_of(const CellRun& run, double voxel_mm, FieldSampler& field) {
  SurfaceCell cell;
  CellKey key = run.key;
  for (std::size_t axis = 3; axis-- > 0; key >>= kPlaceBits) {
    cell.low[axis] = static_cast<std::int32_t>(key & kPlaceMask) - kMostPlace;
  }
  cell.level = static_cast<std::int8_t>(key);
  cell.first = run.first;
  cell.count = static_cast<std::uint16_t>(run.count);
  cell.is_empty = run.distance > 0.0F;
  const double half = 0.5 * cell.side_mm(voxel_mm);
  const FieldCell found = field.cell_at(cell.low_mm(voxel_mm) + Vec3{half, half, half});
  assert(found.level == cell.level && is_crossed(found));
  cell.corners = found.corners;
  return cell;
}

}  // namespace

bool has_all_vertices(const SurfaceCell& cell, const TriangleMesh& surface) {
  if (cell.is_empty) return false;
  int cut_edges = 0;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    for (const std::size_t step : {4U, 2U, 1U}) {
      if ((corner & step) != 0) continue;
      cut_edges += (cell.corners[corner] < 0.0F) != (cell.corners[corner | step] < 0.0F) ? 1 : 0;
    }
  }
  std::array<std::uint32_t, 12> met{};
  int vertices = 0;
  for (std::uint32_t t = cell.first; t < cell.first + cell.count; ++t) {
    for (const std::uint32_t v : surface.triangles[t]) {
      if (vertices == cut_edges) return true;
      const auto end = met.begin() + vertices;
      if (std::find(met.begin(), end, v) == end) met[static_cast<std::size_t>(vertices++)] = v;
    }
  }
  return vertices == cut_edges;
}

std::vector<SurfaceCell> surface_cells(const TriangleMesh& surface, const Clay& clay,
                                       const Pace& pace) {
  std::vector<std::vector<CellRun>> blocks(block_count(surface.triangles.size()));
  in_blocks(surface.triangles.size(), pace.part(0.0, 0.7), [&](std::size_t begin, std::size_t end) {
    blocks[begin / kDistanceBlock] = runs_of_block(surface, clay, begin, end);
  });
  const std::vector<CellRun> runs = joined(blocks, pace.part(0.7, 0.8));
  blocks = {};
  std::vector<SurfaceCell> cells(runs.size());
  in_blocks(runs.size(), pace.part(0.8, 1.0), [&](std::size_t begin, std::size_t end) {
    FieldSampler field(clay);
    for (std::size_t c = begin; c < end; ++c) {
      cells[c] = cell_of(runs[c], clay.options().voxel_mm, field);
    }
  });
  return cells;
}

}  // namespace argil::io
