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

  /// Copies the values. `border` false leaves out the nodes -1 and 9, which then may be
  /// anything.
  void gather(bool border = true);

  const LevelStack& stack() const noexcept { return shown_.stack(); }
  int level() const noexcept { return level_; }
  const Coord& origin() const noexcept { return origin_; }

  /// No finer leaf touches the leaf's cells: no face or edge of them is divided.
  bool uniform() const noexcept { return uniform_; }
  /// Some of the 26 neighbouring leaves are absent at this level, so that values come from coarser.
  bool reads_coarser() const noexcept { return absent_ != 0; }
  /// Which leaves are absent at this level: bit 9 i + 3 j + k of that at offset (i - 1, j - 1, k -
  /// 1).
  std::uint32_t absent_neighbours() const noexcept { return absent_; }
  /// Whether that of a node (each coordinate -1 to 9) is.
  bool absent(const Coord& node) const noexcept { return (absent_ >> neighbour(node) & 1U) != 0; }

  /// How many levels down faces of this leaf's cells may be divided: 0 when uniform.
  int depth() const noexcept { return depth_; }
  bool live(const Coord& cell) const noexcept { return octant(cell) == nullptr; }
  /// The cells of row (x, y), 0 to 7 each, of which a face or an edge may be divided, judged by
  /// octants, be they live or not: bits along z.
  unsigned divided_row(int x, int y) const noexcept;
  /// Which of the 27 cells of the same size in and around a cell are refined: bit 9 i + 3 j + k of
  /// the one at offset (i - 1, j - 1, k - 1).
  std::uint32_t refined_around(const Coord& cell) const noexcept;
  bool refined(int depth, const Coord& cell) const override;

  /// Whether all nodes on and in the faces of the cells of a live octant (its low cell given) lie
  /// on one side, those between this level's nodes included: then no cell of it holds any surface.
  /// Needs no gather().
  bool quiet(const Coord& octant);

  /// Bit z of row (x, y) is set when node (x, y, z) is inside, 0 to 8 each.
  std::uint16_t inside_row(int x, int y) const noexcept;
  /// The same of the next finer level's nodes around a cell that has no finer ones: bit
  /// 9 i + 3 j + k of node 2 cell + (i, j, k), each 0 to 2. That of the node in the cell's middle,
  /// which no polygon has, is that of another. For depth() 1.
  std::uint32_t inside_around(const Coord& cell);
  /// The cells of row (x, y) of whose bits above some but not all are set. For depth() 1. Both keep
  /// what they found of rows until the next gather().
  unsigned mixed_around(int x, int y);

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
  /// A row of cells or nodes, of those that SurfaceView names by (x, y).
  static std::size_t row_index(int x, int y, int side) noexcept {
    assert(x >= 0 && x < side && y >= 0 && y < side);
    return static_cast<std::size_t>(x * side + y);
  }
  /// Whether the octants (i, j, 0 to 3) are refined, as bits; i and j counted from 0.
  unsigned refined_octants(int i, int j) const noexcept {
    return static_cast<unsigned>(refined_ >> static_cast<unsigned>(16 * i + 4 * j) & 0xfU);
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
  unsigned finers_of_eight(int level, const Coord& origin);
  bool touches_live(const Coord& eighth) const noexcept;
  void find_neighbours();
  void find_stored_sides();
  void gather_stored(bool border);
  void gather_absent();
  const float* interpolated_row(int x, int y);
  void interpolate_all();
  void overlay_octants(int low, int high);
  void overlay_octant(const Coord& first, int low, int high);
  float stored(const Coord& node);
  float interpolated(const Coord& node);
  bool quiet_here(const Coord& octant, bool inside);
  void find_absent_sides(int x, int y);
  bool quiet_beyond(const Coord& octant, bool inside);
  bool quiet_leaf(int level, const Coord& origin, const Coord& step, bool inside);
  std::uint32_t between_row(int x, int y);
  struct SidesBetween {
    std::uint32_t known;  ///< which of a row of nodes of the next finer level, 0 to 16
    std::uint32_t inside;
  };
  SidesBetween sides_between(int x, int y) const noexcept;
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
  std::uint64_t refined_ = 0;              // octants that are there
  std::array<std::uint8_t, 64> deeper_{};  // of each octant the eighths refined once more
  std::uint64_t near_live_ = 0;            // octants that a live one's cells or gradients touch
  bool coarse_known_ = false;
  Coord coarse_origin_;  // lowest of the eight coarse leaves around
  std::array<const float*, 8> coarse_{};
  bool coarse_complete_ = false;  // all are there that the leaf's nodes lie in
  static constexpr std::size_t kInterpolatedRow = 12;
  std::array<float, 81 * kInterpolatedRow> interpolated_{};  // where complete: nodes 0 to 8
  std::array<float, kSide * kSide * kSide> dense_{};
  // Of a leaf that is not uniform, by row 0 to 8 and bits along z: whether a node's own level
  // stores it, whether the side that this level's value has is known, and if so whether that is
  // inside.
  std::array<std::uint16_t, 81> stored_here_{};
  std::array<std::uint16_t, 81> side_known_{};
  std::array<std::uint16_t, 81> stored_inside_{};
  std::array<std::uint32_t, 289> between_inside_{};  // depth 1, by row 0 to 16; or kUnknownRow
  std::vector<float> between_;                       // depth 1, -1 to 17: NaN until asked for
  std::vector<std::size_t> between_known_;
};

}  // namespace argil
