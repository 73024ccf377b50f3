// SPDX-License-Identifier: GPL-3.0-or-later
#include "gui/input_queue.h"

#include <string>

#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "viewer/support/imgui_frames.h"

namespace argil::viewer {
namespace {

/// Events that all come between two frames.
class InputQueueTest : public testing::Test {
 protected:
  InputQueueTest() { name_keys(ImGui::GetIO()); }

  void add(InputEvent::Kind kind, int key, const Modifiers& modifiers = {}) {
    InputEvent event;
    event.kind = kind;
    event.key = key;
    event.modifiers = modifiers;
    queue_.add(event);
  }
  /// As quick as a finger, which is quicker than a frame.
  void tap(int key, const Modifiers& modifiers = {}) {
    add(InputEvent::Kind::key_down, key, modifiers);
    add(InputEvent::Kind::key_up, key, modifiers);
  }
  void type(char letter) {
    const int key = letter - 'a' + 'A';
    add(InputEvent::Kind::key_down, key);
    InputEvent text;
    text.kind = InputEvent::Kind::text;
    text.character = static_cast<unsigned char>(letter);
    queue_.add(text);
    add(InputEvent::Kind::key_up, key);
  }
  void click(double x) {
    for (const auto kind : {InputEvent::Kind::press, InputEvent::Kind::release}) {
      InputEvent event;
      event.kind = kind;
      event.x = event.y = x;
      queue_.add(event);
    }
  }

  void begin() {
    queue_.apply(ImGui::GetIO());
    ImGui::NewFrame();
  }
  /// Frames with a field that has the keyboard, until every event was shown; how many.
  int frames_of_field(std::string& text) {
    int frames = 0;
    do {
      begin();
      ImGui::Begin("window");
      if (!ImGui::IsAnyItemActive()) ImGui::SetKeyboardFocusHere();
      ImGui::InputText("field", &text);
      ImGui::End();
      ImGui::EndFrame();
    } while (++frames < 100 && queue_.has_waiting());
    return frames;
  }

  test::ImGuiFrames frames_;
  InputQueue queue_;
};

TEST_F(InputQueueTest, AKeyThatIsLetGoBeforeTheFrameIsSeen) {
  tap(kKeyEnter);
  begin();
  EXPECT_TRUE(ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter)));
  EXPECT_TRUE(queue_.has_waiting());
  ImGui::EndFrame();
  begin();
  EXPECT_FALSE(ImGui::IsKeyDown(ImGui::GetKeyIndex(ImGuiKey_Enter)));
  EXPECT_FALSE(queue_.has_waiting());
  ImGui::EndFrame();
}

TEST_F(InputQueueTest, AClickWithinAFrameIsSeen) {
  click(20.0);
  begin();
  EXPECT_TRUE(ImGui::IsMouseClicked(0));
  ImGui::EndFrame();
  begin();
  EXPECT_TRUE(ImGui::IsMouseReleased(0));
  ImGui::EndFrame();
}

TEST_F(InputQueueTest, LettersAndKeysKeepTheirOrder) {
  std::string text;
  frames_of_field(text);
  frames_of_field(text);
  type('a');
  type('b');
  tap(kKeyBackspace);
  type('c');
  tap(kKeyHome);
  type('d');
  EXPECT_LE(frames_of_field(text), 12);
  EXPECT_EQ(text, "dac");
}

TEST_F(InputQueueTest, AChordKeepsItsCtrlWhicheverIsLetGoFirst) {
  std::string text = "long";
  frames_of_field(text);
  frames_of_field(text);
  constexpr int kLeftCtrl = 341;  // GLFW's
  add(InputEvent::Kind::key_down, kLeftCtrl, {false, true, false});
  add(InputEvent::Kind::key_down, 'A', {false, true, false});
  add(InputEvent::Kind::key_up, kLeftCtrl);
  add(InputEvent::Kind::key_up, 'A');
  type('x');
  frames_of_field(text);
  EXPECT_EQ(text, "x") << "all was chosen, and replaced";
}

}  // namespace
}  // namespace argil::viewer
