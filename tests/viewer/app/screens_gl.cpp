// SPDX-License-Identifier: GPL-3.0-or-later
// Every panel, dialog and menu on screens of three sizes: nothing is cut off. With ARGIL_SHOTS the
// pictures of all are kept in that folder, to be looked at.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "argil/engine/clay.h"
#include "argil/io/mesh_file.h"
#include "argil/io/project_file.h"

#include "document/tool_info.h"
#include "settings/settings.h"
#include "support/shapes.h"
#include "viewer/support/window_run.h"

namespace argil {
namespace {

using test::shell_word;
using test::WindowRun;

struct Screen {
  int width;
  int height;
  int percent;  ///< size of panels and letters
};

class Screens : public test::WindowTest {
 protected:
  explicit Screens(const Screen& screen) : screen_(screen) {}
  void SetUp() override {
    WindowTest::SetUp();
    if (IsSkipped()) return;
    display_ = std::to_string(screen_.width) + "x" + std::to_string(screen_.height);
    ASSERT_TRUE(io::save_project(folder_ / "s.vdb", Clay::ball(25.0, {}).value()).ok());
    viewer::Settings settings;
    settings.panel_percent = screen_.percent;
    ASSERT_TRUE(viewer::write_changes(home(), {}, settings).ok());
  }

  void expect_dialogs_seen();
  void expect_panels_seen();
  void expect_menus_and_tools_seen();
  void expect_questions_seen();

 private:
  /// What a script opens, its picture, and what closes it again.
  std::string seen(const std::string& name, const std::string& opens, const std::string& closes) {
    return opens + "frames 6\nshot " + name + ".png\n" + closes + "frames 3\n";
  }
  /// Expects that a script shows these panels, and that all of them is seen; keeps its pictures.
  void expect_seen(const std::string& script, const std::vector<std::string>& panels,
                   const std::string& project = "s.vdb") {
    const WindowRun run = play(
        "settle\n" + script + "key Ctrl+Q\nframes 4\n", shell_word(folder_ / project),
        "--width " + std::to_string(screen_.width) + " --height " + std::to_string(screen_.height));
    EXPECT_EQ(run.status, 0) << run.words;
    ASSERT_TRUE(run.report.contains("cut_off")) << run.words;
    EXPECT_EQ(run.report["cut_off"].size(), 0U) << run.report["cut_off"].dump(1);
    const nlohmann::json& shown = run.report["panels"];
    for (const std::string& panel : panels) {
      EXPECT_NE(std::find(shown.begin(), shown.end(), panel), shown.end()) << panel << shown.dump();
    }
    keep_pictures();
  }
  void keep_pictures() {
    const char* shots = std::getenv("ARGIL_SHOTS");  // NOLINT(concurrency-mt-unsafe): read only
    if (shots == nullptr) return;
    const std::filesystem::path to = std::filesystem::path(shots) / display_;
    std::filesystem::create_directories(to);
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
      if (entry.path().extension() != ".png") continue;
      std::filesystem::copy_file(entry.path(), to / entry.path().filename(),
                                 std::filesystem::copy_options::overwrite_existing);
    }
  }

  Screen screen_;
};

void Screens::expect_dialogs_seen() {
  const auto mesh = folder_ / "box.stl";
  ASSERT_TRUE(io::write_mesh(mesh, test::box_mesh({10.0, 20.0, 40.0})).ok());
  const std::string esc = "key Esc\n";
  expect_seen(seen("new", "key Ctrl+N\n", esc) + seen("open", "key Ctrl+O\n", esc) +
                  seen("save_as", "key Ctrl+Shift+S\n", esc) + seen("export", "key Ctrl+E\n", esc) +
                  seen("operations", "key Ctrl+W\n", esc) +
                  seen("still", "click File\nframes 2\nclick Still picture...\n", esc) +
                  seen("import", "drop " + mesh.string() + "\nframes 3\nsettle\n", esc) +
                  seen("search", "key Ctrl+K\n", esc) +
                  seen("recent", "key Ctrl+Shift+O\nsettle\n", esc) +
                  seen("image", "drop " + (folder_ / "new.png").string() + "\n", esc),
              {"New clay", "Open", "Save as", "Export for printing", "Whole clay", "Still picture",
               "Import", "What is the image for?", "Recent files"});
}

void Screens::expect_panels_seen() {
  const auto panel = [&](const std::string& name, const std::string& key) {
    return seen(name, "key " + key + "\n", "key " + key + "\n");
  };
  const auto searched = [&](const std::string& name, const std::string& title) {
    const std::string chosen = "key Ctrl+K\nframes 3\ntype " + title + "\nframes 3\nkey Enter\n";
    return seen(name, chosen, chosen);
  };
  expect_seen(panel("pieces", "Ctrl+P") + panel("history", "Ctrl+H") + panel("presets", "Shift+B") +
                  panel("measurements", "Ctrl+Alt+U") + panel("messages", "Ctrl+M") +
                  panel("help", "F1") + panel("keys", "Shift+F1") + panel("slice", "Shift+W") +
                  searched("device", "Device panel") + searched("print", "Print") +
                  searched("favourites", "Change favourites") +
                  searched("references", "Reference images") +
                  searched("figures", "Clay's figures"),
              {"Pieces", "History", "Presets", "Measure", "Messages", "Keys and mouse",
               "Change keys", "Device", "Print", "Favourites", "Reference images"});
}

void Screens::expect_menus_and_tools_seen() {
  std::string script;
  for (const std::string menu :
       {"File", "Edit", "Piece", "Brush", "Mask", "View", "Measure", "Device", "Help"}) {
    script += seen("menu_" + menu, "click " + menu + "\n", "key Esc\n");
  }
  // The options of tools differ at the right; the menu Mask has the name of a tool.
  script += "click Stroke\n";
  for (const viewer::ToolInfo& tool : viewer::tool_infos()) {
    const std::string title = tool.title;
    script += seen("tool_" + title, title == "Mask" ? "key M\n" : "click " + title + "\n", "");
  }
  expect_seen(script, {"Tools", "Brush", "View", "Status"});
}

/// About work that a killed window left, of a project with a long name; and whether to lose work.
void Screens::expect_questions_seen() {
  const std::string name = "a sculpture with a name that is longer than any dialog is wide";
  test::leave_a_stroke(folder_ / (name + ".vdb"));
  expect_seen(seen("recover", "", "click Recover\nsettle\n") +
                  seen("save_first", "key Ctrl+Q\n", "click Back\nkey Ctrl+S\nsettle\n"),
              {"Recover?", "Save first?"}, name + ".vdb");
}

class ScreensGl : public Screens, public testing::WithParamInterface<Screen> {
 protected:
  ScreensGl() : Screens(GetParam()) {}
};

TEST_P(ScreensGl, CutNoDialogOff) { expect_dialogs_seen(); }
TEST_P(ScreensGl, CutNoPanelOff) { expect_panels_seen(); }
TEST_P(ScreensGl, CutNoQuestionOff) { expect_questions_seen(); }
TEST_P(ScreensGl, CutNoMenuOffAndNoTool) { expect_menus_and_tools_seen(); }

INSTANTIATE_TEST_SUITE_P(ViewOn, ScreensGl,
                         testing::Values(Screen{1280, 720, 100}, Screen{1920, 1080, 100}),
                         [](const auto& screen) {
                           return std::to_string(screen.param.width) + "x" +
                                  std::to_string(screen.param.height);
                         });

class ScreensSlow : public Screens {
 protected:
  ScreensSlow() : Screens({3840, 2160, 200}) {}
};

TEST_F(ScreensSlow, CutNothingOffWhereLettersAreTwiceAsLarge) {
  expect_dialogs_seen();
  expect_panels_seen();
  expect_menus_and_tools_seen();
  expect_questions_seen();
}

}  // namespace
}  // namespace argil
