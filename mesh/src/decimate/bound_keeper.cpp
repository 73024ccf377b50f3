// SPDX-License-Identifier: GPL-3.0-or-later
#include "decimate/bound_keeper.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include <tbb/parallel_for.h>

#include "argil/mesh/intersections.h"
#include "argil/mesh/rounding.h"
#include "argil/mesh/triangle_geometry.h"

#include "decimate/fit_vertices.h"

namespace argil::mesh {
namespace {

/// How often a block tries before it is left as it was.
constexpr int kMostBlockTries = 3;

/// Runs `work(begin, end, found)` over chunks of fixed size, and puts together what they found in
/// their order.
template <class Item, class Work>
void in_chunks(std::size_t count, std::vector<Item>& all, const Pace& pace, const Work& work) {
  constexpr std::size_t kChunk = 1024;
  constexpr std::size_t kAtATime = 256;
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

}  // namespace

BoundKeeper::BoundKeeper(CollapseState& state, const TriangleMesh& surface,
                         const DecimationTarget& target, const BoundProof& proof)
    : state_(state),
      surface_(surface),
      target_(target),
      proof_(proof),
      cells_(proof.cells()),
      is_triangle_proven_(surface.triangles.size(), 0),
      block_of_(surface.positions.size(), 0) {
  state.mesh.shorten_ways();
  for (std::uint32_t c = 0; c < cells_.size(); ++c) cells_[c].near = proof.vertex_of(c);
}

bool BoundKeeper::has_moved(HalfEdge triangle) const {
  const auto vertices = vertices_of(state_.mesh, triangle);
  return std::any_of(vertices.begin(), vertices.end(),
                     [&](std::uint32_t v) { return state_.moved[v] != 0; });
}

/// What cannot have changed is proven at the end.
bool BoundKeeper::triangle_needs_proof(HalfEdge h) const {
  if (has_moved(h)) return true;
  if (is_triangle_proven_[triangle_of(h)] != 0) return false;
  const auto vertices = vertices_of(state_.mesh, h);
  return std::any_of(vertices.begin(), vertices.end(),
                     [&](std::uint32_t v) { return state_.stays[v] == 0; });
}

bool BoundKeeper::needs_proof(const Cell& cell) const {
  if (!cell.is_proven || cell.relied.back() == kMany) return true;
  return std::any_of(cell.relied.begin(), cell.relied.end(), [&](HalfEdge h) {
    return h != kNothing && (state_.mesh.is_gone(h) || has_moved(h));
  });
}

void BoundKeeper::begin(const std::vector<VertexBlock>& blocks) {
  blocks_ = &blocks;
  for (std::uint32_t b = 0; b < blocks.size(); ++b) {
    for (const std::uint32_t v : blocks[b]) block_of_[v] = b;
  }
  before_ = state_.mesh;
  quadrics_before_ = state_.quadrics;
  was_triangle_proven_ = is_triangle_proven_;
  has_changed_.assign(blocks.size(), 1);
  tries_.assign(blocks.size(), 0);
  for (Cell& cell : cells_) {
    cell.near = cell.near_before = state_.mesh.became(cell.near);
    cell.was_proven = cell.is_proven;
  }
}

/// Only what has moved moves.
void BoundKeeper::fit() {
  mesh_ = state_.mesh.mesh(kept_);
  std::vector<bool> fixed;
  for (const std::uint32_t v : kept_) {
    fixed.push_back(state_.moved[v] == 0 || state_.stays[v] != 0);
  }
  fit_vertices(mesh_, target_, fixed);
  mesh_ = rounded_to_float(std::move(mesh_));
  for (std::size_t i = 0; i < kept_.size(); ++i) state_.mesh.move(kept_[i], mesh_.positions[i]);
}

/// Looks from where it was found last, and where that fails from where it was before and from what
/// became of its own surface.
void BoundKeeper::prove_cell(std::uint32_t c, TriangleWalk& walk, Faults& faults) {
  Cell& cell = cells_[c];
  const CollapseMesh& mesh = state_.mesh;
  const std::uint32_t vertex = proof_.vertex_of(c);
  cell.is_proven = false;
  for (const std::uint32_t from : {cell.near, cell.near_before, vertex}) {
    walk.begin(mesh.became(from));
    cell.is_proven = proof_.is_near(c, walk);
    if (cell.is_proven) break;
  }
  if (!cell.is_proven) {
    const auto [u, v, w] = vertices_of(mesh, walk.triangle());
    faults.push_back({{surface_.positions[vertex], target_.voxel_mm()},
                      {u, v, w, mesh.became(vertex), mesh.became(cell.near), cell.near_before},
                      cell.was_proven});
    return;
  }
  cell.near = mesh.from(walk.triangle());
  cell.relied.fill(kNothing);
  std::size_t count = 0;
  for (const HalfEdge h : walk.relied_on()) {
    if (std::find(cell.relied.begin(), cell.relied.end(), h) != cell.relied.end()) continue;
    if (count == cell.relied.size()) {
      cell.relied.back() = kMany;
      break;
    }
    cell.relied[count++] = h;
  }
}

template <class Which>
void BoundKeeper::prove_cells(const Which& which, Faults& faults, const Pace& pace) {
  in_chunks(cells_.size(), faults, pace, [&](std::size_t begin, std::size_t end, Faults& found) {
    TriangleWalk walk(state_.mesh);
    for (std::size_t c = begin; c < end; ++c) {
      if (which(cells_[c])) prove_cell(static_cast<std::uint32_t>(c), walk, found);
    }
  });
}

void BoundKeeper::prove_triangles(Faults& faults, const Pace& pace) {
  const CollapseMesh& mesh = state_.mesh;
  std::vector<HalfEdge> triangles;
  for (HalfEdge h = 0; h < mesh.half_edges(); h += 3) {
    if (!mesh.is_gone(h) && triangle_needs_proof(h)) triangles.push_back(h);
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
      found.push_back({{middle(at), longest_side(at)},
                       {u, v, w, u, v, w},
                       was_triangle_proven_[triangle_of(h)] != 0});
    }
  });
}

void BoundKeeper::find_folds(Faults& faults, const Pace& pace) {
  mesh_ = state_.mesh.mesh(kept_);
  const auto add = [&](std::uint32_t s, std::uint32_t t) {
    const Corners at = corners_of(mesh_, s);
    Fault fault{{middle(at), longest_side(at)}, {}, false, true};
    for (std::size_t k = 0; k < 3; ++k) {
      fault.vertices[k] = kept_[mesh_.triangles[s][k]];
      fault.vertices[k + 3] = kept_[mesh_.triangles[t][k]];
    }
    faults.push_back(fault);
  };
  const std::vector<std::uint32_t> flat = degenerate_triangles(mesh_);
  for (const std::uint32_t t : flat) add(t, t);
  const std::vector<TrianglePair> pairs = self_intersections(mesh_, flat, pace);
  for (const auto& [s, t] : pairs) add(s, t);
  folds_ = !flat.empty() || !pairs.empty();
}

/// Looks at all that depends on what has moved.
BoundKeeper::Faults BoundKeeper::find_faults(const Pace& pace) {
  Faults faults;
  prove_cells([&](const Cell& cell) { return needs_proof(cell); }, faults, pace);
  prove_triangles(faults, pace);
  std::fill(state_.moved.begin(), state_.moved.end(), 0);
  find_folds(faults, pace);
  return faults;
}

/// Whether there was any at the faults.
bool BoundKeeper::take_back_fit(const Faults& faults) {
  bool has_any = false;
  for (const Fault& fault : faults) {
    for (const std::uint32_t v : fault.vertices) {
      if (state_.stays[v] != 0 || state_.mesh.position(v) == unfitted_[v]) continue;
      state_.mesh.move(v, unfitted_[v]);
      state_.moved[v] = 1;
      has_any = true;
    }
  }
  return has_any;
}

/// The blocks that are to go back. Where only blocks are near that are as they were, and all was
/// good with these, it may be any.
std::vector<std::uint8_t> BoundKeeper::blamed(const Faults& faults) const {
  std::vector<std::uint8_t> bad(blocks_->size(), 0);
  for (const Fault& fault : faults) {
    bool is_blamed = false;
    for (const std::uint32_t v : fault.vertices) {
      if (has_changed_[block_of_[v]] == 0) continue;
      bad[block_of_[v]] = 1;
      is_blamed = true;
    }
    if (!is_blamed && fault.was_good) return has_changed_;
  }
  return bad;
}

void BoundKeeper::restore(const VertexBlock& block) {
  for (const std::uint32_t v : block) {
    if (state_.stays[v] != 0) continue;
    state_.mesh.restore(v, before_);
    state_.quadrics[v] = quadrics_before_[v];
    state_.moved[v] = 1;
    unfitted_[v] = before_.position(v);
    const HalfEdge first = before_.any_from(v);
    HalfEdge h = first;
    do {
      is_triangle_proven_[triangle_of(h)] = was_triangle_proven_[triangle_of(h)];
      h = before_.next_around(h);
    } while (h != first);
  }
}

/// Of the vertices that were within balls around the faults, and of those next to them. Where the
/// surface folds no smaller reach helps: there it stays.
void BoundKeeper::raise_caution(const Faults& faults, double widen_mm) {
  std::vector<std::uint32_t> raised;
  std::vector<BadPoint> points;
  for (const Fault& fault : faults) {
    points.push_back(fault.point);
    for (const std::uint32_t v : fault.vertices) {
      raised.push_back(v);
      const HalfEdge first = before_.any_from(v);
      HalfEdge h = first;
      do {
        raised.push_back(before_.to(h));
        h = before_.next_around(h);
      } while (h != first);
      if (fault.is_fold) state_.caution[v] = CollapseState::kStays;
    }
  }
  const Balls balls(std::move(points), widen_mm);
  for (std::uint32_t v = 0; v < block_of_.size(); ++v) {
    if (before_.any_from(v) != CollapseMesh::kGone && balls.hold(before_.position(v))) {
      raised.push_back(v);
    }
  }
  std::sort(raised.begin(), raised.end());
  raised.erase(std::unique(raised.begin(), raised.end()), raised.end());
  for (const std::uint32_t v : raised) {
    if (state_.caution[v] < CollapseState::kStays) ++state_.caution[v];
  }
}

void BoundKeeper::take_back(const std::vector<std::uint8_t>& bad, const CollapseRules& rules,
                            std::uint16_t last) {
  tbb::parallel_for(std::size_t{0}, bad.size(), [&](std::size_t b) {
    if (bad[b] == 0) return;
    const VertexBlock& block = (*blocks_)[b];
    restore(block);
    has_changed_[b] = ++tries_[b] <= kMostBlockTries ? 1 : 0;
    if (has_changed_[b] == 0) return;
    CollapseBlock again(state_, block, target_.probe(), rules);
    again.advance(last, block.size());
  });
  most_tries_ = std::max(most_tries_, *std::max_element(tries_.begin(), tries_.end()));
}

std::size_t BoundKeeper::settle(const CollapseRules& rules, std::uint16_t last, bool fits,
                                const Pace& pace) {
  const Pace unknown = pace.part(1.0, 1.0);
  for (int round = 0;; ++round) {
    state_.mesh.round_to_float();
    unfitted_ = state_.mesh.positions();
    if (fits) fit();
    Faults faults = find_faults(unknown);
    while (take_back_fit(faults)) faults = find_faults(unknown);
    const std::vector<std::uint8_t> bad = blamed(faults);
    if (std::find(bad.begin(), bad.end(), 1) == bad.end()) return mesh_.triangles.size();
    raise_caution(faults, (1 << round) * target_.voxel_mm());
    take_back(bad, rules, last);
  }
}

/// What no block changed was not looked at.
bool BoundKeeper::is_all_proven(const Pace& pace) {
  for (HalfEdge h = 0; h < state_.mesh.half_edges(); h += 3) {
    if (state_.mesh.is_gone(h) || is_triangle_proven_[triangle_of(h)] != 0) continue;
    for (const std::uint32_t v : vertices_of(state_.mesh, h)) state_.moved[v] = 1;
  }
  Faults faults;
  prove_triangles(faults, pace);
  return faults.empty() &&
         std::all_of(cells_.begin(), cells_.end(), [](const Cell& cell) { return cell.is_proven; });
}

}  // namespace argil::mesh
