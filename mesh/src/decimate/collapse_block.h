// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "argil/core/distance_probe.h"
#include "argil/core/pace.h"
#include "argil/core/triangle_mesh.h"

#include "decimate/collapse_mesh.h"
#include "decimate/cost_queue.h"
#include "decimate/quadric.h"
#include "decimate/thread_probes.h"
#include "decimate/vertex_blocks.h"

namespace argil::mesh {

/// What all blocks of a surface share: each changes only what belongs to its own vertices.
struct CollapseState {
  /// Quadrics of the triangles around each vertex. `voxel_mm` of the field, greater than 0.
  CollapseState(CollapseMesh made, const Box3& box, double voxel_mm);

  /// Forgets all that is gone, when no block is at work: what looks at everything from then on
  /// takes as long as what is left. Vertices and half-edges get new numbers in the old order, with
  /// no mark but `moved`; returns that of what each vertex has become.
  std::vector<std::uint32_t> compact();

  CollapseMesh mesh;
  Vec3 centre;  ///< quadrics are about it
  std::vector<Quadric> quadrics;
  std::vector<std::uint16_t> class_of;  ///< of each edge, for the queues
  std::vector<std::uint8_t> refusals;   ///< of each edge
  std::vector<std::uint8_t> stays;      ///< of each vertex: neither goes nor moves
  std::vector<std::uint8_t> moved;      ///< of each vertex: by a step since this was last made 0
  std::vector<std::uint32_t>
      last_step;  ///< of each vertex: which of its block's steps moved it last
  /// Of each vertex: how often steps here were taken back, or kStays, after which there are none.
  std::vector<std::uint8_t> caution;
  static constexpr std::uint8_t kStays = 4;
  // Between these classes what was refused is tried again each time steps cost twice as much.
  std::uint16_t first_wait = 0;  ///< what costs less is nothing: a thousandth of a voxel
  std::uint16_t last_wait = 0;   ///< no step costs more
};

/// How steps are judged.
struct CollapseRules {
  /// No step goes farther from the field, four fifths as far for each time that a step was taken
  /// back there; 0: no bound.
  double reach_mm = 0.0;
  /// Steps of this class and above ask the field, and its distance is a part of their cost.
  std::uint16_t first_asking = CostQueue::kClasses;
};

/// Collapses edges between the vertices of one block, in order of cost.
///
/// Threads      one; blocks that share a state run at the same time where the neighbours of every
///              vertex that may move are of its own block.
class CollapseBlock {
 public:
  CollapseBlock(CollapseState& state, const VertexBlock& vertices, const CollapseRules& rules);

  /// The class of the cheapest edge, CostQueue::kClasses when none is left.
  std::uint16_t next_class() noexcept { return queue_.next_class(); }
  /// Steps in classes up to `last`, `most` of them at most; returns how many. `field` is of this
  /// thread.
  std::size_t advance(std::uint16_t last, std::size_t most, DistanceProbe& field);
  /// As advance, but until so many edges were looked at, whether that made steps of them or not.
  std::size_t look_at(std::uint16_t last, std::size_t edges, DistanceProbe& field);
  std::size_t vertices_left() const noexcept { return vertices_left_; }

 private:
  /// A triangle that a step changes: the moved vertex, then two that stay, seen from outside.
  struct StarTriangle {
    Vec3 right, left;
    Vec3 area_normal;    ///< as it was
    double shape = 0.0;  ///< as it was: twice its area to its longest side squared
  };
  struct Step {
    HalfEdge edge = 0;
    Vec3 position;
    double cost = 0.0;
  };
  /// What the field was found to make of a step that waits for its turn.
  struct Asked {
    std::uint16_t cost_class = 0;
    std::uint32_t after_step = 0;  ///< of the block
  };

  bool is_bounded() const noexcept { return rules_.reach_mm > 0.0; }
  void put_all(const VertexBlock& vertices);
  HalfEdge edge_of(HalfEdge h) const noexcept;
  Step step_for(HalfEdge edge) const;
  void put(HalfEdge h);
  void gather_star(HalfEdge edge);
  void gather_fan(HalfEdge from, HalfEdge edge);
  double least_shape(HalfEdge edge) const;
  bool keeps_shape(const Step& step) const;
  int caution_at(HalfEdge edge) const noexcept;
  std::optional<double> field_cost(const Step& step);
  bool has_cost(const Step& step);
  bool has_cost_still(HalfEdge edge);
  void refuse(HalfEdge edge);
  bool try_step(HalfEdge edge);
  template <class GoesOn>
  std::size_t advance_while(std::uint16_t last, DistanceProbe& field, const GoesOn& goes_on);
  bool is_allowed(const Step& step);
  void apply(const Step& step);

  CollapseState& state_;
  CollapseMesh& mesh_;
  std::size_t vertices_left_;
  DistanceProbe* field_ = nullptr;  ///< while it advances
  CollapseRules rules_;
  CostQueue queue_;
  std::unordered_map<HalfEdge, Asked> asked_;
  std::uint32_t steps_ = 0;
  std::vector<StarTriangle> star_;
  std::vector<std::uint32_t> ring_;
};

/// Advances blocks through classes up to `last`, to their ends, and hears an interruption now and
/// then; returns how many steps that took. Throws Interrupted.
std::size_t advance_to_end(std::vector<CollapseBlock>& blocks, std::uint16_t last,
                           ThreadProbes& probes, const Pace& pace);

}  // namespace argil::mesh
