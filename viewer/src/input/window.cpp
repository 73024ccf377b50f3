// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/window.h"

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <utility>

#include <epoxy/gl.h>
// epoxy before GLFW, which would bring OpenGL's own header.
#include <GLFW/glfw3.h>

namespace argil::viewer {
namespace {

static_assert(kKeyEscape == GLFW_KEY_ESCAPE && kKeyHome == GLFW_KEY_HOME &&
              kKeyF12 == GLFW_KEY_F12 && kKeyPad9 == GLFW_KEY_KP_9 &&
              kKeyPadPeriod == GLFW_KEY_KP_DECIMAL && kKeyPadEnter == GLFW_KEY_KP_ENTER &&
              kKeyApostrophe == GLFW_KEY_APOSTROPHE && kKeyComma == GLFW_KEY_COMMA &&
              kKeyMinus == GLFW_KEY_MINUS && kKeySlash == GLFW_KEY_SLASH &&
              kKeySemicolon == GLFW_KEY_SEMICOLON && kKeyEqual == GLFW_KEY_EQUAL &&
              kKeyBackslash == GLFW_KEY_BACKSLASH && kKeyGrave == GLFW_KEY_GRAVE_ACCENT &&
              kKeyInsert == GLFW_KEY_INSERT && kKeyPageUp == GLFW_KEY_PAGE_UP &&
              kKeyPageDown == GLFW_KEY_PAGE_DOWN && kKeyPause == GLFW_KEY_PAUSE &&
              kKeyPadDivide == GLFW_KEY_KP_DIVIDE && kKeyPadTimes == GLFW_KEY_KP_MULTIPLY &&
              kKeyPadMinus == GLFW_KEY_KP_SUBTRACT && kKeyPadPlus == GLFW_KEY_KP_ADD);

/// The Window that GLFW calls back for.
Window& self(GLFWwindow* window) { return *static_cast<Window*>(glfwGetWindowUserPointer(window)); }

/// GLFW's reason for the last failure.
std::string last_words() {
  const char* words = nullptr;
  glfwGetError(&words);
  return words != nullptr ? words : "no reason given";
}

int glfw_button(MouseButton button) {
  if (button == MouseButton::left) return GLFW_MOUSE_BUTTON_LEFT;
  return button == MouseButton::right ? GLFW_MOUSE_BUTTON_RIGHT : GLFW_MOUSE_BUTTON_MIDDLE;
}

/// The modifier that a key is; 0 for others.
int modifier_of(int key) {
  if (key == GLFW_KEY_LEFT_SHIFT || key == GLFW_KEY_RIGHT_SHIFT) return GLFW_MOD_SHIFT;
  if (key == GLFW_KEY_LEFT_CONTROL || key == GLFW_KEY_RIGHT_CONTROL) return GLFW_MOD_CONTROL;
  return key == GLFW_KEY_LEFT_ALT || key == GLFW_KEY_RIGHT_ALT ? GLFW_MOD_ALT : 0;
}

int glfw_modifiers(const Modifiers& modifiers) {
  return (modifiers.shift ? GLFW_MOD_SHIFT : 0) | (modifiers.ctrl ? GLFW_MOD_CONTROL : 0) |
         (modifiers.alt ? GLFW_MOD_ALT : 0);
}

/// GLFW 3.4 prefers Wayland, which tells no window its place, and beside which neither a pen nor
/// fingers are heard (pen.h): X11, also that of a Wayland session, where there is one.
bool start_glfw() {
#ifdef GLFW_PLATFORM_X11
  if (std::getenv("DISPLAY") != nullptr) {  // NOLINT(concurrency-mt-unsafe): nobody changes it
    glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
    if (glfwInit() == GLFW_TRUE) return true;
    glfwInitHint(GLFW_PLATFORM, GLFW_ANY_PLATFORM);
  }
#endif
  return glfwInit() == GLFW_TRUE;
}

InputEvent::Kind kind_of(FingerEvent::What what) {
  switch (what) {
    case FingerEvent::What::down:
      return InputEvent::Kind::finger_down;
    case FingerEvent::What::move:
      return InputEvent::Kind::finger_move;
    case FingerEvent::What::up:
      break;
  }
  return InputEvent::Kind::finger_up;
}

}  // namespace

Result<std::unique_ptr<Window>> Window::open(int width, int height, bool has_debug_context) {
  assert(width > 0 && height > 0);
  if (!start_glfw()) {
    return Error{ErrorKind::device, "there is no display to open a window on (" + last_words() +
                                        "); run in a desktop session, or under xvfb-run"};
  }
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, has_debug_context ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);  // the renderer has its own
  GLFWwindow* window = glfwCreateWindow(width, height, "Argil", nullptr, nullptr);
  if (window == nullptr) {
    Error error{ErrorKind::device, "there is no OpenGL 3.3 for a window (" + last_words() +
                                       "); install a graphics driver, or libgl1-mesa-dri"};
    glfwTerminate();
    return error;
  }
  // What the panels need; the same as options may ask for.
  glfwSetWindowSizeLimits(window, 320, 240, GLFW_DONT_CARE, GLFW_DONT_CARE);
  glfwMakeContextCurrent(window);
  std::unique_ptr<Window> made(new Window(window));
  made->listen();
  return made;
}

Window::Window(GLFWwindow* window)
    : window_(window),
      pen_(Pen::open()),
      space_mouse_(SpaceMouse::open()),
      touch_screen_(TouchScreen::open()) {
  assert(window != nullptr);
  measure();
}

Window::~Window() {
  glfwDestroyWindow(window_);
  glfwTerminate();
}

void Window::measure() {
  // On displays with a scale the framebuffer has more pixels than the window has units.
  const std::pair former{width_, height_};
  glfwGetFramebufferSize(window_, &width_, &height_);
  // Of a window that was made smaller nothing is exposed.
  if (former != std::pair{width_, height_}) is_exposed_ = true;
  float x = 1.0F;
  float y = 1.0F;
  glfwGetWindowContentScale(window_, &x, &y);
  scale_ = static_cast<double>(x);
}

InputEvent& Window::push(InputEvent::Kind kind, int modifiers) {
  modifiers_ = {(modifiers & GLFW_MOD_SHIFT) != 0, (modifiers & GLFW_MOD_CONTROL) != 0,
                (modifiers & GLFW_MOD_ALT) != 0};
  InputEvent event;
  event.kind = kind;
  event.time_s = now_s();
  event.x = x_;
  event.y = y_;
  event.pressure = pen_state_.pressure;
  event.is_eraser = pen_state_.is_eraser;
  event.modifiers = modifiers_;
  return events_.emplace_back(std::move(event));
}

void Window::listen() {
  // The callbacks only note what happened: poll() hands it on between frames.
  glfwSetWindowUserPointer(window_, this);
  glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
    Window& me = self(window);
    int wide = 1;
    int high = 1;
    glfwGetWindowSize(window, &wide, &high);
    me.x_ = wide > 0 ? x * me.width_ / wide : x;
    me.y_ = high > 0 ? y * me.height_ / high : y;
    me.push(InputEvent::Kind::move, glfw_modifiers(me.modifiers_));
  });
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int mods) {
    if (button > GLFW_MOUSE_BUTTON_MIDDLE) return;  // the thumb's buttons
    assert(button >= 0);
    auto& event = self(window).push(
        action == GLFW_PRESS ? InputEvent::Kind::press : InputEvent::Kind::release, mods);
    event.button = static_cast<MouseButton>(button);
  });
  glfwSetScrollCallback(window_, [](GLFWwindow* window, double, double steps) {
    Window& me = self(window);
    me.push(InputEvent::Kind::scroll, glfw_modifiers(me.modifiers_)).steps = steps;
  });
  glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int mods) {
    // X11 says of a modifier what was before it was pressed or let go.
    const int own = modifier_of(key);
    mods = action == GLFW_RELEASE ? mods & ~own : mods | own;
    auto& event = self(window).push(
        action == GLFW_RELEASE ? InputEvent::Kind::key_up : InputEvent::Kind::key_down, mods);
    event.key = key;
    event.is_repeat = action == GLFW_REPEAT;
  });
  glfwSetCharCallback(window_, [](GLFWwindow* window, unsigned character) {
    Window& me = self(window);
    me.push(InputEvent::Kind::text, glfw_modifiers(me.modifiers_)).character = character;
  });
  glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** files) {
    Window& me = self(window);
    me.push(InputEvent::Kind::drop, 0).files.assign(files, files + count);
  });
  glfwSetWindowFocusCallback(window_, [](GLFWwindow* window, int has_focus) {
    if (has_focus == GLFW_FALSE) self(window).push(InputEvent::Kind::away, 0);
  });
  glfwSetWindowRefreshCallback(window_,
                               [](GLFWwindow* window) { self(window).is_exposed_ = true; });
  glfwSetWindowCloseCallback(window_, [](GLFWwindow* window) {
    glfwSetWindowShouldClose(window, GLFW_FALSE);  // the program asks first
    self(window).push(InputEvent::Kind::close, 0);
  });
}

/// Events that were played since the last call are handed on first and without waiting.
std::vector<InputEvent> Window::poll(double wait_s) {
  assert(wait_s >= 0.0);
  // Before the motions that the pen's pressure belongs to are taken.
  if (pen_ != nullptr) pen_state_ = pen_->poll().value_or(pen_state_);
  wait(events_.empty() ? wait_s : 0.0);
  take_fingers();
  measure();
  return std::exchange(events_, {});
}

/// GLFW wakes neither for a 3D mouse nor for a second finger: what is there is polled a hundred
/// times a second.
bool Window::is_polled() const noexcept {
  return space_mouse_ != nullptr || (touch_screen_ != nullptr && touch_screen_->is_touched());
}

void Window::wait(double wait_s) {
  constexpr double kSliceS = 0.01;
  const double until_s = now_s() + wait_s;
  take_space_mouse();
  while (is_polled() && events_.empty() && now_s() + kSliceS < until_s) {
    glfwWaitEventsTimeout(kSliceS);
    take_space_mouse();
    take_fingers();
  }
  const double rest_s = until_s - now_s();
  if (events_.empty() && rest_s > 0.0) {
    glfwWaitEventsTimeout(rest_s);
  } else {
    glfwPollEvents();
  }
}

void Window::take_space_mouse() {
  if (space_mouse_ == nullptr) return;
  for (InputEvent& event : space_mouse_->poll()) {
    event.time_s = now_s();
    event.x = x_;
    event.y = y_;
    events_.push_back(std::move(event));
  }
}

/// Those that came down in this window, where no other lies over it: the pointer follows the first.
void Window::take_fingers() {
  if (touch_screen_ == nullptr) return;
  for (const FingerEvent& told : touch_screen_->poll()) {
    int left = 0;
    int top = 0;
    int wide = 1;
    int high = 1;
    glfwGetWindowPos(window_, &left, &top);
    glfwGetWindowSize(window_, &wide, &high);
    const double x = told.screen.x - left;
    const double y = told.screen.y - top;
    if (told.what == FingerEvent::What::down) {
      const bool is_in = x >= 0.0 && y >= 0.0 && x < wide && y < high;
      if (is_in && glfwGetWindowAttrib(window_, GLFW_HOVERED) == GLFW_TRUE) {
        fingers_.insert(told.finger);
      }
    }
    if (fingers_.count(told.finger) == 0) continue;
    if (told.what == FingerEvent::What::up) fingers_.erase(told.finger);
    InputEvent& event = push(kind_of(told.what), glfw_modifiers(modifiers_));
    event.finger = told.finger;
    event.x = wide > 0 ? x * width_ / wide : x;
    event.y = high > 0 ? y * height_ / high : y;
  }
}

/// Through GLFW's own callbacks, so that what a script does takes the way of a real event, and a
/// fault in that way shows in tests.
void Window::play(const InputEvent& event) {
  pen_state_ = {event.pressure, event.is_eraser};
  int wide = width_;
  int high = height_;
  glfwGetWindowSize(window_, &wide, &high);
  const int mods = glfw_modifiers(event.modifiers);
  // GLFW tells a callback only when another takes its place: set none, and set it again.
  const auto callback_of = [this](auto set) {
    auto callback = set(window_, nullptr);
    set(window_, callback);
    return callback;
  };
  switch (event.kind) {
    case InputEvent::Kind::move:
      modifiers_ = event.modifiers;
      callback_of(glfwSetCursorPosCallback)(window_, event.x * wide / width_,
                                            event.y * high / height_);
      break;
    case InputEvent::Kind::press:
    case InputEvent::Kind::release:
      callback_of(glfwSetMouseButtonCallback)(
          window_, glfw_button(event.button),
          event.kind == InputEvent::Kind::press ? GLFW_PRESS : GLFW_RELEASE, mods);
      break;
    case InputEvent::Kind::scroll:
      callback_of(glfwSetScrollCallback)(window_, 0.0, event.steps);
      break;
    case InputEvent::Kind::puck:
    case InputEvent::Kind::finger_down:
    case InputEvent::Kind::finger_move:
    case InputEvent::Kind::finger_up:
      events_.push_back(event);
      events_.back().time_s = now_s();
      break;
    case InputEvent::Kind::key_down:
    case InputEvent::Kind::key_up:
      callback_of(glfwSetKeyCallback)(
          window_, event.key, 0, event.kind == InputEvent::Kind::key_up ? GLFW_RELEASE : GLFW_PRESS,
          mods);
      break;
    case InputEvent::Kind::text:
      callback_of(glfwSetCharCallback)(window_, event.character);
      break;
    case InputEvent::Kind::drop: {
      std::vector<const char*> files;
      files.reserve(event.files.size());
      for (const std::string& file : event.files) files.push_back(file.c_str());
      callback_of(glfwSetDropCallback)(window_, static_cast<int>(files.size()), files.data());
      break;
    }
    case InputEvent::Kind::away:
      callback_of(glfwSetWindowFocusCallback)(window_, GLFW_FALSE);
      break;
    case InputEvent::Kind::close:
      callback_of(glfwSetWindowCloseCallback)(window_);
      break;
  }
}

void Window::wake() noexcept { glfwPostEmptyEvent(); }
void Window::swap() { glfwSwapBuffers(window_); }
void Window::set_swap_interval(int frames) { glfwSwapInterval(frames); }
void Window::hide() { glfwHideWindow(window_); }

void Window::set_title(const std::string& title) { glfwSetWindowTitle(window_, title.c_str()); }
void Window::resize(int width, int height) { glfwSetWindowSize(window_, width, height); }
double Window::now_s() const { return glfwGetTime(); }

std::string Window::clipboard() const {
  const char* text = glfwGetClipboardString(window_);
  return text != nullptr ? text : "";
}
void Window::set_clipboard(const std::string& text) {
  glfwSetClipboardString(window_, text.c_str());
}

}  // namespace argil::viewer
