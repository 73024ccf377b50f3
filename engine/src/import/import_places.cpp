// SPDX-License-Identifier: GPL-3.0-or-later
// Which leaves the band of the mesh can reach: the boxes of all triangles, collected in parallel,
// then thinned by a query of the true distance.
#include <algorithm>
#include <cassert>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "import/import_field.h"

namespace argil {
namespace {

constexpr std::size_t kTrianglesPerTask = 2048;
constexpr double kSqrt3 = 1.7320508075688772;

struct TriangleCorners {
  Vec3 a, b, c;
};

/// Collects all leaves whose box, widened by the band, meets the bounds of a triangle.
class OriginCollector {
 public:
  explicit OriginCollector(const ImportSampler& sampler) : sampler_(sampler) {}

  /// Large triangles are halved at their longest edge, so that their bounds stay close to them.
  void add(const TriangleCorners& t) {
    const double ab = squared(t.b - t.a);
    const double bc = squared(t.c - t.b);
    const double ca = squared(t.a - t.c);
    const double piece = kLeafSide * sampler_.voxel();
    if (std::max({ab, bc, ca}) <= piece * piece) {
      add_bounds(t);
    } else if (ab >= bc && ab >= ca) {
      halve(t.a, t.b, t.c);
    } else if (bc >= ca) {
      halve(t.b, t.c, t.a);
    } else {
      halve(t.c, t.a, t.b);
    }
  }

  std::vector<Coord> take() {
    sort_unique();
    return std::move(origins_);
  }

 private:
  static double squared(const Vec3& v) { return dot(v, v); }

  void halve(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 middle = (a + b) * 0.5;
    add({a, middle, c});
    add({middle, b, c});
  }

  void add_bounds(const TriangleCorners& t) {
    Box3 box;
    for (const Vec3& p : {t.a, t.b, t.c}) box.include(p);
    Coord low;
    Coord high;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double shift = sampler_.input().center[axis];
      const int i = static_cast<int>(axis);
      low[i] = leaf_index((box.min[axis] + shift - sampler_.band()) / sampler_.voxel());
      high[i] = leaf_index((box.max[axis] + shift + sampler_.band()) / sampler_.voxel());
    }
    for (int x = low.x(); x <= high.x(); ++x) {
      for (int y = low.y(); y <= high.y(); ++y) {
        for (int z = low.z(); z <= high.z(); ++z) origins_.emplace_back(x * 8, y * 8, z * 8);
      }
    }
    if (origins_.size() >= 2 * sorted_ + (1U << 14)) sort_unique();  // a great triangle
  }

  static int leaf_index(double node) { return static_cast<int>(std::floor(node / kLeafSide)); }

  void sort_unique() {
    std::sort(origins_.begin(), origins_.end());
    origins_.erase(std::unique(origins_.begin(), origins_.end()), origins_.end());
    sorted_ = origins_.size();
  }

  const ImportSampler& sampler_;
  std::vector<Coord> origins_;
  std::size_t sorted_ = 0;
};

/// Unions of neighbouring lists, pair by pair, so that no step keeps many copies.
std::vector<Coord> united(std::vector<std::vector<Coord>> lists) {
  for (std::size_t step = 1; step < lists.size(); step *= 2) {
    tbb::parallel_for(std::size_t{0}, (lists.size() + 2 * step - 1) / (2 * step),
                      [&](std::size_t k) {
                        const std::size_t i = 2 * step * k;
                        if (i + step >= lists.size()) return;
                        std::vector<Coord> both;
                        std::set_union(lists[i].begin(), lists[i].end(), lists[i + step].begin(),
                                       lists[i + step].end(), std::back_inserter(both));
                        lists[i] = std::move(both);
                        std::vector<Coord>().swap(lists[i + step]);
                      });
  }
  return lists.empty() ? std::vector<Coord>{} : std::move(lists.front());
}

/// Whether a triangle comes near enough to the leaf's middle to reach one of its nodes.
bool in_reach(const ImportSampler& sampler, const Coord& origin) {
  const double h = sampler.voxel();
  const double half = 0.5 * (kLeafSide - 1) * h;
  const Vec3 middle = sampler.position(origin) + Vec3{half, half, half};
  const double reach = (sampler.band() + half * kSqrt3) * (1.0 + 1e-9);
  return sampler.distance().closest(middle, reach).triangle != kNoTriangle;
}

}  // namespace

/// Lists of many triangles each, made in parallel, sorted and united: the result does not depend on
/// how they were split.
std::vector<Coord> leaves_near_triangles(const ImportSampler& sampler) {
  const ImportInput& input = sampler.input();
  const std::size_t tasks = (input.triangles.size() + kTrianglesPerTask - 1) / kTrianglesPerTask;
  std::vector<std::vector<Coord>> lists(tasks);
  tbb::parallel_for(std::size_t{0}, tasks, [&](std::size_t task) {
    OriginCollector collector(sampler);
    const std::size_t end = std::min(input.triangles.size(), (task + 1) * kTrianglesPerTask);
    for (std::size_t i = task * kTrianglesPerTask; i < end; ++i) {
      const Triangle& t = input.triangles[i];
      collector.add({input.positions[t[0]], input.positions[t[1]], input.positions[t[2]]});
    }
    lists[task] = collector.take();
  });
  std::vector<Coord> origins = united(std::move(lists));
  assert(are_sorted_origins(origins));
  std::vector<char> keep(origins.size());
  tbb::parallel_for(std::size_t{0}, origins.size(),
                    [&](std::size_t i) { keep[i] = in_reach(sampler, origins[i]) ? 1 : 0; });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < origins.size(); ++i) {
    if (keep[i] != 0) origins[kept++] = origins[i];
  }
  origins.resize(kept);
  return origins;
}

}  // namespace argil
