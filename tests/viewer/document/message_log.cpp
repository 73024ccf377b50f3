// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/message_log.h"

#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace argil::viewer {
namespace {

std::string shown(const MessageLog& log) {
  std::string all;
  for (const Message& message : log.messages()) {
    if (message.is_shown) all += message.notice.text + ";";
  }
  return all;
}

TEST(MessageLog, ErrorsStayUntilTheyAreDismissedAndTheRestGoes) {
  MessageLog log;
  log.add({Notice::Kind::done, "saved"}, 0.0, "14:00:00");
  log.add(notice_of({ErrorKind::disk, "full"}), 1.0, "14:00:01");
  log.tick(2.0);
  EXPECT_EQ(shown(log), "saved;full;");
  log.tick(1e6);
  EXPECT_EQ(shown(log), "full;");
  log.dismiss(1);
  EXPECT_EQ(shown(log), "");
  ASSERT_EQ(log.messages().size(), 2U);  // and can be looked up
  EXPECT_EQ(log.messages()[1].clock, "14:00:01");
}

TEST(MessageLog, SaysWhenTheNextOfThemIsToBeHidden) {
  MessageLog log;
  EXPECT_EQ(log.next_s(), std::numeric_limits<double>::infinity());
  log.add(notice_of({ErrorKind::disk, "full"}), 0.0, "");
  EXPECT_EQ(log.next_s(), std::numeric_limits<double>::infinity());
  log.add({Notice::Kind::done, "saved"}, 3.0, "");
  log.add({Notice::Kind::done, "opened"}, 2.0, "");
  EXPECT_EQ(log.next_s(), 2.0 + MessageLog::kShownS);
  log.tick(2.5 + MessageLog::kShownS);
  EXPECT_EQ(log.next_s(), 3.0 + MessageLog::kShownS);
}

TEST(MessageLog, AnErrorTakesThePlaceOfTheOneOfItsKind) {
  MessageLog log;
  log.add(notice_of({ErrorKind::disk, "full"}), 0.0, "");
  log.add(notice_of({ErrorKind::bad_input, "no mesh"}), 0.0, "");
  log.add(notice_of({ErrorKind::disk, "still full"}), 0.0, "");
  log.add({Notice::Kind::warning, "holes"}, 0.0, "");
  EXPECT_EQ(shown(log), "no mesh;still full;holes;");
}

TEST(MessageLog, TheSameWordsStandThereOnce) {
  MessageLog log;
  log.add({Notice::Kind::warning, "in stereo"}, 0.0, "");
  log.add({Notice::Kind::warning, "holes"}, 0.0, "");
  log.add({Notice::Kind::warning, "in stereo"}, 0.0, "");
  EXPECT_EQ(shown(log), "holes;in stereo;");
}

TEST(MessageLog, KeepsTheNewest) {
  MessageLog log;
  for (std::size_t n = 0; n < MessageLog::kMost + 10; ++n) {
    log.add({Notice::Kind::done, std::to_string(n)}, 0.0, "");
  }
  ASSERT_EQ(log.messages().size(), MessageLog::kMost);
  EXPECT_EQ(log.messages().front().notice.text, "10");
}

}  // namespace
}  // namespace argil::viewer
