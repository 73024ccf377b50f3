// SPDX-License-Identifier: GPL-3.0-or-later
// The question about what a killed window left: what it is, how it looked, and what becomes of it.
#include <cassert>
#include <cstddef>
#include <string>
#include <utility>

#include <imgui.h>

#include "base/text.h"
#include "commands/command.h"
#include "gui/dialog.h"
#include "gui/gui.h"
#include "gui/layout.h"
#include "panels/file_picture.h"
#include "panels/panels.h"

namespace argil::viewer {
namespace {

// Units; together with the answers as wide as the least room for panels (scale_of_panels).
constexpr float kLeftDialogWidth = 640.0F;
constexpr float kLeftPictureWidth = 200.0F;
constexpr float kOtherLeftWidth = 64.0F;  // of the picture of another one

constexpr float height_of_picture(float width) {
  return width * kThumbnailHeight / kThumbnailWidth;
}

void say_within(const std::string& text, float width) {
  ImGui::PushTextWrapPos(width > 0.0F ? ImGui::GetCursorPosX() + width : 0.0F);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
}

std::string count_of_steps(std::size_t steps) {
  return std::to_string(steps) + (steps == 1 ? " step" : " steps");
}

/// The picture of what was left: of the work itself where there is one, else of what was saved.
/// Never of more steps than there are, which would be other work.
struct LeftPicture {
  ShownPicture picture;
  std::string words;  ///< what it shows
};
LeftPicture picture_of_left(const ShownFile& file, std::size_t steps) {
  if (file.work.number != 0 && file.work_steps <= steps) {
    const std::size_t later = steps - file.work_steps;
    if (later == 0) return {file.work, "As the last step left it."};
    return {file.work, std::string("As it was ") + count_of_steps(later) + " before the last."};
  }
  if (file.picture.number == 0) return {};
  return {file.picture,
          steps == 0 ? "As it was saved." : "As it was saved; what is not saved is not in it."};
}

void draw_left_picture(const UiState& ui) {
  const LeftQuestion& left = *ui.clay.left;
  const float width = kLeftPictureWidth * unit();
  const ShownFile* known = known_file(ui, left.asked.file);
  const LeftPicture shown =
      known != nullptr ? picture_of_left(*known, left.left.steps) : LeftPicture();
  ImGui::BeginGroup();
  ImGui::Dummy({width, height_of_picture(width)});
  draw_picture_in(shown.picture, *ImGui::GetWindowDrawList(), ImGui::GetItemRectMin(),
                  ImGui::GetItemRectMax(), known != nullptr ? "no picture" : "");
  say_within(shown.words, width);
  ImGui::EndGroup();
}

/// The others that were left, to be asked about instead.
void draw_other_left(const UiState& ui, DocumentThread& document) {
  assert(ui.clay.left);
  const OpenFile& asked = ui.clay.left->asked;
  bool is_first = true;
  for (const LeftProject& left : ui.left_projects) {
    if (left.file == asked.file) continue;
    if (std::exchange(is_first, false)) {
      ImGui::Separator();
      ImGui::TextUnformatted("Also never saved, and in the File menu from now on:");
    }
    const ShownFile* known = known_file(ui, left.file);
    const float width = kOtherLeftWidth * unit();
    ImGui::Dummy({width, height_of_picture(width)});
    if (known != nullptr) {
      const ShownPicture& picture = known->work.number != 0 ? known->work : known->picture;
      draw_picture_in(picture, *ImGui::GetWindowDrawList(), ImGui::GetItemRectMin(),
                      ImGui::GetItemRectMax(), "");
    }
    ImGui::SameLine();
    if (choice(left.text.c_str(), false)) document.send(OpenFile{left.file, asked.saves_former});
  }
}

/// The project that is asked about, where it has no name yet: only then may the window drop it.
const LeftProject* left_without_name(const UiState& ui) {
  for (const LeftProject& left : ui.left_projects) {
    if (left.file == ui.clay.left->asked.file) return &left;
  }
  return nullptr;
}

/// What a killed window left, in a sentence or two.
std::string words_about(const LeftQuestion& left) {
  const std::string name = left.asked.file.filename().string();
  if (left.left.steps == 0) {
    return name + " has no name yet. Steps that were not recovered are kept beside it.";
  }
  return name + " was not closed: " + count_of_steps(left.left.steps) +
         (left.left.steps == 1 ? " was" : " were") + " not saved, the last one at " +
         clock_text(left.left.newest, "%d %B %Y, %H:%M") + ".";
}

/// Nothing brings it back, so it is asked for twice.
void draw_drop_answers(UiState& ui, DocumentThread& document) {
  const LeftQuestion& left = *ui.clay.left;
  // Under the pointer that has just clicked, so that a double click does no harm.
  const double as_wide_as_both_before = 216.0 * static_cast<double>(unit());
  if (button("Keep it", as_wide_as_both_before)) ui.asks_to_drop = false;
  ImGui::SameLine();
  if (button("Throw it away for good")) {
    ui.asks_to_drop = false;
    document.send(DropProject{left.asked.file});
  }
  say_within(left.asked.file.filename().string() +
                 " and every step kept for it are removed, and nothing brings them back.",
             0.0F);
}

void draw_unnamed_answers(const LeftProject& unnamed, UiState& ui, DocumentThread& document) {
  if (button("Ask no more")) {
    ui.settings.unasked.push_back(unnamed.state);
    document.send(ForgetQuestion{});
  }
  ImGui::SameLine();
  if (button("Throw it away...")) ui.asks_to_drop = true;
  ImGui::TextDisabled("Asked about no more, it stays in the File menu.");
}

void draw_left_answers(UiState& ui, DocumentThread& document) {
  assert(ui.clay.left);
  const LeftQuestion& left = *ui.clay.left;
  // The same request again, now with an answer.
  const auto answer = [&](OpenFile::Left word) {
    OpenFile again = left.asked;
    again.left = word;
    document.send(again);
  };
  const bool is_dropping = ui.asks_to_drop;
  ImGui::BeginDisabled(is_dropping);
  if (left.left.steps > 0) {
    if (button("Recover")) answer(OpenFile::Left::repeat);
    ImGui::SameLine();
  }
  if (button("Open as it was saved")) answer(OpenFile::Left::put_aside);
  ImGui::SameLine();
  if (button("Not now")) document.send(ForgetQuestion{});
  ImGui::EndDisabled();
  const LeftProject* unnamed = left_without_name(ui);
  if (is_dropping) {
    draw_drop_answers(ui, document);
    return;
  }
  if (unnamed != nullptr) draw_unnamed_answers(*unnamed, ui, document);
  ImGui::TextDisabled("What is not recovered is kept beside the project.");
}

}  // namespace

void draw_left_question(UiState& ui, DocumentThread& document) {
  const DialogLayout layout{false, kLeftDialogWidth, 0.0F};
  if (!begin_dialog("Recover?", open_dialog(ui) == Dialog::recover, nullptr, layout)) return;
  draw_left_picture(ui);
  ImGui::SameLine();
  ImGui::BeginGroup();
  say_within(words_about(*ui.clay.left), 0.0F);
  draw_left_answers(ui, document);
  ImGui::EndGroup();
  if (!ui.asks_to_drop) draw_other_left(ui, document);
  end_dialog();
}

}  // namespace argil::viewer
