// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/servo/passivity.h"

#include <cmath>

#include <gtest/gtest.h>

#include "haptics/servo/loop_scenes.h"

namespace argil::haptics {
namespace {

TEST(PassivityObserver, CountsForceTimesWay) {
  PassivityController observer({}, 0);
  observer.tick({0.0, 2.0, 0.0}, {}, 1e-3);
  observer.tick({0.0, 0.0, 0.0}, {0.0, 3.0, 0.0}, 1e-3);  // 2 N held over 3 mm
  EXPECT_DOUBLE_EQ(observer.given_nmm(), 6.0);
  observer.tick({0.0, 0.0, 0.0}, {0.0, 5.0, 0.0}, 1e-3);
  EXPECT_DOUBLE_EQ(observer.given_nmm(), 6.0);
}

TEST(PassivityObserver, DoesNotTouchTheForce) {
  PassivityController observer({}, 0);
  for (int n = 0; n < 100; ++n) {
    const Vec3 force{0.0, 5.0, 1.0};
    EXPECT_EQ(observer.tick(force, {0.0, 0.1, 0.0}, 1e-3), force);
  }
  EXPECT_GT(observer.given_nmm(), 0.0);
}

TEST(PassivityController, TakesBackWhatWasGiven) {
  PassivityOptions options;
  options.controls = true;
  PassivityController controller(options, 0);
  controller.tick({0.0, 2.0, 0.0}, {}, 1e-3);
  const Vec3 force = controller.tick({}, {0.0, 0.1, 0.0}, 1e-3);  // 0.2 mJ given
  EXPECT_LT(force.y, 0.0);                                        // now it brakes
  controller.tick({}, {0.0, 0.1, 0.0}, 1e-3);
  EXPECT_LT(controller.given_nmm(), 0.2);
}

TEST(PassivityObserver, CountsTheForceThatActedAfterItsDelay) {
  PassivityController observer({}, 1);
  observer.tick({0.0, 2.0, 0.0}, {}, 1e-3);
  observer.tick({0.0, 0.0, 0.0}, {0.0, 3.0, 0.0}, 1e-3);  // nothing was held yet
  EXPECT_DOUBLE_EQ(observer.given_nmm(), 0.0);
  observer.tick({0.0, 0.0, 0.0}, {0.0, 3.0, 0.0}, 1e-3);
  EXPECT_DOUBLE_EQ(observer.given_nmm(), 6.0);
}

TEST(PassivityController, CalmsAWallThatCycles) {
  ServoOptions servo = bare_servo(1e-3);
  for (const bool controls : {false, true}) {
    servo.passivity.controls = controls;
    scenes::PlainWall wall(8000.0);
    const HoldTestResult result =
        run_hold_test(wall, scenes::press_wall(Hand::push, 8000.0, servo));
    EXPECT_EQ(result.judgement.verdict == Verdict::limit_cycle, !controls);
  }
}

}  // namespace
}  // namespace argil::haptics
