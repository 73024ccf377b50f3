// SPDX-License-Identifier: GPL-3.0-or-later
// Borders are sums of directed edges, of which opposite ones cancel; so what is left of whole
// blocks is always a number of closed loops, and a strip or a lid on each leaves nothing.
#include "live/seam.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "argil/core/vec3.h"

namespace argil {
namespace {

Vec3 place_of(const DisplayVertex& v) {
  return {static_cast<double>(v.position_mm[0]), static_cast<double>(v.position_mm[1]),
          static_cast<double>(v.position_mm[2])};
}

/// Squared.
float apart(const DisplayVertex& a, const DisplayVertex& b) {
  float sum = 0.0F;
  for (std::size_t i = 0; i < 3; ++i) {
    const float side = a.position_mm[i] - b.position_mm[i];
    sum += side * side;
  }
  return sum;
}

/// The vertex of a loop nearest to one.
std::size_t nearest_on(const Border::Loop& loop, const DisplayVertex& to) {
  std::size_t best = 0;
  float least = apart(loop[0], to);
  for (std::size_t i = 1; i < loop.size(); ++i) {
    const float distance = apart(loop[i], to);
    if (distance >= least) continue;
    least = distance;
    best = i;
  }
  return best;
}

/// How far some vertices of a loop lie from those of another, in the mean.
double mean_distance(const Border::Loop& from, const Border::Loop& to) {
  constexpr std::size_t kProbes = 8;
  const std::size_t count = std::min(kProbes, from.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const DisplayVertex& at = from[i * from.size() / count];
    sum += std::sqrt(static_cast<double>(apart(to[nearest_on(to, at)], at)));
  }
  return sum / static_cast<double>(count);
}

Box3 box_of(const Border::Loop& loop, double around_mm) {
  Box3 box;
  for (const DisplayVertex& v : loop) box.include(place_of(v));
  box.min -= Vec3{around_mm, around_mm, around_mm};
  box.max += Vec3{around_mm, around_mm, around_mm};
  return box;
}

bool have_common(const Box3& a, const Box3& b) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (a.max[axis] < b.min[axis] || b.max[axis] < a.min[axis]) return false;
  }
  return true;
}

/// Makes the triangles. Those of two corners in one place are left out, whose sides are opposite.
class SeamMaker {
 public:
  void lid(const Border::Loop& loop) {
    Vec3 middle;
    Vec3 normal;
    for (const DisplayVertex& v : loop) {
      middle += place_of(v);
      normal += Vec3{static_cast<double>(v.normal[0]), static_cast<double>(v.normal[1]),
                     static_cast<double>(v.normal[2])};
    }
    middle = middle / static_cast<double>(loop.size());
    if (length(normal) < 1e-6) normal = {0.0, 0.0, 1.0};
    normal = normalized(normal);
    const auto as_floats = [](const Vec3& v) {
      return std::array<float, 3>{static_cast<float>(v.x), static_cast<float>(v.y),
                                  static_cast<float>(v.z)};
    };
    const DisplayVertex centre{as_floats(middle), as_floats(normal)};
    for (std::size_t i = 0; i < loop.size(); ++i) add(loop[(i + 1) % loop.size()], loop[i], centre);
  }

  /// Both have their surface on the left, so they run against each other. From the nearest rung on
  /// the next is always the shorter of the two that can be.
  void strip(const Border::Loop& one, Border::Loop other) {
    std::reverse(other.begin(), other.end());
    const std::size_t start = nearest_on(other, one[0]);
    std::rotate(other.begin(), other.begin() + static_cast<std::ptrdiff_t>(start), other.end());
    const auto at = [](const Border::Loop& loop, std::size_t i) { return loop[i % loop.size()]; };
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < one.size() || j < other.size()) {
      const bool is_by_one =
          j == other.size() || (i < one.size() && apart(at(one, i + 1), at(other, j)) <=
                                                      apart(at(one, i), at(other, j + 1)));
      if (is_by_one) {
        add(at(one, i + 1), at(one, i), at(other, j));
        ++i;
      } else {
        add(at(one, i), at(other, j), at(other, j + 1));
        ++j;
      }
    }
  }

  SeamMesh take() { return std::move(mesh_); }

 private:
  void add(const DisplayVertex& a, const DisplayVertex& b, const DisplayVertex& c) {
    if (a.position_mm == b.position_mm || b.position_mm == c.position_mm ||
        c.position_mm == a.position_mm) {
      return;
    }
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    mesh_.vertices.insert(mesh_.vertices.end(), {a, b, c});
    mesh_.triangles.push_back({first, first + 1, first + 2});
  }

  SeamMesh mesh_;
};

/// Adds the parts of a loop that pass no vertex twice: so the loops of both sides of a seam are the
/// same ones where octants touch at an edge.
void split_at_pinches(Border::Loop loop, std::vector<Border::Loop>& loops) {
  std::map<std::array<float, 3>, std::size_t> place;
  Border::Loop way;
  for (const DisplayVertex& vertex : loop) {
    const auto [found, is_new] = place.try_emplace(vertex.position_mm, way.size());
    if (!is_new) {
      const auto first = way.begin() + static_cast<std::ptrdiff_t>(found->second);
      loops.emplace_back(first, way.end());
      for (auto at = first + 1; at != way.end(); ++at) place.erase(at->position_mm);
      way.erase(first, way.end());
    }
    way.push_back(vertex);
  }
  loops.push_back(std::move(way));
}

}  // namespace

std::vector<BorderEdge> border_of(const DisplayBlock& block) {
  // Sides by their lower end, which few share: an edge and its opposite find each other there.
  constexpr std::int32_t kNone = -1;
  struct Side {
    std::uint32_t high;
    int times;  ///< from low to high, less those from high to low
    std::int32_t next;
  };
  std::vector<Side> sides;
  sides.reserve(2 * block.triangles.size());
  std::vector<std::int32_t> first(block.vertices.size(), kNone);
  const auto count = [&](std::uint32_t from, std::uint32_t to) {
    const std::uint32_t high = std::max(from, to);
    std::int32_t& list = first[std::min(from, to)];
    std::int32_t at = list;
    while (at != kNone && sides[static_cast<std::size_t>(at)].high != high) {
      at = sides[static_cast<std::size_t>(at)].next;
    }
    if (at == kNone) {
      at = static_cast<std::int32_t>(sides.size());
      sides.push_back({high, 0, list});
      list = at;
    }
    sides[static_cast<std::size_t>(at)].times += from < to ? 1 : -1;
  };
  for (const Triangle& t : block.triangles) {
    for (std::size_t i = 0; i < 3; ++i) count(t[i], t[(i + 1) % 3]);
  }
  std::vector<BorderEdge> edges;
  for (std::size_t low = 0; low < first.size(); ++low) {
    for (std::int32_t at = first[low]; at != kNone; at = sides[static_cast<std::size_t>(at)].next) {
      const Side& side = sides[static_cast<std::size_t>(at)];
      const DisplayVertex& a = block.vertices[low];
      const DisplayVertex& b = block.vertices[side.high];
      for (int n = side.times; n > 0; --n) edges.push_back({a, b});
      for (int n = side.times; n < 0; ++n) edges.push_back({b, a});
    }
  }
  return edges;
}

std::size_t Border::KeyHash::operator()(const Key& key) const noexcept {
  std::uint64_t hash = 0;
  for (const float x : key) {
    hash = (hash ^ std::bit_cast<std::uint32_t>(x + 0.0F)) * 0x9e3779b97f4a7c15ULL;  // -0 as 0
    hash ^= hash >> 29;
  }
  return static_cast<std::size_t>(hash);
}

void Border::count(const std::vector<BorderEdge>& edges, int times) {
  for (const BorderEdge& edge : edges) {
    const auto& from = edge.from.position_mm;
    const auto& to = edge.to.position_mm;
    if (from == to) continue;
    const bool is_forward = from < to;
    const BorderEdge sorted = is_forward ? edge : BorderEdge{edge.to, edge.from};
    const auto& a = sorted.from.position_mm;
    const auto& b = sorted.to.position_mm;
    const auto at = counts_.try_emplace({a[0], a[1], a[2], b[0], b[1], b[2]}).first;
    if (at->second.times == 0) at->second.edge = sorted;
    at->second.times += is_forward ? times : -times;
    if (at->second.times == 0) counts_.erase(at);
  }
}

std::vector<Border::Loop> Border::loops() const {
  std::vector<BorderEdge> edges;
  for (const auto& [key, count] : counts_) {
    const BorderEdge& edge = count.edge;
    for (int n = count.times; n > 0; --n) edges.push_back(edge);
    for (int n = count.times; n < 0; ++n) edges.push_back({edge.to, edge.from});
  }
  const auto name = [](const BorderEdge& e) {
    return std::pair(e.from.position_mm, e.to.position_mm);
  };
  std::sort(edges.begin(), edges.end(),
            [&](const BorderEdge& a, const BorderEdge& b) { return name(a) < name(b); });
  std::vector<bool> is_used(edges.size(), false);
  // As many edges end at a vertex as begin there, so a way that left it can always go on.
  const auto next_from = [&](const DisplayVertex& vertex) {
    auto at = std::lower_bound(edges.begin(), edges.end(), vertex.position_mm,
                               [](const BorderEdge& edge, const std::array<float, 3>& place) {
                                 return edge.from.position_mm < place;
                               });
    while (is_used[static_cast<std::size_t>(at - edges.begin())]) ++at;
    assert(at->from.position_mm == vertex.position_mm);
    return static_cast<std::size_t>(at - edges.begin());
  };
  std::vector<Loop> loops;
  for (std::size_t first = 0; first < edges.size(); ++first) {
    if (is_used[first]) continue;
    Loop loop;
    std::size_t at = first;
    for (;;) {
      is_used[at] = true;
      loop.push_back(edges[at].from);
      if (edges[at].to.position_mm == edges[first].from.position_mm) break;
      at = next_from(edges[at].to);
    }
    split_at_pinches(std::move(loop), loops);
  }
  std::stable_sort(loops.begin(), loops.end(),
                   [](const Loop& a, const Loop& b) { return a.size() > b.size(); });
  return loops;
}

SeamMesh seam_between(const Border& one, const Border& other, double reach_mm) {
  const std::vector<Border::Loop> others = other.loops();
  std::vector<Box3> boxes;
  for (const Border::Loop& loop : others) boxes.push_back(box_of(loop, reach_mm));
  std::vector<bool> is_closed(others.size(), false);
  SeamMaker maker;
  for (const Border::Loop& loop : one.loops()) {
    const Box3 box = box_of(loop, 0.0);
    std::optional<std::size_t> best;
    double nearest = reach_mm;
    for (std::size_t n = 0; n < others.size(); ++n) {
      if (is_closed[n] || !have_common(box, boxes[n])) continue;
      const double distance =
          std::max(mean_distance(loop, others[n]), mean_distance(others[n], loop));
      if (distance >= nearest) continue;
      nearest = distance;
      best = n;
    }
    if (best) {
      maker.strip(loop, others[*best]);
      is_closed[*best] = true;
    } else {
      maker.lid(loop);
    }
  }
  for (std::size_t n = 0; n < others.size(); ++n) {
    if (!is_closed[n]) maker.lid(others[n]);
  }
  return maker.take();
}

}  // namespace argil
