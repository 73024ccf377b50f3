// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/triangle_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace argil::mesh {
namespace {

/// Beyond these a box sweep is faster, in cells a triangle and in pairs of one cell a triangle.
constexpr std::size_t kMostCells = 8;
constexpr std::size_t kMostPairsInCells = 100;

}  // namespace

TriangleGrid::Box TriangleGrid::box_of(const TriangleMesh& mesh, const Triangle& t) noexcept {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Box box;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [low, high] =
        std::minmax({mesh.positions[t[0]][k], mesh.positions[t[1]][k], mesh.positions[t[2]][k]});
    box.low[k] = static_cast<float>(low);
    box.high[k] = static_cast<float>(high);
    if (double{box.low[k]} > low) box.low[k] = std::nextafter(box.low[k], -kInfinity);
    if (double{box.high[k]} < high) box.high[k] = std::nextafter(box.high[k], kInfinity);
  }
  return box;
}

TriangleGrid::Gathered::Gathered(std::size_t most) : is_near(most) {
  for (std::size_t k = 0; k < 3; ++k) {
    low[k].resize(most);
    high[k].resize(most);
    flat[k].resize(most);
  }
}

/// Without branches, so that compilers make it of whole registers.
void TriangleGrid::Gathered::look_from(std::size_t i, std::size_t count) noexcept {
  assert(count <= is_near.size());
  const std::array<float, 3> from{low[0][i], low[1][i], low[2][i]};
  const std::array<float, 3> to{high[0][i], high[1][i], high[2][i]};
  // One that is not flat is in common with none; there are no such numbers.
  constexpr std::uint32_t kNone = kNoVertex - 1;
  std::array<std::uint32_t, 3> own{flat[0][i], flat[1][i], flat[2][i]};
  for (std::uint32_t& v : own) v = v == kNoVertex ? kNone : v;
  const float* const low_x = low[0].data();
  const float* const low_y = low[1].data();
  const float* const low_z = low[2].data();
  const float* const high_x = high[0].data();
  const float* const high_y = high[1].data();
  const float* const high_z = high[2].data();
  const std::uint32_t* const a = flat[0].data();
  const std::uint32_t* const b = flat[1].data();
  const std::uint32_t* const c = flat[2].data();
  std::uint32_t* const near = is_near.data();
  for (std::size_t j = i + 1; j < count; ++j) {
    const unsigned overlap = unsigned{low_x[j] <= to[0]} & unsigned{high_x[j] >= from[0]} &
                             unsigned{low_y[j] <= to[1]} & unsigned{high_y[j] >= from[1]} &
                             unsigned{low_z[j] <= to[2]} & unsigned{high_z[j] >= from[2]};
    const unsigned shares =
        unsigned{a[j] == own[0]} | unsigned{a[j] == own[1]} | unsigned{a[j] == own[2]} |
        unsigned{b[j] == own[0]} | unsigned{b[j] == own[1]} | unsigned{b[j] == own[2]} |
        unsigned{c[j] == own[0]} | unsigned{c[j] == own[1]} | unsigned{c[j] == own[2]};
    near[j] = overlap & (shares ^ 1U);
  }
}

void TriangleGrid::gather(std::span<const std::uint32_t> items, Gathered& to) const noexcept {
  for (std::size_t i = 0; i < items.size(); ++i) {
    const Box& box = boxes_[items[i]];
    const Triangle& t = mesh_.triangles[numbers_[items[i]]];
    for (std::size_t k = 0; k < 3; ++k) {
      to.low[k][i] = box.low[k];
      to.high[k][i] = box.high[k];
      to.flat[k][i] = is_flat_[t[k]] != 0 ? t[k] : kNoVertex;
    }
  }
}

TriangleGrid::TriangleGrid(const TriangleMesh& mesh, std::span<const std::uint32_t> numbers,
                           const std::vector<std::uint8_t>& is_flat)
    : mesh_(mesh), numbers_(numbers), is_flat_(is_flat) {
  assert(is_flat.size() == mesh.positions.size() && is_flat.size() < kNoVertex - 1);
  boxes_.reserve(numbers.size());
  for (const std::uint32_t t : numbers) boxes_.push_back(box_of(mesh, mesh.triangles[t]));
  if (choose_cells()) fill_buckets();
}

/// False where they would be too many to be numbered.
bool TriangleGrid::choose_cells() {
  constexpr double kMostAlong = 1 << 20;
  if (boxes_.empty()) return false;
  std::array<float, 3> high = boxes_[0].high;
  low_ = boxes_[0].low;
  double sides = 0.0;
  for (const Box& box : boxes_) {
    double side = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      low_[k] = std::min(low_[k], box.low[k]);
      high[k] = std::max(high[k], box.high[k]);
      side = std::max(side, double{box.high[k]} - double{box.low[k]});
    }
    sides += side;
  }
  per_unit_ = static_cast<float>(0.5 * static_cast<double>(boxes_.size()) / sides);
  for (std::size_t k = 0; k < 3; ++k) {
    const double along = (double{high[k]} - double{low_[k]}) * double{per_unit_};
    if (!(along < kMostAlong)) return false;
  }
  const auto buckets = std::bit_ceil(boxes_.size());
  shift_ = 64 - std::max(1, std::countr_zero(buckets));
  return true;
}

template <class Use>
void TriangleGrid::for_each_bucket(const Box& box, const Use& use) const {
  Cell low;
  Cell high;
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = cell_along(k, box.low[k]);
    high[k] = cell_along(k, box.high[k]);
  }
  for (std::uint32_t x = low[0]; x <= high[0]; ++x) {
    for (std::uint32_t y = low[1]; y <= high[1]; ++y) {
      for (std::uint32_t z = low[2]; z <= high[2]; ++z) use(bucket_of({x, y, z}));
    }
  }
}

/// A counting sort; gives up as soon as there is too much to look at.
void TriangleGrid::fill_buckets() {
  double cells = 0.0;
  for (const Box& box : boxes_) {
    double of_box = 1.0;
    for (std::size_t k = 0; k < 3; ++k) {
      of_box *= 1.0 + cell_along(k, box.high[k]) - cell_along(k, box.low[k]);
    }
    cells += of_box;
  }
  if (cells > static_cast<double>(kMostCells * boxes_.size())) return;
  begin_.assign((std::size_t{1} << (64 - shift_)) + 1, 0);
  for (const Box& box : boxes_) {
    for_each_bucket(box, [&](std::size_t bucket) { ++begin_[bucket + 1]; });
  }
  std::size_t pairs = 0;
  for (const std::size_t n : begin_) {
    pairs += n * n / 2;
    largest_bucket_ = std::max(largest_bucket_, n);
  }
  if (pairs > kMostPairsInCells * boxes_.size()) return;
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  items_.resize(begin_.back());
  end_.assign(begin_.begin(), begin_.end() - 1);
  for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
    for_each_bucket(boxes_[i], [&](std::size_t bucket) {
      std::uint32_t& end = end_[bucket];
      if (end == begin_[bucket] || items_[end - 1] != i) items_[end++] = i;
    });
  }
  fits_ = true;
}

}  // namespace argil::mesh
