// SPDX-License-Identifier: GPL-3.0-or-later
#include "decimate/bound_keeper.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <utility>

#include <tbb/parallel_for.h>

#include "argil/mesh/edges.h"
#include "argil/mesh/intersections.h"
#include "argil/mesh/rounding.h"
#include "argil/mesh/triangle_geometry.h"

#include "decimate/cost_queue.h"
#include "decimate/fit_vertices.h"

namespace argil::mesh {
namespace {

/// After so many nothing more is taken back.
constexpr int kMostRounds = 10;
/// Around what failed for the first time, in voxels, and how often it is doubled.
constexpr double kFirstRadius = 0.5;
constexpr int kMostDoublings = 5;

void sort_unique(std::vector<std::uint32_t>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

/// Runs `work(begin, end, found)` over chunks of fixed size, and puts together what they found in
/// their order.
template <class Item, class Work>
void in_chunks(std::size_t count, std::vector<Item>& all, const Pace& pace, const Work& work) {
  constexpr std::size_t kChunk = 1024;
  constexpr std::size_t kAtATime = 64;  // some 100 ms; then an interruption is heard
  const std::size_t chunks = (count + kChunk - 1) / kChunk;
  std::vector<std::vector<Item>> found(chunks);
  for (std::size_t first = 0; first < chunks; first += kAtATime) {
    pace.at(static_cast<double>(first) / static_cast<double>(chunks));
    tbb::parallel_for(first, std::min(chunks, first + kAtATime), [&](std::size_t chunk) {
      work(chunk * kChunk, std::min(count, (chunk + 1) * kChunk), found[chunk]);
    });
  }
  for (const std::vector<Item>& of : found) all.insert(all.end(), of.begin(), of.end());
}

std::array<std::uint32_t, 3> vertices_of(const CollapseMesh& mesh, HalfEdge h) {
  return {mesh.from(h), mesh.to(h), mesh.to(next_in_triangle(h))};
}

Corners corners_at(const CollapseMesh& mesh, HalfEdge h) {
  const auto& [a, b, c] = vertices_of(mesh, h);
  return {mesh.position(a), mesh.position(b), mesh.position(c)};
}

/// Calls `use(u)` for the vertices that share an edge with `v`, which must be there.
template <class Use>
void for_each_neighbour(const CollapseMesh& mesh, std::uint32_t v, const Use& use) {
  const HalfEdge first = mesh.any_from(v);
  HalfEdge h = first;
  do {
    use(mesh.to(h));
    h = mesh.next_around(h);
  } while (h != first);
}

/// The vertices and their neighbours, ascending.
VertexBlock with_neighbours(const CollapseMesh& mesh, const VertexBlock& vertices) {
  VertexBlock all = vertices;
  for (const std::uint32_t v : vertices) {
    for_each_neighbour(mesh, v, [&](std::uint32_t other) { all.push_back(other); });
  }
  sort_unique(all);
  return all;
}

}  // namespace

BoundKeeper::BoundKeeper(CollapseState& state, const TriangleMesh& surface,
                         const std::vector<std::uint32_t>& vertex_for,
                         const DecimationTarget& target, const BoundProof& proof,
                         ThreadProbes& probes)
    : state_(state),
      surface_(surface),
      vertex_for_(vertex_for),
      target_(target),
      proof_(proof),
      probes_(probes),
      cells_(proof.cells()),
      is_triangle_proven_(state.mesh.half_edges() / 3, 0),
      before_(state.mesh),
      quadrics_before_(state.quadrics) {
  assert(vertex_for.size() == surface.positions.size());
  for (std::uint32_t c = 0; c < cells_.size(); ++c) {
    cells_[c].near = vertex_for[proof.vertex_of(c)];
  }
}

Balls BoundKeeper::balls_around(const Faults& faults, double radius_mm) {
  std::vector<BadPoint> points;
  for (const Fault& fault : faults) points.push_back({fault.at_mm, 0.0});
  return {std::move(points), radius_mm};
}

bool BoundKeeper::has_moved(HalfEdge triangle) const {
  const auto vertices = vertices_of(state_.mesh, triangle);
  return std::any_of(vertices.begin(), vertices.end(),
                     [&](std::uint32_t v) { return state_.moved[v] != 0; });
}

bool BoundKeeper::needs_proof(const Cell& cell) const {
  if (!cell.is_proven || cell.relied.back() == kMany) return true;
  return std::any_of(cell.relied.begin(), cell.relied.end(), [&](HalfEdge h) {
    return h != kNothing && (state_.mesh.is_gone(h) || has_moved(h));
  });
}

/// Only what has moved moves.
void BoundKeeper::fit(const Pace& pace) {
  mesh_ = state_.mesh.mesh(kept_);
  std::vector<bool> fixed;
  for (const std::uint32_t v : kept_) {
    fixed.push_back(state_.moved[v] == 0);
  }
  fit_vertices(mesh_, target_, fixed, pace);
  mesh_ = rounded_to_float(std::move(mesh_));
  for (std::size_t i = 0; i < kept_.size(); ++i) state_.mesh.move(kept_[i], mesh_.positions[i]);
}

/// Begins at what became of a vertex, and of one of each other sheet of the cell.
void BoundKeeper::begin_near(std::uint32_t vertex, std::uint32_t cell, SheetWalks& walks) const {
  walks.begin(walks.mesh().became(vertex));
  for (const std::uint32_t other : proof_.other_vertices_of(cell)) {
    walks.begin_also(walks.mesh().became(vertex_for_[other]));
  }
}

/// Notes the triangles that the answers came from.
void BoundKeeper::rely_on(const SheetWalks& walks, Cell& cell) const {
  cell.near = state_.mesh.from(walks.walks().front().triangle());
  cell.relied.fill(kNothing);
  std::size_t count = 0;
  for (const TriangleWalk& walk : walks.walks()) {
    for (const HalfEdge on : walk.relied_on()) {
      // One half-edge of each triangle, whichever the walk came by.
      const auto h = static_cast<HalfEdge>(3 * triangle_of(on));
      if (std::find(cell.relied.begin(), cell.relied.end(), h) != cell.relied.end()) continue;
      if (count == cell.relied.size()) {
        cell.relied.back() = kMany;
        return;
      }
      cell.relied[count++] = h;
    }
  }
}

/// Looks at the triangle that the cell before was near, then from where it was found last, and
/// where that fails from what became of its own surface.
void BoundKeeper::prove_cell(std::uint32_t c, SheetWalks& walks, Faults& faults) {
  Cell& cell = cells_[c];
  const CollapseMesh& mesh = state_.mesh;
  const std::uint32_t vertex = vertex_for_[proof_.vertex_of(c)];
  cell.is_proven =
      proof_.other_vertices_of(c).empty() && walks.go_on() && proof_.is_near_at_once(c, walks);
  if (cell.is_proven) return rely_on(walks, cell);
  for (const std::uint32_t from : {cell.near, vertex}) {
    begin_near(from, c, walks);
    cell.is_proven = proof_.is_near(c, walks);
    if (cell.is_proven) return rely_on(walks, cell);
  }
  const auto [u, v, w] = vertices_of(mesh, walks.walks().front().triangle());
  const std::uint32_t last = mesh.from(walks.walks().back().triangle());
  faults.push_back({surface_.positions[proof_.vertex_of(c)],
                    {u, v, w, mesh.became(vertex), mesh.became(cell.near), last},
                    c});
}

void BoundKeeper::prove_cells(Faults& faults, const Pace& pace) {
  in_chunks(cells_.size(), faults, pace, [&](std::size_t begin, std::size_t end, Faults& found) {
    SheetWalks walks(state_.mesh);
    for (std::size_t c = begin; c < end; ++c) {
      if (needs_proof(cells_[c])) prove_cell(static_cast<std::uint32_t>(c), walks, found);
    }
  });
}

void BoundKeeper::prove_triangles(Faults& faults, const Pace& pace) {
  const CollapseMesh& mesh = state_.mesh;
  std::vector<HalfEdge> triangles;
  for (HalfEdge h = 0; h < mesh.half_edges(); h += 3) {
    if (mesh.is_gone(h)) continue;
    if (is_triangle_proven_[triangle_of(h)] == 0 || has_moved(h)) triangles.push_back(h);
  }
  in_chunks(triangles.size(), faults, pace, [&](std::size_t begin, std::size_t end, Faults& found) {
    std::vector<Corners> corners;
    for (std::size_t i = begin; i < end; ++i) {
      corners.push_back(corners_at(mesh, triangles[i]));
    }
    std::vector<std::uint8_t> is_near(corners.size());
    proof_.ask_triangles(corners, is_near);
    for (std::size_t i = begin; i < end; ++i) {
      const HalfEdge h = triangles[i];
      is_triangle_proven_[triangle_of(h)] = is_near[i - begin];
      if (is_near[i - begin] != 0) continue;
      const Corners& at = corners[i - begin];
      const auto [u, v, w] = vertices_of(mesh, h);
      found.push_back({middle(at), {u, v, w, u, v, w}, kNothing, {h, h}});
    }
  });
}

void BoundKeeper::find_folds(Faults& faults, const Pace& pace) {
  mesh_ = state_.mesh.mesh(kept_);
  std::vector<HalfEdge> triangles;
  for (HalfEdge h = 0; h < state_.mesh.half_edges(); h += 3) {
    if (!state_.mesh.is_gone(h)) triangles.push_back(h);
  }
  assert(triangles.size() == mesh_.triangles.size());
  folds_ = false;
  const auto add = [&](std::uint32_t s, std::uint32_t t) {
    const Corners at = corners_of(mesh_, s);
    Fault fault{middle(at), {}, kNothing, {triangles[s], triangles[t]}, true};
    for (std::size_t k = 0; k < 3; ++k) {
      fault.vertices[k] = kept_[mesh_.triangles[s][k]];
      fault.vertices[k + 3] = kept_[mesh_.triangles[t][k]];
    }
    if (was_there_before(fault)) {
      folds_ = true;
    } else {
      faults.push_back(fault);
    }
  };
  const std::vector<std::uint32_t> flat = degenerate_triangles(mesh_);
  for (const std::uint32_t t : flat) add(t, t);
  for (const auto& [s, t] : self_intersections(mesh_, flat, pace)) add(s, t);
}

/// Looks at all that depends on what has moved.
BoundKeeper::Faults BoundKeeper::find_faults(const Pace& pace) {
  Faults faults;
  prove_cells(faults, pace.part(0.0, 0.7));
  prove_triangles(faults, pace.part(0.7, 0.9));
  std::fill(state_.moved.begin(), state_.moved.end(), 0);
  find_folds(faults, pace.part(0.9, 1.0));
  return faults;
}

/// Whether there was any at the faults.
bool BoundKeeper::take_back_fit(const Faults& faults) {
  bool has_any = false;
  for (const Fault& fault : faults) {
    for (const std::uint32_t v : fault.vertices) {
      if (state_.mesh.position(v) == unfitted_[v]) continue;
      state_.mesh.move(v, unfitted_[v]);
      state_.moved[v] = 1;
      has_any = true;
    }
  }
  return has_any;
}

bool BoundKeeper::is_as_before(HalfEdge triangle) const {
  return !before_.is_gone(triangle) &&
         corners_at(state_.mesh, triangle) == corners_at(before_, triangle);
}

/// Whether no step is at fault: what nothing was done to is wrong by itself, and so is a cell that
/// is not proven with what was there before either.
bool BoundKeeper::was_there_before(const Fault& fault) const {
  if (fault.cell != kNothing) {
    SheetWalks walks(before_);
    begin_near(vertex_for_[proof_.vertex_of(fault.cell)], fault.cell, walks);
    return !proof_.is_near(fault.cell, walks);
  }
  return is_as_before(fault.triangles[0]) && is_as_before(fault.triangles[1]);
}

bool BoundKeeper::was_there_before(const Faults& faults, const Pace& pace) const {
  constexpr std::size_t kBetweenReports = 256;
  for (std::size_t i = 0; i < faults.size(); ++i) {
    if (i % kBetweenReports == 0) pace.at(0.0);
    if (was_there_before(faults[i])) return true;
  }
  return false;
}

/// Of the vertices that were around the faults, and of those next to them. Where the surface folds
/// no smaller reach helps: there it stays.
void BoundKeeper::raise_caution(const Faults& faults, double radius_mm, const Pace& pace) {
  std::vector<std::uint32_t> raised;
  for (const Fault& fault : faults) {
    for (const std::uint32_t v : fault.vertices) {
      raised.push_back(v);
      for_each_neighbour(before_, v, [&](std::uint32_t other) { raised.push_back(other); });
      if (fault.is_fold) state_.caution[v] = CollapseState::kStays;
    }
  }
  const Balls balls = balls_around(faults, radius_mm);
  in_chunks(before_.vertices(), raised, pace,
            [&](std::size_t begin, std::size_t end, std::vector<std::uint32_t>& found) {
              for (auto v = static_cast<std::uint32_t>(begin); v < end; ++v) {
                const bool was_there = before_.any_from(v) != CollapseMesh::kGone;
                if (was_there && balls.hold(before_.position(v))) found.push_back(v);
              }
            });
  sort_unique(raised);
  for (const std::uint32_t v : raised) {
    if (state_.caution[v] < CollapseState::kStays) ++state_.caution[v];
  }
}

/// Vertices of the faults, and those that are around these now, become what they were before.
void BoundKeeper::take_back(const Faults& faults, double radius_mm, const CollapseRules& rules,
                            const Pace& pace) {
  std::vector<std::uint32_t> around;
  for (const Fault& fault : faults) {
    around.insert(around.end(), fault.vertices.begin(), fault.vertices.end());
  }
  const Balls balls = balls_around(faults, radius_mm);
  in_chunks(kept_.size(), around, pace,
            [&](std::size_t begin, std::size_t end, std::vector<std::uint32_t>& found) {
              for (std::size_t i = begin; i < end; ++i) {
                if (balls.hold(state_.mesh.position(kept_[i]))) found.push_back(kept_[i]);
              }
            });
  std::vector<std::uint8_t> goes_back(state_.mesh.vertices(), 0);
  for (const std::uint32_t v : around) goes_back[v] = 1;
  const std::vector<std::uint32_t> back = state_.mesh.restore(before_, goes_back, pace);
  for (const std::uint32_t v : back) {
    state_.quadrics[v] = quadrics_before_[v];
    state_.moved[v] = 1;
  }
  collapse_again(back, rules, pace);
}

/// These vertices, those next to them, which move too, and those next to these: in blocks of which
/// no two have one in common, ascending by their first vertices.
std::vector<VertexBlock> BoundKeeper::separate_blocks(const std::vector<std::uint32_t>& vertices) {
  const CollapseMesh& mesh = state_.mesh;
  const VertexBlock moving = with_neighbours(mesh, vertices);
  std::fill(state_.stays.begin(), state_.stays.end(), 1);
  DisjointSets sets(mesh.vertices());
  for (const std::uint32_t v : moving) {
    state_.stays[v] = 0;
    for_each_neighbour(mesh, v, [&](std::uint32_t other) { sets.unite(v, other); });
  }
  // A set is named by its first vertex, which comes before all others of it.
  std::vector<VertexBlock> blocks;
  std::vector<std::size_t> block_of(mesh.vertices(), 0);
  for (const std::uint32_t v : with_neighbours(mesh, moving)) {
    const std::uint32_t name = sets.find(v);
    if (name == v) {
      block_of[v] = blocks.size();
      blocks.emplace_back();
    }
    blocks[block_of[name]].push_back(v);
  }
  return blocks;
}

/// Only vertices that went back and their neighbours move. What goes on in one place has nothing to
/// do with another: the same as one after the other.
void BoundKeeper::collapse_again(const std::vector<std::uint32_t>& vertices,
                                 const CollapseRules& rules, const Pace& pace) {
  std::vector<CollapseBlock> blocks;
  for (const VertexBlock& block : separate_blocks(vertices)) {
    blocks.emplace_back(state_, block, rules);
  }
  advance_to_end(blocks, CostQueue::kClasses - 1, probes_, pace);
}

bool BoundKeeper::settle(const CollapseRules& rules, const Pace& pace) {
  const Pace rest = pace.part(0.8, 0.8);
  for (int round = 0;; ++round) {
    most_rounds_ = std::max(most_rounds_, round);
    state_.mesh.shorten_ways();
    state_.mesh.round_to_float();
    unfitted_ = state_.mesh.positions();
    // Most of the work is to look at everything once.
    const bool is_first = round == 0;
    fit(is_first ? pace.part(0.0, 0.1) : rest);
    Faults faults = find_faults(is_first ? pace.part(0.1, 0.8) : rest);
    while (take_back_fit(faults)) faults = find_faults(rest);
    if (faults.empty()) return true;
    // What was wrong before may be mended by steps and the fit, but not by going back once more.
    const bool may_be_mended = round < CollapseState::kStays || !was_there_before(faults, rest);
    if (!may_be_mended || round == kMostRounds) return false;
    // What is at fault may lie beside: ever wider, but only the vertices themselves at first.
    const int doublings = std::min(round, kMostDoublings);
    const double radius_mm = kFirstRadius * (1 << doublings) * target_.voxel_mm();
    raise_caution(faults, radius_mm, rest);
    take_back(faults, round == 0 ? 0.0 : radius_mm, rules, rest);
  }
}

}  // namespace argil::mesh
