// SPDX-License-Identifier: GPL-3.0-or-later
#include "gui/layout.h"

#include <cstddef>
#include <string>

#include <gtest/gtest.h>
#include <imgui.h>

namespace argil::viewer {
namespace {

TEST(Layout, PanelsAreAsLargeAsTheScreenAndTheUserAskFor) {
  EXPECT_DOUBLE_EQ(scale_of_panels(1.0, 100, 1280, 720), 1.0);
  EXPECT_DOUBLE_EQ(scale_of_panels(1.0, 100, 1920, 1080), 1.0);
  EXPECT_DOUBLE_EQ(scale_of_panels(2.0, 100, 3840, 2160), 2.0);
  EXPECT_DOUBLE_EQ(scale_of_panels(2.0, 150, 3840, 2160), 3.0);
  EXPECT_DOUBLE_EQ(scale_of_panels(1.0, 75, 1280, 720), 0.75);
}

TEST(Layout, PanelsAreNoLargerThanTheWindowHasRoomFor) {
  EXPECT_DOUBLE_EQ(scale_of_panels(2.0, 300, 1280, 720), 1.8);
  EXPECT_DOUBLE_EQ(scale_of_panels(2.0, 100, 640, 480), 1.0);
  EXPECT_DOUBLE_EQ(scale_of_panels(1.0, 100, 320, 240), 0.75) << "letters can still be read";
}

/// Whether a text begins and ends with whole letters of UTF-8, as those here do: of one or two
/// bytes.
bool has_whole_letters(const std::string& text) {
  std::size_t at = 0;
  while (at < text.size()) {
    const bool has_two = (static_cast<unsigned char>(text[at]) & 0xE0U) == 0xC0U;
    if (!has_two && static_cast<unsigned char>(text[at]) > 127) return false;
    at += has_two ? 2 : 1;
  }
  return at == text.size();
}

TEST(Layout, TextsThatDoNotFitAreCutBetweenLetters) {
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.DisplaySize = {640.0F, 480.0F};
  unsigned char* pixels = nullptr;
  int width = 0;
  int height = 0;
  io.Fonts->GetTexDataAsAlpha8(&pixels, &width, &height);
  ImGui::NewFrame();
  const std::string text = "/home/t\xC3\xB6n/\xC3\xA4\xC3\xB6\xC3\xBC/figures";
  const float whole = ImGui::CalcTextSize(text.c_str()).x;
  const float dots = ImGui::CalcTextSize("...").x;
  EXPECT_EQ(fitted(text, whole), text);
  EXPECT_EQ(fitted_end(text, whole), text);
  for (float room = dots; room < whole; room += 3.0F) {
    const std::string begins = fitted(text, room);
    const std::string ends = fitted_end(text, room);
    for (const std::string& cut : {begins, ends}) {
      EXPECT_TRUE(has_whole_letters(cut)) << cut;
      EXPECT_LE(ImGui::CalcTextSize(cut.c_str()).x, room);
    }
    EXPECT_TRUE(text.starts_with(begins.substr(0, begins.size() - 3)) && begins.ends_with("..."));
    EXPECT_TRUE(text.ends_with(ends.substr(3)) && ends.starts_with("..."));
  }
  EXPECT_EQ(fitted(text, 0.0F), "...");
  EXPECT_EQ(fitted_end(text, 0.0F), "...");
  ImGui::EndFrame();
  ImGui::DestroyContext();
}

}  // namespace
}  // namespace argil::viewer
