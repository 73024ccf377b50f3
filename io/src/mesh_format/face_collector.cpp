// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_format/face_collector.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "argil/mesh/polygon_triangles.h"

namespace argil::io {
namespace {

/// No vertex has this number.
constexpr std::uint32_t kNoVertex = std::numeric_limits<std::uint32_t>::max();

}  // namespace

std::string FaceCollector::add(const std::vector<std::int64_t>& corners, std::uint64_t position) {
  assert(corners.size() >= 3);
  if (corners.size() > kMostCorners) {
    return "a face has " + std::to_string(corners.size()) + " corners, and at most " +
           std::to_string(kMostCorners) + " are possible; triangulate the mesh where it was made";
  }
  // Judged before they become 32 bits, in which a negative number would look like a large one.
  const std::int64_t top = *std::max_element(corners.begin(), corners.end());
  if (top >= kNoVertex || *std::min_element(corners.begin(), corners.end()) < 0) {
    return "a face names a vertex below 0 or beyond 4294967294; split the mesh";
  }
  if (top > highest_) {
    highest_ = top;
    highest_position_ = position;
  }
  const std::size_t before = corners_.size();
  for (const std::int64_t corner : corners) corners_.push_back(static_cast<std::uint32_t>(corner));
  if (corners.size() > 4) {
    ends_.push_back(corners_.size());
    return {};
  }
  if (corners.size() == 4) quads_.push_back(triangles_.size());
  add_fan(std::span(corners_).subspan(before));
  corners_.resize(before);
  return {};
}

bool FaceCollector::add_triangle(const std::array<std::int64_t, 3>& corners,
                                 std::uint64_t position) {
  const auto [low, top] = std::minmax({corners[0], corners[1], corners[2]});
  if (top >= kNoVertex || low < 0) return false;
  if (top > highest_) {
    highest_ = top;
    highest_position_ = position;
  }
  triangles_.push_back({static_cast<std::uint32_t>(corners[0]),
                        static_cast<std::uint32_t>(corners[1]),
                        static_cast<std::uint32_t>(corners[2])});
  return true;
}

void FaceCollector::add_fan(std::span<const std::uint32_t> corners) {
  for (std::size_t i = 2; i < corners.size(); ++i) {
    triangles_.push_back({corners[0], corners[i - 1], corners[i]});
  }
}

void FaceCollector::add_polygon(std::span<const std::uint32_t> corners,
                                std::span<const Vec3> positions) {
  std::vector<Vec3> points;
  points.reserve(corners.size());
  for (const std::uint32_t corner : corners) points.push_back(positions[corner]);
  const std::vector<Triangle> inside = mesh::triangulated(points);
  if (inside.empty()) return add_fan(corners);
  for (const Triangle& t : inside) {
    triangles_.push_back({corners[t[0]], corners[t[1]], corners[t[2]]});
  }
}

std::vector<Triangle> FaceCollector::take(std::span<const Vec3> positions) {
  assert(highest_ < static_cast<std::int64_t>(positions.size()));
  for (const std::size_t first : quads_) {
    const auto [a, b, c] = triangles_[first];
    const std::uint32_t d = triangles_[first + 1][2];
    const Vec3 side = cross(positions[b] - positions[a], positions[c] - positions[a]);
    const Vec3 other = cross(positions[c] - positions[a], positions[d] - positions[a]);
    // Both halves face alike: the quad is convex, or concave where this diagonal ends.
    if (dot(side, other) >= 0.0) continue;
    triangles_[first] = {a, b, d};  // a corner points inwards: only the other diagonal lies inside
    triangles_[first + 1] = {b, c, d};
  }
  std::size_t begin = 0;
  for (const std::size_t end : ends_) {
    add_polygon(std::span(corners_).subspan(begin, end - begin), positions);
    begin = end;
  }
  return std::move(triangles_);
}

std::string position_problem(const Vec3& p, const std::string& of) {
  if (is_in_reach(p)) return {};
  if (!is_finite(p))
    return "a coordinate" + of + " is NaN or infinite; repair the mesh where it was made";
  std::ostringstream text;
  text << "a coordinate" << of << " is " << std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)})
       << " mm from the origin, and at most " << kMaxReachMm
       << " are possible; move or scale the mesh where it was made";
  return text.str();
}

Error no_triangles(const std::string& name) {
  return {
      ErrorKind::bad_input,
      name + " has no triangles; export it again as a mesh with faces, not as points or curves"};
}

}  // namespace argil::io
