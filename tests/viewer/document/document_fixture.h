// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "document/document.h"
#include "document/document_thread.h"
#include "support/scratch.h"

namespace argil::viewer {

/// The news of a sculpture that has a single piece; of several, that of the first.
inline BlockNews only_piece(SceneNews&& news) {
  BlockNews only;
  if (!news.pieces.empty()) only = std::move(news.pieces.begin()->second);
  // Another sculpture, or none.
  only.is_fresh = only.is_fresh || !news.gone.empty();
  return only;
}

/// A document's thread whose home is a folder that goes with the test.
class DocumentThreadTest : public testing::Test {
 protected:
  static io::StartShape ball(double radius_mm) {
    return {io::StartShape::Kind::ball, {radius_mm, 0.0, 0.0}, {}};
  }
  static Tool small_tool() {
    Tool tool;
    tool.radii_mm = {2.0, 2.0, 2.0};
    return tool;
  }
  static StrokeSample at(double time_s, const Vec3& place) { return {time_s, place, {}, 1.0}; }

  /// Waits until all was done, and takes the blocks as a renderer would.
  BlockNews settle() { return only_piece(settle_all()); }
  SceneNews settle_all() {
    SceneNews all;
    do {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      std::vector<double> inputs;
      all.append(thread_.take_blocks(inputs));
    } while (!thread_.is_idle());
    return all;
  }

  std::vector<std::string> errors() {
    std::vector<std::string> found;
    for (const Notice& notice : thread_.take_notices()) {
      if (notice.kind == Notice::Kind::error) found.push_back(notice.text);
    }
    return found;
  }

  void stroke(const Vec3& from, const Vec3& to, const Tool& tool = small_tool()) {
    thread_.send(BeginStroke{tool, {}});
    for (int n = 0; n <= 10; ++n) {
      thread_.send(ExtendStroke{{at(0.01 * n, from + (0.1 * n) * (to - from))}, 0.0});
    }
    thread_.send(EndStroke{});
  }

  test::ScratchFolder folder_;
  DocumentThread thread_{DocumentThreadOptions{folder_.path()}};
};

}  // namespace argil::viewer
