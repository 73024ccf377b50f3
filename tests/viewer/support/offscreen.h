// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

namespace argil::test {

/// An OpenGL 3.3 core debug context without a window or display, current in the thread that made
/// it, and a framebuffer in it that stands for the window: 8-bit colour.
class Offscreen {
 public:
  /// Null when there is none here: `why_not` names what is missing then.
  static std::unique_ptr<Offscreen> make(int width, int height, std::string& why_not);
  Offscreen(const Offscreen&) = delete;
  Offscreen& operator=(const Offscreen&) = delete;
  ~Offscreen();

  unsigned framebuffer() const { return framebuffer_; }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  Offscreen() = default;

  void* display_ = nullptr;
  void* context_ = nullptr;
  unsigned framebuffer_ = 0;
  unsigned color_ = 0;
  int width_ = 0;
  int height_ = 0;
};

}  // namespace argil::test
