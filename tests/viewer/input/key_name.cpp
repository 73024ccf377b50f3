// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/key_name.h"

#include <string>

#include <gtest/gtest.h>

namespace argil::viewer {
namespace {

TEST(KeyName, EveryKeyWithANameIsReadAsItWasWritten) {
  int named = 0;
  for (int key = 1; key < 400; ++key) {
    for (int held = 0; held < 8; ++held) {
      const KeyChord chord{key, {(held & 1) != 0, (held & 2) != 0, (held & 4) != 0}};
      const std::string text = text_of(chord);
      if (text.empty()) continue;
      ++named;
      EXPECT_EQ(chord_of(text), chord) << text;
    }
  }
  // Letters, digits, F keys, the digits of the numpad and 33 more, each with all modifiers.
  EXPECT_EQ(named, 8 * (26 + 10 + 12 + 10 + 33));
}

TEST(KeyName, AModifierIsNoKey) {
  for (int key = 340; key <= 347; ++key) EXPECT_EQ(text_of(KeyChord{key, {}}), "");
  EXPECT_FALSE(chord_of("Ctrl+"));
  EXPECT_FALSE(chord_of(""));
  EXPECT_EQ(text_of(*chord_of("alt+shift+ctrl+numplus")), "Ctrl+Shift+Alt+NumPlus");
}

}  // namespace
}  // namespace argil::viewer
