// SPDX-License-Identifier: GPL-3.0-or-later
// A window that is made of what the last one left has the bits of a fresh one.
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "argil/engine/window.h"

#include "support/effort.h"

namespace argil {
namespace {

/// A tool that wanders about a clay, works it, is taken back and changes its size.
class Wandering {
 public:
  Wandering(Clay clay, std::uint32_t seed) : clay_(std::move(clay)), random_(seed) {}

  void run(int steps) {
    choose_tool();
    for (int step = 0; step < steps; ++step) {
      SCOPED_TRACE("step " + std::to_string(step) + ", " + what_);
      do_something();
      expect_same_as_fresh();
      if (::testing::Test::HasFailure()) return;
    }
    EXPECT_GT(dabs_, steps / 20);
  }

 private:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Vec3 direction() { return normalized(Vec3{between(-1, 1), between(-1, 1), between(-1, 1.01)}); }

  void choose_tool() {
    radius_mm_ = std::exp2(between(0.0, 3.3));
    voxel_mm_ = radius_mm_ / 4.0;
    place_ = direction() * between(14.0, 18.0);
  }

  void do_something() {
    const int choice = std::uniform_int_distribution<int>(0, 99)(random_);
    if (choice < 55) {
      place_ += direction() * (voxel_mm_ * between(0.0, 4.0));
      what_ = "moved";
    } else if (choice < 90) {
      dab(choice);
    } else if (choice < 95) {
      what_ = clay_.undo() ? "undone" : "nothing to undo";
    } else {
      choose_tool();
      what_ = "another tool";
    }
  }

  void dab(int choice) {
    constexpr Action kActions[] = {Action::carve, Action::add, Action::smooth, Action::inflate};
    Stroke stroke;
    stroke.tool.action = kActions[choice % 4];
    const double radius = radius_mm_ * between(0.3, 1.0);
    stroke.tool.radii_mm = {radius, radius, radius};
    stroke.samples = {{0.0, place_ + direction() * (0.5 * radius_mm_), {}, 1.0}};
    if (clay_.apply(stroke)) ++dabs_;
    what_ = "a dab of action " + std::to_string(choice % 4);
  }

  void expect_same_as_fresh() {
    const WindowRequest request{place_, voxel_mm_, 2.2 * radius_mm_, 2.0 * radius_mm_ + 4.0};
    ASSERT_TRUE(publisher_.publish(clay_, request).ok());
    ASSERT_TRUE(channel_.fetch());
    const FieldWindow fresh = read_window(clay_, request, Extension::layers).value();
    const FieldWindowView kept = channel_.read_slot().view();
    ASSERT_EQ(kept.distance_mm.size(), fresh.storage.size());
    std::size_t differ = 0;
    for (std::size_t n = 0; n < fresh.storage.size(); ++n) {
      differ += kept.distance_mm[n] == fresh.storage[n] ? 0U : 1U;
    }
    EXPECT_EQ(differ, 0U) << "of " << fresh.storage.size() << " nodes, radius " << radius_mm_;
    EXPECT_EQ(kept.distance_error_mm, fresh.view.distance_error_mm);
  }

  Clay clay_;
  std::mt19937 random_;
  WindowChannel channel_;
  WindowPublisher publisher_{channel_};
  double radius_mm_ = 0.0;
  double voxel_mm_ = 0.0;
  Vec3 place_;
  std::string what_;
  int dabs_ = 0;
};

TEST(WindowTiles, HaveTheBitsOfAFreshWindow) {
  const int runs = test::effort(2, 20);
  for (int run = 0; run < runs; ++run) {
    SCOPED_TRACE("run " + std::to_string(run));
    ClayOptions options;
    options.voxel_mm = 0.5;
    Wandering(Clay::ball(16.0, options).value(), 17U + static_cast<std::uint32_t>(run))
        .run(test::effort(60, 500));
  }
}

}  // namespace
}  // namespace argil
