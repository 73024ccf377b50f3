// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// Embree 3 (Debian 12) and 4 (Debian 13): what of their differences matters to this library is
/// here and nowhere else in it. Both trace a single ray with no filter but the geometry's unless
/// told otherwise.
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace argil::mesh {

/// What goes with a ray to the geometry's filter, which gets a pointer to it: derive from it what
/// that is to know.
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

}  // namespace argil::mesh
