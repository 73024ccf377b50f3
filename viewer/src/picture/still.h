// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "argil/engine/render.h"

#include "picture/camera.h"

namespace argil::viewer {

/// A picture of what a window shows, of any size: drawn part by part, each as large as the window,
/// with several pixels for each of its own both ways, which are averaged as light.
struct StillOptions {
  static constexpr int kLeastPixels = 16;  // as of `argil render`
  static constexpr int kMostPixels = 16384;
  static constexpr int kMostSamples = 8;
  int width = 3840;   ///< pixels, kLeastPixels to kMostPixels
  int height = 2160;  ///< likewise
  int samples = 2;    ///< across a pixel, 1 to kMostSamples
  friend bool operator==(const StillOptions&, const StillOptions&) = default;
};

/// The parts of a still, one after the other, and what they add up to.
class Still {
 public:
  /// `window`: the lens of a window of so many pixels, which a part is as large as; at least
  /// kLeastPartPixels a side. All that it shows is in the still, more beside it where that is of
  /// another shape. Throws bad_alloc.
  Still(const StillOptions& options, const Lens& window, int part_width, int part_height);
  static constexpr int kLeastPartPixels = 64;

  bool is_done() const noexcept { return next_ == count(); }
  double fraction() const noexcept;
  /// By how much finer than the window's its pixels are, samples included.
  double finer() const noexcept { return finer_; }

  /// Of the part that comes next; not when it is done (assert, as for take).
  Lens lens() const;
  /// Where that part begins and ends between the bottom (0) and the top (1) of the still.
  std::pair<double, double> rows() const;
  /// That part, drawn through the lens.
  void take(const Image& part);

  /// Once it is done.
  Image image() &&;

 private:
  struct Corner {
    int x = 0;  ///< of the still's pixels, from the upper left
    int y = 0;
  };
  int count() const noexcept { return across_ * down_; }
  Corner corner() const noexcept;

  StillOptions options_;
  Lens whole_;
  int part_width_;
  int part_height_;
  int step_x_;  ///< pixels of the still that a part gives
  int step_y_;
  int across_;
  int down_;
  double finer_;
  int next_ = 0;
  Image image_;
};

}  // namespace argil::viewer
