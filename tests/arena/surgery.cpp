// SPDX-License-Identifier: GPL-3.0-or-later
#include "arena/surgery.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "argil/core/winding_number.h"
#include "argil/engine/mesh_distance.h"
#include "argil/mesh/compact.h"
#include "argil/mesh/polygon_triangles.h"
#include "argil/mesh/rounding.h"
#include "argil/mesh/triangle_geometry.h"

#include "arena/truth.h"

namespace argil::arena {
namespace {

std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
  return static_cast<std::uint64_t>(std::min(a, b)) << 32 | std::max(a, b);
}

/// Rims along the plane, from one to the next, each as a ring of vertex numbers.
std::vector<std::vector<std::uint32_t>> rings_of(std::map<std::uint32_t, std::uint32_t> next) {
  std::vector<std::vector<std::uint32_t>> rings;
  while (!next.empty()) {
    std::vector<std::uint32_t> ring;
    std::uint32_t at = next.begin()->first;
    for (auto found = next.find(at); found != next.end(); found = next.find(at)) {
      ring.push_back(at);
      at = found->second;
      next.erase(found);
    }
    rings.push_back(std::move(ring));
  }
  return rings;
}

/// Cuts one mesh; both sides share the numbers of the rim's vertices.
class PlaneCut {
 public:
  PlaneCut(const TriangleMesh& mesh, const Vec3& at, const Vec3& normal) : whole_(mesh) {
    for (const Vec3& p : mesh.positions) off_.push_back(dot(p - at, normal));
  }

  std::optional<Cut> run() {
    const double least = 1e-5 * largest_side(whole_);
    if (std::any_of(off_.begin(), off_.end(), [&](double d) { return std::abs(d) < least; })) {
      return std::nullopt;
    }
    below_.positions = above_.positions = whole_.positions;
    for (const Triangle& t : whole_.triangles) share_out(t);
    if (next_.empty()) return std::nullopt;
    Cut cut;
    cut.cap.positions = below_.positions = above_.positions = whole_.positions;
    for (const std::vector<std::uint32_t>& ring : rings_of(next_)) {
      std::vector<Vec3> corners;
      for (const std::uint32_t v : ring) corners.push_back(whole_.positions[v]);
      if (corners.size() < 3) return std::nullopt;
      const std::vector<Triangle> inside = mesh::triangulated(corners);
      if (inside.empty()) return std::nullopt;
      for (const auto& [a, b, c] : inside) {
        cut.cap.triangles.push_back({ring[a], ring[b], ring[c]});
      }
    }
    cut.cap = mesh::compacted(cut.cap);
    cut.below = mesh::compacted(below_);
    cut.above = mesh::compacted(above_);
    return cut;
  }

 private:
  std::uint32_t on_edge(std::uint32_t a, std::uint32_t b) {
    const auto [found, is_new] =
        middles_.try_emplace(edge_key(a, b), static_cast<std::uint32_t>(whole_.positions.size()));
    if (is_new) {
      const auto [low, high] = std::minmax(a, b);
      const double t = off_[low] / (off_[low] - off_[high]);
      const Vec3 p = whole_.positions[low] + t * (whole_.positions[high] - whole_.positions[low]);
      const auto rounded = mesh::floats_of(p);
      whole_.positions.push_back({rounded[0], rounded[1], rounded[2]});
    }
    return found->second;
  }

  void share_out(const Triangle& t) {
    const auto is_below = [&](std::size_t k) { return off_[t[k % 3]] < 0.0; };
    const int count = is_below(0) + is_below(1) + is_below(2);
    if (count == 0 || count == 3) {
      (count == 0 ? above_ : below_).triangles.push_back(t);
      return;
    }
    std::size_t lone = 0;
    while (is_below(lone) != (count == 1)) ++lone;
    const std::uint32_t a = t[lone];
    const std::uint32_t b = t[(lone + 1) % 3];
    const std::uint32_t c = t[(lone + 2) % 3];
    const std::uint32_t ab = on_edge(a, b);
    const std::uint32_t ca = on_edge(c, a);
    TriangleMesh& with_lone = count == 1 ? below_ : above_;
    TriangleMesh& with_two = count == 1 ? above_ : below_;
    with_lone.triangles.push_back({a, ab, ca});
    with_two.triangles.push_back({ab, b, c});
    with_two.triangles.push_back({ab, c, ca});
    // The rim of what is below, backwards, is how its cap goes.
    if (count == 1) {
      next_[ca] = ab;
    } else {
      next_[ab] = ca;
    }
  }

  TriangleMesh whole_;
  std::vector<double> off_;
  TriangleMesh below_;
  TriangleMesh above_;
  std::unordered_map<std::uint64_t, std::uint32_t> middles_;
  std::map<std::uint32_t, std::uint32_t> next_;
};

}  // namespace

double largest_side(const TriangleMesh& mesh) {
  const Vec3 size = mesh::used_bounds(mesh).size();
  return std::max({size.x, size.y, size.z});
}

std::size_t pick(Random& random, std::size_t below) {
  return std::min(below - 1,
                  static_cast<std::size_t>(random.between(0.0, static_cast<double>(below))));
}

std::vector<std::size_t> pick_some(Random& random, std::size_t below, std::size_t count) {
  std::vector<std::size_t> all(below);
  std::iota(all.begin(), all.end(), std::size_t{0});
  count = std::min(count, below);
  for (std::size_t i = 0; i < count; ++i) std::swap(all[i], all[i + pick(random, below - i)]);
  all.resize(count);
  return all;
}

void append(TriangleMesh& mesh, const TriangleMesh& from) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), from.positions.begin(), from.positions.end());
  for (const auto& [a, b, c] : from.triangles) {
    mesh.triangles.push_back({first + a, first + b, first + c});
  }
}

void turn_over(Triangle& t) { std::swap(t[1], t[2]); }
void turn_over(TriangleMesh& mesh) {
  for (Triangle& t : mesh.triangles) turn_over(t);
}

TriangleMesh placed(const TriangleMesh& mesh, const Quat& by, double scale, const Vec3& move) {
  TriangleMesh moved{mesh.positions, {}, mesh.triangles};
  const Vec3 center = bounds(mesh).center();
  for (Vec3& p : moved.positions) p = center + scale * rotate(by, p - center) + move;
  return mesh::rounded_to_float(std::move(moved));
}

std::vector<Vec3> vertex_normals(const TriangleMesh& mesh) {
  std::vector<Vec3> normals(mesh.positions.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 normal = mesh::area_normal(mesh::corners_of(mesh, t));
    for (const std::uint32_t v : mesh.triangles[t]) normals[v] += normal;
  }
  for (Vec3& normal : normals) normal = normalized(normal);
  return normals;
}

std::vector<double> edge_lengths(const TriangleMesh& mesh) {
  std::vector<double> sums(mesh.positions.size(), 0.0);
  std::vector<double> counts(mesh.positions.size(), 0.0);
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k];
      const std::uint32_t b = t[(k + 1) % 3];
      const double long_mm = length(mesh.positions[a] - mesh.positions[b]);
      sums[a] += long_mm;
      sums[b] += long_mm;
      counts[a] += 1.0;
      counts[b] += 1.0;
    }
  }
  for (std::size_t v = 0; v < sums.size(); ++v) sums[v] /= std::max(1.0, counts[v]);
  return sums;
}

std::vector<std::size_t> patch_around(const TriangleMesh& mesh, std::size_t first, double radius) {
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> at_edge;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& c = mesh.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) at_edge[edge_key(c[k], c[(k + 1) % 3])].push_back(t);
  }
  const Vec3 center = mesh::middle(mesh::corners_of(mesh, first));
  std::vector<std::size_t> patch{first};
  std::vector<bool> is_in(mesh.triangles.size(), false);
  is_in[first] = true;
  for (std::size_t i = 0; i < patch.size(); ++i) {
    const Triangle c = mesh.triangles[patch[i]];
    for (std::size_t k = 0; k < 3; ++k) {
      for (const std::size_t other : at_edge[edge_key(c[k], c[(k + 1) % 3])]) {
        if (is_in[other]) continue;
        if (length(mesh::middle(mesh::corners_of(mesh, other)) - center) > radius) continue;
        is_in[other] = true;
        patch.push_back(other);
      }
    }
  }
  return patch;
}

void erase_triangles(TriangleMesh& mesh, const std::vector<bool>& goes) {
  std::vector<Triangle> kept;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!goes[t]) kept.push_back(mesh.triangles[t]);
  }
  mesh.triangles = std::move(kept);
  mesh = mesh::compacted(mesh);
}

std::optional<Cut> cut_by_plane(const TriangleMesh& mesh, const Vec3& at, const Vec3& normal) {
  return PlaneCut(mesh, at, normal).run();
}

InnerBall inner_ball(const TriangleMesh& mesh, Random& random) {
  constexpr int kTries = 400;
  const WindingNumber winding(mesh.positions, mesh.triangles);
  const MeshDistance surface(mesh.positions, mesh.triangles);
  const Box3 box = bounds(mesh);
  InnerBall best;
  for (int i = 0; i < kTries; ++i) {
    const Vec3 p{random.between(box.min.x, box.max.x), random.between(box.min.y, box.max.y),
                 random.between(box.min.z, box.max.z)};
    if (winding.at(p) < 0.5) continue;
    const double off = surface.closest(p, std::numeric_limits<double>::infinity()).distance;
    if (off > best.radius) best = {p, off};
  }
  return best;
}

}  // namespace argil::arena
