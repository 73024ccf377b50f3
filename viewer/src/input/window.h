// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "argil/core/result.h"

#include "input/input_event.h"
#include "input/pen.h"
#include "input/space_mouse.h"
#include "input/touch_screen.h"

struct GLFWwindow;

namespace argil::viewer {

/// A window with a current OpenGL context, and what is done to it as a list of events.
///
/// Threads  the main one.
class Window {
 public:
  /// Errors  device without a display or without OpenGL 3.3, with the remedy.
  static Result<std::unique_ptr<Window>> open(int width, int height, bool has_debug_context);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// The events since the last call. Waits for one at most this long; 0: not at all.
  std::vector<InputEvent> poll(double wait_s);

  /// Ends the wait of poll() at once, or the next one. Threads  any.
  static void wake() noexcept;

  /// Plays an event through the same callbacks that the window system calls.
  void play(const InputEvent& event);

  /// Whether what the window showed was lost, as behind another window. True once.
  bool take_exposed() noexcept { return std::exchange(is_exposed_, false); }
  bool is_exposed() const noexcept { return is_exposed_; }
  void swap();
  void set_swap_interval(int frames);
  void set_title(const std::string& title);
  /// Nobody sees it any more, though what was begun for it still ends.
  void hide();
  /// As a user would who drags its corner; the system may decide otherwise.
  void resize(int width, int height);
  double now_s() const;

  int width() const noexcept { return width_; }  ///< in pixels of the framebuffer
  int height() const noexcept { return height_; }
  double scale() const noexcept {
    return scale_;
  }  ///< how many times larger letters are on this screen

  std::string clipboard() const;
  void set_clipboard(const std::string& text);

 private:
  explicit Window(GLFWwindow* window);
  void listen();
  InputEvent& push(InputEvent::Kind kind, int glfw_modifiers);
  void measure();
  void wait(double wait_s);
  void take_space_mouse();
  void take_fingers();
  bool is_polled() const noexcept;

  GLFWwindow* window_;
  std::unique_ptr<Pen> pen_;  // null where there is none, as the next two
  std::unique_ptr<SpaceMouse> space_mouse_;
  std::unique_ptr<TouchScreen> touch_screen_;
  std::set<unsigned> fingers_;  // that came down in this window and are still down
  std::vector<InputEvent> events_;
  PenState pen_state_;  // the newest
  double x_ = 0.0;
  double y_ = 0.0;
  Modifiers modifiers_;
  int width_ = 0;
  int height_ = 0;
  double scale_ = 1.0;
  bool is_exposed_ = true;
};

}  // namespace argil::viewer
