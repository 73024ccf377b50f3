// SPDX-License-Identifier: GPL-3.0-or-later
// The values around one leaf in a dense array, read from leaf buffers in rows. Values that come
// from coarser levels are interpolated only when asked for: most blocks have none.
#include "surface/surface_view.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>

#include "field/row_bits.h"
#include "field/sampling.h"

namespace argil {

namespace {

constexpr float kUnknownValue = std::numeric_limits<float>::quiet_NaN();
constexpr int kBetweenSide = 19;
constexpr std::uint32_t kUnknownRow = ~0U;

// Bits along an octant's row of cells, or along two of them, by bits of the octants along z: from
// one octant before the leaf's to one after them.
constexpr std::array<std::uint8_t, 4> kCellsIn{0x00, 0x0f, 0xf0, 0x00};
constexpr std::array<std::uint8_t, 4> kCellsAt{0x01, 0x1f, 0xf8, 0x80};  // and those beside them
unsigned cells_of(const std::array<std::uint8_t, 4>& cells, unsigned octants) {
  unsigned found = 0;
  for (std::size_t k = 0; k < 4; ++k) found |= (octants >> k & 1U) != 0 ? cells[k] : 0U;
  return found;
}

// Nodes -1 to 17 of the next finer level along each axis.
std::size_t between_index(const Coord& n) {
  return static_cast<std::size_t>(((n.x() + 1) * kBetweenSide + n.y() + 1) * kBetweenSide + n.z() +
                                  1);
}

// Bit k becomes bit 2 k, up to 8.
std::uint32_t spread(std::uint32_t bits) {
  bits = (bits | bits << 8) & 0x00ff00ffU;
  bits = (bits | bits << 4) & 0x0f0f0f0fU;
  bits = (bits | bits << 2) & 0x33333333U;
  return (bits | bits << 1) & 0x55555555U;
}

bool even(const Coord& n) { return ((n.x() | n.y() | n.z()) & 1) == 0; }

}  // namespace

SurfaceView::SurfaceView(const ShownLeaves& leaves) : shown_(leaves) {
  finders_.reserve(static_cast<std::size_t>(stack().count()));
  for (int level = 0; level < stack().count(); ++level) finders_.emplace_back(stack(), level);
  between_.assign(kBetweenSide * kBetweenSide * kBetweenSide, kUnknownValue);
}

void SurfaceView::forget() {
  for (LeafFinder& finder : finders_) finder.forget();
}

const float* SurfaceView::buffer(int level, const Coord& node) {
  const float* found = finders_[static_cast<std::size_t>(level)].values(node);
  return found != nullptr && shown_.shows(level, node) ? found : nullptr;
}

bool SurfaceView::open(int level, const Coord& origin) {
  assert(stack().is_level(level) && is_leaf_origin(origin));
  level_ = level;
  origin_ = origin;
  coarse_known_ = false;
  bool all_refined = false;
  uniform_ = find_octants(all_refined);
  if (all_refined || !buffer(level, origin)) return false;
  depth_ = 0;
  find_neighbours();
  if (!uniform_) {
    find_near_live();
    find_deeper();
    find_stored_sides();
  }
  return true;
}

void SurfaceView::gather(bool border) {
  gather_stored(border);
  if (absent_ != 0) gather_absent();
  if (uniform_) return;
  overlay_octants(border ? -1 : 0, border ? 9 : 8);
  for (const std::size_t n : between_known_) between_[n] = kUnknownValue;
  between_known_.clear();
  between_inside_.fill(kUnknownRow);
}

// What this level stores; the rest unknown.
void SurfaceView::gather_stored(bool border) {
  static const LeafValues unknown = [] {
    LeafValues values;
    values.fill(kUnknownValue);
    return values;
  }();
  std::array<const float*, 27> leaves;
  for (std::size_t n = 0; n < leaves.size(); ++n) {
    leaves[n] = leaves_[n] != nullptr ? leaves_[n] : unknown.data();
  }
  const int low = border ? -1 : 0;
  const int high = border ? 9 : 8;
  for (int x = low; x <= high; ++x) {
    for (int y = low; y <= high; ++y) {
      const float* const* const three = leaves.data() + neighbour(Coord(x, y, -8));
      const int offset = (x & 7) << 6 | (y & 7) << 3;
      float* const row = dense_.data() + index(x, y, 0);
      std::memcpy(row, three[1] + offset, kLeafSide * sizeof(float));
      row[-1] = three[0][offset + 7];
      row[8] = three[2][offset];
      row[9] = three[2][offset + 1];
    }
  }
}

// The nodes 0 to 8 that this level does not store.
void SurfaceView::gather_absent() {
  for (int n = 0; n < 8; ++n) {
    const Coord leaf(n >> 2, n >> 1 & 1, n & 1);
    if (leaves_[static_cast<std::size_t>(neighbour(leaf << 3))] != nullptr) continue;
    const Coord first = leaf << 3;
    const auto last = [&](int axis) { return leaf[axis] == 0 ? 7 : 8; };
    for (int x = first.x(); x <= last(0); ++x) {
      for (int y = first.y(); y <= last(1); ++y) {
        const float* const between = interpolated_row(x, y);
        float* const row = dense_.data() + index(x, y, 0);
        for (int z = first.z(); z <= last(2); ++z) {
          row[z] = between != nullptr ? between[z] : interpolated(Coord(x, y, z));
        }
      }
    }
  }
}

// Only values of octants that share a face, an edge or a corner with a live one are ever asked for.
void SurfaceView::find_near_live() {
  near_live_ = 0;
  for (unsigned o = 0; o < 8; ++o) {
    const unsigned first = (o >> 2) * 16 + (o >> 1 & 1U) * 4 + (o & 1U);
    if (finer_[first + 21] != nullptr) continue;
    for (unsigned plane = 0; plane < 3; ++plane) near_live_ |= 0x777ULL << (first + 16 * plane);
  }
}

// True when none is refined.
bool SurfaceView::find_octants(bool& all_refined) {
  refined_ = 0;
  all_refined = false;
  finer_.fill(nullptr);
  if (level_ == 0) return true;
  LeafFinder& finder = finders_[static_cast<std::size_t>(level_ - 1)];
  const Coord base = (origin_ << 1).offsetBy(-kLeafSide);
  constexpr std::uint64_t kOwn = 0x0000'0660'0660'0000ULL;
  for (std::uint64_t there = finder.leaves_of_64(base); there != 0; there &= there - 1) {
    const auto octant = static_cast<unsigned>(std::countr_zero(there));
    const Coord at = base + (Coord(static_cast<int>(octant >> 4), static_cast<int>(octant >> 2 & 3),
                                   static_cast<int>(octant & 3))
                             << 3);
    finer_[octant] = buffer(level_ - 1, at);
    if (finer_[octant] != nullptr) refined_ |= std::uint64_t{1} << octant;
  }
  all_refined = (refined_ & kOwn) == kOwn;
  return refined_ == 0;
}

void SurfaceView::find_deeper() {
  depth_ = 1;
  deeper_.fill(0);
  if (level_ < 2) return;
  for (std::size_t o = 0; o < 64; ++o) {
    if (!finer_[o] || (near_live_ >> o & 1U) == 0) continue;
    const Coord first(static_cast<int>(o >> 4), static_cast<int>(o >> 2 & 3),
                      static_cast<int>(o & 3));
    const Coord low = first.offsetBy(-1) << 2;
    unsigned there = finers_of_eight(level_ - 2, (origin_ + low) << 2);
    deeper_[o] = static_cast<std::uint8_t>(there);
    for (; there != 0 && depth_ == 1; there &= there - 1) {
      const int e = std::countr_zero(there);
      const Coord eighth = low + Coord((e >> 2) * 2, e & 2, (e & 1) * 2);
      if (touches_live(eighth)) depth_ = std::min(level_, ContourCell::kMaxDepth);
    }
  }
}

unsigned SurfaceView::finers_of_eight(int level, const Coord& origin) {
  const unsigned there = finders_[static_cast<std::size_t>(level)].leaves_of_eight(origin);
  unsigned shown = there;
  for (unsigned rest = there; rest != 0; rest &= rest - 1) {
    const int e = std::countr_zero(rest);
    const Coord at = origin + Coord((e >> 2) * 8, (e & 2) * 4, (e & 1) * 8);
    if (!shown_.shows(level, at)) shown &= ~(rest & -rest);
  }
  return shown;
}

// Whether 2^3 cells from `eighth` on meet a live octant, be it in a corner. In a balanced stack
// what is refined twice never does.
bool SurfaceView::touches_live(const Coord& eighth) const noexcept {
  for (int o = 0; o < 8; ++o) {
    const Coord low((o >> 2) * 4, (o >> 1 & 1) * 4, (o & 1) * 4);
    bool meets = live(low);
    for (int a = 0; a < 3; ++a) meets &= eighth[a] <= low[a] + 4 && eighth[a] + 2 >= low[a];
    if (meets) return true;
  }
  return false;
}

void SurfaceView::find_neighbours() {
  absent_ = 0;
  std::size_t at = 0;
  for (int i = -8; i <= 8; i += 8) {
    for (int j = -8; j <= 8; j += 8) {
      for (int k = -8; k <= 8; k += 8, ++at) {
        leaves_[at] = buffer(level_, origin_.offsetBy(i, j, k));
        if (!leaves_[at]) absent_ |= 1U << at;
      }
    }
  }
}

void SurfaceView::find_stored_sides() {
  for (int x = 0; x <= 8; ++x) {
    for (int y = 0; y <= 8; ++y) {
      const float* const* leaves = leaves_.data() + neighbour(Coord(x, y, 0));
      const int offset = (x & 7) << 6 | (y & 7) << 3;
      unsigned here = 0;
      unsigned inside = 0;
      if (leaves[0] != nullptr) {
        here = 0xff;
        inside = inside_bits(leaves[0] + offset);
      }
      if (leaves[1] != nullptr) {
        here |= 0x100U;
        inside |= leaves[1][offset] < 0.0F ? 0x100U : 0U;
      }
      stored_here_[row_index(x, y, 9)] = static_cast<std::uint16_t>(here);
      side_known_[row_index(x, y, 9)] = static_cast<std::uint16_t>(here);
      stored_inside_[row_index(x, y, 9)] = static_cast<std::uint16_t>(inside);
    }
  }
}

// Octants met by the 3^3 cells around a cell, save where only a corner touches.
unsigned SurfaceView::divided_row(int x, int y) const noexcept {
  if (uniform_) return 0;
  const int i = (x >> 2) + 1;
  const int j = (y >> 2) + 1;
  unsigned across_both = 0;
  unsigned across_one = 0;
  for (const int a : {(x - 1) >> 2, (x + 1) >> 2}) {
    across_one |= refined_octants(a + 1, j);
    for (const int b : {(y - 1) >> 2, (y + 1) >> 2}) across_both |= refined_octants(a + 1, b + 1);
  }
  for (const int b : {(y - 1) >> 2, (y + 1) >> 2}) across_one |= refined_octants(i, b + 1);
  return cells_of(kCellsIn, across_both) | cells_of(kCellsAt, across_one);
}

std::uint32_t SurfaceView::refined_around(const Coord& cell) const noexcept {
  const int before = (cell.z() - 1) >> 2;
  const int here = cell.z() >> 2;
  const int after = (cell.z() + 1) >> 2;
  std::uint32_t found = 0;
  unsigned bit = 0;
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j, bit += 3) {
      const unsigned row = refined_octants(((cell.x() + i) >> 2) + 1, ((cell.y() + j) >> 2) + 1);
      const unsigned cells = (row >> (before + 1) & 1U) | (row >> (here + 1) & 1U) << 1 |
                             (row >> (after + 1) & 1U) << 2;
      found |= std::uint32_t{cells} << bit;
    }
  }
  return found;
}

bool SurfaceView::refined(int depth, const Coord& cell) const {
  if (depth >= level_) return false;
  const Coord own = cell >> depth;
  if (own.x() < -4 || own.y() < -4 || own.z() < -4 || own.x() > 11 || own.y() > 11 ||
      own.z() > 11) {
    return false;
  }
  const std::size_t o = octant_index(own);
  if (!finer_[o]) return false;
  if (depth == 0) return true;
  const Coord half = cell >> (depth - 1);
  const int eighth = (half.x() >> 2 & 1) << 2 | (half.y() >> 2 & 1) << 1 | (half.z() >> 2 & 1);
  if ((deeper_[o] >> eighth & 1) == 0) return false;
  return depth == 1 || shown_.has_leaf(level_ - depth - 1, ((origin_ << depth) + cell) << 1);
}

bool SurfaceView::quiet(const Coord& octant) {
  const bool inside = stored(octant) < 0.0F;
  return quiet_here(octant, inside) && quiet_beyond(octant, inside);
}

// Nodes between this level's are either interpolated from stored values here, or lie in finer
// leaves beyond the high faces (low faces belong to the octant itself), as do the finer values of
// this level's nodes there.
bool SurfaceView::quiet_here(const Coord& octant, bool inside) {
  const unsigned nodes = 0x1fU << octant.z();
  const unsigned flip = inside ? ~0U : 0U;
  const auto differs = [&](std::size_t row) {
    return ((stored_inside_[row] ^ flip) & side_known_[row] & nodes) != 0;
  };
  unsigned known = nodes;
  for (int x = octant.x(); x <= octant.x() + 4; ++x) {
    for (int y = octant.y(); y <= octant.y() + 4; ++y) {
      if (differs(row_index(x, y, 9))) return false;
      known &= side_known_[row_index(x, y, 9)];
    }
  }
  if (known == nodes) return true;
  for (int x = octant.x(); x <= octant.x() + 4; ++x) {
    for (int y = octant.y(); y <= octant.y() + 4; ++y) {
      if ((side_known_[row_index(x, y, 9)] & nodes) == nodes) continue;
      find_absent_sides(x, y);
      if (differs(row_index(x, y, 9))) return false;
    }
  }
  return true;
}

// Of the nodes of a row that this level does not store.
void SurfaceView::find_absent_sides(int x, int y) {
  const std::size_t row = row_index(x, y, 9);
  const float* const values = interpolated_row(x, y);
  unsigned inside = stored_inside_[row];
  for (unsigned rest = 0x1ffU & ~unsigned{stored_here_[row]}; rest != 0; rest &= rest - 1) {
    const int z = std::countr_zero(rest);
    const float value = values != nullptr ? values[z] : interpolated(Coord(x, y, z));
    if (value < 0.0F) inside |= 1U << z;
  }
  stored_inside_[row] = static_cast<std::uint16_t>(inside);
  side_known_[row] = 0x1ff;
}

bool SurfaceView::quiet_beyond(const Coord& octant, bool inside) {
  for (int beyond = 1; beyond < 8; ++beyond) {
    const Coord step(beyond >> 2, beyond >> 1 & 1, beyond & 1);
    const Coord next = octant + (step << 2);
    if (this->octant(next) && !quiet_leaf(level_ - 1, (origin_ + next) << 1, step, inside)) {
      return false;
    }
  }
  return true;
}

// Whether the nodes with coordinate 0 in every direction of `step` lie on one side, in a leaf and
// in all finer ones over it.
bool SurfaceView::quiet_leaf(int level, const Coord& origin, const Coord& step, bool inside) {
  const float* values = buffer(level, origin);
  if (!values) return true;
  const Coord last = Coord(7) - (step << 3) + step;
  const unsigned nodes = last.z() == 0 ? 0x01 : 0xff;
  for (int x = 0; x <= last.x(); ++x) {
    for (int y = 0; y <= last.y(); ++y) {
      if ((inside_bits(values + (x << 6 | y << 3)) & nodes) != (inside ? nodes : 0)) return false;
    }
  }
  if (level == 0 || depth_ == 1) return true;
  for (int e = 0; e < 8; ++e) {
    const Coord eighth(e >> 2, e >> 1 & 1, e & 1);
    const bool touches =
        (eighth.x() & step.x()) + (eighth.y() & step.y()) + (eighth.z() & step.z()) == 0;
    if (touches && !quiet_leaf(level - 1, (origin << 1) + (eighth << 3), step, inside))
      return false;
  }
  return true;
}

std::uint16_t SurfaceView::inside_row(int x, int y) const noexcept {
  const float* row = dense_.data() + index(x, y, 0);
  return static_cast<std::uint16_t>(inside_bits(row) | (row[8] < 0.0F ? 0x100U : 0U));
}

std::uint32_t SurfaceView::inside_around(const Coord& cell) {
  assert(depth_ == 1);
  const Coord low = cell << 1;
  std::uint32_t found = 0;
  unsigned bit = 0;
  for (int i = 0; i <= 2; ++i) {
    for (int j = 0; j <= 2; ++j, bit += 3) {
      found |= (between_row(low.x() + i, low.y() + j) >> low.z() & 7U) << bit;
    }
  }
  return found;
}

unsigned SurfaceView::mixed_around(int x, int y) {
  assert(depth_ == 1);
  std::uint32_t any = 0;
  std::uint32_t all = ~0U;
  for (int i = 0; i <= 2; ++i) {
    for (int j = 0; j <= 2; ++j) {
      const std::uint32_t row = between_row(2 * x + i, 2 * y + j);
      any |= row;
      all &= row;
    }
  }
  const std::uint32_t mixed = (any | any >> 1 | any >> 2) & ~(all & all >> 1 & all >> 2);
  unsigned cells = 0;
  for (unsigned z = 0; z < kLeafSide; ++z) cells |= (mixed >> (2 * z) & 1U) << z;
  return cells;
}

// The sides of the next finer level's nodes 0 to 16 in a row.
std::uint32_t SurfaceView::between_row(int x, int y) {
  std::uint32_t& row = between_inside_[row_index(x, y, 17)];
  if (row != kUnknownRow) return row;
  const SidesBetween own = sides_between(x, y);
  std::uint32_t found = 0;
  std::uint32_t unknown = 0;
  for (int z = 0; z <= 16; z += kLeafSide) {
    const Coord first(x, y, z);
    const std::size_t o = octant_index(first >> 1);
    const std::uint32_t nodes = (z < 16 ? 0xffU : 1U) << z;
    if (finer_[o] == nullptr) {
      found |= own.inside & nodes;
      unknown |= ~own.known & nodes;
    } else if (z < 16 && deeper_[o] == 0) {
      found |= inside_bits(finer_[o] + leaf_offset(first)) << z;
    } else {
      unknown |= nodes;
    }
  }
  constexpr std::uint32_t kEven = 0x15555;
  const bool has_middles = (x & y & 1) != 0;  // of cells
  if (has_middles) unknown &= kEven;
  for (; unknown != 0; unknown &= unknown - 1) {
    const int z = std::countr_zero(unknown);
    if (value(1, Coord(x, y, z)) < 0.0F) found |= 1U << z;
  }
  if (has_middles) found = (found & kEven) | (found & kEven & 0xffffU) << 1;
  return row = found;
}

// Of those nodes where no finer leaf is. What is interpolated between nodes of one side lies there
// too.
SurfaceView::SidesBetween SurfaceView::sides_between(int x, int y) const noexcept {
  std::uint32_t here = ~0U;  // by node of this level
  std::uint32_t all = ~0U;
  std::uint32_t any = 0;
  for (int i = x >> 1; i <= (x + 1) >> 1; ++i) {
    for (int j = y >> 1; j <= (y + 1) >> 1; ++j) {
      const std::size_t row = row_index(i, j, 9);
      here &= stored_here_[row];
      all &= stored_inside_[row];
      any |= stored_inside_[row];
    }
  }
  const std::uint32_t inside = here & all;
  const std::uint32_t outside = here & ~any & 0x1ffU;
  const std::uint32_t inside_after = inside & inside >> 1;
  const std::uint32_t outside_after = outside & outside >> 1;
  return {spread(inside | outside) | spread(inside_after | outside_after) << 1,
          spread(inside) | spread(inside_after) << 1};
}

// The nodes 0 to 8 of a row between the next coarser level's; null when that does not store all
// that the leaf's take.
const float* SurfaceView::interpolated_row(int x, int y) {
  if (level_ == stack().top()) return nullptr;
  if (!coarse_known_) find_coarse();
  return coarse_complete_ ? interpolated_.data() + row_index(x, y, 9) * kInterpolatedRow : nullptr;
}

// The same sums as interpolated(), for all nodes: along z, then y, then x.
void SurfaceView::interpolate_all() {
  constexpr std::size_t kCoarse = 5;
  constexpr std::size_t kRow = kInterpolatedRow;
  constexpr std::size_t kPlane = 9 * kRow;
  const Coord low = coarser(origin_);
  for (std::size_t i = 0; i < kCoarse; ++i) {
    float* const plane = interpolated_.data() + 2 * i * kPlane;
    for (std::size_t j = 0; j < kCoarse; ++j) {
      float* const row = plane + 2 * j * kRow;
      const Coord node = low.offsetBy(static_cast<int>(i), static_cast<int>(j), 0);
      const float* const four = coarse_leaf(node) + leaf_offset(node);
      for (std::size_t k = 0; k < 4; ++k) row[2 * k] = four[k];
      const Coord fifth = node.offsetBy(0, 0, 4);
      row[8] = coarse_leaf(fifth)[leaf_offset(fifth)];
      for (std::size_t z = 1; z < 9; z += 2) row[z] = lerp_steps(row[z - 1], row[z + 1], 1, 1);
    }
    for (std::size_t y = 1; y < 9; y += 2) {
      float* const row = plane + y * kRow;
      for (std::size_t z = 0; z < kRow; ++z)
        row[z] = lerp_steps(row[z - kRow], row[z + kRow], 1, 1);
    }
  }
  for (std::size_t x = 1; x < 9; x += 2) {
    float* const plane = interpolated_.data() + x * kPlane;
    for (std::size_t n = 0; n < kPlane; ++n) {
      plane[n] = lerp_steps(plane[n - kPlane], plane[n + kPlane], 1, 1);
    }
  }
}

void SurfaceView::overlay_octants(int low, int high) {
  for (int i = -4; i <= 8; i += 4) {
    for (int j = -4; j <= 8; j += 4) {
      for (int k = -4; k <= 8; k += 4) {
        const Coord first(i, j, k);
        const bool is_near = (near_live_ >> octant_index(first) & 1U) != 0;
        if (is_near && octant(first)) overlay_octant(first, low, high);
      }
    }
  }
}

// Takes the finest values where an octant is refined.
void SurfaceView::overlay_octant(const Coord& first, int low, int high) {
  const float* fine = octant(first);
  const unsigned deeper = deeper_[octant_index(first)];
  const auto from = [&](int axis) { return std::max(first[axis], low); };
  const auto to = [&](int axis) { return std::min(first[axis] + 3, high); };
  for (int x = from(0); x <= to(0); ++x) {
    for (int y = from(1); y <= to(1); ++y) {
      float* row = dense_.data() + index(x, y, 0);
      const float* fine_row = fine + leaf_offset(Coord(x, y, 0) << 1);
      for (int z = from(2); z <= to(2); ++z) {
        const int eighth = (x >> 1 & 1) << 2 | (y >> 1 & 1) << 1 | (z >> 1 & 1);
        row[z] = (deeper >> eighth & 1U) != 0 ? shown_.node_value(level_, origin_.offsetBy(x, y, z))
                                              : fine_row[2 * z & (kLeafSide - 1)];
      }
    }
  }
}

// This level's own value, finer ones ignored.
float SurfaceView::stored(const Coord& node) {
  const float* leaf = leaves_[static_cast<std::size_t>(neighbour(node))];
  return leaf ? leaf[leaf_offset(node)] : interpolated(node);
}

float SurfaceView::interpolated(const Coord& node) {
  const Coord global = origin_ + node;
  if (level_ == stack().top()) return shown_.sample(level_, global);
  if (!coarse_known_) find_coarse();
  if (!coarse_leaf(coarser(global))) return shown_.sample(level_, global);
  return interpolated_between(global, 1, [this](const Coord& n) { return coarse_stored(n); });
}

void SurfaceView::find_coarse() {
  coarse_known_ = true;
  coarse_origin_ = leaf_origin(coarser(origin_).offsetBy(-1));
  for (int i = 0; i < 8; ++i) {
    const Coord offset((i >> 2) * 8, (i >> 1 & 1) * 8, (i & 1) * 8);
    coarse_[static_cast<std::size_t>(i)] = buffer(level_ + 1, coarse_origin_ + offset);
  }
  // The leaf's nodes lie between those of one of these along each axis, or of two.
  const Coord low = coarser(origin_);
  coarse_complete_ = true;
  for (int i = 0; i < 8; ++i) {
    const Coord corner = low.offsetBy(i & 4, (i & 2) * 2, (i & 1) * 4);
    coarse_complete_ = coarse_complete_ && coarse_leaf(corner) != nullptr;
  }
  if (coarse_complete_) interpolate_all();
}

const float* SurfaceView::coarse_leaf(const Coord& node) const noexcept {
  assert(coarse_known_);
  const Coord n = (node - coarse_origin_) >> 3;
  return coarse_[static_cast<std::size_t>(n.x() << 2 | n.y() << 1 | n.z())];
}

float SurfaceView::coarse_stored(const Coord& node) const {
  const float* leaf = coarse_leaf(node);
  return leaf ? leaf[leaf_offset(node)] : shown_.sample(level_ + 1, node);
}

float SurfaceView::value(const Coord& node) {
  float& known = dense_[static_cast<std::size_t>(index(node.x(), node.y(), node.z()))];
  if (std::isnan(known)) known = stored(node);
  return known;
}

float SurfaceView::value(int depth, const Coord& node) {
  assert(depth >= 0 && depth <= level_);
  Coord reduced = node;
  for (; depth > 0 && even(reduced); --depth) reduced = reduced >> 1;
  if (depth == 0) return value(reduced);
  if (depth > 1) return shown_.node_value(level_ - depth, (origin_ << depth) + reduced);
  const std::size_t at = between_index(reduced);
  if (std::isnan(between_[at])) {
    between_[at] = between(reduced);
    between_known_.push_back(at);
  }
  return between_[at];
}

// A node one level finer that is none of this level's.
float SurfaceView::between(const Coord& node) {
  const std::size_t o = octant_index(node >> 1);
  if (!finer_[o]) {
    if (absent(node >> 1)) return shown_.sample(level_ - 1, (origin_ << 1) + node);
    return interpolated_between(node, 1, [this](const Coord& n) { return stored(n); });
  }
  const int eighth = (node.x() >> 2 & 1) << 2 | (node.y() >> 2 & 1) << 1 | (node.z() >> 2 & 1);
  if ((deeper_[o] >> eighth & 1) != 0) {
    return shown_.node_value(level_ - 1, (origin_ << 1) + node);
  }
  return finer_[o][leaf_offset(node)];
}

}  // namespace argil
