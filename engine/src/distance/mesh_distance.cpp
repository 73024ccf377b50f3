// SPDX-License-Identifier: GPL-3.0-or-later
// Embree finds the candidates in floats with a margin for its rounding; the distance itself is
// computed in double, and of equal distances the lower triangle wins, whatever the order of the
// search. All threads build the tree: its order shows nowhere, since a box is left out only where
// it lies farther than what was found, by more than any rounding.
#include "argil/engine/mesh_distance.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <new>
#include <utility>

#include "argil/core/closest_on_triangle.h"

#include "embree.h"

namespace argil {

struct MeshDistance::Scene {
  const std::vector<Vec3>& positions;
  const std::vector<Triangle>& triangles;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<std::uint32_t>
      triangle_of;        // of each piece in the tree; empty: they are the triangles
  double rounding = 0.0;  // how far a float may move a point, with room for Embree's own arithmetic

  Scene(const std::vector<Vec3>& p, const std::vector<Triangle>& t) : positions(p), triangles(t) {}
  ~Scene() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;
};

namespace {

struct Query {
  const std::vector<Vec3>& positions;
  const std::vector<Triangle>& triangles;
  const std::vector<std::uint32_t>& triangle_of;
  Vec3 p;
  double rounding;
  double best2;
  MeshDistance::Closest found;

  /// Whether `triangle` is closer than what was found so far.
  bool offer(std::uint32_t triangle) noexcept {
    assert(triangle < triangles.size());
    const Triangle& t = triangles[triangle];
    const Vec3 point = closest_on_triangle(p, positions[t[0]], positions[t[1]], positions[t[2]]);
    const double d2 = dot(point - p, point - p);
    if (d2 > best2 || (d2 == best2 && triangle >= found.triangle)) return false;
    const bool nearer = d2 < best2;
    best2 = d2;
    found.point = point;
    found.triangle = triangle;
    return nearer;
  }
  float radius() const noexcept {
    return static_cast<float>(std::sqrt(best2) * (1.0 + 1e-6) + rounding);
  }
};

/// Embree's callback: a closer triangle shrinks the search.
bool on_triangle(RTCPointQueryFunctionArguments* args) {
  Query& query = *static_cast<Query*>(args->userPtr);
  const std::uint32_t piece = args->primID;
  if (!query.offer(query.triangle_of.empty() ? piece : query.triangle_of[piece])) return false;
  args->query->radius = query.radius();
  return true;
}

/// Long triangles that lie askew have boxes full of others: the tree has pieces of them.
struct Pieces {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> triangle_of;
};

double longest_side(const std::vector<Vec3>& positions, const Triangle& t) {
  double longest = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    longest = std::max(longest, length(positions[t[(k + 1) % 3]] - positions[t[k]]));
  }
  return longest;
}

/// Halved across their longest side until that is no longer than `step`.
void append_pieces(const Triangle& triangle, std::uint32_t number, double step, Pieces& pieces) {
  std::vector<Triangle> open{triangle};
  while (!open.empty()) {
    const Triangle t = open.back();
    open.pop_back();
    std::size_t longest = 0;
    double side = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double own = length(pieces.positions[t[(k + 1) % 3]] - pieces.positions[t[k]]);
      if (own > side) longest = k;
      side = std::max(side, own);
    }
    if (!(side > step)) {
      pieces.triangles.push_back(t);
      pieces.triangle_of.push_back(number);
      continue;
    }
    const std::size_t next = (longest + 1) % 3;
    const auto middle = static_cast<std::uint32_t>(pieces.positions.size());
    pieces.positions.push_back(0.5 * (pieces.positions[t[longest]] + pieces.positions[t[next]]));
    for (const std::size_t moved : {longest, next}) {
      open.push_back(t);
      open.back()[moved] = middle;
    }
  }
}

/// The longest side that a piece may have: the shortest for which there are not too many pieces;
/// infinite where no triangle is longer than the shortest that helps.
double piece_step(const std::vector<Vec3>& positions, const std::vector<Triangle>& triangles) {
  constexpr double kFinest = 1.0 / 64.0;        // of the diagonal
  constexpr std::size_t kPerTriangle = 32;      // pieces
  constexpr std::size_t kMostAdded = 1U << 18;  // some 40 MB
  Box3 box;
  for (const Triangle& t : triangles) {
    for (const std::uint32_t v : t) box.include(positions[v]);
  }
  const double budget = static_cast<double>(std::min(kPerTriangle * triangles.size(), kMostAdded));
  double step = kFinest * length(box.size());
  for (;; step *= 1.5) {
    double pieces = 0.0;
    for (const Triangle& t : triangles) {
      const double side = longest_side(positions, t);
      if (!(side > step)) continue;
      const Vec3& p = positions[t[0]];
      const double height = length(cross(positions[t[1]] - p, positions[t[2]] - p)) / side;
      pieces += 2.0 * (side / step) * (height / step + 1.0);
    }
    if (pieces == 0.0) return std::numeric_limits<double>::infinity();
    if (pieces <= budget) return step;
  }
}

Pieces pieces_of(const std::vector<Vec3>& positions, const std::vector<Triangle>& triangles,
                 double step) {
  Pieces pieces{positions, {}, {}};
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    append_pieces(triangles[t], t, step, pieces);
  }
  return pieces;
}

/// Positions as floats; the exact ones stay with the caller.
void fill_buffers(RTCGeometry geometry, const std::vector<Vec3>& positions,
                  const std::vector<Triangle>& triangles) {
  auto* xyz = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              3 * sizeof(float), std::max<std::size_t>(positions.size(), 1)));
  auto* ids = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), triangles.size()));
  if (xyz == nullptr || ids == nullptr) throw std::bad_alloc();
  for (const Vec3& p : positions) {
    for (std::size_t axis = 0; axis < 3; ++axis) *xyz++ = static_cast<float>(p[axis]);
  }
  for (const Triangle& t : triangles) ids = std::copy(t.begin(), t.end(), ids);
}

}  // namespace

MeshDistance::MeshDistance(const std::vector<Vec3>& positions,
                           const std::vector<Triangle>& triangles)
    : scene_(std::make_unique<Scene>(positions, triangles)) {
  double largest = 0.0;
  for (const Vec3& p : positions) {
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  scene_->rounding = largest * 0x1p-20;
  // Each of these is null where there is no memory; Embree 4 dies of a null that it is given back.
  scene_->device = rtcNewDevice(nullptr);
  if (scene_->device == nullptr) throw std::bad_alloc();
  scene_->scene = rtcNewScene(scene_->device);
  if (scene_->scene == nullptr) throw std::bad_alloc();
  if (triangles.empty()) return;
  const GeometryHandle geometry(rtcNewGeometry(scene_->device, RTC_GEOMETRY_TYPE_TRIANGLE),
                                &rtcReleaseGeometry);
  if (geometry == nullptr) throw std::bad_alloc();
  if (const double step = piece_step(positions, triangles); std::isfinite(step)) {
    Pieces pieces = pieces_of(positions, triangles, step);
    fill_buffers(geometry.get(), pieces.positions, pieces.triangles);
    scene_->triangle_of = std::move(pieces.triangle_of);
  } else {
    fill_buffers(geometry.get(), positions, triangles);
  }
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometry(scene_->scene, geometry.get());
  rtcSetSceneFlags(scene_->scene, RTC_SCENE_FLAG_ROBUST);
  rtcCommitScene(scene_->scene);
  if (rtcGetDeviceError(scene_->device) != RTC_ERROR_NONE) throw std::bad_alloc();
}

MeshDistance::~MeshDistance() = default;

MeshDistance::Closest MeshDistance::closest(const Vec3& p, double reach, std::uint32_t hint) const {
  assert(is_finite(p) && reach >= 0.0);
  assert(hint == kNoTriangle || hint < scene_->triangles.size());
  Query query{scene_->positions,
              scene_->triangles,
              scene_->triangle_of,
              p,
              scene_->rounding,
              reach * reach,
              {}};
  if (hint != kNoTriangle) query.offer(hint);
  if (!scene_->triangles.empty()) {
    RTCPointQuery ball{};
    ball.x = static_cast<float>(p.x);
    ball.y = static_cast<float>(p.y);
    ball.z = static_cast<float>(p.z);
    ball.radius = query.radius();
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(scene_->scene, &ball, &context, on_triangle, &query);
  }
  query.found.distance =
      query.found.triangle == kNoTriangle ? reach : std::min(reach, std::sqrt(query.best2));
  return query.found;
}

}  // namespace argil
