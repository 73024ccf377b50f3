// SPDX-License-Identifier: GPL-3.0-or-later
#include "arena/judge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "argil/engine/mesh_distance.h"
#include "argil/mesh/bodies.h"
#include "argil/mesh/check.h"
#include "argil/mesh/compact.h"
#include "argil/mesh/triangle_geometry.h"

#include "arena/surgery.h"

namespace argil::arena {
namespace {

constexpr std::size_t kPoints = 20'000;

/// So many points spread by area, one in each equal part of it, and all vertices.
std::vector<Vec3> points_on(const TriangleMesh& mesh) {
  Random random(7);
  std::vector<Vec3> points = mesh::compacted(mesh).positions;
  const double step = surface_area(mesh) / kPoints;
  double passed = 0.0;
  double next = 0.5 * step;
  for (std::size_t t = 0; t < mesh.triangles.size() && step > 0.0; ++t) {
    const mesh::Corners c = mesh::corners_of(mesh, t);
    passed += 0.5 * length(mesh::area_normal(c));
    for (; next < passed; next += step) {
      const double s = std::sqrt(random.between(0.0, 1.0));
      const double u = random.between(0.0, 1.0);
      points.push_back((1.0 - s) * c[0] + s * (1.0 - u) * c[1] + s * u * c[2]);
    }
  }
  return points;
}

double farthest(const TriangleMesh& from, const TriangleMesh& to,
                const std::vector<FreeBall>& free) {
  if (to.triangles.empty()) return std::numeric_limits<double>::infinity();
  const MeshDistance surface(to.positions, to.triangles);
  double most = 0.0;
  std::uint32_t hint = kNoTriangle;
  for (const Vec3& p : points_on(from)) {
    const bool is_free = std::any_of(free.begin(), free.end(), [&](const FreeBall& ball) {
      return length(p - ball.center) < ball.radius;
    });
    if (is_free) continue;
    const auto nearest = surface.closest(p, std::numeric_limits<double>::infinity(), hint);
    hint = nearest.triangle;
    most = std::max(most, nearest.distance);
  }
  return most;
}

std::string faults_of(const mesh::MeshVerdict& v) {
  std::string text;
  const auto say = [&](std::int64_t n, const char* what) {
    if (n > 0) text += (text.empty() ? "" : ", ") + std::to_string(n) + " " + what;
  };
  say(v.boundary_edges, "open edges");
  say(v.nonmanifold_edges, "non-manifold edges");
  say(v.misoriented_edges, "misoriented edges");
  say(v.nonmanifold_vertices, "non-manifold vertices");
  say(v.self_intersections, "crossings");
  say(v.degenerate, "without area");
  say(v.duplicate, "duplicates");
  if (text.empty() && !v.outward) text = "inside out";
  return text.empty() ? "not to be judged" : text;
}

std::string percent(double part) {
  std::string text = std::to_string(100.0 * part);
  return text.substr(0, text.find('.') + 3) + " %";
}

}  // namespace

Judgement judge(const TriangleMesh& result, const Truth& truth) {
  Judgement judged;
  if (result.triangles.empty()) {
    judged.why = "nothing";
    return judged;
  }
  const mesh::MeshVerdict verdict = mesh::check_mesh(result);
  judged.valid = verdict.printable;
  const double size = largest_side(truth.must);
  TriangleMesh allowed = truth.must;
  append(allowed, truth.may);
  judged.added = farthest(result, allowed, truth.free) / size;
  judged.lost = farthest(truth.must, result, truth.free) / size;
  judged.volume_off = signed_volume(result) / truth.volume - 1.0;
  if (judged.valid) judged.bodies = mesh::mesh_bodies(result).count;
  const auto add = [&](const std::string& what) {
    judged.why += (judged.why.empty() ? "" : "; ") + what;
  };
  if (!judged.valid) add(faults_of(verdict));
  const bool is_near = judged.added <= truth.tolerance && judged.lost <= truth.tolerance;
  if (judged.added > truth.tolerance) add("added at " + percent(judged.added));
  if (judged.lost > truth.tolerance) add("lost at " + percent(judged.lost));
  const bool is_full = std::abs(judged.volume_off) <= truth.volume_tolerance;
  if (!is_full) add("volume " + percent(judged.volume_off));
  const bool has_bodies = !judged.valid || std::find(truth.bodies.begin(), truth.bodies.end(),
                                                     judged.bodies) != truth.bodies.end();
  if (!has_bodies) add(std::to_string(judged.bodies) + " bodies");
  judged.kept = is_near && is_full && has_bodies;
  return judged;
}

Judgement judge(const TriangleMesh& result, const Broken& broken) {
  Judgement best = judge(result, broken.truth);
  for (const Truth& other : broken.also) {
    if (best.kept) break;
    const Judgement judged = judge(result, other);
    const auto off = [](const Judgement& j) { return std::max(j.added, j.lost); };
    if (judged.kept || off(judged) < off(best)) best = judged;
  }
  return best;
}

}  // namespace argil::arena
