// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "surface/contour_cell.h"
#include "surface/contour_loop.h"
#include "surface/surface_view.h"

namespace argil {

/// How far a cut keeps from the ends of its lattice edge, as a fraction of the edge. Measured in
/// docs/surface.md: the larger, the fewer slivers and the more deviation.
inline constexpr double kCutClamp = 0.02;

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

  Rows inside_rows() const;
  void find_quiet_octants();
  void contour_row(int x, int y);
  void contour_table_cell(const Coord& cell, unsigned pattern);
  void contour_general_cell(const Coord& cell);
  bool find_insides(const Coord& cell);
  bool fill_loops(std::span<const LoopCorner> corners, std::span<const std::uint16_t> lengths,
                  const Coord& cell, bool regular);
  void fill_with_pyramids(const Coord& cell);
  std::uint32_t vertex(int depth, const Coord& low, int axis);
  std::uint32_t add_vertex(int depth, const Coord& low, int axis);
  Vec3 dense_normal(const Coord& low, int axis, double t);
  Vec3 normal(int depth, const Coord& low, int axis, double t);
  std::array<float, 3> gradient(int depth, const Coord& node);
  void note_coarser(const Coord& low, int axis);
  LoopBody body(const Coord& cell) const;

  SurfaceView view_;
  ContourCell cell_;
  Path path_ = Path::fastest;
  SurfaceBlock out_;  // kept between calls so that its vectors need not grow again
  double voxel_mm_ = 0.0;
  Rows rows_{};
  std::array<bool, 8> skip_{};                            // by octant: refined, or without surface
  std::array<std::uint32_t, 3 * 9 * 9 * 9> vertex_of_{};  // depth 0, by axis and low node
  std::unordered_map<std::uint64_t, std::uint32_t> finer_vertex_;  // depth > 0, by key
  std::vector<float> values_;                                      // by node of cell_
  std::vector<LoopCorner> cut_corners_;                            // by cut of cell_
  std::vector<LoopCorner> corners_;
  std::vector<std::uint16_t> lengths_;
};

}  // namespace argil
