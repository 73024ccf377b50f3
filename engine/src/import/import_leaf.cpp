// SPDX-License-Identifier: GPL-3.0-or-later
// Signs are told for groups of nodes, not for nodes: nodes that no triangle can separate share one
// winding number, so a leaf needs a few of them and not 512.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "import/import_field.h"

namespace argil {
namespace {

// How far beyond the nearest point of the triangles the other side is looked for, in voxels: what
// is thinner counts as one surface with both its sides outside.
constexpr double kBeyondVoxels = 0.05;
// At an edge or corner of the input a step beyond may miss a sharp solid. Then both faces of the
// nearest triangle are looked at, this far in from its edge and this far off it.
constexpr double kFromEdgeVoxels = 0.2;
constexpr double kOffFaceVoxels = 0.01;
// w of an open input changes by less over a lattice edge that no triangle crosses, or is summed
// again.
constexpr double kSureChange = 0.3;

constexpr std::array<int, 3> kStride = {64, 8, 1};

Coord node_at(const Coord& origin, int offset) {
  return origin.offsetBy(offset >> 6, (offset >> 3) & 7, offset & 7);
}
int coordinate(int offset, int axis) { return (offset >> (6 - 3 * axis)) & 7; }

/// The unsigned distance at the nodes of a leaf, and where it was found.
struct Distances {
  std::array<double, kLeafNodes> distance;  // at most the band
  std::array<Vec3, kLeafNodes> nearest;     // meaningless at the band
  std::array<std::uint32_t, kLeafNodes> triangle;
};

/// Each node hints at the nearest triangle of the node before it, which most often is its own.
void measure(const ImportSampler& sampler, const Coord& origin, Distances& out) {
  for (int n = 0; n < kLeafNodes; ++n) {
    const std::size_t i = static_cast<std::size_t>(n);
    const int before = (n & 7) != 0 ? 1 : ((n & 56) != 0 ? 8 : 64);
    const std::uint32_t hint =
        n == 0 ? kNoTriangle : out.triangle[i - static_cast<std::size_t>(before)];
    const auto found =
        sampler.distance().closest(sampler.position(node_at(origin, n)), sampler.band(), hint);
    out.distance[i] = found.distance;
    out.nearest[i] = found.point;
    out.triangle[i] = found.triangle;
  }
}

/// Groups of nodes joined by lattice edges that no triangle can cross: an edge of length h is free
/// of them when the distances of its ends sum to more.
class Groups {
 public:
  Groups(const Distances& d, double h) {
    for (int n = 0; n < kLeafNodes; ++n) parent_[index(n)] = static_cast<std::int16_t>(n);
    const double safe = safe_sum(h);
    for (int n = 0; n < kLeafNodes; ++n) {
      for (int axis = 0; axis < 3; ++axis) {
        const int m = n + kStride[index(axis)];
        if (coordinate(n, axis) < 7 && d.distance[index(n)] + d.distance[index(m)] > safe)
          join(n, m);
      }
    }
  }
  /// What two distances must exceed together.
  static double safe_sum(double h) { return h * (1.0 + 1e-9); }

  int of(int n) {
    while (parent_[index(n)] != n) n = parent_[index(n)] = parent_[index(parent_[index(n)])];
    return n;
  }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  void join(int n, int m) {
    const int a = of(n);
    const int b = of(m);
    parent_[index(std::max(a, b))] = static_cast<std::int16_t>(std::min(a, b));
  }
  std::array<std::int16_t, kLeafNodes> parent_;
};

using Inside = std::array<bool, kLeafNodes>;

/// The nodes of a leaf being told apart.
struct Telling {
  const ImportSampler& sampler;
  Coord origin;
  Distances d;
  Inside inside;
  ImportLeaf out;

  Vec3 node(int n) const { return sampler.position(node_at(origin, n)); }
};

/// For each group its node farthest from all triangles, at the index of the group; -1 elsewhere.
std::array<std::int16_t, kLeafNodes> farthest_of(Groups& groups, const Distances& d) {
  std::array<std::int16_t, kLeafNodes> farthest;
  farthest.fill(-1);
  for (int n = 0; n < kLeafNodes; ++n) {
    std::int16_t& far = farthest[static_cast<std::size_t>(groups.of(n))];
    if (far < 0 ||
        d.distance[static_cast<std::size_t>(n)] > d.distance[static_cast<std::size_t>(far)]) {
      far = static_cast<std::int16_t>(n);
    }
  }
  return farthest;
}

/// Closed input: w is constant on a group. A node on a triangle is outside by convention.
void tell_closed(Telling& t, Groups& groups) {
  const auto farthest = farthest_of(groups, t.d);
  for (int n = 0; n < kLeafNodes; ++n) {
    const int group = groups.of(n);  // the lowest node of the group, so told before the others
    const auto i = static_cast<std::size_t>(n);
    if (group != n) {
      t.inside[i] = t.inside[static_cast<std::size_t>(group)];
    } else if (t.d.distance[static_cast<std::size_t>(farthest[i])] > 0.0) {
      t.inside[i] = t.sampler.inside(t.node(farthest[i]));
    } else {
      t.inside[i] = false;
    }
  }
}

/// Open input: w of a node from that of a neighbour which no triangle separates from it. Both are
/// whole numbers less what the open edges contribute; the one is taken that changes w least.
double continued(const Telling& t, double from, int n) {
  const double fraction = t.sampler.open_fraction(t.node(n));
  const double w = std::round(from + fraction) - fraction;
  return std::abs(w - from) < kSureChange ? w : t.sampler.winding(t.node(n));
}

/// w over one group, from its farthest node on.
void spread_winding(const Telling& t, int start, std::array<double, kLeafNodes>& w,
                    NodeMask& told) {
  assert(start >= 0 && start < kLeafNodes);
  std::array<std::int16_t, kLeafNodes> queue;
  std::size_t head = 0;
  std::size_t tail = 0;
  w[static_cast<std::size_t>(start)] = t.sampler.winding(t.node(start));
  told.setOn(static_cast<openvdb::Index32>(start));
  queue[tail++] = static_cast<std::int16_t>(start);
  while (head < tail) {
    const int n = queue[head++];
    for (int face = 0; face < 6; ++face) {
      const int axis = face / 2;
      if (coordinate(n, axis) == ((face & 1) != 0 ? 7 : 0)) continue;
      const int m = n + ((face & 1) != 0 ? 1 : -1) * kStride[static_cast<std::size_t>(axis)];
      const auto i = static_cast<std::size_t>(n);
      const auto j = static_cast<std::size_t>(m);
      if (told.isOn(static_cast<openvdb::Index32>(m)) ||
          t.d.distance[i] + t.d.distance[j] <= Groups::safe_sum(t.sampler.voxel())) {
        continue;
      }
      w[j] = continued(t, w[i], m);
      told.setOn(static_cast<openvdb::Index32>(m));
      queue[tail++] = static_cast<std::int16_t>(m);
    }
  }
}

/// Open input. A node is clear when w is within 1/4 of a whole number: w turns by a quarter over a
/// right angle at a straight open edge, so that the edge is then nearer than the membrane.
void tell_open(Telling& t, Groups& groups) {
  std::array<double, kLeafNodes> w;
  NodeMask told;
  for (const std::int16_t start : farthest_of(groups, t.d)) {
    if (start >= 0) spread_winding(t, start, w, told);
  }
  for (int n = 0; n < kLeafNodes; ++n) {
    const auto i = static_cast<std::size_t>(n);
    t.inside[i] = w[i] > 0.5;
    if (w[i] > 0.25 && w[i] < 0.75) {
      ++t.out.bridged;
      t.out.unknown.setOn(static_cast<openvdb::Index32>(n));
    }
  }
}

/// Whether the two faces of a triangle, near a point on it, lie on different sides of the solid.
bool faces_differ(const ImportSampler& sampler, const Vec3& point, std::uint32_t triangle) {
  assert(triangle != kNoTriangle);
  const ImportInput& input = sampler.input();
  const Triangle& t = input.triangles[triangle];
  const Vec3& a = input.positions[t[0]];
  const Vec3& b = input.positions[t[1]];
  const Vec3& c = input.positions[t[2]];
  const Vec3 inward = (a + b + c) / 3.0 - point;
  const double fraction = std::min(0.5, kFromEdgeVoxels * sampler.voxel() / length(inward));
  const Vec3 from = length(inward) > 0.0 ? point + inward * fraction : point;
  const Vec3 off = normalized(cross(b - a, c - a)) * (kOffFaceVoxels * sampler.voxel());
  return sampler.inside(from + off) != sampler.inside(from - off);
}

/// Whether the nearest triangle of a node is the surface: the other side lies behind it.
bool nearest_is_surface(const Telling& t, int n) {
  const auto i = static_cast<std::size_t>(n);
  assert(t.d.distance[i] < t.sampler.band());
  const Vec3& nearest = t.d.nearest[i];
  if (t.d.distance[i] > 0.0) {
    const double step = kBeyondVoxels * t.sampler.voxel() / t.d.distance[i];
    if (t.sampler.inside(nearest + (nearest - t.node(n)) * step) != t.inside[i]) return true;
  }
  return faces_differ(t.sampler, nearest, t.d.triangle[i]);
}

/// Whether all nodes of the leaf around this one are on its side.
bool alone_on_its_side(const Inside& inside, int n) {
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const int nx = coordinate(n, 0) + x;
        const int ny = coordinate(n, 1) + y;
        const int nz = coordinate(n, 2) + z;
        if (((nx | ny | nz) & ~7) != 0) continue;
        const int m = nx * 64 + ny * 8 + nz;
        if (inside[static_cast<std::size_t>(m)] != inside[static_cast<std::size_t>(n)])
          return false;
      }
    }
  }
  return true;
}

/// A triangle comes near, yet no side changes around the node: a wall, a sheet thinner than a
/// voxel, or a corner that falls between nodes. On a triangle there is no side to tell by.
bool is_suspicious(const Telling& t, int n) {
  const double distance = t.d.distance[static_cast<std::size_t>(n)];
  if (!(distance > 0.0)) return true;
  return distance < t.sampler.voxel() && alone_on_its_side(t.inside, n);
}

/// A node whose nearest triangle is a wall: nothing is known of its distance. One on the wall had
/// no side yet: any point beside it has the right one.
void doubt(Telling& t, int n) {
  const auto i = static_cast<std::size_t>(n);
  if (!(t.d.distance[i] > 0.0)) {
    const double e = kBeyondVoxels * t.sampler.voxel();
    t.inside[i] = t.sampler.inside(t.d.nearest[i] + Vec3{e, e, e});
  }
  t.d.distance[i] = t.sampler.band();
  t.out.unknown.setOn(static_cast<openvdb::Index32>(n));
  t.out.wall = true;
  t.out.doubtful = true;
}

/// Which nodes are asked whether their nearest triangle is the surface.
void ask_walls(Telling& t, AskWalls ask) {
  std::vector<int> walls;
  for (int n = 0; n < kLeafNodes; ++n) {
    const auto bit = static_cast<openvdb::Index32>(n);
    if (t.d.distance[static_cast<std::size_t>(n)] >= t.sampler.band()) {
      t.out.unknown.setOn(bit);
    } else if ((ask == AskWalls::all || t.out.unknown.isOn(bit) || is_suspicious(t, n)) &&
               !nearest_is_surface(t, n)) {
      walls.push_back(n);
    } else if (t.out.unknown.isOn(bit)) {
      t.out.doubtful = true;
    }
  }
  for (const int n : walls) doubt(t, n);  // afterwards: suspicion reads the sides around
}

}  // namespace

ImportLeaf sample_leaf(const ImportSampler& sampler, const Coord& origin, AskWalls ask) {
  assert(is_leaf_origin(origin));
  Telling t{sampler, origin, {}, {}, {}};
  measure(sampler, origin, t.d);
  Groups groups(t.d, sampler.voxel());
  if (sampler.input().closed) {
    tell_closed(t, groups);
  } else {
    tell_open(t, groups);
  }
  ask_walls(t, ask);
  const float band = static_cast<float>(sampler.band());
  t.out.leaf = std::make_unique<VdbLeaf>(origin, band, false);
  float* value = t.out.leaf->buffer().data();
  for (std::size_t i = 0; i < kLeafNodes; ++i) {
    const float distance = std::min(band, static_cast<float>(t.d.distance[i]));
    value[i] = t.inside[i] && distance > 0.0F ? -distance : distance;
  }
  return std::move(t.out);
}

}  // namespace argil
