// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "argil/core/pace.h"
#include "argil/core/triangle_mesh.h"
#include "argil/mesh/decimate.h"

#include "decimate/balls.h"
#include "decimate/collapse_block.h"
#include "decimate/triangle_walk.h"
#include "decimate/vertex_blocks.h"

namespace argil::mesh {

/// Keeps a surface that is collapsed by blocks within a bound of the field: what the steps and the
/// fit of a block did stays where it is proven, both ways, and does not fold. Else the fit is taken
/// back around what failed; where that is not enough the block goes back to what it was before and
/// tries again with more caution there, and after a few times stays as it was.
///
/// Determinism  same bits for any number of threads.
class BoundKeeper {
 public:
  /// Positions of `surface` are floats; all must outlive this.
  BoundKeeper(CollapseState& state, const TriangleMesh& surface, const DecimationTarget& target,
              const BoundProof& proof);

  /// Remembers what blocks go back to; `blocks` must stay until settle() has returned.
  void begin(const std::vector<VertexBlock>& blocks);
  /// Proves all blocks after their steps, with `fits` fitted to the field, and takes back what
  /// fails; blocks that try again take steps by `rules` in classes up to `last`. Returns the
  /// triangles left. Throws Interrupted.
  std::size_t settle(const CollapseRules& rules, std::uint16_t last, bool fits, const Pace& pace);

  /// Proves also what no block ever changed. Throws Interrupted.
  bool is_all_proven(const Pace& pace);
  bool folds() const noexcept { return folds_; }
  int most_tries() const noexcept { return most_tries_; }

 private:
  static constexpr HalfEdge kNothing = 0xffffffff;
  static constexpr HalfEdge kMany = 0xfffffffe;
  /// What is known of a cell of the proof.
  struct Cell {
    std::uint32_t near = 0;         ///< a vertex near it
    std::uint32_t near_before = 0;  ///< when the blocks began
    /// Half-edges of the triangles that the proof is about, the last one kMany where there are
    /// more.
    std::array<HalfEdge, 3> relied{kNothing, kNothing, kNothing};
    bool is_proven = false;
    bool was_proven = false;  ///< when the blocks began
  };
  /// Something wrong, and vertices that may have made it so.
  struct Fault {
    BadPoint point;
    std::array<std::uint32_t, 6> vertices;
    bool was_good = true;  ///< before the blocks changed
    bool is_fold = false;
  };
  using Faults = std::vector<Fault>;

  bool has_moved(HalfEdge triangle) const;
  bool triangle_needs_proof(HalfEdge h) const;
  bool needs_proof(const Cell& cell) const;
  void fit();
  template <class Which>
  void prove_cells(const Which& which, Faults& faults, const Pace& pace);
  void prove_cell(std::uint32_t c, TriangleWalk& walk, Faults& faults);
  void prove_triangles(Faults& faults, const Pace& pace);
  void find_folds(Faults& faults, const Pace& pace);
  Faults find_faults(const Pace& pace);
  bool take_back_fit(const Faults& faults);
  std::vector<std::uint8_t> blamed(const Faults& faults) const;
  void restore(const VertexBlock& block);
  void raise_caution(const Faults& faults, double widen_mm);
  void take_back(const std::vector<std::uint8_t>& bad, const CollapseRules& rules,
                 std::uint16_t last);

  CollapseState& state_;
  const TriangleMesh& surface_;
  const DecimationTarget& target_;
  const BoundProof& proof_;
  std::vector<Cell> cells_;
  std::vector<std::uint8_t> is_triangle_proven_;  ///< by its number in the surface
  std::vector<std::uint8_t> was_triangle_proven_;
  const std::vector<VertexBlock>* blocks_ = nullptr;
  std::vector<std::uint32_t> block_of_;  ///< of each vertex
  CollapseMesh before_;
  std::vector<Quadric> quadrics_before_;
  std::vector<Vec3> unfitted_;             ///< of each vertex
  std::vector<std::uint8_t> has_changed_;  ///< of each block: not as it was before
  std::vector<int> tries_;                 ///< of each block
  TriangleMesh mesh_;                      ///< what is left
  std::vector<std::uint32_t> kept_;        ///< the number of each of its vertices
  bool folds_ = false;
  int most_tries_ = 0;
};

}  // namespace argil::mesh
