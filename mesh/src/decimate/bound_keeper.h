// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "argil/core/pace.h"
#include "argil/core/triangle_mesh.h"
#include "argil/mesh/decimate.h"

#include "decimate/balls.h"
#include "decimate/collapse_block.h"
#include "decimate/thread_probes.h"
#include "decimate/triangle_walk.h"
#include "decimate/vertex_blocks.h"

namespace argil::mesh {

/// Keeps a surface that is collapsed within a bound of the field: what steps and the fit did stays
/// where it is proven, both ways, and does not fold. Else the fit is taken back around what failed;
/// where that is not enough the vertices there become again what they were before, and steps are
/// tried again with more caution, ever wider around what keeps failing.
///
/// Determinism  same bits for any number of threads.
class BoundKeeper {
 public:
  /// The surface as it is now is what steps go back to; `vertex_for` has which of its vertices each
  /// one of `surface`, that the proof was made for, has become. Positions of `surface` are floats;
  /// all must outlive this.
  BoundKeeper(CollapseState& state, const TriangleMesh& surface,
              const std::vector<std::uint32_t>& vertex_for, const DecimationTarget& target,
              const BoundProof& proof, ThreadProbes& probes);

  /// Fits what has moved, proves all that is not proven, and takes back what fails; steps that are
  /// tried again follow `rules`. Whether all is proven then. Throws Interrupted.
  bool settle(const CollapseRules& rules, const Pace& pace);

  std::size_t triangles() const noexcept { return mesh_.triangles.size(); }  ///< when settled
  bool folds() const noexcept { return folds_; }  ///< has some that were there before
  int most_rounds() const noexcept { return most_rounds_; }

 private:
  static constexpr HalfEdge kNothing = 0xffffffff;
  static constexpr HalfEdge kMany = 0xfffffffe;
  /// What is known of a cell of the proof.
  struct Cell {
    std::uint32_t near = 0;  ///< a vertex near it
    /// Half-edges of the triangles that the proof is about, the last one kMany where there are
    /// more.
    std::array<HalfEdge, 3> relied{kNothing, kNothing, kNothing};
    bool is_proven = false;
  };
  /// Something wrong, and vertices that may have made it so.
  struct Fault {
    Vec3 at_mm;
    std::array<std::uint32_t, 6> vertices;
    std::uint32_t cell = kNothing;        ///< which is not proven, or
    std::array<HalfEdge, 2> triangles{};  ///< what is not, or folds
    bool is_fold = false;
  };
  using Faults = std::vector<Fault>;

  static Balls balls_around(const Faults& faults, double radius_mm);
  bool has_moved(HalfEdge triangle) const;
  bool needs_proof(const Cell& cell) const;
  void fit(const Pace& pace);
  void prove_cells(Faults& faults, const Pace& pace);
  void begin_near(std::uint32_t vertex, std::uint32_t cell, SheetWalks& walks) const;
  void rely_on(const SheetWalks& walks, Cell& cell) const;
  void prove_cell(std::uint32_t c, SheetWalks& walks, Faults& faults);
  void prove_triangles(Faults& faults, const Pace& pace);
  void find_folds(Faults& faults, const Pace& pace);
  Faults find_faults(const Pace& pace);
  bool take_back_fit(const Faults& faults);
  bool is_as_before(HalfEdge triangle) const;
  bool was_there_before(const Fault& fault) const;
  bool was_there_before(const Faults& faults, const Pace& pace) const;
  void raise_caution(const Faults& faults, double radius_mm, const Pace& pace);
  void take_back(const Faults& faults, double radius_mm, const CollapseRules& rules,
                 const Pace& pace);
  std::vector<VertexBlock> separate_blocks(const std::vector<std::uint32_t>& vertices);
  void collapse_again(const std::vector<std::uint32_t>& vertices, const CollapseRules& rules,
                      const Pace& pace);

  CollapseState& state_;
  const TriangleMesh& surface_;
  const std::vector<std::uint32_t>& vertex_for_;
  const DecimationTarget& target_;
  const BoundProof& proof_;
  ThreadProbes& probes_;
  std::vector<Cell> cells_;
  std::vector<std::uint8_t> is_triangle_proven_;  ///< by its number in the state
  const CollapseMesh before_;
  const std::vector<Quadric> quadrics_before_;
  std::vector<Vec3> unfitted_;       ///< of each vertex
  TriangleMesh mesh_;                ///< what is left
  std::vector<std::uint32_t> kept_;  ///< the number of each of its vertices
  bool folds_ = false;
  int most_rounds_ = 0;
};

}  // namespace argil::mesh
