// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// Embree 3 (Debian 12) and 4 (Debian 13): what differs between them is here and nowhere else.
/// Both trace a single ray with no filter and as an incoherent one unless told otherwise.
#include <memory>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace argil {

using DeviceHandle = std::unique_ptr<RTCDeviceTy, decltype(&rtcReleaseDevice)>;
using SceneHandle = std::unique_ptr<RTCSceneTy, decltype(&rtcReleaseScene)>;
using GeometryHandle = std::unique_ptr<RTCGeometryTy, decltype(&rtcReleaseGeometry)>;

/// What goes with a ray to the callbacks of user geometries, which get a pointer to it: derive from
/// it what they are to know.
#if RTC_VERSION_MAJOR >= 4
struct RayContext : RTCRayQueryContext {
  RayContext() noexcept { rtcInitRayQueryContext(this); }
};
#else
struct RayContext : RTCIntersectContext {
  RayContext() noexcept { rtcInitIntersectContext(this); }
};
#endif

/// The closest hit along the ray, written into `query`; its mask must not be 0.
inline void trace_closest(RTCScene scene, RTCRayHit& query, RayContext& context) noexcept {
#if RTC_VERSION_MAJOR >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context;
  rtcIntersect1(scene, &query, &arguments);
#else
  rtcIntersect1(scene, &context, &query);
#endif
}
inline void trace_closest(RTCScene scene, RTCRayHit& query) noexcept {
  RayContext context;
  trace_closest(scene, query, context);
}

/// In a callback of a user geometry: the ray that it is asked about, one at a time as it is traced
/// here.
inline RTCRayHit& asked_ray(const RTCIntersectFunctionNArguments& arguments) noexcept {
  return *reinterpret_cast<RTCRayHit*>(arguments.rayhit);
}

/// Tells Embree that the primitive is hit there. Version 3 sees it by the ray alone, 4 asks for the
/// answer as well.
inline void answer_hit(const RTCIntersectFunctionNArguments& arguments, float along) noexcept {
  RTCRayHit& query = asked_ray(arguments);
  query.ray.tfar = along;
  query.hit.geomID = arguments.geomID;
  query.hit.primID = arguments.primID;
  arguments.valid[0] = -1;
}
inline void answer_miss(const RTCIntersectFunctionNArguments& arguments) noexcept {
  arguments.valid[0] = 0;
}

/// Any hit along the ray makes its `tfar` negative; its mask must not be 0.
inline void trace_any(RTCScene scene, RTCRay& ray) noexcept {
#if RTC_VERSION_MAJOR >= 4
  rtcOccluded1(scene, &ray);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, &ray);
#endif
}

}  // namespace argil
