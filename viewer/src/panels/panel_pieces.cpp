// SPDX-License-Identifier: GPL-3.0-or-later
// The pieces of a sculpture: their list, what is done to them, and where the active one stands.
#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <string_view>
#include <system_error>
#include <utility>

#include <imgui.h>

#include "base/text.h"
#include "commands/command.h"
#include "commands/piece_edits.h"
#include "gestures/piece_gestures.h"
#include "gui/gui.h"
#include "gui/layout.h"
#include "panels/panels.h"

namespace argil::viewer {
namespace {

constexpr float kPiecesWidth = 270.0F;  // units, as all sizes here
constexpr float kIconSide = 20.0F;
constexpr int kMostRows = 8;  // without scrolling

struct NamedColor {
  const char* name;
  Rgb8 color;
};
constexpr NamedColor kPalette[] = {
    {"White", {235, 232, 226}}, {"Grey", {140, 142, 146}},  {"Black", {48, 48, 52}},
    {"Red", {196, 64, 56}},     {"Orange", {226, 140, 56}}, {"Yellow", {226, 200, 84}},
    {"Green", {96, 160, 84}},   {"Teal", {64, 152, 152}},   {"Blue", {72, 116, 196}},
    {"Violet", {136, 96, 180}}, {"Pink", {220, 140, 160}},  {"Skin", {224, 172, 140}}};

ImVec4 shown(const Rgb8& color) {
  return {static_cast<float>(color[0]) / 255.0F, static_cast<float>(color[1]) / 255.0F,
          static_cast<float>(color[2]) / 255.0F, 1.0F};
}

std::optional<Rgb8> color_of(const std::string& text) {
  const std::string_view digits = std::string_view(text).substr(text.starts_with('#') ? 1 : 0);
  std::uint32_t number = 0;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), number, 16);
  const bool is_whole = read.ec == std::errc() && read.ptr == digits.data() + digits.size();
  if (digits.size() != 6 || !is_whole) return std::nullopt;
  return Rgb8{static_cast<std::uint8_t>(number >> 16U), static_cast<std::uint8_t>(number >> 8U),
              static_cast<std::uint8_t>(number)};
}

/// A square to click on, with a picture drawn about its middle.
template <class Draw>
bool icon(const std::string& label, const char* help, const Draw& draw) {
  const float side = kIconSide * unit();
  const bool is_clicked = tile(label.c_str(), static_cast<double>(side), static_cast<double>(side));
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", help);
  const ImVec2 low = ImGui::GetItemRectMin();
  draw(*ImGui::GetWindowDrawList(), ImVec2{low.x + 0.5F * side, low.y + 0.5F * side}, unit());
  return is_clicked;
}

bool draw_eye(const std::string& name, bool is_open) {
  const ImU32 color = ImGui::GetColorU32(is_open ? ImGuiCol_Text : ImGuiCol_TextDisabled);
  return icon("Show " + name, is_open ? "hide it" : "show it",
              [&](ImDrawList& list, const ImVec2& at, float u) {
                const float thick = 1.4F * u;
                const ImVec2 left{at.x - 7.0F * u, at.y};
                const ImVec2 right{at.x + 7.0F * u, at.y};
                const auto lid = [&](float y) {
                  list.AddBezierQuadratic(left, {at.x, at.y + y * u}, right, color, thick);
                };
                lid(8.0F);
                if (!is_open) return;
                lid(-8.0F);
                list.AddCircleFilled(at, 2.4F * u, color);
              });
}

bool draw_lock(const std::string& name, bool is_shut) {
  const ImU32 color = ImGui::GetColorU32(is_shut ? ImGuiCol_CheckMark : ImGuiCol_TextDisabled);
  return icon("Lock " + name, is_shut ? "free it: it is locked" : "lock it against any change",
              [&](ImDrawList& list, const ImVec2& at, float u) {
                const float open = is_shut ? 0.0F : 3.0F * u;
                const ImVec2 bow{at.x + open, at.y - 1.0F * u};
                list.PathArcTo(bow, 3.4F * u, 3.1416F, 6.2832F, 12);
                list.PathStroke(color, 0, 1.6F * u);
                list.AddRectFilled({at.x - 5.0F * u, at.y - 1.0F * u},
                                   {at.x + 5.0F * u, at.y + 6.0F * u}, color, 1.5F * u);
              });
}

void change(ChangePiece wanted, DocumentThread& document) {
  edit_piece(PieceEdit{std::move(wanted)}, document);
}

void set_color(const std::string& name, std::optional<Rgb8> color, DocumentThread& document) {
  ChangePiece wanted{name};
  wanted.color = std::optional<std::optional<Rgb8>>(color);
  change(std::move(wanted), document);
  ImGui::CloseCurrentPopup();
}

/// The colours to choose from, and a field for any other.
void draw_palette(const PieceLook& look, std::string& typed, DocumentThread& document) {
  int column = 0;
  for (const NamedColor& offered : kPalette) {
    if (column++ % 6 != 0) ImGui::SameLine();
    const std::string label = std::string("Colour ") + offered.name;
    if (ImGui::ColorButton(label.c_str(), shown(offered.color), ImGuiColorEditFlags_NoTooltip)) {
      set_color(look.name, offered.color, document);
    }
    note_widget(label);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", offered.name);
  }
  if (ImGui::IsWindowAppearing()) {
    char text[8] = "#";
    if (look.color) {
      const auto& [red, green, blue] = *look.color;
      std::snprintf(text, sizeof text, "#%02x%02x%02x", static_cast<unsigned>(red),
                    static_cast<unsigned>(green), static_cast<unsigned>(blue));
    }
    typed = text;
  }
  ImGui::SetNextItemWidth(80.0F * unit());
  if (text_field("sRGB", typed)) {
    if (const auto color = color_of(typed)) set_color(look.name, color, document);
  }
  ImGui::SameLine();
  if (button("As clay")) set_color(look.name, std::nullopt, document);
}

void draw_color(const PieceLook& look, std::string& typed, DocumentThread& document) {
  const std::string label = "Colour " + look.name;
  const bool is_clicked =
      icon(label, "its colour", [&](ImDrawList& list, const ImVec2& at, float u) {
        const ImVec4 color = look.color ? shown(*look.color) : ImVec4{0.75F, 0.53F, 0.42F, 1.0F};
        list.AddCircleFilled(at, 6.0F * u, ImGui::ColorConvertFloat4ToU32(color), 20);
        if (!look.color)
          list.AddCircle(at, 6.0F * u, ImGui::GetColorU32(ImGuiCol_TextDisabled), 20);
      });
  const std::string popup = label + "##popup";
  if (is_clicked) ImGui::OpenPopup(popup.c_str());
  if (!ImGui::BeginPopup(popup.c_str())) return;
  draw_palette(look, typed, document);
  ImGui::EndPopup();
}

void draw_name(const PieceState& piece, bool is_active, UiState& ui, DocumentThread& document) {
  PieceChoice& choices = ui.pieces;
  const std::string& name = piece.look.name;
  if (choices.renamed != piece.key) {
    if (choice(name.c_str(), is_active) && !is_active) edit_piece(SelectPiece{name}, document);
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0)) {
      choices.renamed = piece.key;
      choices.new_name = name;
    }
    return;
  }
  ImGui::SetNextItemWidth(-1.0F);
  const bool begins = ImGui::IsWindowAppearing() || !ImGui::IsAnyItemActive();
  if (begins) ImGui::SetKeyboardFocusHere();
  const bool is_entered = text_field("##rename", choices.new_name);
  if (!is_entered && !ImGui::IsItemDeactivated()) return;
  choices.renamed.reset();
  if ((!is_entered && !ImGui::IsItemDeactivatedAfterEdit()) || choices.new_name == name) return;
  ChangePiece wanted{name};
  wanted.new_name = choices.new_name;
  change(std::move(wanted), document);
}

void draw_list(UiState& ui, DocumentThread& document) {
  const PieceList& list = *ui.clay.pieces;
  const int rows = std::min(static_cast<int>(list.pieces.size()), kMostRows);
  const float row = (kIconSide + 4.0F) * unit();
  ImGui::BeginChild("list", {0.0F, static_cast<float>(rows) * row + 16.0F * unit()}, true);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {4.0F * unit(), 4.0F * unit()});
  for (std::size_t n = 0; n < list.pieces.size(); ++n) {
    const PieceState& piece = list.pieces[n];
    ImGui::PushID(static_cast<int>(piece.key));
    if (draw_eye(piece.look.name, piece.look.is_visible)) {
      ChangePiece wanted{piece.look.name};
      wanted.is_visible = !piece.look.is_visible;
      change(std::move(wanted), document);
    }
    ImGui::SameLine();
    if (draw_lock(piece.look.name, piece.look.is_locked)) {
      ChangePiece wanted{piece.look.name};
      wanted.is_locked = !piece.look.is_locked;
      change(std::move(wanted), document);
    }
    ImGui::SameLine();
    draw_color(piece.look, ui.pieces.typed_color, document);
    ImGui::SameLine();
    draw_name(piece, n == list.active, ui, document);
    // One that became active by other means than a click here comes into sight.
    if (n == list.active && std::exchange(ui.pieces.listed, piece.key) != piece.key) {
      ImGui::SetScrollHereY();
    }
    ImGui::PopID();
  }
  ImGui::PopStyleVar();
  ImGui::EndChild();
}

/// A command as a button, grey while it cannot be done. `label` may be shorter than in the menu.
void command_button(Command command, const char* label, UiState& ui, DocumentThread& document) {
  ImGui::BeginDisabled(!is_possible(command, ui));
  if (button(label)) perform(command, ui, document);
  ImGui::EndDisabled();
}

void draw_changes(UiState& ui, DocumentThread& document) {
  command_button(Command::piece_ball, "Add ball", ui, document);
  ImGui::SameLine();
  command_button(Command::piece_import, "Add mesh...", ui, document);
  ImGui::SameLine();
  if (button("Rename")) {
    ui.pieces.renamed = ui.clay.pieces->active_piece().key;
    ui.pieces.new_name = ui.clay.pieces->active_piece().look.name;
  }
  command_button(Command::piece_duplicate, "Duplicate##piece", ui, document);
  ImGui::SameLine();
  command_button(Command::piece_remove, "Remove##piece", ui, document);
  ImGui::SameLine();
  command_button(Command::piece_split, "Split##piece", ui, document);
  const std::string other = other_piece(ui);
  if (other.empty()) return;
  std::vector<std::string> names;
  std::vector<PieceKey> keys;
  int at = 0;
  for (const PieceState& piece : ui.clay.pieces->pieces) {
    if (piece.key == ui.clay.pieces->active_piece().key) continue;
    if (piece.look.name == other) at = static_cast<int>(names.size());
    names.push_back(piece.look.name);
    keys.push_back(piece.key);
  }
  ImGui::Separator();
  ImGui::SetNextItemWidth(110.0F * unit());
  if (pick_one("With", at, names)) ui.pieces.other = keys[static_cast<std::size_t>(at)];
  ImGui::SameLine();
  check("Keep it", ui.pieces.keeps_other);
  command_button(Command::piece_unite, "Merge##piece", ui, document);
  ImGui::SameLine();
  command_button(Command::piece_subtract, "Subtract##piece", ui, document);
  ImGui::SameLine();
  command_button(Command::piece_intersect, "Intersect##piece", ui, document);
}

/// Three fields in a line; true when one was left with another number.
bool draw_numbers(const std::array<const char*, 3>& labels, Vec3& values, double most,
                  const char* format, bool& is_typing) {
  bool is_entered = false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (axis > 0) ImGui::SameLine();
    ImGui::SetNextItemWidth(78.0F * unit());
    // What is not typed stays as it is, also beyond what can be typed.
    double value = values[axis];
    if (number(labels[axis], value, -most, most, format)) values[axis] = value;
    is_typing = is_typing || ImGui::IsItemActive();
    is_entered = is_entered || ImGui::IsItemDeactivatedAfterEdit();
  }
  return is_entered;
}

/// By how much the side changes that was typed: of those that differ the one that does most.
double wanted_factor(const Vec3& now, const Vec3& wanted) {
  double factor = 1.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(now[axis] > 0.0 && wanted[axis] > 0.0)) continue;
    const double own = wanted[axis] / now[axis];
    if (std::abs(std::log(own)) > std::abs(std::log(factor))) factor = own;
  }
  return factor;
}

/// How large the active piece is, by its surface, in its own frame: one side decides for all three.
/// Its foot stays where it is.
void draw_piece_size(UiState& ui, DocumentThread& document) {
  constexpr double kMostMm = 1e6;
  constexpr double kLeastPercent = 0.1;
  constexpr double kMostPercent = 1e5;
  const Box3& box = ui.clay.surface_mm;
  const auto foot = foot_of_active(ui);
  if (!foot) return;
  PieceChoice& choices = ui.pieces;
  const Vec3 now = shown_factor(ui) * box.size();
  if (!choices.is_typing_size) {
    choices.size_mm = now;
    choices.percent = 100.0 * shown_factor(ui);
  }
  choices.is_typing_size = false;
  ImGui::TextDisabled("Size along its own x, y, z, mm");
  double factor = 1.0;
  if (draw_numbers({"##sx", "##sy", "##sz"}, choices.size_mm, kMostMm, "%.3f",
                   choices.is_typing_size)) {
    factor = wanted_factor(now, choices.size_mm);
  }
  ImGui::SetNextItemWidth(78.0F * unit());
  number("Scale, %", choices.percent, kLeastPercent, kMostPercent, "%.4g");
  choices.is_typing_size = choices.is_typing_size || ImGui::IsItemActive();
  if (ImGui::IsItemDeactivatedAfterEdit()) factor = choices.percent / 100.0;
  if (factor > 0.0) scale_active(factor, *foot, ui, document);
}

/// Where the active piece stands. A number that is typed is kept as it is: the turns of an
/// orientation are not the only ones that lead to it.
void draw_place(UiState& ui, DocumentThread& document) {
  constexpr double kMostMm = 1e6;  // where a piece can stand (Sculpture)
  constexpr double kMostDeg = 360.0;
  PieceChoice& choices = ui.pieces;
  const Placement now = shown_placement(ui);
  if (!choices.is_typing) {
    choices.position_mm = now.position_mm;
    if (!(choices.turned == now.orientation)) choices.turns_deg = turns_of(now.orientation);
    choices.turned = now.orientation;
  }
  choices.is_typing = false;
  const bool is_locked = ui.clay.pieces->active_piece().look.is_locked;
  ImGui::BeginDisabled(is_locked);
  ImGui::TextDisabled("Place, mm");
  const bool is_moved =
      draw_numbers({"##x", "##y", "##z"}, choices.position_mm, kMostMm, "%.3f", choices.is_typing);
  ImGui::TextDisabled("Turned about x, y, z, degrees");
  const bool is_turned = draw_numbers({"##rx", "##ry", "##rz"}, choices.turns_deg, kMostDeg, "%.2f",
                                      choices.is_typing);
  if (is_moved || is_turned) {
    Placement wanted{choices.position_mm, now.orientation};
    if (is_turned) wanted.orientation = choices.turned = orientation_of(choices.turns_deg);
    place_active(wanted, ui, document);
  }
  draw_piece_size(ui, document);
  check("Gizmo", choices.has_gizmo);
  ImGui::SameLine();
  command_button(Command::piece_bed, "Drop to bed##piece", ui, document);
  ImGui::SameLine();
  command_button(Command::piece_middle, "Centre##piece", ui, document);
  command_button(Command::piece_flat, "Lay flat##piece", ui, document);
  ImGui::EndDisabled();
  ImGui::SameLine();
  command_button(Command::piece_bed_all, "Drop all to bed##piece", ui, document);
}

}  // namespace

void draw_pieces(UiState& ui, DocumentThread& document) {
  if (!ui.panels.has_pieces) return;
  put_beside(kPiecesPanelLeft, kPiecesWidth);
  ImGui::SetNextWindowSize({kPiecesWidth * unit(), 0.0F});
  keep_on_screen(kPiecesWidth);
  ImGui::Begin("Pieces", &ui.panels.has_pieces, ImGuiWindowFlags_NoSavedSettings);
  if (ui.clay.pieces) {
    draw_list(ui, document);
    draw_changes(ui, document);
    ImGui::Separator();
    draw_place(ui, document);
  } else {
    ImGui::TextUnformatted("no clay");
  }
  ImGui::End();
}

/// Beside the pointer, where a stroke was tried on a piece that is not the active one.
void draw_switch_hint(const UiState& ui) {
  if (!ui.pieces.refused_at) return;
  const std::string& name = ui.other_under_pointer;
  const std::string& key = ui.keys.text_of(Command::piece_switch);
  const std::string text = (name.empty() ? "This" : in_quotes(name)) + " is another piece.\n" +
                           (key.empty() ? "A" : key + " or a") + " double click: sculpt it";
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const float margin = 4.0F * unit();
  const float most = ImGui::GetIO().DisplaySize.x - size.x - 2.0F * margin;
  const ImVec2 at{std::min(static_cast<float>(ui.pointer.x) + 16.0F * unit(), most),
                  static_cast<float>(ui.pointer.y) + 12.0F * unit()};
  ImDrawList& list = *ImGui::GetForegroundDrawList();
  list.AddRectFilled({at.x - margin, at.y - margin},
                     {at.x + size.x + margin, at.y + size.y + margin},
                     ImGui::GetColorU32(ImGuiCol_PopupBg), margin);
  list.AddText(at, ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
}

}  // namespace argil::viewer
