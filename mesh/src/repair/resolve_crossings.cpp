// SPDX-License-Identifier: GPL-3.0-or-later
#include "repair/resolve_crossings.h"

#include <array>
#include <cassert>
#include <cmath>
#include <optional>
#include <random>
#include <utility>

#include "argil/mesh/compact.h"
#include "argil/mesh/edges.h"
#include "argil/mesh/rounding.h"

#include "repair/arrangement.h"
#include "repair/winding_rays.h"
#include "topology/repeated_triangles.h"

namespace argil::mesh {
namespace {

/// Faces that hang together without a line of crossing between them, all of which have the same
/// winding number in front.
struct Patch {
  std::uint32_t largest = 0;  ///< face
  double area = -1.0;
  bool is_boundary = false;  ///< of what is inside
};

class Resolution {
 public:
  Resolution(const TriangleMesh& mesh, const std::vector<TrianglePair>& pairs, const Pace& pace)
      : given_(mesh), arranged_(mesh, pairs, pace.part(0.0, 0.6)), rays_(mesh) {
    for (std::uint32_t n = 0; n < arranged_.points(); ++n) {
      faces_.positions.push_back(arranged_.rounded_point(n));
    }
    for (const ArrangedFace& face : arranged_.faces()) faces_.triangles.push_back(face.corners);
    const EdgeTable edges(faces_);
    patch_of_ = mesh_parts(faces_, edges, true);
    find_boundaries(pace.part(0.6, 1.0));
  }

  TriangleMesh boundary() const {
    return only_triangles(faces_, [&](std::size_t f) { return is_boundary(f); });
  }
  /// Faces are numbered as the arrangement has them.
  bool is_boundary(std::size_t face) const {
    return patches_[patch_of_.of_triangle[face]].is_boundary;
  }

 private:
  void find_boundaries(const Pace& pace);
  bool bounds_the_inside(std::uint32_t face);

  const TriangleMesh& given_;
  const Arrangement arranged_;
  WindingRays rays_;
  TriangleMesh faces_;  ///< with nearest doubles
  MeshParts patch_of_;
  std::vector<Patch> patches_;
};

void Resolution::find_boundaries(const Pace& pace) {
  constexpr std::size_t kAtATime = 256;
  patches_.resize(patch_of_.count);
  for (std::uint32_t f = 0; f < faces_.triangles.size(); ++f) {
    const auto& [a, b, c] = faces_.triangles[f];
    const Vec3& p = faces_.positions[a];
    const double area = length(cross(faces_.positions[b] - p, faces_.positions[c] - p));
    Patch& patch = patches_[patch_of_.of_triangle[f]];
    if (area > patch.area) patch = {f, area, false};
  }
  for (std::size_t n = 0; n < patches_.size(); ++n) {
    if (n % kAtATime == 0) {
      pace.at(static_cast<double>(n) / static_cast<double>(patches_.size()));
    }
    patches_[n].is_boundary = bounds_the_inside(patches_[n].largest);
  }
}

/// By a ray from somewhere within the face, along the axis that it looks along most.
bool Resolution::bounds_the_inside(std::uint32_t face) {
  const Triangle& corners = faces_.triangles[face];
  const std::array<ExactPoint, 3> p{arranged_.point(corners[0]), arranged_.point(corners[1]),
                                    arranged_.point(corners[2])};
  const Exact::Vector_3 normal = CGAL::cross_product(p[1] - p[0], p[2] - p[0]);
  int axis = 0;
  double most = -1.0;
  for (int k = 0; k < 3; ++k) {
    const double size = std::abs(CGAL::to_double(normal[k]));
    if (size <= most || CGAL::is_zero(normal[k])) continue;
    most = size;
    axis = k;
  }
  const std::int32_t jump = arranged_.faces()[face].jump;
  std::mt19937 random(face);
  for (;;) {
    // Whole numbers, so that the point is in the face exactly.
    std::array<double, 3> weight;
    for (double& w : weight) w = 1.0 + static_cast<double>(random() % 65536);
    const double sum = weight[0] + weight[1] + weight[2];
    const ExactPoint from = p[0] + (weight[1] / Exact::FT(sum)) * (p[1] - p[0]) +
                            (weight[2] / Exact::FT(sum)) * (p[2] - p[0]);
    const auto beyond = rays_.beyond(from, static_cast<std::size_t>(axis));
    if (!beyond) continue;  // through an edge: from another place
    const bool looks_along = CGAL::is_positive(normal[axis]);
    const std::int32_t front = looks_along ? *beyond : *beyond - jump;
    return front <= 0 && front + jump >= 1;
  }
}

/// More would take longer than a level set.
constexpr std::size_t kMostLineCrossings = 500'000;

/// How often the lines that triangles are cut along may cross one another.
std::size_t most_line_crossings(const TriangleMesh& mesh, const std::vector<TrianglePair>& pairs) {
  std::vector<std::size_t> lines(mesh.triangles.size(), 0);
  for (const auto& [a, b] : pairs) {
    ++lines[a];
    ++lines[b];
  }
  std::size_t crossings = 0;
  for (const std::size_t of : lines) crossings += of * of;
  return crossings;
}

/// Parts of `mesh` that are one with others after what crosses is cut, or that nothing crosses but
/// others enclose.
std::int64_t united(const TriangleMesh& mesh, const std::vector<TrianglePair>& pairs,
                    const Resolution& resolution) {
  const EdgeTable edges(mesh);
  const MeshParts parts = mesh_parts(mesh, edges, false);
  DisjointSets sets(parts.count);
  std::vector<bool> meets(mesh.triangles.size(), false);
  for (const auto& [a, b] : pairs) {
    sets.unite(parts.of_triangle[a], parts.of_triangle[b]);
    meets[a] = meets[b] = true;
  }
  std::vector<bool> is_left(parts.count, false);
  std::size_t face = 0;  // the arrangement has those that nothing touches first
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (meets[t] || resolution.is_boundary(face++)) is_left[parts.of_triangle[t]] = true;
  }
  std::int64_t gone = 0;
  for (std::uint32_t n = 0; n < parts.count; ++n) gone += sets.find(n) != n || !is_left[n] ? 1 : 0;
  return gone;
}

}  // namespace

std::optional<ResolvedCrossings> resolve_crossings(const TriangleMesh& mesh,
                                                   const std::vector<TrianglePair>& pairs,
                                                   const Pace& pace) {
  std::vector<TrianglePair> meeting = pairs;
  const std::vector<TrianglePair> repeated = repeated_pairs(mesh);
  meeting.insert(meeting.end(), repeated.begin(), repeated.end());
  if (most_line_crossings(mesh, meeting) > kMostLineCrossings) return std::nullopt;
  const Resolution resolution(mesh, meeting, pace);
  const TriangleMesh rounded = welded(rounded_to_float(resolution.boundary()));
  // Slivers whose corners are one place now.
  const auto is_triangle = [&](std::size_t t) {
    const auto& [a, b, c] = rounded.triangles[t];
    return a != b && b != c && c != a;
  };
  return ResolvedCrossings{only_triangles(rounded, is_triangle), united(mesh, meeting, resolution)};
}

}  // namespace argil::mesh
