// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "argil/core/triangle_mesh.h"

namespace argil::mesh {

/// Triangles in the cells of a grid that their boxes meet, twice as wide as a box is on average, to
/// find those whose boxes overlap.
///
/// Shapes       triangles of much the same size, as those of a surface are: see `fits`.
/// Determinism  pairs come in the same order every time.
/// Threads      one.
/// Cost         100 ns a triangle, and 2 ns for each two in one cell; 60 bytes a triangle.
class TriangleGrid {
 public:
  /// Those of `numbers`, which must stay, as the others must. Positions must be finite.
  /// `is_flat`: flat_fans(mesh), whose triangles need not be looked at.
  TriangleGrid(const TriangleMesh& mesh, std::span<const std::uint32_t> numbers,
               const std::vector<std::uint8_t>& is_flat);

  /// Whether the cells hold so few that looking into each is worth it; else there are no pairs.
  bool fits() const noexcept { return fits_; }

  /// Calls `use(i, j)`, i < j, once for each two places in `numbers` whose boxes overlap and that
  /// have no flat vertex in common.
  template <class Use>
  void for_each_pair(const Use& use) const {
    assert(fits_);
    Gathered all(largest_bucket_);
    for (std::size_t bucket = 0; bucket < end_.size(); ++bucket) {
      const std::span<const std::uint32_t> items(items_.data() + begin_[bucket],
                                                 end_[bucket] - begin_[bucket]);
      if (items.size() < 2) continue;
      gather(items, all);
      for (std::size_t i = 0; i + 1 < items.size(); ++i) {
        all.look_from(i, items.size());
        for (std::size_t j = i + 1; j < items.size(); ++j) {
          if (all.is_near[j] == 0) continue;
          const Cell common = first_common(boxes_[items[i]], boxes_[items[j]]);
          if (bucket_of(common) == bucket) use(items[i], items[j]);
        }
      }
    }
  }

 private:
  /// Rounded outward, so that it holds its triangle.
  struct Box {
    std::array<float, 3> low;
    std::array<float, 3> high;
  };
  using Cell = std::array<std::uint32_t, 3>;

  /// What one cell has, side by side, so that one triangle is compared with several at once.
  struct Gathered {
    explicit Gathered(std::size_t most);
    /// Which of those behind `i`, up to `count`, is_near.
    void look_from(std::size_t i, std::size_t count) noexcept;

    std::array<std::vector<float>, 3> low;
    std::array<std::vector<float>, 3> high;
    std::array<std::vector<std::uint32_t>, 3> flat;  ///< vertices; kNoVertex for others
    std::vector<std::uint32_t> is_near;
  };
  static constexpr std::uint32_t kNoVertex = 0xFFFFFFFFU;

  static Box box_of(const TriangleMesh& mesh, const Triangle& t) noexcept;
  void gather(std::span<const std::uint32_t> items, Gathered& to) const noexcept;
  bool choose_cells();
  std::uint32_t cell_along(std::size_t axis, float at) const noexcept {
    return static_cast<std::uint32_t>((at - low_[axis]) * per_unit_);
  }
  /// The lowest cell that both boxes meet, in which alone their pair counts.
  Cell first_common(const Box& a, const Box& b) const noexcept {
    Cell cell;
    for (std::size_t k = 0; k < 3; ++k) cell[k] = cell_along(k, std::max(a.low[k], b.low[k]));
    return cell;
  }
  std::size_t bucket_of(const Cell& cell) const noexcept {
    const std::uint64_t mixed = cell[0] * 0x9E3779B97F4A7C15ULL ^ cell[1] * 0xC2B2AE3D27D4EB4FULL ^
                                cell[2] * 0x165667B19E3779F9ULL;
    return static_cast<std::size_t>(mixed * 0x9E3779B97F4A7C15ULL >> shift_);
  }
  template <class Use>
  void for_each_bucket(const Box& box, const Use& use) const;
  void fill_buckets();

  const TriangleMesh& mesh_;
  std::span<const std::uint32_t> numbers_;
  const std::vector<std::uint8_t>& is_flat_;
  std::vector<Box> boxes_;
  std::array<float, 3> low_{};
  float per_unit_ = 0.0F;
  int shift_ = 63;
  bool fits_ = false;
  std::vector<std::uint32_t> begin_;  ///< of each bucket in items_, one more at the end
  std::vector<std::uint32_t> end_;    ///< as a triangle with two cells in one bucket is there once
  std::vector<std::uint32_t> items_;
  std::size_t largest_bucket_ = 0;
};

}  // namespace argil::mesh
