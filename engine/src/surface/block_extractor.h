// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "surface/contour_cell.h"
#include "surface/contour_loop.h"
#include "surface/contour_trace.h"
#include "surface/contour_vertex.h"
#include "surface/surface_view.h"

namespace argil {

/// The name of a lattice edge: the coordinates of its low node (19 bits each), its axis, its level.
/// Never ContourMesh::kNoKey.
std::uint64_t lattice_edge_key(int level, const Coord& low, int axis) noexcept;

/// What else is known of a block, to tell when it must be extracted again.
struct BlockTrace {
  std::uint64_t signs = 0;      ///< where no finer leaf touches it: hash of its insides, 9^3 nodes
  bool reads_coarser = false;   ///< some neighbouring leaf is absent at this level,
  bool values_coarser = false;  ///< and not only for the insides of nodes
};

/// The surface in the live cells of one leaf. Vertices that another block may share carry the key
/// of their lattice edge and have the same bits in every block.
struct SurfaceBlock {
  ContourMesh mesh;
  BlockTrace trace;

  static constexpr bool kIsListed = false;  ///< BlocksOf tells which of them change

  std::int64_t triangle_count() const noexcept {
    return static_cast<std::int64_t>(mesh.triangles.size());
  }
  /// Becomes `from`. Says whether that is another surface, as far as is known without looking.
  bool assign(const SurfaceBlock& from) {
    *this = from;
    return true;
  }
};

/// Extracts blocks one by one. One per thread; nobody may write the stack meanwhile.
class BlockExtractor {
 public:
  explicit BlockExtractor(const ShownLeaves& leaves);

  /// Call it when the stack was written since the last extraction.
  void forget() { view_.forget(); }

  /// The block, until the next call; null when the leaf is absent or has no live cell.
  const SurfaceBlock* extract(int level, const Coord& origin);

  /// The hash that `extract` would put into BlockTrace::signs of a leaf that no finer one
  /// touches; 0 where it would give null.
  std::uint64_t signs(int level, const Coord& origin);

  /// Sends every cell along the path for transitions, or also rebuilds every one from pyramids: the
  /// results must be the same, or as valid. For tests.
  enum class Path { fastest, general, pyramids };
  void set_path(Path path) noexcept { path_ = path; }

 private:
  using Rows = std::array<std::array<std::uint16_t, 9>, 9>;

  /// A vertex that is to be made: on a lattice edge, or the centre of a loop.
  struct Planned {
    std::uint8_t finer = 0;  ///< levels that the edge's is finer than the leaf's
    std::uint8_t axis = kCentre;
    std::array<std::int16_t, 3> low{};  ///< the edge's low node, from the leaf's in that level's
  };
  static constexpr std::uint8_t kCentre = 3;

  /// A cell whose vertices are planned and whose loops are to be filled.
  struct PlannedCell {
    const TracedCell* traced = nullptr;
    std::uint32_t first_corner = 0;  ///< in corners_
    std::uint32_t vertices = 0;      ///< planned when its corners were; those of its centres follow
    int step = 0;                    ///< at which it was planned
    Coord cell;
    bool is_pyramids = false;  ///< whatever its loops are
  };

  // Steps of a block, in the order in which its vertices are numbered: of each row of cells first
  // those beside finer ones, then the others.
  static constexpr int kStepsOfRow = 2 * kLeafSide;
  static constexpr int kSteps = kLeafSide * kLeafSide * kStepsOfRow;

  Rows inside_rows() const;
  void find_quiet_octants();
  void contour();
  void plan(int from);
  void plan_row(int x, int y, int from);
  void plan_general_cell(const Coord& cell, int step);
  void plan_cell(const Coord& cell, const TracedCell& traced, int step, bool is_pyramids);
  std::uint32_t& vertex_of_finer(const Coord& cell, const TracedCut& cut);
  std::uint32_t plan_vertex(const Coord& cell, const TracedCut& cut);
  void forget_planned(std::size_t vertices);
  void place(std::size_t first);
  void place_lanes(std::span<const std::uint32_t> vertices);
  void take_lane(std::size_t lane, std::uint32_t vertex);
  void place_finer(std::uint32_t vertex);
  bool fill(const PlannedCell& cell);
  const TracedCell& trace(const Coord& cell, int depth, int step);
  bool find_insides(const Coord& cell);
  void fill_with_pyramids(const Coord& cell);
  Vec3 normal(int depth, const Coord& low, int axis, double t);
  std::array<float, 3> gradient(int depth, const Coord& node);
  void note_coarser(const Coord& low, int axis);
  LoopBody body(const Coord& cell) const;

  SurfaceView view_;
  ContourCell cell_;
  DividedCells divided_cells_;
  Path path_ = Path::fastest;
  SurfaceBlock out_;  // kept between calls so that its vectors need not grow again
  double voxel_mm_ = 0.0;
  Rows rows_{};
  std::array<bool, 8> skip_{};                         // by octant: refined, or without surface
  std::array<std::uint32_t, kEdgeSlots> vertex_of_{};  // finer 0, by edge_slot()
  std::unordered_map<std::uint64_t, std::uint32_t> finer_vertex_;  // finer > 0, by key
  std::vector<Planned> planned_;                                   // by vertex
  std::vector<PlannedCell> cells_;
  std::vector<std::uint32_t> corners_;          // vertices of the loops of all planned cells
  std::vector<std::uint32_t> in_lanes_;         // vertices to be placed many at once
  std::unordered_map<int, TracedCell> traced_;  // what no table keeps, in this block, by step
  std::vector<LoopCorner> loop_corners_;        // of one cell
  std::vector<float> values_;                   // by node of cell_
  CutEdges lanes_{};
};

}  // namespace argil
