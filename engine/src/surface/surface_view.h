// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <vector>

#include "field/leaf_finder.h"
#include "field/level_stack.h"
#include "surface/contour_cell.h"
#include "surface/shown_leaves.h"

namespace argil {

// Notation: "relative" coordinates count from the low corner of the open leaf, in nodes or cells of
// a level `depth` levels finer than it. An octant is a leaf of the next finer level: 4^3 cells.

/// Everything a block of the surface reads: the values and the refinement in and around one leaf,
/// gathered from the leaf buffers once. In octants that are live or touch a live one, values are
/// those of LevelStack::node_value, bit for bit; the others are none of the surface's. A hidden
/// leaf counts as absent.
/// Scratch to be used again and again, by one thread at a time, while nobody writes the stack.
class SurfaceView : public Refinement {
 public:
  /// Nodes -1 to 9 along each axis: the leaf's cells and one node more for gradients.
  static constexpr int kSide = 11;

  explicit SurfaceView(const ShownLeaves& leaves);

  /// Forgets where leaves were found: call it when the stack was written.
  void forget();

  /// Looks at another leaf; false when it is absent or all of its cells are refined: then there is
  /// nothing to read. Values are known from gather() on.
  bool open(int level, const Coord& origin);

  /// Copies the values. `border` false leaves out the nodes -1 and 9, which then are unknown.
  void gather(bool border = true);

  const LevelStack& stack() const noexcept { return shown_.stack(); }
  int level() const noexcept { return level_; }
  const Coord& origin() const noexcept { return origin_; }

  /// No finer leaf touches the leaf's cells: no face or edge of them is divided.
  bool uniform() const noexcept { return uniform_; }
  /// Some of the 26 neighbouring leaves are absent at this level, so that values come from coarser.
  bool reads_coarser() const noexcept { return absent_ != 0; }
  /// Whether the leaf of a node (each coordinate -1 to 9) is absent at this level.
  bool absent(const Coord& node) const noexcept { return (absent_ >> neighbour(node) & 1U) != 0; }

  /// How many levels down faces of this leaf's cells may be divided: 0 when uniform.
  int depth() const noexcept { return depth_; }
  bool live(const Coord& cell) const noexcept { return octant(cell) == nullptr; }
  /// Whether a face or an edge of the cell may be divided, judged by octants.
  bool divided(const Coord& cell) const noexcept;
  bool refined(int depth, const Coord& cell) const override;

  /// Whether all nodes on and in the faces of the cells of a live octant (its low cell given) lie
  /// on one side, those between this level's nodes included: then no cell of it holds any surface.
  /// Needs no gather().
  bool quiet(const Coord& octant);
  /// The same of one cell whose corners lie on one side. Dearer for a cell, but sees more of them.
  bool quiet_cell(const Coord& cell);

  /// Bit z of row (x, y) is set when node (x, y, z) is inside, 0 to 8 each.
  std::uint16_t inside_row(int x, int y) const noexcept;

  /// The dense values: node (x, y, z) at index(x, y, z). A border node whose leaf is absent at
  /// this level is NaN here until `value` is asked for it.
  const float* dense() const noexcept { return dense_.data(); }
  static constexpr int index(int x, int y, int z) noexcept {
    assert(x >= -1 && x < kSide - 1 && y >= -1 && y < kSide - 1 && z >= -1 && z < kSide - 1);
    return ((x + 1) * kSide + y + 1) * kSide + z + 1;
  }

  /// The value at a node of this level, -1 to 9.
  float value(const Coord& node);
  /// The value at a node `depth` levels finer, -1 to 8 * 2^depth + 1.
  float value(int depth, const Coord& node);

 private:
  static int neighbour(const Coord& node) noexcept {
    return (((node.x() >> 3) + 1) * 3 + (node.y() >> 3) + 1) * 3 + (node.z() >> 3) + 1;
  }
  static std::size_t octant_index(const Coord& node) noexcept {
    return static_cast<std::size_t>((((node.x() >> 2) + 1) * 4 + (node.y() >> 2) + 1) * 4 +
                                    (node.z() >> 2) + 1);
  }
  const float* octant(const Coord& node) const noexcept { return finer_[octant_index(node)]; }
  const float* buffer(int level, const Coord& node);
  bool find_octants(bool& all_refined);
  void find_near_live();
  void find_deeper();
  bool touches_live(const Coord& eighth) const noexcept;
  void find_neighbours();
  void gather_row(int x, int y, int low, int high);
  void overlay_octants(int low, int high);
  void overlay_octant(const Coord& first, int low, int high);
  float stored(const Coord& node);
  float interpolated(const Coord& node);
  bool quiet_here(const Coord& octant, bool inside);
  bool quiet_row(const Coord& first, int count, bool inside);
  bool quiet_beyond(const Coord& octant, bool inside);
  bool quiet_leaf(int level, const Coord& origin, const Coord& step, bool inside);
  void find_coarse();
  const float* coarse_leaf(const Coord& node) const noexcept;
  float coarse_stored(const Coord& node) const;
  float between(const Coord& node);

  ShownLeaves shown_;
  std::vector<LeafFinder> finders_;  // by level
  int level_ = 0;
  Coord origin_;
  int depth_ = 0;
  bool uniform_ = true;
  std::uint32_t absent_ = 0;               // by neighbour
  std::array<const float*, 27> leaves_{};  // this level, by neighbour
  std::array<const float*, 64> finer_{};   // next finer level, by octant
  std::array<std::uint8_t, 64> deeper_{};  // of each octant the eighths refined once more
  std::uint64_t near_live_ = 0;            // octants that a live one's cells or gradients touch
  bool coarse_known_ = false;
  Coord coarse_origin_;  // lowest of the eight coarse leaves around
  std::array<const float*, 8> coarse_{};
  std::array<float, kSide * kSide * kSide> dense_{};
  std::vector<float> between_;  // depth 1, -1 to 17: NaN until asked for
  std::vector<std::size_t> between_known_;
};

}  // namespace argil
