// SPDX-License-Identifier: GPL-3.0-or-later
// The values around one leaf in a dense array, read from leaf buffers in rows. Values that come
// from coarser levels are interpolated only when asked for: most blocks have none.
#include "surface/surface_view.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>

#include "field/sampling.h"

namespace argil {

namespace {

constexpr float kUnknownValue = std::numeric_limits<float>::quiet_NaN();
constexpr int kBetweenSide = 19;

// Nodes -1 to 17 of the next finer level along each axis.
std::size_t between_index(const Coord& n) {
  return static_cast<std::size_t>(((n.x() + 1) * kBetweenSide + n.y() + 1) * kBetweenSide + n.z() +
                                  1);
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
  if (!uniform_) {
    find_near_live();
    find_deeper();
  }
  find_neighbours();
  return true;
}

void SurfaceView::gather(bool border) {
  const int low = border ? -1 : 0;
  const int high = border ? 9 : 8;
  for (int x = low; x <= high; ++x) {
    for (int y = low; y <= high; ++y) gather_row(x, y, low, high);
  }
  if (uniform_) return;
  overlay_octants(low, high);
  for (const std::size_t n : between_known_) between_[n] = kUnknownValue;
  between_known_.clear();
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
  finer_.fill(nullptr);
  all_refined = false;
  if (level_ == 0) return true;
  const Coord base = origin_ << 1;
  bool none = true;
  int own = 0;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      for (int k = 0; k < 4; ++k) {
        const float* found = buffer(level_ - 1, base.offsetBy(8 * i - 8, 8 * j - 8, 8 * k - 8));
        finer_[static_cast<std::size_t>((i * 4 + j) * 4 + k)] = found;
        if (!found) continue;
        none = false;
        if ((i == 1 || i == 2) && (j == 1 || j == 2) && (k == 1 || k == 2)) ++own;
      }
    }
  }
  all_refined = own == 8;
  return none;
}

void SurfaceView::find_deeper() {
  depth_ = 1;
  deeper_.fill(0);
  if (level_ < 2) return;
  for (std::size_t o = 0; o < 64; ++o) {
    if (!finer_[o] || (near_live_ >> o & 1U) == 0) continue;
    const Coord first(static_cast<int>(o >> 4), static_cast<int>(o >> 2 & 3),
                      static_cast<int>(o & 3));
    for (int e = 0; e < 8; ++e) {
      const Coord eighth = (first.offsetBy(-1) << 2) + Coord((e >> 2) * 2, e & 2, (e & 1) * 2);
      if (!buffer(level_ - 2, (origin_ + eighth) << 2)) continue;
      deeper_[o] = static_cast<std::uint8_t>(deeper_[o] | 1U << e);
      if (touches_live(eighth)) depth_ = std::min(level_, ContourCell::kMaxDepth);
    }
  }
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

bool SurfaceView::divided(const Coord& cell) const noexcept {
  if (uniform_) return false;
  // Octants met by the 3^3 cells around it, save where only a corner touches: at most 7 others.
  const Coord low = cell.offsetBy(-1);
  const Coord high = cell.offsetBy(1);
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      for (int k = 0; k < 2; ++k) {
        const Coord near(i ? high.x() : low.x(), j ? high.y() : low.y(), k ? high.z() : low.z());
        const Coord a(cell.x(), near.y(), near.z());
        const Coord b(near.x(), cell.y(), near.z());
        const Coord c(near.x(), near.y(), cell.z());
        if (octant(a) || octant(b) || octant(c)) return true;
      }
    }
  }
  return false;
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

bool SurfaceView::quiet_cell(const Coord& cell) {
  if (depth_ > 1) return false;
  const Coord low = cell << 1;
  const bool inside = value(cell) < 0.0F;
  for (int i = 0; i < 27; ++i) {
    const Coord offset(i / 9, i / 3 % 3, i % 3);
    const Coord odd = offset & 1;
    const int odds = odd.x() + odd.y() + odd.z();
    if (odds == 0 || odds == 3) continue;  // a corner; the middle, which no polygon has
    if ((value(1, low + offset) < 0.0F) != inside) return false;
  }
  return true;
}

// Nodes between this level's are either interpolated from stored values here, or lie in finer
// leaves beyond the high faces (low faces belong to the octant itself), as do the finer values of
// this level's nodes there.
bool SurfaceView::quiet_here(const Coord& octant, bool inside) {
  for (int x = 0; x <= 4; ++x) {
    for (int y = 0; y <= 4; ++y) {
      const Coord first = octant.offsetBy(x, y, 0);
      if (!quiet_row(first, 4, inside) || !quiet_row(first.offsetBy(0, 0, 4), 1, inside)) {
        return false;
      }
    }
  }
  return true;
}

// `count` nodes along z, all of one leaf.
bool SurfaceView::quiet_row(const Coord& first, int count, bool inside) {
  bool same = true;
  if (const float* leaf = leaves_[static_cast<std::size_t>(neighbour(first))]) {
    const float* row = leaf + leaf_offset(first);
    for (int z = 0; z < count; ++z) same &= (row[z] < 0.0F) == inside;
    return same;
  }
  for (int z = 0; z < count; ++z) same &= (interpolated(first.offsetBy(0, 0, z)) < 0.0F) == inside;
  return same;
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
  for (int x = 0; x <= last.x(); ++x) {
    for (int y = 0; y <= last.y(); ++y) {
      for (int z = 0; z <= last.z(); ++z) {
        if ((values[x << 6 | y << 3 | z] < 0.0F) != inside) return false;
      }
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
  unsigned bits = 0;
  for (unsigned z = 0; z < 9; ++z) bits |= (row[z] < 0.0F ? 1U : 0U) << z;
  return static_cast<std::uint16_t>(bits);
}

void SurfaceView::gather_row(int x, int y, int low, int high) {
  const bool inner = x >= 0 && x <= 8 && y >= 0 && y <= 8;
  float* row = dense_.data() + index(x, y, 0);
  const float* const* leaves = leaves_.data() + neighbour(Coord(x, y, -8));
  const int offset = (x & 7) << 6 | (y & 7) << 3;
  if (leaves[1]) std::memcpy(row, leaves[1] + offset, 8 * sizeof(float));
  for (int z = leaves[1] ? 8 : 0; z <= high; ++z) {
    const float* leaf = leaves[1 + (z >> 3)];
    if (leaf) {
      row[z] = leaf[offset | (z & 7)];
    } else {
      row[z] = inner && z <= 8 ? interpolated(Coord(x, y, z)) : kUnknownValue;
    }
  }
  if (low < 0) row[-1] = leaves[0] ? leaves[0][offset | 7] : kUnknownValue;
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
      for (int z = from(2); z <= to(2); ++z) {
        const int eighth = (x >> 1 & 1) << 2 | (y >> 1 & 1) << 1 | (z >> 1 & 1);
        float& here = dense_[static_cast<std::size_t>(index(x, y, z))];
        here = (deeper >> eighth & 1U) != 0 ? shown_.node_value(level_, origin_.offsetBy(x, y, z))
                                            : fine[leaf_offset(Coord(x, y, z) << 1)];
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
