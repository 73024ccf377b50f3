// SPDX-License-Identifier: GPL-3.0-or-later
// Embree finds the candidates in floats with a margin for its rounding; the distance itself is
// computed in double, and of equal distances the lower triangle wins, whatever the order of the
// search. All threads build the tree: its order shows nowhere, since a box is left out only where
// it lies farther than what was found, by more than any rounding.
#include "argil/engine/mesh_distance.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <new>

#include "argil/core/closest_on_triangle.h"

#include "embree.h"

namespace argil {

struct MeshDistance::Scene {
  const std::vector<Vec3>& positions;
  const std::vector<Triangle>& triangles;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
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
  if (!query.offer(args->primID)) return false;
  args->query->radius = query.radius();
  return true;
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
  fill_buffers(geometry.get(), positions, triangles);
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
  Query query{scene_->positions, scene_->triangles, p, scene_->rounding, reach * reach, {}};
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
