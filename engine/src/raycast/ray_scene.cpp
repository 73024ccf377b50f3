// SPDX-License-Identifier: GPL-3.0-or-later
// Embree over one mesh. Rays are traced in floats; positions are computed in double afterwards.
#include "raycast/ray_scene.h"

#include <cassert>
#include <cstring>
#include <limits>
#include <vector>

#include <tbb/task_arena.h>

#include "distance/embree.h"

namespace argil {
namespace {

/// False: no memory. Embree 4 dies of a buffer that was never made.
bool fill_positions(RTCGeometry geometry, const std::vector<Vec3>& positions) {
  void* memory = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                         3 * sizeof(float), positions.size());
  if (memory == nullptr) return false;
  float* out = static_cast<float*>(memory);
  for (const Vec3& p : positions) {
    for (std::size_t a = 0; a < 3; ++a) *out++ = static_cast<float>(p[a]);
  }
  return true;
}

bool fill_triangles(RTCGeometry geometry, const std::vector<Triangle>& triangles) {
  void* memory = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                         sizeof(Triangle), triangles.size());
  if (memory != nullptr) std::memcpy(memory, triangles.data(), triangles.size() * sizeof(Triangle));
  return memory != nullptr;
}

/// As Embree calls it; what it is told is a fraction.
bool ask_to_go_on(void* goes_on, double fraction) {
  return (*static_cast<const std::function<bool(double)>*>(goes_on))(fraction);
}

/// A ray from 0 to infinity that hits everything.
RTCRayHit ray_hit(const Vec3& origin, const Vec3& direction) {
  assert(is_finite(origin) && is_finite(direction));  // Embree ends the program of others
  RTCRayHit query{};
  query.ray.org_x = static_cast<float>(origin.x);
  query.ray.org_y = static_cast<float>(origin.y);
  query.ray.org_z = static_cast<float>(origin.z);
  query.ray.dir_x = static_cast<float>(direction.x);
  query.ray.dir_y = static_cast<float>(direction.y);
  query.ray.dir_z = static_cast<float>(direction.z);
  query.ray.tfar = std::numeric_limits<float>::infinity();
  query.ray.mask = ~0U;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  return query;
}

Vec3 facing(const Vec3& normal, const Vec3& direction) {
  return dot(normal, direction) > 0.0 ? -normal : normal;
}

}  // namespace

struct RayScene::State {
  DeviceHandle device{nullptr, &rtcReleaseDevice};
  SceneHandle scene{nullptr, &rtcReleaseScene};
  const TriangleMesh* mesh = nullptr;
};

RayScene::RayScene(std::unique_ptr<State> state) : state_(std::move(state)) {}
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;
RayScene::~RayScene() = default;

Result<RayScene> RayScene::build(const TriangleMesh& mesh,
                                 const std::function<bool(double fraction)>& goes_on) {
  const Error no_memory{ErrorKind::memory, "the ray tracer could not be built over " +
                                               std::to_string(mesh.triangles.size()) +
                                               " triangles; free memory or render a coarser mesh"};
  auto state = std::make_unique<State>();
  state->mesh = &mesh;
  state->device.reset(rtcNewDevice(nullptr));
  if (!state->device) return no_memory;
  state->scene.reset(rtcNewScene(state->device.get()));
  if (!state->scene) return no_memory;
  rtcSetSceneFlags(state->scene.get(), RTC_SCENE_FLAG_ROBUST);
  const GeometryHandle geometry(rtcNewGeometry(state->device.get(), RTC_GEOMETRY_TYPE_TRIANGLE),
                                &rtcReleaseGeometry);
  if (!geometry || !fill_positions(geometry.get(), mesh.positions) ||
      !fill_triangles(geometry.get(), mesh.triangles)) {
    return no_memory;
  }
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometry(state->scene.get(), geometry.get());
  if (goes_on) {
    rtcSetSceneProgressMonitorFunction(state->scene.get(), ask_to_go_on,
                                       const_cast<std::function<bool(double)>*>(&goes_on));
  }
  // One thread always orders the tree's leaves alike, so that of two triangles hit on their common
  // edge the same one answers in every run. Looking for all that are equally far, whatever the
  // tree, takes a second trace of each ray: a seventh of a picture's time, more than a second
  // thread would save below a million triangles. Not rtcJoinCommitScene, which leaves the caller's
  // arena for the device's, nor a device with threads=1, which holds all of TBB to one thread while
  // it lives.
  tbb::task_arena alone(1);
  alone.execute([&] { rtcCommitScene(state->scene.get()); });
  rtcSetSceneProgressMonitorFunction(state->scene.get(), nullptr, nullptr);
  const RTCError failed = rtcGetDeviceError(state->device.get());
  if (failed == RTC_ERROR_CANCELLED) {
    return Error{ErrorKind::interrupted, "interrupted; no picture was made"};
  }
  if (failed != RTC_ERROR_NONE) return no_memory;
  return RayScene(std::move(state));
}

std::optional<RayHit> RayScene::closest(const Vec3& origin, const Vec3& direction) const {
  RTCRayHit query = ray_hit(origin, direction);
  trace_closest(state_->scene.get(), query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;

  const TriangleMesh& mesh = *state_->mesh;
  assert(query.hit.primID < mesh.triangles.size());
  const Triangle& t = mesh.triangles[query.hit.primID];
  RayHit hit;
  hit.distance = static_cast<double>(query.ray.tfar);
  hit.position = origin + hit.distance * direction;
  hit.facet = facing(
      normalized(Vec3{static_cast<double>(query.hit.Ng_x), static_cast<double>(query.hit.Ng_y),
                      static_cast<double>(query.hit.Ng_z)}),
      direction);
  hit.normal = hit.facet;
  hit.triangle = query.hit.primID;
  if (!mesh.normals.empty()) {
    const double u = static_cast<double>(query.hit.u);
    const double v = static_cast<double>(query.hit.v);
    const Vec3 n = normalized((1.0 - u - v) * mesh.normals[t[0]] + u * mesh.normals[t[1]] +
                              v * mesh.normals[t[2]]);
    // The interpolated normal keeps to the side of the facet; at a silhouette it may lean away.
    if (n != Vec3{}) hit.normal = dot(n, hit.facet) < 0.0 ? -n : n;
  }
  return hit;
}

bool RayScene::occluded(const Vec3& origin, const Vec3& direction) const {
  RTCRay ray = ray_hit(origin, direction).ray;
  trace_any(state_->scene.get(), ray);
  return ray.tfar < 0.0F;
}

}  // namespace argil
