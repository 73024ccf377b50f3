// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/support/pinholes.h"

#include <cassert>
#include <cstddef>
#include <utility>
#include <vector>

#include "viewer/support/scene.h"

namespace argil::test {
namespace {

constexpr std::size_t kLargest = 64;

/// Anything of the gradient that the background shader mixes: bluish, 41 to 94 of 255.
bool is_background(const Rgb& pixel) {
  return pixel.red >= 40 && pixel.blue <= 95 && pixel.blue >= pixel.red &&
         pixel.blue <= pixel.red + 8;
}
bool is_clay(const Rgb& pixel) { return pixel.red > pixel.blue + 4; }

class Patches {
 public:
  Patches(const Image& picture, int left, int right)
      : picture_(picture),
        left_(left),
        right_(right),
        seen_(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height)) {
    assert(0 <= left && right <= picture.width);
  }

  int enclosed() {
    int count = 0;
    for (int y = 0; y < picture_.height; ++y) {
      for (int x = left_; x < right_; ++x) {
        if (visit(x, y) && is_enclosed({x, y})) ++count;
      }
    }
    return count;
  }

 private:
  /// Whether it is background that was not seen before.
  bool visit(int x, int y) {
    const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width) +
                           static_cast<std::size_t>(x);
    if (seen_[at] || !is_background(rgb_at(picture_, x, y))) return false;
    seen_[at] = true;
    return true;
  }

  /// The patch that goes on from its first pixel.
  bool is_enclosed(const std::pair<int, int>& first) {
    bool has_clay_around = true;
    std::size_t size = 0;
    std::vector<std::pair<int, int>> open{first};
    while (!open.empty()) {
      const auto [x, y] = open.back();
      open.pop_back();
      ++size;
      for (const auto& [to_x, to_y] : {std::pair{x - 1, y}, {x + 1, y}, {x, y - 1}, {x, y + 1}}) {
        if (to_x < left_ || to_x >= right_ || to_y < 0 || to_y >= picture_.height) {
          has_clay_around = false;
        } else if (visit(to_x, to_y)) {
          open.emplace_back(to_x, to_y);
        } else if (const Rgb beside = rgb_at(picture_, to_x, to_y); !is_background(beside)) {
          has_clay_around = has_clay_around && is_clay(beside);
        }
      }
    }
    return has_clay_around && size <= kLargest;
  }

  const Image& picture_;
  int left_;
  int right_;
  std::vector<bool> seen_;
};

}  // namespace

int pinholes(const Image& picture, int left, int right) {
  return Patches(picture, left, right).enclosed();
}

}  // namespace argil::test
