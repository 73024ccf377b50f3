// SPDX-License-Identifier: GPL-3.0-or-later
// A session with large tools, drawn at every moment as the window draws it: nothing may be seen
// through the clay.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "argil/io/project_file.h"

#include "document/document_thread.h"
#include "support/bumpy_clay.h"
#include "support/scratch.h"
#include "viewer/document/document_fixture.h"
#include "viewer/support/scene.h"

namespace argil::test {
namespace {

using viewer::BlockNews;

/// Background that no way through background leads to from the border of the picture, straight or
/// askew: holes in one solid that hides nothing behind an arch.
int pinholes(const viewer::DepthMap& map) {
  const int width = map.width;
  const int height = map.height;
  const auto at = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  };
  std::vector<bool> is_open(map.depth_mm.size());
  for (std::size_t n = 0; n < is_open.size(); ++n) is_open[n] = !std::isfinite(map.depth_mm[n]);
  std::vector<std::pair<int, int>> reached;
  const auto reach = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= width || y >= height || !is_open[at(x, y)]) return;
    is_open[at(x, y)] = false;
    reached.emplace_back(x, y);
  };
  for (int x = 0; x < width; ++x) {
    reach(x, 0);
    reach(x, height - 1);
  }
  for (int y = 0; y < height; ++y) {
    reach(0, y);
    reach(width - 1, y);
  }
  while (!reached.empty()) {
    const auto [x, y] = reached.back();
    reached.pop_back();
    for (int n = 0; n < 9; ++n) reach(x + n / 3 - 1, y + n % 3 - 1);
  }
  return static_cast<int>(std::count(is_open.begin(), is_open.end(), true));
}

class PreviewedSessionGl : public RendererScene {
 protected:
  static constexpr double kBallMm = 14.0;
  static constexpr double kVoxelMm = 0.1;

  /// A ball whose finest level is everywhere.
  void open() {
    const auto clay = bumpy_ball(kBallMm, kVoxelMm);
    ASSERT_TRUE(clay.ok());
    ASSERT_TRUE(io::save_project(folder_ / "p.vdb", clay.value()).ok());
    thread_.send(viewer::OpenFile{folder_ / "p.vdb"});
    settle();
  }

  /// Takes what there is and looks at it.
  void look() {
    std::vector<double> inputs;
    const BlockNews news = viewer::only_piece(thread_.take_blocks(inputs));
    if (news.empty()) return;
    if (news.is_fresh) renderer_->clear();
    for (const BlockId& id : news.gone) renderer_->drop(0, id);
    for (const auto& [id, block] : news.changed) {
      put(block);
      seams_ += id.origin[0] % 8 != 0 ? 1 : 0;
    }
    draw({});
    EXPECT_EQ(pinholes(renderer_->read_depth()), 0) << "picture " << pictures_;
    ++pictures_;
  }
  void settle() {
    do {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      look();
    } while (!thread_.is_idle());
  }

  /// The stroke's pieces one by one, each looked at when it is drawn.
  void stroke(Action action, double radius_mm, double strength) {
    Tool tool;
    tool.action = action;
    tool.radii_mm = {radius_mm, radius_mm, radius_mm};
    tool.strength = strength;
    thread_.send(viewer::BeginStroke{tool, {}});
    for (int n = 0; n < 6; ++n) {
      const double turn = 0.12 * n - 0.3;
      const Vec3 place = kBallMm * Vec3{std::sin(turn), -std::cos(turn), 0.1};
      thread_.send(viewer::ExtendStroke{{{0.01 * n, place, {}, 1.0}}, 0.0});
      const int before = pictures_;
      for (int wait = 0; wait < 1000 && pictures_ == before; ++wait) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        look();
      }
    }
    thread_.send(viewer::EndStroke{});
  }

  ScratchFolder folder_;
  viewer::DocumentThread thread_{viewer::DocumentThreadOptions{folder_.path()}};
  int pictures_ = 0;
  int seams_ = 0;
};

TEST_F(PreviewedSessionGl, ShowsNoPinhole) {
  look_at(kBallMm + 3.0);
  camera_.zoom(2.0, {0.5 * kWidth, 0.5 * kHeight});  // a voxel is two pixels
  open();
  stroke(Action::carve, 10.0, 1.0);
  settle();
  EXPECT_GT(seams_, 0);
  // Each of these begins while the clay still works at the one before.
  stroke(Action::smooth, 5.0, 0.6);
  stroke(Action::add, 10.0, 0.9);
  stroke(Action::inflate, 5.0, -0.5);
  stroke(Action::grab, 5.0, 0.4);
  stroke(Action::flatten, 6.0, 0.5);
  settle();
  EXPECT_GT(pictures_, 15);
  RecordProperty("pictures", pictures_);
}

}  // namespace
}  // namespace argil::test
