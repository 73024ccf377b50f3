// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include "surface/contour_cell.h"
#include "surface/contour_loop.h"
#include "surface/contour_trace.h"
#include "surface/cut_edges.h"
#include "surface/surface_view.h"
#include "surface/vertex_table.h"

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
  /// The loops of a cell none of whose faces and edges is divided, flat.
  struct PlainCell {
    std::uint8_t loops = 0;
    bool may_cross = false;
    std::array<LoopShape, 4> shapes{};
    std::array<std::uint16_t, 12> slots{};  ///< of the corners of all loops, from the cell's
  };
  /// Any other cell; its corners are vertices or, with kFiner, places in finer_.
  struct GeneralCell {
    const TracedCell* traced = nullptr;
    std::size_t first_corner = 0;  ///< in corners_
    Coord cell;
  };
  /// A vertex on an edge of a level that is finer than the leaf's.
  struct FinerVertex {
    std::uint8_t finer = 0;  ///< by how many levels
    std::uint8_t axis = 0;
    std::array<std::int16_t, 3> low{};  ///< the edge's low node, from the leaf's in that level's
  };
  static constexpr std::uint32_t kFiner = 1U << 31;

  /// Nothing but the table is needed.
  bool is_plain() const noexcept { return view_.uniform() && path_ == Path::fastest; }
  static const std::array<PlainCell, 256>& plain_cells();
  InsideRows inside_rows() const;
  void find_quiet_octants();
  void find_cells();
  void contour();
  void plan_general_cells();
  void plan_general_cell(const Coord& cell);
  std::uint32_t plan_corner(const Coord& cell, const TracedCut& cut);
  const TracedCell& trace(const Coord& cell, int depth);
  std::uint32_t vertex_of(std::uint32_t corner) const noexcept {
    return (corner & kFiner) == 0 ? corner
                                  : static_cast<std::uint32_t>(edges_.count()) + (corner & ~kFiner);
  }
  void place_edges();
  void place_finer(std::size_t place);
  void place_alone(int depth, const Coord& low, int axis, unsigned flags, std::size_t vertex);
  bool is_where_levels_meet(const Coord& node) const;
  void fill_plain_cells();
  void fill_plain_cell(const Coord& cell, const PlainCell& plain);
  void fill_general_cell(const GeneralCell& general);
  void fill_loop(const LoopShape& shape, const std::uint32_t* loop, const Coord& cell,
                 bool may_wait);
  void fill_waiting();
  void look_for_crossings(const Coord& cell, std::size_t vertices, std::size_t triangles);
  bool find_insides(const Coord& cell);
  void fill_with_pyramids(const Coord& cell);
  CutJob cut_job(const float* origin_in_cube, int side, int level, const Coord& origin) const;
  CutVertices vertices_from(std::size_t first);
  bool some_value_is_coarser() const;
  LoopBody body(const Coord& cell) const;

  SurfaceView view_;
  ContourCell cell_;
  DividedCells divided_cells_;
  Path path_ = Path::fastest;
  SurfaceBlock out_;  // kept between calls so that its vectors need not grow again
  double voxel_mm_ = 0.0;
  InsideRows rows_{};
  std::array<bool, 8> skip_{};  // by octant: refined, or without surface
  CellRows plain_{};            // cells with surface that the table has
  CellRows general_{};          // the others
  CutEdges edges_;
  VertexTable finer_place_;  // by key
  std::vector<FinerVertex> finer_;
  std::vector<GeneralCell> general_cells_;
  std::vector<std::uint32_t> corners_;
  std::deque<TracedCell> traced_;  // in this block, what no table keeps
  std::vector<Quadrilateral> waiting_;
  std::vector<std::size_t> waiting_at_;  // the first of their two triangles
  std::vector<unsigned char> is_even_;
  std::vector<std::uint32_t> loop_;
  std::vector<Coord> crossing_;  // cells that are left to pyramids
  std::vector<unsigned short> flat_;
  std::vector<float> values_;  // by node of cell_
};

}  // namespace argil
