// SPDX-License-Identifier: GPL-3.0-or-later
// Commands on a project whose window kept its history for undo.
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/core/hash_text.h"
#include "argil/io/session.h"

#include "cli/run_argil.h"
#include "support/scratch.h"

namespace argil::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A folder with a ball that got a stroke, p.vdb, in a session that kept it for undo.
class CliKeptHistory : public testing::Test {
 protected:
  void SetUp() override {
    auto made =
        io::Session::create(folder / "p.vdb", Clay::ball(8.0, {0.4, 0.1}).value(), keeping());
    ASSERT_TRUE(made) << made.error().message;
    start_ = made.value().clay().hash();
    Stroke stroke;
    stroke.samples = {{0.0, {8.0, 0.0, 0.0}, {}, 1.0}};
    ASSERT_TRUE(made.value().clay().apply(stroke));
    made.value().record(stroke);
    ASSERT_TRUE(made.value().close());
    fill(folder / "s.strokes.jsonl",
         "{\"argil_strokes\":1}\n"
         R"({"tool":"carve","shape":"ball","radius_mm":2,"poses":[[0,0,0,8]]})"
         "\n");
  }
  static io::SessionOptions keeping() {
    io::SessionOptions options;
    options.keeps_history = true;
    return options;
  }
  std::string path(const std::string& name) const { return (folder / name).string(); }
  nlohmann::json info() const { return run_argil({"info", path("p.vdb"), "--json"}).json(); }

  ScratchFolder folder;
  std::uint64_t start_ = 0;
};

TEST_F(CliKeptHistory, IsToldByInfo) {
  const nlohmann::json told = info();
  EXPECT_EQ(told["history"]["steps"], 1);
  EXPECT_GT(told["history"]["bytes"], fs::file_size(folder / ".p.origin.vdb"));
  EXPECT_EQ(told["recovered_strokes"], 0);
  EXPECT_THAT(run_argil({"info", path("p.vdb")}).out, HasSubstr("history 1 step, "));
}

TEST_F(CliKeptHistory, GoesOnWhereTheProjectIsSculpted) {
  const Ended run = run_argil(
      {"sculpt", path("p.vdb"), "--strokes", path("s.strokes.jsonl"), "-o", path("p.vdb")});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(info()["history"]["steps"], 2);
  auto session = io::Session::open(folder / "p.vdb", keeping());
  ASSERT_TRUE(session) << session.error().message;
  ASSERT_TRUE(session.value().deepen());
  for (int n = 0; n < 2; ++n) ASSERT_TRUE(session.value().sculpture().undo());
  EXPECT_EQ(session.value().clay().hash(), start_);
}

TEST_F(CliKeptHistory, GoesWithTheClayThatItIsOf) {
  const Ended run = run_argil({"edit", path("p.vdb"), "-o", path("p.vdb"), "--cut", "0,0,0,0,0,1"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("the history of 'p.vdb' was of the clay before and is gone"));
  EXPECT_EQ(info()["history"]["steps"], 0);
  EXPECT_FALSE(fs::exists(folder / "p.journal.jsonl"));
  EXPECT_FALSE(fs::exists(folder / ".p.origin.vdb"));
}

TEST_F(CliKeptHistory, OfACopyIsNone) {
  fs::copy_file(folder / "p.vdb", folder / "copy.vdb");
  const Ended run = run_argil({"info", path("copy.vdb"), "--json"});
  EXPECT_EQ(run.json()["history"]["steps"], 0);
  EXPECT_EQ(run.json()["hash"], info()["hash"]);
}

}  // namespace
}  // namespace argil::test
