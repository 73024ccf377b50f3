// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart gallery: that it draws what it is asked for with the figures it measured, what is
// left out by name, and that it leaves nothing behind.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/engine/action.h"

#include "cli/cli_files.h"
#include "cli/run_argil.h"
#include "evaluation/csv.h"
#include "support/clients.h"
#include "support/scratch.h"
#include "support/setting.h"

namespace argil::test {
namespace {

using testing::HasSubstr;

Ended gallery(const std::filesystem::path& folder, const std::vector<std::string>& actions,
              const RunOptions& options = {}) {
  std::vector<std::string> words{"chart", "gallery", "-o", folder.string(), "--json"};
  for (const std::string& action : actions) words.insert(words.end(), {"--action", action});
  return run_argil(words, options);
}

/// The rows of one column, by what is measured.
std::map<std::string, double> column_of(const std::filesystem::path& folder,
                                        const std::string& action, const std::string& maker) {
  std::map<std::string, double> values;
  for (const CsvRow& row : read_csv(folder / "gallery.csv").rows) {
    if (row.at("action") == action && row.at("maker").starts_with(maker)) {
      values[row.at("figure")] = csv_value(row, "value");
    }
  }
  return values;
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

TEST(ChartGallery, DrawsThreeLevelsWithoutBlenderAndSaysSo) {
  const ScratchFolder scratch;
  const Setting path("PATH", (scratch / "nothing").string());
  const Ended run = gallery(scratch / "pictures", {"inflate", "carve"});
  ASSERT_EQ(run.status, 0) << run.err;
  const nlohmann::json report = run.json();
  EXPECT_EQ(report["plates"], 2);
  EXPECT_THAT(report["skipped"].get<std::vector<std::string>>(),
              testing::ElementsAre(HasSubstr("blender is not installed")));
  EXPECT_EQ(report["files"].size(), 3U);
  const std::string sheet = text_of((scratch / "pictures" / "inflate.svg").string());
  EXPECT_EQ(count_of(sheet, "<image "), 3U);
  EXPECT_THAT(sheet, HasSubstr("Blender: blender is not installed"));
  double voxel = 0.5;
  for (const char* level : {"level 0", "level 1", "level 2"}) {
    SCOPED_TRACE(level);
    EXPECT_THAT(sheet, HasSubstr(level));
    auto inflated = column_of(scratch / "pictures", "inflate", level);
    EXPECT_NEAR(inflated["out"], 1.25, 0.1);  // a quarter of its radius
    EXPECT_LT(inflated["in"], 0.12 * voxel);  // what the clay is stored by
    voxel *= 0.5;
    EXPECT_LT(inflated["ripples; rms"], 0.03);
    EXPECT_GT(inflated["volume"], 0.0);
    // As docs/actions.md has rims, of a tool as large in voxels.
    auto carved = column_of(scratch / "pictures", "carve", level);
    EXPECT_LT(carved["saw of the rim; rms"], 0.05);
    EXPECT_GT(carved["saw of the rim; rms"], 0.0);
  }
}

TEST(ChartGallery, NamesWhatItCannotDo) {
  const ScratchFolder scratch;
  const Ended run = gallery(scratch / "pictures", {"polish"});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("--action is 'polish'; must be one of add, carve, smooth"));
  EXPECT_FALSE(std::filesystem::exists(scratch / "pictures"));
}

/// The shell script `script` as the only `blender`, and a screen that needs no Xvfb.
std::string with_blender(const std::filesystem::path& folder, const std::string& script) {
  std::filesystem::create_directory(folder / "bin");
  const auto add = [&](const char* name, const std::string& text) {
    std::ofstream(folder / "bin" / name) << "#!/bin/sh\n" << text << "\n";
    std::filesystem::permissions(folder / "bin" / name, std::filesystem::perms::owner_all);
  };
  add("blender", script);
  add("Xvfb", "echo 99; exec sleep 100");
  const char* before = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe): one thread
  return (folder / "bin").string() + ":" + (before == nullptr ? "" : before);
}

TEST(ChartGallery, TellsInItsColumnWhyBlenderDidNothing) {
  const ScratchFolder scratch;
  const Setting path("PATH",
                     with_blender(scratch.path(), "echo no library of that name >&2; exit 1"));
  const Ended run = gallery(scratch / "pictures", {"inflate"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.json()["skipped"].get<std::vector<std::string>>(),
              testing::ElementsAre(HasSubstr("no library of that name")));
  EXPECT_THAT(text_of((scratch / "pictures" / "inflate.svg").string()),
              HasSubstr("no library of that name"));
}

TEST(ChartGallery, EndsBlenderWithAnInterruptAndLeavesNothing) {
  const ScratchFolder scratch;
  std::filesystem::create_directory(scratch / "tmp");
  const std::string begun = (scratch / "begun").string();
  const Setting path("PATH", with_blender(scratch.path(), ": >'" + begun + "'; exec sleep 100"));
  const Setting place("TMPDIR", (scratch / "tmp").string());
  RunOptions options;
  options.interrupt_when = [&] { return std::filesystem::exists(begun); };
  const Ended run = gallery(scratch / "pictures", {"inflate"}, options);
  EXPECT_EQ(run.status, 130) << run.err;
  EXPECT_TRUE(std::filesystem::is_empty(scratch / "tmp"));
  EXPECT_TRUE(std::filesystem::is_empty(scratch / "pictures"));
}

TEST(ChartGalleryClient, MakesBlenderMoveTheSurfaceAsFar) {
  ARGIL_CLIENT_OR_SKIP("blender");
  ARGIL_CLIENT_OR_SKIP("Xvfb");
  const ScratchFolder scratch;
  const Ended run = gallery(scratch / "pictures", {"inflate", "crease", "carve", "grab", "noise"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.json()["skipped"].get<std::vector<std::string>>(), testing::IsEmpty());
  const std::filesystem::path folder = scratch / "pictures";
  for (const char* action : {"inflate", "crease", "carve", "grab"}) {
    const std::string sheet = text_of((folder / (std::string(action) + ".svg")).string());
    EXPECT_EQ(count_of(sheet, "<image "), 4U) << action;
  }
  EXPECT_NEAR(column_of(folder, "inflate", "Blender")["out"],
              column_of(folder, "inflate", "level 1")["out"], 0.05);
  EXPECT_NEAR(column_of(folder, "crease", "Blender")["depth"],
              column_of(folder, "crease", "level 1")["depth"], 0.15);
  // What goes with the hand goes as far without any matching.
  EXPECT_NEAR(column_of(folder, "grab", "Blender")["out"],
              column_of(folder, "grab", "level 1")["out"], 0.5);
  // A remesh cuts edges off.
  EXPECT_GT(column_of(folder, "carve", "Blender")["rim off its circle"], 0.1);
  EXPECT_THAT(text_of((folder / "noise.svg").string()), HasSubstr("nothing alike"));
  EXPECT_TRUE(column_of(folder, "noise", "Blender").empty());
}

/// The page shows every action, and nothing that is none.
TEST(GalleryPage, ShowsEveryAction) {
  const std::string page = text_of("docs/gallery.md");
  std::size_t pictures = 0;
  for (const ActionInfo& info : kActionInfos) {
    const std::string picture = "img/gallery/" + std::string(info.name) + ".svg";
    EXPECT_EQ(count_of(page, "](" + picture + ")"), 1U) << picture;
    EXPECT_TRUE(std::filesystem::exists("docs/" + picture)) << "run examples/actions.sh";
    ++pictures;
  }
  EXPECT_EQ(count_of(page, "!["), pictures);
}

}  // namespace
}  // namespace argil::test
