// SPDX-License-Identifier: GPL-3.0-or-later
// What is cut off, one thing at a time, and next to it what is not.
#include "gui/cut_off.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <imgui.h>

#include "gui/gui.h"
#include "viewer/support/imgui_frames.h"

namespace argil::viewer {
namespace {

using Strings = std::vector<std::string>;

class CutOffTest : public testing::Test {
 protected:
  /// What is found after these frames, each with one panel of this size and content.
  template <class Content>
  Strings found(const ImVec2& at, const ImVec2& size, ImGuiWindowFlags flags,
                const Content& content, int frames = 6) {
    CutOff cut_off;
    for (int n = 0; n < frames; ++n) {
      begin_widgets();
      ImGui::NewFrame();
      ImGui::SetNextWindowPos(at);
      ImGui::SetNextWindowSize(size);
      ImGui::Begin("Panel", nullptr, flags);
      content();
      ImGui::End();
      ImGui::Render();
      cut_off.look();
    }
    EXPECT_EQ(cut_off.panels(), Strings{"Panel"});
    return cut_off.found();
  }
  static void three_lines() {
    for (int n = 0; n < 3; ++n) ImGui::TextUnformatted("one line of words");
  }

  test::ImGuiFrames frames_;
};

TEST_F(CutOffTest, FindsNothingWhereAllIsSeen) {
  const auto all = [] {
    three_lines();
    button("Do it");
    button("name", "Do it", 200.0);
  };
  EXPECT_EQ(found({10.0F, 10.0F}, {300.0F, 200.0F}, 0, all), Strings());
}

TEST_F(CutOffTest, FindsAPanelThatReachesBeyondTheScreen) {
  for (const ImVec2 at : {ImVec2{-10.0F, 10.0F}, ImVec2{10.0F, 300.0F}, ImVec2{400.0F, 10.0F}}) {
    EXPECT_EQ(found(at, {300.0F, 200.0F}, 0, three_lines),
              Strings{"Panel reaches beyond the screen"});
  }
}

TEST_F(CutOffTest, FindsWhatIsWiderThanItsPanel) {
  EXPECT_EQ(found({10.0F, 10.0F}, {90.0F, 200.0F}, 0, three_lines), Strings{"Panel is too narrow"});
  EXPECT_EQ(
      found({10.0F, 10.0F}, {90.0F, 200.0F}, ImGuiWindowFlags_HorizontalScrollbar, three_lines),
      Strings());
}

TEST_F(CutOffTest, FindsWhatIsHigherThanItsPanelWhereThatDoesNotScroll) {
  EXPECT_EQ(found({10.0F, 10.0F}, {300.0F, 40.0F}, 0, three_lines), Strings());
  for (const ImGuiWindowFlags inputs : {ImGuiWindowFlags_None, ImGuiWindowFlags_NoInputs}) {
    EXPECT_EQ(
        found({10.0F, 10.0F}, {300.0F, 40.0F}, ImGuiWindowFlags_NoDecoration | inputs, three_lines),
        Strings{"Panel is not high enough"});
  }
}

TEST_F(CutOffTest, FindsAButtonNarrowerThanItsWords) {
  const float words = 7.0F * 5.0F;  // Dear ImGui's own letters are seven pixels wide
  const auto narrow = [&] { button("name", "Do it", static_cast<double>(words + 0.5F)); };
  EXPECT_EQ(found({10.0F, 10.0F}, {300.0F, 200.0F}, 0, narrow),
            Strings{"Do it is wider than its button"});
}

TEST_F(CutOffTest, LeavesPanelsTimeToFindTheirSize) {
  EXPECT_EQ(found({10.0F, 10.0F}, {90.0F, 200.0F}, 0, three_lines, 3), Strings());
}

}  // namespace
}  // namespace argil::viewer
