// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <imgui.h>

#include "base/theme.h"
#include "gui/input_queue.h"
#include "input/input_event.h"

namespace argil::viewer {

class Window;

/// Height of the letters at a scale of 1; sizes of widgets are relative to it.
inline constexpr float kLetterPixels = 15.0F;

/// Dear ImGui fed with a window's events. Keeps where its widgets are, so that a script can click
/// them by label.
///
/// Threads  the window's. One at a time.
class Gui {
 public:
  explicit Gui(Window& window);
  ~Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;

  /// Feeds an event; true when a panel takes it. An open menu or list takes every key.
  bool feed(const InputEvent& event);

  /// True when the event is an Esc that closed an open menu or list; it does nothing else then. The
  /// lists of a dialog are left to the dialog.
  bool leaves_list(const InputEvent& event);

  /// How large panels and letters are from the next frame on, times kLetterPixels, and their
  /// colours.
  void set_look(double scale, Theme theme);

  void begin_frame(double elapsed_s);
  /// True when the panels look different from those at the last end_frame.
  bool end_frame();
  /// Draws them over what is in the window's framebuffer.
  void draw() const;

  /// Whether the pointer is over a panel, as of the last begin_frame.
  bool takes_mouse() const;
  /// Whether a button of the mouse is held on a panel.
  bool is_held() const;
  /// Whether the next frame has something to show that came before the last one.
  bool has_waiting_input() const noexcept { return queue_.has_waiting(); }

  /// The middle of a widget of the last frame by its label.
  std::optional<Vec3> position_of(const std::string& label) const;
  std::vector<std::string> labels() const;

 private:
  Window& window_;
  std::string clipboard_;
  double scale_ = 0.0;
  Theme theme_ = Theme::dark;
  std::string look_;  ///< all that was to be drawn at the last end_frame
  InputQueue queue_;
};

/// The colours that panels are drawn in; as Dear ImGui's own.
const ThemeColors& shown_colors();
ImVec4 imgui_color(const Paint& paint);
/// A text in one of them.
void colored_text(const Paint& paint, const std::string& text);

/// Forgets what is known of the widgets of the frame before; Gui::begin_frame() does so.
void begin_widgets();

/// What is written on buttons of this frame that are narrower.
const std::vector<std::string>& narrow_buttons();

/// Remembers where the widget just made is, under its label. The functions below do so themselves.
void note_widget(const std::string& label);

// Widgets that a script finds by their label.
bool button(const char* label, double width = 0.0);
/// One whose words change: a script finds it by its name.
bool button(const std::string& name, const std::string& words, double width);
bool choice(const char* label, bool is_chosen, double width = 0.0);
/// An area of this size to click on; the caller draws what it shows.
bool tile(const char* label, double width, double height);
bool check(const char* label, bool& value);
/// A star, filled where `is_on`, in the place of a letter; true when it is clicked.
bool star(const char* label, bool is_on);
bool slide(const char* label, double& value, double least, double most, const char* format,
           bool is_logarithmic = false);
bool slide(const char* label, int& value, int least, int most);
bool number(const char* label, double& value, double least, double most, const char* format);
bool pick_one(const char* label, int& index, const std::vector<std::string>& names);
bool text_field(const char* label, std::string& text);
bool menu_item(const char* label, const char* chord, bool is_checked, bool is_possible);
bool begin_menu(const char* label);

}  // namespace argil::viewer
