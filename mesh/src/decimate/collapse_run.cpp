// SPDX-License-Identifier: GPL-3.0-or-later
// A run goes in phases, each over blocks of vertices that lie together and class of cost by class
// of cost in all blocks at the same time: independent of threads, and for the whole surface as if
// there were no blocks. Vertices next to another block wait for the next phase, which cuts
// elsewhere.
#include "decimate/collapse_run.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include <tbb/parallel_for.h>

#include "argil/mesh/rounding.h"

#include "decimate/bound_keeper.h"
#include "decimate/collapse_block.h"
#include "decimate/thread_probes.h"
#include "decimate/vertex_blocks.h"

namespace argil::mesh {
namespace {

constexpr std::size_t kBlockVertices = 8192;
/// Of the bound, what is in hand for the distance between samples: by steps, that look at few, and
/// by the proof, which is exact.
constexpr double kStepFraction = 0.85;
constexpr double kProvenFraction = 0.98;
/// Of the bound, how far steps go about that are too cheap to ask the field.
constexpr double kFreeFraction = 0.3;

class CollapseRun {
 public:
  CollapseRun(CollapseMesh mesh, const TriangleMesh& surface, const DecimationTarget& target,
              std::int64_t triangles, const std::vector<bool>& locked)
      : state_(std::move(mesh), bounds(surface), target.voxel_mm()),
        probes_(target),
        target_(target),
        locked_(locked),
        from_(surface.triangles.size()),
        triangles_(from_),
        has_count_(triangles > 0),
        // No closed mesh has fewer than the four triangles of a tetrahedron.
        enough_(static_cast<std::size_t>(std::max<std::int64_t>(triangles, 4))) {
    assert(locked.empty() || locked.size() == surface.positions.size());
  }

  Collapsed run(const Pace& pace);
  CollapsedWithin run_within(const TriangleMesh& surface, const BoundProof& proof, double bound_mm,
                             bool is_careful, const Pace& pace);

 private:
  /// How far a phase goes, by triangles more than are wanted, where its blocks are cut and how its
  /// steps are judged.
  struct Phase {
    std::size_t more = 0;
    double fraction = 0.5;
    CollapseRules rules;
    std::size_t block = kBlockVertices;       ///< vertices, at most
    std::uint16_t end = CostQueue::kClasses;  ///< steps of this class and above wait
  };

  std::vector<VertexBlock> cut(const Phase& phase) const;
  std::size_t mark_rims(const std::vector<VertexBlock>& blocks);
  std::vector<CollapseBlock> begin(const std::vector<VertexBlock>& cut, const CollapseRules& rules);
  void advance(const Phase& phase, const Pace& pace);
  void advance_to(std::size_t goal, std::uint16_t end, std::vector<CollapseBlock>& blocks,
                  const Pace& pace);
  std::uint16_t advance_class(std::vector<CollapseBlock>& blocks, std::size_t goal,
                              std::uint16_t end);
  Collapsed collapsed() const;
  bool is_locked(std::uint32_t v) const { return !locked_.empty() && locked_[v]; }

  CollapseState state_;
  ThreadProbes probes_;
  const DecimationTarget& target_;
  const std::vector<bool>& locked_;  ///< of the surface's vertices; none where it is empty
  std::vector<std::uint32_t> surface_vertex_;  ///< that each one is, once the state is compact
  std::size_t from_;
  std::size_t triangles_;  ///< left
  bool has_count_;
  std::size_t enough_;
};

std::vector<VertexBlock> CollapseRun::cut(const Phase& phase) const {
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t v = 0; v < state_.mesh.vertices(); ++v) {
    if (state_.mesh.any_from(v) != CollapseMesh::kGone) vertices.push_back(v);
  }
  return vertex_blocks(state_.mesh.positions(), std::move(vertices), phase.block, phase.fraction);
}

/// Keeps what is locked and what has a neighbour in another block; returns how many of these.
std::size_t CollapseRun::mark_rims(const std::vector<VertexBlock>& blocks) {
  const CollapseMesh& mesh = state_.mesh;
  std::vector<std::uint32_t> block_of(mesh.vertices(), 0);
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t b) {
    for (const std::uint32_t v : blocks[b]) block_of[v] = static_cast<std::uint32_t>(b);
  });
  std::vector<std::size_t> rims(blocks.size(), 0);
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t b) {
    for (const std::uint32_t v : blocks[b]) {
      bool is_rim = false;
      const HalfEdge first = mesh.any_from(v);
      HalfEdge h = first;
      do {
        is_rim = is_rim || block_of[mesh.to(h)] != b;
        h = mesh.next_around(h);
      } while (h != first);
      state_.stays[v] = is_rim || is_locked(v) ? 1 : 0;
      rims[b] += is_rim ? 1 : 0;
    }
  });
  return std::accumulate(rims.begin(), rims.end(), std::size_t{0});
}

std::vector<CollapseBlock> CollapseRun::begin(const std::vector<VertexBlock>& cut,
                                              const CollapseRules& rules) {
  std::vector<std::optional<CollapseBlock>> made(cut.size());
  tbb::parallel_for(std::size_t{0}, cut.size(),
                    [&](std::size_t b) { made[b].emplace(state_, cut[b], rules); });
  std::vector<CollapseBlock> blocks;
  for (std::optional<CollapseBlock>& block : made) blocks.push_back(std::move(*block));
  return blocks;
}

/// Takes steps of the cheapest class in all blocks, as many as are left to `goal`; returns that
/// class, `end` or more where there are no steps before that.
std::uint16_t CollapseRun::advance_class(std::vector<CollapseBlock>& blocks, std::size_t goal,
                                         std::uint16_t end) {
  // Between two of these calls an interruption is heard.
  constexpr std::size_t kMostSteps = 4096;
  std::uint16_t cheapest = CostQueue::kClasses;
  for (CollapseBlock& block : blocks) cheapest = std::min(cheapest, block.next_class());
  if (cheapest >= end) return cheapest;
  std::vector<CollapseBlock*> cheap;
  std::size_t left = 0;
  for (CollapseBlock& block : blocks) {
    if (block.next_class() != cheapest) continue;
    cheap.push_back(&block);
    left += block.vertices_left();
  }
  // Where a class has more than is wanted each block takes its share of it, and the first ones what
  // the division leaves.
  const std::size_t wanted = (triangles_ - goal + 1) / 2;
  std::vector<std::size_t> steps(cheap.size());
  std::size_t shared = 0;
  for (std::size_t b = 0; b < cheap.size(); ++b) {
    steps[b] = wanted * cheap[b]->vertices_left() / left;
    shared += steps[b];
  }
  for (std::size_t b = 0; b < cheap.size() && shared < wanted; ++b, ++shared) ++steps[b];
  tbb::parallel_for(std::size_t{0}, cheap.size(), [&](std::size_t b) {
    steps[b] = cheap[b]->advance(cheapest, std::min(steps[b], kMostSteps), probes_.mine());
  });
  triangles_ -= 2 * std::accumulate(steps.begin(), steps.end(), std::size_t{0});
  return cheapest;
}

void CollapseRun::advance_to(std::size_t goal, std::uint16_t end,
                             std::vector<CollapseBlock>& blocks, const Pace& pace) {
  const auto whole = static_cast<double>(from_ - std::min(from_ - 1, enough_));
  std::uint16_t last = 0;
  while (triangles_ > goal && last < end) {
    last = advance_class(blocks, goal, end);
    pace.at(static_cast<double>(from_ - triangles_) / whole);
  }
}

void CollapseRun::advance(const Phase& phase, const Pace& pace) {
  if (triangles_ <= enough_ + phase.more) return;
  const std::vector<VertexBlock> blocks = cut(phase);
  const std::size_t rims = mark_rims(blocks);
  std::vector<CollapseBlock> runs = begin(blocks, phase.rules);
  if (!has_count_) {
    // The same as class by class where no count is to be reached.
    triangles_ -= 2 * advance_to_end(runs, phase.end - 1, probes_, pace);
    return;
  }
  const std::size_t goal = enough_ + phase.more + (phase.more > 0 ? 2 * rims : 0);
  advance_to(goal, phase.end, runs, pace);
}

Collapsed CollapseRun::collapsed() const {
  Collapsed done;
  done.steps = static_cast<std::int64_t>((from_ - triangles_) / 2);
  done.mesh = state_.mesh.mesh(done.kept);
  if (!surface_vertex_.empty()) {
    for (std::uint32_t& v : done.kept) v = surface_vertex_[v];
  }
  assert(done.kept.size() == done.mesh.positions.size() &&
         done.mesh.triangles.size() == triangles_);
  return done;
}

Collapsed CollapseRun::run(const Pace& pace) {
  // The field is asked only by the last steps: what it adds to the quality is made there. Before,
  // every block goes as far as the others; what that leaves to the end must not be more than half
  // of what is wanted, or else the last steps cannot mend it.
  constexpr double kLateFraction = 0.05;
  constexpr double kLateOfWanted = 0.5;
  const auto late = static_cast<std::size_t>(std::min(
      kLateFraction * static_cast<double>(from_), kLateOfWanted * static_cast<double>(enough_)));
  const CollapseRules never;
  const CollapseRules always{0.0, 0};
  // The last phase is of one block: there goes what a cut leaves undone.
  for (const Phase& phase : {Phase{2 * late, 0.5, never}, Phase{late, 0.4, never},
                             Phase{0, 0.55, always}, Phase{0, 0.5, always, from_}}) {
    advance(phase, pace);
  }
  return collapsed();
}

CollapsedWithin CollapseRun::run_within(const TriangleMesh& surface, const BoundProof& proof,
                                        double bound_mm, bool is_careful, const Pace& pace) {
  // What costs less is far from the bound, and need not be asked or proven before it is used.
  const double least = kFreeFraction * bound_mm * target_.voxel_mm();
  const std::uint16_t first_asking = is_careful ? 0 : CostQueue::class_for(least * least);
  const CollapseRules rules{kStepFraction * bound_mm, first_asking};
  if (!is_careful) {
    // Of a count some are left for the phases that ask.
    const std::size_t more = has_count_ ? from_ / 20 : 0;
    advance({more, 0.5, rules, kBlockVertices, first_asking}, pace.part(0.0, 0.4));
    advance({more, 0.4, rules, kBlockVertices, first_asking}, pace.part(0.4, 0.5));
  }
  state_.mesh.round_to_float();
  state_.mesh.shorten_ways();
  static_cast<void>(state_.mesh.mesh(surface_vertex_));
  const std::vector<std::uint32_t> vertex_for = state_.compact();
  BoundKeeper keeper(state_, surface, vertex_for, target_, proof, probes_);
  advance({0, 0.55, rules, 2048}, pace.part(0.5, 0.65));
  advance({0, 0.45, rules, 1024}, pace.part(0.65, 0.7));
  advance({0, 0.6, rules, 4096}, pace.part(0.7, 0.75));
  CollapsedWithin done;
  done.is_proven = keeper.settle(rules, pace.part(0.75, 0.95));
  triangles_ = keeper.triangles();
  if (done.is_proven && triangles_ > enough_) {
    // Where something was taken back more is left to do. What is proven stands where that fails.
    done.has_folds = keeper.folds();
    done.collapsed = collapsed();
    advance({0, 0.52, rules, 4096}, pace.part(0.95, 0.96));
    if (!keeper.settle(rules, pace.part(0.96, 1.0))) {
      done.tries = 1 + keeper.most_rounds();
      return done;
    }
    triangles_ = keeper.triangles();
  }
  done.has_folds = keeper.folds();
  done.tries = 1 + keeper.most_rounds();
  done.collapsed = collapsed();
  return done;
}

const char* const kNotClosed =
    "the surface is not closed and two-manifold; repair it before removing triangles";

}  // namespace

Result<Collapsed> collapse_edges(const TriangleMesh& surface, const DecimationTarget& target,
                                 std::int64_t triangles, const std::vector<bool>& locked,
                                 const Pace& pace) {
  std::optional<CollapseMesh> mesh = CollapseMesh::build(surface);
  if (!mesh) return Error{ErrorKind::bad_input, kNotClosed};
  return CollapseRun(std::move(*mesh), surface, target, triangles, locked).run(pace);
}

Result<CollapsedWithin> collapse_within(const TriangleMesh& surface, const DecimationTarget& target,
                                        const DecimateOptions& options, const Pace& pace) {
  const std::unique_ptr<BoundProof> proof =
      target.proof(kProvenFraction * options.max_error_mm, pace.part(0.0, 0.1));
  const std::vector<bool> none_locked;
  const TriangleMesh rounded = rounded_to_float(surface);
  const auto run = [&](bool is_careful) -> Result<CollapsedWithin> {
    std::optional<CollapseMesh> mesh = CollapseMesh::build(rounded);
    if (!mesh) return Error{ErrorKind::bad_input, kNotClosed};
    return CollapseRun(std::move(*mesh), rounded, target, options.triangles, none_locked)
        .run_within(rounded, *proof, options.max_error_mm, is_careful, pace.part(0.1, 1.0));
  };
  Result<CollapsedWithin> made = run(false);
  // Rarely something that looked free was not: then nothing is, and all falls back on the surface.
  const bool is_good = !made || (made.value().is_proven && !made.value().has_folds);
  return is_good ? std::move(made) : run(true);
}

}  // namespace argil::mesh
