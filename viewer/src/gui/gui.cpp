// SPDX-License-Identifier: GPL-3.0-or-later
#include "gui/gui.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <utility>

#include <backends/imgui_impl_opengl3.h>
#include <imgui_internal.h>  // closing a list from outside
#include <imgui_stdlib.h>

#include "input/window.h"

namespace argil::viewer {
namespace {

/// Where widgets are: of the frame that is being made, and of the one before, which is on the
/// screen.
struct WidgetPositions {
  std::map<std::string, Vec3> now;
  std::map<std::string, Vec3> shown;
  std::vector<std::string> narrow;  ///< of the frame that is being made: narrow_buttons()
};
/// Global as Dear ImGui itself is: widgets are made by plain functions.
WidgetPositions& positions() {
  static WidgetPositions all;
  return all;
}

/// A font of the system that has more than ASCII, else Dear ImGui's own.
void load_letters(double scale) {
  ImGuiIO& io = ImGui::GetIO();
  const float pixels = kLetterPixels * static_cast<float>(scale);
  for (const char* file : {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                           "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf"}) {
    std::error_code error;
    if (std::filesystem::exists(file, error) &&
        io.Fonts->AddFontFromFileTTF(file, pixels) != nullptr) {
      return;
    }
  }
  ImFontConfig config;
  config.SizePixels = pixels;
  io.Fonts->AddFontDefault(&config);
}

/// The theme that panels are drawn in; global as the style of Dear ImGui.
Theme& drawn_theme() {
  static Theme theme = Theme::dark;
  return theme;
}

/// Which of Dear ImGui's colours is which of ours.
void set_colors(const ThemeColors& colors, ImGuiStyle& style) {
  const auto put = [&](std::initializer_list<ImGuiCol> places, const Paint& paint) {
    for (const ImGuiCol place : places) style.Colors[place] = imgui_color(paint);
  };
  put({ImGuiCol_Text}, colors.text);
  put({ImGuiCol_TextDisabled}, colors.weak_text);
  put({ImGuiCol_WindowBg}, colors.window);
  put({ImGuiCol_PopupBg}, colors.popup);
  put({ImGuiCol_TitleBgActive, ImGuiCol_TableHeaderBg}, colors.title);
  put({ImGuiCol_TitleBg, ImGuiCol_TitleBgCollapsed}, colors.title_idle);
  put({ImGuiCol_MenuBarBg}, colors.popup);
  put({ImGuiCol_FrameBg}, colors.frame);
  put({ImGuiCol_FrameBgHovered}, colors.frame_hovered);
  put({ImGuiCol_FrameBgActive}, colors.frame_active);
  put({ImGuiCol_Button}, colors.button);
  put({ImGuiCol_ButtonHovered}, colors.button_hovered);
  put({ImGuiCol_ButtonActive}, colors.button_active);
  put({ImGuiCol_Header, ImGuiCol_TextSelectedBg}, colors.header);
  put({ImGuiCol_HeaderHovered}, colors.header_hovered);
  put({ImGuiCol_HeaderActive}, colors.header_active);
  put({ImGuiCol_SliderGrab, ImGuiCol_PlotHistogram}, colors.grab);
  put({ImGuiCol_SliderGrabActive, ImGuiCol_PlotHistogramHovered}, colors.grab_active);
  put({ImGuiCol_PlotLines}, colors.mark);
  put({ImGuiCol_CheckMark, ImGuiCol_PlotLinesHovered}, colors.mark_active);
  put({ImGuiCol_Border, ImGuiCol_Separator, ImGuiCol_ResizeGrip, ImGuiCol_TableBorderLight,
       ImGuiCol_TableBorderStrong},
      colors.line);
}

void set_style(double scale, Theme theme) {
  ImGui::GetStyle() = ImGuiStyle();  // sizes are scaled once
  ImGuiStyle& style = ImGui::GetStyle();
  if (theme == Theme::light) {
    ImGui::StyleColorsLight();
  } else {
    ImGui::StyleColorsDark();
  }
  set_colors(colors_of(theme), style);
  style.WindowRounding = 4.0F;
  style.FrameRounding = 3.0F;
  style.GrabRounding = 3.0F;
  style.WindowBorderSize = 0.0F;
  style.ScaleAllSizes(static_cast<float>(scale));
  drawn_theme() = theme;
}

/// A menu or what a field offers, and no dialog of ours, which is a popup too.
bool is_list_open() {
  return ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup) &&
         ImGui::GetTopMostPopupModal() == nullptr;
}

/// Every corner, index and command of what is to be drawn, as bytes.
std::string look_of(const ImDrawData& drawn) {
  std::string look;
  const auto add = [&](const auto& values) {
    look.append(reinterpret_cast<const char*>(values.Data),
                static_cast<std::size_t>(values.size_in_bytes()));
  };
  for (int n = 0; n < drawn.CmdListsCount; ++n) {
    const ImDrawList& list = *drawn.CmdLists[n];
    add(list.VtxBuffer);
    add(list.IdxBuffer);
    add(list.CmdBuffer);
  }
  return look;
}

}  // namespace

Gui::Gui(Window& window) : window_(window) {
  assert(ImGui::GetCurrentContext() == nullptr);
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;               // panels begin where the program puts them
  io.ConfigInputTextCursorBlink = false;  // or a window that waits for a name would never rest
  io.BackendPlatformName = "argil";
  io.ClipboardUserData = this;
  io.GetClipboardTextFn = [](void* me) {
    auto& gui = *static_cast<Gui*>(me);
    gui.clipboard_ = gui.window_.clipboard();
    return gui.clipboard_.c_str();
  };
  io.SetClipboardTextFn = [](void* me, const char* text) {
    static_cast<Gui*>(me)->window_.set_clipboard(text);
  };
  name_keys(io);
  ImGui_ImplOpenGL3_Init("#version 330 core");
  set_look(window.scale(), Theme::dark);
}

void Gui::set_look(double scale, Theme theme) {
  assert(scale > 0.0);
  if (scale == scale_ && theme == theme_) return;
  theme_ = theme;
  set_style(scale, theme);
  if (scale == std::exchange(scale_, scale)) return;
  ImGui::GetIO().Fonts->Clear();
  load_letters(scale);
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
}

Gui::~Gui() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext();
  positions() = {};
}

/// True where the panels keep the event for themselves. What WantCapture... says is of the frame
/// before: Dear ImGui learns where its windows are when they are drawn.
bool Gui::feed(const InputEvent& event) {
  const ImGuiIO& io = ImGui::GetIO();
  switch (event.kind) {
    case InputEvent::Kind::move:
    case InputEvent::Kind::press:
    case InputEvent::Kind::release:
      queue_.add(event);
      return io.WantCaptureMouse;
    case InputEvent::Kind::scroll:
      if (io.WantCaptureMouse) queue_.add(event);
      return io.WantCaptureMouse;
    case InputEvent::Kind::finger_down:  // the first moves the pointer
    case InputEvent::Kind::finger_move:
    case InputEvent::Kind::finger_up:
      return io.WantCaptureMouse;
    case InputEvent::Kind::key_down:
    case InputEvent::Kind::key_up:
    case InputEvent::Kind::text:
      queue_.add(event);
      // An open menu or list has the keyboard: a letter must not choose a tool behind it.
      return io.WantTextInput || is_list_open();
    default:
      return false;
  }
}

bool Gui::leaves_list(const InputEvent& event) {
  if (event.kind != InputEvent::Kind::key_down || event.key != kKeyEscape || !is_list_open()) {
    return false;
  }
  ImGui::ClosePopupToLevel(0, true);
  return true;
}

void Gui::begin_frame(double elapsed_s) {
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(window_.width()), static_cast<float>(window_.height())};
  // Dear ImGui takes no step of zero; a long pause is no reason to repeat keys for all of it.
  io.DeltaTime = static_cast<float>(std::clamp(elapsed_s, 1e-4, 0.5));
  queue_.apply(io);
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  begin_widgets();
}

bool Gui::end_frame() {
  ImGui::Render();
  positions().shown = positions().now;
  // Compared as bytes: a frame whose panels are the same as before need not be drawn.
  std::string look = look_of(*ImGui::GetDrawData());
  if (look == look_) return false;
  look_ = std::move(look);
  return true;
}

void Gui::draw() const { ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData()); }

bool Gui::takes_mouse() const { return ImGui::GetIO().WantCaptureMouse; }

bool Gui::is_held() const { return ImGui::IsAnyMouseDown() && ImGui::GetIO().WantCaptureMouse; }

std::optional<Vec3> Gui::position_of(const std::string& label) const {
  const auto found = positions().shown.find(label);
  if (found == positions().shown.end()) return std::nullopt;
  return found->second;
}

std::vector<std::string> Gui::labels() const {
  std::vector<std::string> all;
  all.reserve(positions().shown.size());
  for (const auto& [label, position] : positions().shown) all.push_back(label);
  return all;
}

// ---- widgets -----------------------------------------------------------------------------------

const ThemeColors& shown_colors() { return colors_of(drawn_theme()); }

ImVec4 imgui_color(const Paint& paint) { return {paint.r, paint.g, paint.b, paint.a}; }

void colored_text(const Paint& paint, const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, imgui_color(paint));
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopStyleColor();
}

void note_widget(const std::string& label) {
  const ImVec2 low = ImGui::GetItemRectMin();
  const ImVec2 high = ImGui::GetItemRectMax();
  // What follows ## only keeps two of the same name apart.
  positions().now[label] = {0.5 * static_cast<double>(low.x + high.x),
                            0.5 * static_cast<double>(low.y + high.y), 0.0};
}

void begin_widgets() {
  positions().now.clear();
  positions().narrow.clear();
}

const std::vector<std::string>& narrow_buttons() { return positions().narrow; }

bool button(const char* label, double width) {
  const std::string name = label;
  return button(name, name.substr(0, name.find("##")), width);
}

bool button(const std::string& name, const std::string& words, double width) {
  const bool pressed =
      ImGui::Button((words + "###" + name).c_str(), {static_cast<float>(width), 0.0F});
  note_widget(name);
  constexpr float kRounded = 0.5F;
  const float room = ImGui::GetItemRectSize().x - ImGui::GetStyle().FramePadding.x + kRounded;
  if (!ImGui::GetCurrentWindow()->SkipItems && ImGui::CalcTextSize(words.c_str()).x > room) {
    positions().narrow.push_back(words);
  }
  return pressed;
}

bool choice(const char* label, bool is_chosen, double width) {
  const bool pressed = ImGui::Selectable(label, is_chosen, 0, {static_cast<float>(width), 0.0F});
  note_widget(label);
  return pressed;
}

bool tile(const char* label, double width, double height) {
  const bool pressed =
      ImGui::InvisibleButton(label, {static_cast<float>(width), static_cast<float>(height)});
  note_widget(label);
  return pressed;
}

bool star(const char* label, bool is_on) {
  constexpr int kCorners = 10;  // far ones and near ones in turn
  constexpr float kNear = 0.42F;
  const float side = ImGui::GetFontSize();
  const bool pressed = ImGui::InvisibleButton(label, {side, side});
  note_widget(label);
  const ImVec2 low = ImGui::GetItemRectMin();
  const ImVec2 middle{low.x + 0.5F * side, low.y + 0.54F * side};
  std::array<ImVec2, kCorners> corners;
  for (int n = 0; n < kCorners; ++n) {
    const float angle = 6.2831853F * static_cast<float>(n) / kCorners;
    const float away = 0.5F * side * (n % 2 == 0 ? 1.0F : kNear);
    corners[static_cast<std::size_t>(n)] = {middle.x + away * std::sin(angle),
                                            middle.y - away * std::cos(angle)};
  }
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 color =
      ImGui::GetColorU32(ImGui::IsItemHovered() || is_on ? ImGuiCol_Text : ImGuiCol_TextDisabled);
  for (int n = 0; is_on && n < kCorners; ++n) {
    list.AddTriangleFilled(middle, corners[static_cast<std::size_t>(n)],
                           corners[static_cast<std::size_t>((n + 1) % kCorners)], color);
  }
  list.AddPolyline(corners.data(), kCorners, color, ImDrawFlags_Closed, 0.07F * side);
  return pressed;
}

bool check(const char* label, bool& value) {
  const bool changed = ImGui::Checkbox(label, &value);
  note_widget(label);
  return changed;
}

bool slide(const char* label, double& value, double least, double most, const char* format,
           bool is_logarithmic) {
  assert(least < most);
  const ImGuiSliderFlags flags =
      ImGuiSliderFlags_AlwaysClamp | (is_logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
  const bool changed =
      ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &least, &most, format, flags);
  note_widget(label);
  return changed;
}

bool slide(const char* label, int& value, int least, int most) {
  assert(least < most);
  const bool changed =
      ImGui::SliderInt(label, &value, least, most, "%d", ImGuiSliderFlags_AlwaysClamp);
  note_widget(label);
  return changed;
}

bool number(const char* label, double& value, double least, double most, const char* format) {
  assert(least <= most);
  const bool changed = ImGui::InputDouble(label, &value, 0.0, 0.0, format);
  note_widget(label);
  // Typed numbers may be anything.
  value = std::clamp(value, least, most);
  return changed;
}

bool pick_one(const char* label, int& index, const std::vector<std::string>& names) {
  const auto chosen = static_cast<std::size_t>(index);
  assert(chosen < names.size());
  bool changed = false;
  const bool is_open = ImGui::BeginCombo(label, names[chosen].c_str());
  note_widget(label);
  if (!is_open) return false;
  for (std::size_t n = 0; n < names.size(); ++n) {
    if (ImGui::Selectable(names[n].c_str(), n == chosen)) {
      changed = n != chosen;
      index = static_cast<int>(n);
    }
    note_widget(std::string(label) + "/" + names[n]);
  }
  ImGui::EndCombo();
  return changed;
}

bool text_field(const char* label, std::string& text) {
  const bool entered = ImGui::InputText(
      label, &text, ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
  note_widget(label);
  return entered;
}

bool menu_item(const char* label, const char* chord, bool is_checked, bool is_possible) {
  const bool chosen = ImGui::MenuItem(label, chord, is_checked, is_possible);
  note_widget(label);
  return chosen;
}

bool begin_menu(const char* label) {
  const bool is_open = ImGui::BeginMenu(label);
  // An open menu's last item would be its own: the bar's is noted only while it is shut.
  if (!is_open) note_widget(label);
  return is_open;
}

}  // namespace argil::viewer
