// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/bridge/bridge_law.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

namespace argil::haptics {
namespace {

constexpr BridgeSpring kSpring{1000.0, 4.0};
constexpr Vec3 kInside{2.0, -1.0, 0.0};

/// A floor, touched below the handle.
BridgeProxy on_floor(const Vec3& handle_mm) {
  BridgeProxy proxy;
  proxy.header.flags = kBridgeContact | kBridgePlane;
  proxy.position_mm = proxy.plane_point_mm = {handle_mm.x, 0.0, handle_mm.z};
  proxy.direct_force_n = {0.0, 1.5, 0.0};
  return proxy;
}

TEST(BridgeLaw, DirectGivesWhatTheSimulatorSaysWhileItTouches) {
  BridgeProxy proxy = on_floor(kInside);
  EXPECT_EQ(bridge_force(BridgeLaw::direct, kSpring, kInside, {}, proxy), proxy.direct_force_n);
  proxy.header.flags = kBridgePlane;
  EXPECT_EQ(bridge_force(BridgeLaw::direct, kSpring, kInside, {}, proxy), Vec3{});
}

TEST(BridgeLaw, IndirectDrawsTheHandleToTheProxy) {
  // 1 mm and 1000 N/m: 1 N towards the proxy, where eq. 4.2 as printed pushes away from it.
  const Vec3 force = bridge_force(BridgeLaw::indirect, kSpring, kInside, {}, on_floor(kInside));
  EXPECT_DOUBLE_EQ(force.y, 1.0);
  EXPECT_EQ(force.x, 0.0);
  const Vec3 damped =
      bridge_force(BridgeLaw::indirect, kSpring, kInside, {0.0, -100.0, 0.0}, on_floor(kInside));
  EXPECT_DOUBLE_EQ(damped.y, 1.4);
}

TEST(BridgeLaw, IndirectLetsGoOfAHandleThatHasLeft) {
  const Vec3 outside{2.0, 0.5, 0.0};
  BridgeProxy proxy = on_floor(kInside);
  EXPECT_EQ(bridge_force(BridgeLaw::indirect, kSpring, outside, {}, proxy), Vec3{});
  proxy.header.flags = 0;
  EXPECT_EQ(bridge_force(BridgeLaw::indirect, kSpring, kInside, {}, proxy), Vec3{});
}

TEST(BridgeLaw, PlaneIsProjectedOnAnewAndNeverDrawsNorDrags) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-5.0, 5.0);
  std::uniform_real_distribution<double> speed(-300.0, 300.0);
  for (int n = 0; n < 10'000; ++n) {
    BridgeProxy proxy = on_floor({});
    proxy.plane_normal = normalized(Vec3{place(random), place(random), place(random)});
    const Vec3 at{place(random), place(random), place(random)};
    const Vec3 v{speed(random), speed(random), speed(random)};
    const Vec3 force = bridge_force(BridgeLaw::plane, kSpring, at, v, proxy);
    const double along = dot(force, proxy.plane_normal);
    const double depth = -dot(proxy.plane_normal, at);
    EXPECT_GE(along, 0.0);
    EXPECT_LT(length(force - along * proxy.plane_normal), 1e-12);
    if (depth <= 0.0) {
      EXPECT_EQ(force, Vec3{});
    }
    const double wanted = depth - 4.0 * dot(v, proxy.plane_normal) / 1000.0;
    if (depth > 0.0) {
      EXPECT_NEAR(along, std::max(0.0, wanted), 1e-9);
    }
  }
}

TEST(BridgeLaw, RefusesByTheSlowerLoop) {
  EXPECT_DOUBLE_EQ(bridge_period_s(BridgeLaw::direct, 1e-3, 60.0), 1.0 / 60.0);
  EXPECT_DOUBLE_EQ(bridge_period_s(BridgeLaw::plane, 1e-3, 60.0), 1e-3);
  EXPECT_TRUE(is_bridge_stable(5999.0, 1e-3, 3.0));
  EXPECT_FALSE(is_bridge_stable(6000.0, 1e-3, 3.0));
  EXPECT_FALSE(is_bridge_stable(1500.0, 1.0 / 60.0, 3.0));
  EXPECT_TRUE(is_bridge_stable(359.0, 1.0 / 60.0, 3.0));
}

}  // namespace
}  // namespace argil::haptics
