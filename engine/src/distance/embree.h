// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// Embree 3 (Debian 12) and 4 (Debian 13): what differs between them is here and nowhere else.
/// Both trace a single ray with no filter and as an incoherent one unless told otherwise.
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace argil {

/// The closest hit along the ray, written into `query`; its mask must not be 0.
inline void trace_closest(RTCScene scene, RTCRayHit& query) noexcept {
#if RTC_VERSION_MAJOR >= 4
  rtcIntersect1(scene, &query);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &query);
#endif
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
