// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "input_event.h"
#include "renderer.h"

namespace argil::viewer {

class Window;

/// Height of the letters at a scale of 1, which sizes of widgets are meant for.
inline constexpr float kLetterPixels = 15.0F;

/// Dear ImGui behind a window's events, and where its widgets are, so that a script can click what
/// a person would.
///
/// Threads  the window's. One at a time.
class Gui {
 public:
  explicit Gui(Window& window);
  ~Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;

  /// Feeds an event; true when a panel takes it: any key while a menu or a list is open.
  bool feed(const InputEvent& event);

  /// Esc closes an open menu or list, and does nothing else: true where it did. What a dialog
  /// holds it leaves to the dialog.
  bool leaves_list(const InputEvent& event);

  void begin_frame(double elapsed_s);
  /// True when the panels look otherwise than at the last end_frame.
  bool end_frame();
  /// Draws them over what is in the window's framebuffer.
  void draw() const;

  /// Whether the pointer is a panel's, as of the last begin_frame.
  bool takes_mouse() const;
  /// Whether somebody types into a field.
  bool takes_text() const;

  /// The middle of a widget of the last frame by its label.
  std::optional<Vec3> place_of(const std::string& label) const;
  std::vector<std::string> labels() const;

 private:
  void press(MouseButton button, bool is_down);

  Window& window_;
  std::string clipboard_;
  std::string look_;  ///< all that was to be drawn at the last end_frame
  // A click within one frame is shown to the panels over two, or they would not see it.
  std::array<bool, 3> pressed_now_{};
  std::array<bool, 3> released_later_{};
};

/// Remembers where the widget just made is. What makes widgets calls it through the functions
/// below.
void note_widget(const std::string& label);

// Widgets that a script finds by their label.
bool button(const char* label, double width = 0.0);
bool choice(const char* label, bool is_chosen, double width = 0.0);
/// A place of this size to click on, of which the caller draws what it shows.
bool tile(const char* label, double width, double height);
bool check(const char* label, bool& value);
bool slide(const char* label, double& value, double least, double most, const char* format,
           bool is_logarithmic = false);
bool slide(const char* label, int& value, int least, int most);
bool number(const char* label, double& value, double least, double most, const char* format);
bool pick_one(const char* label, int& index, const std::vector<std::string>& names);
bool text_field(const char* label, std::string& text);
bool menu_item(const char* label, const char* chord, bool is_checked, bool is_possible);
bool begin_menu(const char* label);

}  // namespace argil::viewer
