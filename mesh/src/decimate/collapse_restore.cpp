// SPDX-License-Identifier: GPL-3.0-or-later
// A vertex stands for all those of an earlier state that became it. Where only some go back, the
// triangles of then around these are there again, with corners that are vertices of then or what
// those have become; one with two corners in the same vertex stays away. That needs no order of
// steps, but may give an edge more than two triangles, or a vertex two rounds of them: then what
// was to stay there goes back too.
#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <utility>
#include <vector>

#include "decimate/collapse_mesh.h"

namespace argil::mesh {

class CollapseMesh::Restoring {
 public:
  Restoring(CollapseMesh& mesh, const CollapseMesh& before, std::vector<std::uint8_t>& goes_back,
            const Pace& pace)
      : mesh_(mesh),
        before_(before),
        goes_back_(goes_back),
        pace_(pace),
        is_back_(mesh.vertices(), 0) {
    assert(before.vertices() == mesh.vertices() && goes_back.size() == mesh.vertices());
  }

  std::vector<std::uint32_t> run() {
    for (;;) {
      find();
      // Nothing is written before each edge has two triangles.
      if (!find_twins()) continue;
      count_triangles();
      write();
      if (are_round()) return std::move(back_);
    }
  }

 private:
  /// A half-edge as it will be, and its twin.
  struct Edge {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    HalfEdge h = 0;
    HalfEdge twin = 0;

    std::pair<std::uint32_t, std::uint32_t> ends() const noexcept { return {from, to}; }
  };
  /// How many triangles a vertex will have around it.
  struct Round {
    std::uint32_t vertex = 0;
    std::size_t triangles = 0;
  };

  /// Of as many as take some 50 ms an interruption is heard before the first.
  void hear(std::size_t number) const {
    if (number % 65536 == 0) pace_.at(0.0);
  }
  void find();
  void find_triangle(HalfEdge first);
  bool find_twins();
  void count_triangles();
  void write();
  bool are_round();

  template <class Use>
  void for_each_staying(std::uint32_t v, const Use& use) const;
  bool goes(HalfEdge h) const;
  void widen(std::uint32_t v) {
    if (is_back_[v] == 0) goes_back_[v] = 1;
  }

  CollapseMesh& mesh_;
  const CollapseMesh& before_;
  std::vector<std::uint8_t>& goes_back_;
  Pace pace_;                          ///< how often all is looked at again is not known before
  std::vector<std::uint8_t> is_back_;  ///< of each vertex: it was there before and is again
  std::vector<std::uint32_t> back_;    ///< these
  std::vector<HalfEdge> away_;         ///< a half-edge of each triangle around these that is not
  std::vector<Edge> edges_;            ///< of those that are, by their ends
  std::vector<Round> rounds_;
};

/// What goes back, and the triangles around it.
void CollapseMesh::Restoring::find() {
  back_.clear();
  away_.clear();
  edges_.clear();
  for (std::uint32_t v = 0; v < is_back_.size(); ++v) {
    is_back_[v] = before_.out_[v] != kGone && goes_back_[mesh_.became(v)] != 0 ? 1 : 0;
    if (is_back_[v] != 0) back_.push_back(v);
  }
  pace_.at(0.0);
  for (std::size_t i = 0; i < back_.size(); ++i) {
    hear(i);
    const std::uint32_t v = back_[i];
    const HalfEdge first = before_.out_[v];
    HalfEdge h = first;
    do {
      const std::uint32_t second = before_.to(h);
      const std::uint32_t third = before_.to(next_in_triangle(h));
      // Once, by the lowest of its corners that are back.
      const bool is_first =
          (is_back_[second] == 0 || v < second) && (is_back_[third] == 0 || v < third);
      if (is_first) find_triangle(h);
      h = before_.next_around(h);
    } while (h != first);
  }
  std::sort(edges_.begin(), edges_.end(), [](const Edge& a, const Edge& b) {
    return a.ends() != b.ends() ? a.ends() < b.ends() : a.h < b.h;
  });
}

void CollapseMesh::Restoring::find_triangle(HalfEdge first) {
  const HalfEdge second = next_in_triangle(first);
  const std::array<HalfEdge, 3> sides{first, second, next_in_triangle(second)};
  std::array<std::uint32_t, 3> corners{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t v = before_.from_[sides[k]];
    corners[k] = is_back_[v] != 0 ? v : mesh_.became(v);
  }
  if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) {
    away_.push_back(first);
    return;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    edges_.push_back({corners[k], corners[(k + 1) % 3], sides[k], kGone});
  }
}

/// Whether the triangle of `h`, as it is now, has a corner that goes back.
bool CollapseMesh::Restoring::goes(HalfEdge h) const {
  const HalfEdge second = next_in_triangle(h);
  return goes_back_[mesh_.from_[h]] != 0 || goes_back_[mesh_.from_[second]] != 0 ||
         goes_back_[mesh_.to(second)] != 0;
}

/// Calls `use(h)` for the half-edges from a vertex whose triangles stay.
template <class Use>
void CollapseMesh::Restoring::for_each_staying(std::uint32_t v, const Use& use) const {
  if (is_back_[v] != 0) return;
  const HalfEdge first = mesh_.out_[v];
  HalfEdge h = first;
  do {
    if (!goes(h)) use(h);
    h = mesh_.next_around(h);
  } while (h != first);
}

/// Whether each edge has just one twin; where not, its ends go back.
bool CollapseMesh::Restoring::find_twins() {
  const auto less = [](const Edge& e, const std::pair<std::uint32_t, std::uint32_t>& ends) {
    return e.ends() < ends;
  };
  bool are_all_good = true;
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    hear(i);
    Edge& edge = edges_[i];
    int same_way = 0;
    int back = 0;
    auto e = std::lower_bound(edges_.begin(), edges_.end(), edge.ends(), less);
    for (; e != edges_.end() && e->ends() == edge.ends(); ++e) ++same_way;
    const std::pair other_way(edge.to, edge.from);
    e = std::lower_bound(edges_.begin(), edges_.end(), other_way, less);
    for (; e != edges_.end() && e->ends() == other_way; ++e, ++back) edge.twin = e->h;
    for_each_staying(edge.from, [&](HalfEdge h) { same_way += mesh_.to(h) == edge.to ? 1 : 0; });
    for_each_staying(edge.to, [&](HalfEdge h) {
      if (mesh_.to(h) != edge.from) return;
      edge.twin = h;
      ++back;
    });
    if (same_way == 1 && back == 1) continue;
    are_all_good = false;
    widen(edge.from);
    widen(edge.to);
  }
  return are_all_good;
}

void CollapseMesh::Restoring::count_triangles() {
  rounds_.clear();
  for (const Edge& edge : edges_) {
    if (rounds_.empty() || rounds_.back().vertex != edge.from) {
      rounds_.push_back({edge.from, 0});
      for_each_staying(edge.from, [&](HalfEdge) { ++rounds_.back().triangles; });
    }
    ++rounds_.back().triangles;
  }
}

void CollapseMesh::Restoring::write() {
  for (const std::uint32_t v : back_) {
    goes_back_[v] = 1;
    mesh_.into_[v] = v;
    mesh_.positions_[v] = before_.positions_[v];
  }
  for (std::uint32_t v = 0; v < is_back_.size(); ++v) {
    // What had become one of them then.
    const bool was_gone = before_.out_[v] == kGone;
    if (was_gone && goes_back_[mesh_.became(v)] != 0) mesh_.into_[v] = before_.became(v);
  }
  for (const HalfEdge h : away_) {
    const HalfEdge second = next_in_triangle(h);
    for (const HalfEdge side : {h, second, next_in_triangle(second)}) mesh_.from_[side] = kGone;
  }
  for (const Edge& edge : edges_) {
    mesh_.from_[edge.h] = edge.from;
    mesh_.twin_[edge.h] = edge.twin;
    mesh_.twin_[edge.twin] = edge.h;
    mesh_.out_[edge.from] = edge.h;
  }
}

/// Whether turning around each vertex meets all its triangles; where not, what stays there goes
/// back.
bool CollapseMesh::Restoring::are_round() {
  bool are_all_good = true;
  auto edge = edges_.begin();
  for (const auto& [v, triangles] : rounds_) {
    std::size_t met = 0;
    HalfEdge h = mesh_.out_[v];
    do {
      ++met;
      h = mesh_.next_around(h);
    } while (h != mesh_.out_[v] && met <= triangles);
    const bool is_good = met == triangles;
    are_all_good = are_all_good && is_good;
    if (!is_good) widen(v);
    for (; edge != edges_.end() && edge->from == v; ++edge) {
      if (!is_good) widen(edge->to);
    }
  }
  return are_all_good;
}

std::vector<std::uint32_t> CollapseMesh::restore(const CollapseMesh& before,
                                                 std::vector<std::uint8_t>& goes_back,
                                                 const Pace& pace) {
  return Restoring(*this, before, goes_back, pace).run();
}

}  // namespace argil::mesh
