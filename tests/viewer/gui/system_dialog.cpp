// SPDX-License-Identifier: GPL-3.0-or-later
#include "gui/system_dialog.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>

#include "support/scratch.h"

namespace argil::viewer {
namespace {

/// A zenity of our own first on the PATH.
class SystemDialogTest : public testing::Test {
 protected:
  // NOLINTBEGIN(concurrency-mt-unsafe): this test has one thread
  void SetUp() override {
    path_ = std::getenv("PATH");
    ::setenv("PATH", (folder_.path().string() + ":" + path_).c_str(), 1);
  }
  void TearDown() override { ::setenv("PATH", path_.c_str(), 1); }
  // NOLINTEND(concurrency-mt-unsafe)

  void install(const std::string& body) {
    const auto program = folder_ / "zenity";
    std::ofstream(program) << "#!/bin/sh\n" << body;
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  }

  std::optional<std::filesystem::path> wait(SystemDialog& dialog) {
    for (int n = 0; n < 500; ++n) {
      if (auto answer = dialog.answer()) return answer;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return std::nullopt;
  }

  test::ScratchFolder folder_;
  std::string path_;
};

TEST_F(SystemDialogTest, TellsTheFileThatWasChosen) {
  install("printf '%s\\n' \"$@\" > '" + (folder_ / "words").string() +
          "'\necho '/a folder/of mine/owl.vdb'\n");
  ASSERT_TRUE(SystemDialog::is_there());
  SystemDialog dialog;
  ASSERT_TRUE(dialog.ask({"Save as", folder_ / "owl.vdb", true, {".vdb"}}));
  EXPECT_EQ(wait(dialog), "/a folder/of mine/owl.vdb");
  EXPECT_FALSE(dialog.is_open());
  std::ifstream words(folder_ / "words");
  const std::string all(std::istreambuf_iterator<char>(words), {});
  EXPECT_NE(all.find("--save\n"), std::string::npos) << all;
  EXPECT_NE(all.find("*.vdb\n"), std::string::npos) << all;
}

TEST_F(SystemDialogTest, AClosedDialogIsNoFile) {
  install("exit 1\n");
  SystemDialog dialog;
  ASSERT_TRUE(dialog.ask({"Open", folder_.path(), false, {".vdb", ".stl"}}));
  EXPECT_EQ(wait(dialog), "");
}

TEST_F(SystemDialogTest, AnOpenOneEndsWithItsOwner) {
  install("echo $$ > '" + (folder_ / "pid").string() + "'\nexec sleep 60\n");
  pid_t process = 0;
  {
    SystemDialog dialog;
    ASSERT_TRUE(dialog.ask({"Open", folder_.path(), false, {".vdb"}}));
    for (int n = 0; n < 500 && process == 0; ++n) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      std::ifstream(folder_ / "pid") >> process;
    }
    EXPECT_FALSE(dialog.answer());
  }
  ASSERT_GT(process, 0);
  EXPECT_NE(::kill(process, 0), 0);
}

TEST_F(SystemDialogTest, OneThatNobodyWaitsForIsClosedAndAnotherCanBeAsked) {
  install("exec sleep 60\n");
  SystemDialog dialog;
  dialog.close();
  ASSERT_TRUE(dialog.ask({"Open", folder_.path(), false, {".vdb"}}));
  dialog.close();
  EXPECT_FALSE(dialog.is_open());
  EXPECT_FALSE(dialog.answer());
  install("echo /there.vdb\n");
  ASSERT_TRUE(dialog.ask({"Open", folder_.path(), false, {".vdb"}}));
  EXPECT_EQ(wait(dialog), "/there.vdb");
}

}  // namespace
}  // namespace argil::viewer
