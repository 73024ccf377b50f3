// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/bridge/bridge_law.h"

#include <cassert>

#include "math/units.h"

namespace argil::haptics {
namespace {

/// Eq. 4.2 on the handle, but nothing that pulls it into the surface.
Vec3 indirect_force(const BridgeSpring& spring, const Vec3& position_mm,
                    const Vec3& velocity_mm_per_s, const BridgeProxy& proxy) noexcept {
  const Vec3 stretch_mm = proxy.position_mm - position_mm;
  const Vec3 relative = proxy.velocity_mm_per_s - velocity_mm_per_s;
  const Vec3 force =
      (spring.stiffness_n_per_m * stretch_mm + spring.damping_n_s_per_m * relative) / kMmPerM;
  const bool draws_in =
      (proxy.header.flags & kBridgePlane) != 0 && dot(force, proxy.plane_normal) <= 0.0;
  return draws_in ? Vec3{} : force;
}

/// A spring and damper along the plane's normal, from the depth that the servo itself computes.
Vec3 plane_spring_force(const BridgeSpring& spring, const Vec3& position_mm,
                        const Vec3& velocity_mm_per_s, const BridgeProxy& proxy) noexcept {
  const Vec3 normal = normalized(proxy.plane_normal);
  const double depth_mm = dot(normal, proxy.plane_point_mm - position_mm);
  if (!(depth_mm > 0.0)) return {};
  const double speed = dot(normal, velocity_mm_per_s - proxy.velocity_mm_per_s);
  const double push =
      (spring.stiffness_n_per_m * depth_mm - spring.damping_n_s_per_m * speed) / kMmPerM;
  return push > 0.0 ? push * normal : Vec3{};
}

}  // namespace

const char* bridge_law_name(BridgeLaw law) noexcept {
  switch (law) {
    case BridgeLaw::direct:
      return "direct";
    case BridgeLaw::indirect:
      return "indirect";
    case BridgeLaw::clay:
      return "clay";
    case BridgeLaw::scene:
      return "scene";
    case BridgeLaw::plane:
      break;
  }
  return "plane";
}

Vec3 bridge_force(BridgeLaw law, const BridgeSpring& spring, const Vec3& position_mm,
                  const Vec3& velocity_mm_per_s, const BridgeProxy& proxy) noexcept {
  assert(spring.stiffness_n_per_m > 0.0 && spring.damping_n_s_per_m >= 0.0);
  if (is_own_force(law)) return {};
  if (law == BridgeLaw::plane) {
    if ((proxy.header.flags & kBridgePlane) == 0) return {};
    return plane_spring_force(spring, position_mm, velocity_mm_per_s, proxy);
  }
  if ((proxy.header.flags & kBridgeContact) == 0) return {};
  return law == BridgeLaw::direct ? proxy.direct_force_n
                                  : indirect_force(spring, position_mm, velocity_mm_per_s, proxy);
}

double bridge_period_s(BridgeLaw law, double servo_period_s, double simulator_rate_hz) noexcept {
  assert(servo_period_s > 0.0 && simulator_rate_hz > 0.0);
  return law == BridgeLaw::direct ? 1.0 / simulator_rate_hz : servo_period_s;
}

bool is_bridge_stable(double stiffness_n_per_m, double period_s,
                      double device_damping_n_s_per_m) noexcept {
  assert(stiffness_n_per_m >= 0.0 && period_s > 0.0 && device_damping_n_s_per_m >= 0.0);
  return stiffness_n_per_m * period_s < 2.0 * device_damping_n_s_per_m;
}

}  // namespace argil::haptics
