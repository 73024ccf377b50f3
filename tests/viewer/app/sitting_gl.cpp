// SPDX-License-Identifier: GPL-3.0-or-later
// docs/sitting.md is a script of two windows: it is played, and each step does to the pieces what
// the page says, in the project, in the 3MF and in Blender.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <numbers>
#include <sstream>

#include <gtest/gtest.h>

#include "argil/engine/surface.h"
#include "argil/io/assembly.h"
#include "argil/io/mesh_file.h"
#include "argil/io/project_file.h"
#include "argil/mesh/check.h"

#include "support/blender_boxes.h"
#include "viewer/support/page_script.h"
#include "viewer/support/picture_alike.h"
#include "viewer/support/pinholes.h"
#include "viewer/support/window_run.h"

namespace argil {
namespace {

namespace fs = std::filesystem;

const fs::path kSitting = "docs/sitting.md";
constexpr const char* kSittingSize = "--width 1280 --height 720";
constexpr double kCellMm = 0.25;  // of the grid that volumes are summed on

/// The scripts of the page's windows: each ends as its user leaves.
std::vector<std::string> windows_of(const std::string& script) {
  const std::string leave = "key Ctrl+Q\nframes 3\n";
  std::vector<std::string> windows;
  for (std::size_t from = 0;;) {
    const std::size_t at = script.find(leave, from);
    if (at == std::string::npos) return windows;
    windows.push_back(script.substr(from, at + leave.size() - from));
    from = at + leave.size();
  }
}

/// The script with a copy of the project saved after each picture but the first, of a dialog.
std::string with_copies(const std::string& window) {
  std::istringstream in(window);
  std::string script;
  for (std::string line; std::getline(in, line);) {
    script += line + "\n";
    if (!line.starts_with("shot ") || line.ends_with("01-import.png")) continue;
    script += "key Ctrl+Shift+S\n" +
              test::name_file(fs::path(line.substr(5)).stem().string() + ".vdb") +
              "move 620 680\nframes 3\n";
  }
  return script;
}

double volume_mm3(const Clay& clay) { return mesh::check_mesh(extract_surface(clay)).volume_mm3; }

/// Of the clay's inside where `also` holds, in its own frame, counted on a grid.
double volume_where(const Clay& clay, const std::function<bool(const Vec3&)>& also) {
  const Box3 box = clay.bounds_mm();
  std::int64_t cells = 0;
  for (double x = box.min.x; x < box.max.x; x += kCellMm) {
    for (double y = box.min.y; y < box.max.y; y += kCellMm) {
      for (double z = box.min.z; z < box.max.z; z += kCellMm) {
        const Vec3 at = Vec3{x, y, z} + 0.5 * kCellMm * Vec3{1.0, 1.0, 1.0};
        if (also(at) && clay.distance_at(at) < 0.0) ++cells;
      }
    }
  }
  return static_cast<double>(cells) * kCellMm * kCellMm * kCellMm;
}

/// What the sitting left behind.
class SittingGl : public test::WindowTest {
 protected:
  void SetUp() override {
    test::WindowTest::SetUp();
    if (IsSkipped()) return;
    page_ = test::read_page_script(kSitting);
    const std::vector<std::string> windows = windows_of(page_.script);
    ASSERT_EQ(windows.size(), 2U);
    for (const fs::path& shot : page_.shots)
      fs::create_directories((folder_.path() / shot).parent_path());
    fs::copy_file("examples/pebble.ply", folder_ / "pebble.ply");
    fs::copy_file("examples/alphas/stars.png", folder_ / "stars.png");
    const test::WindowRun first = play(with_copies(windows[0]), "", kSittingSize);
    leave_as_promised(first);
    measured_ = first.report.value("measurements", nlohmann::json::array());
    leave_as_promised(play(with_copies(windows[1]), "flask.vdb", kSittingSize));
  }

  static void leave_as_promised(const test::WindowRun& run) {
    ASSERT_EQ(run.status, 0) << run.words;
    EXPECT_EQ(run.report.at("gl_errors"), 0);
    EXPECT_EQ(run.report.at("complaints").size(), 0U) << run.report.dump();
  }

  /// The copy that was saved after the picture of this name.
  Sculpture copy(const std::string& picture) const {
    auto read = io::load_sculpture(folder_ / (picture + ".vdb"));
    EXPECT_TRUE(read.ok()) << picture;
    return std::move(read).value();
  }

  void expect_volumes_of_each_step() const;
  void expect_mask_held() const;
  void expect_measured() const;
  void expect_undo_goes_behind_the_opening() const;
  void expect_pieces_in_the_3mf() const;
  void expect_pieces_in_blender() const;
  void expect_pictures() const;

  test::PageScript page_;
  nlohmann::json measured_;  ///< in the first window
};

Vec3 turns_of_piece(const Sculpture& sculpture, std::size_t n) {
  const Quat& q = sculpture.look(n).placement.orientation;
  return (360.0 / std::numbers::pi) * std::atan2(length(Vec3{q.x, q.y, q.z}), q.w) *
         normalized(Vec3{q.x, q.y, q.z});
}

void expect_places(const Sculpture& sculpture, const Vec3& flask, const Vec3& stopper) {
  ASSERT_EQ(sculpture.piece_count(), 2U);
  EXPECT_EQ(sculpture.look(0).name, "Flask");
  EXPECT_EQ(sculpture.look(1).name, "Stopper");
  EXPECT_LT(length(sculpture.look(0).placement.position_mm - flask), 1e-9);
  EXPECT_LT(length(sculpture.look(1).placement.position_mm - stopper), 1e-9);
  EXPECT_LT(length(turns_of_piece(sculpture, 0) - Vec3{0.0, 0.0, 45.0}), 1e-6);
  EXPECT_LT(length(turns_of_piece(sculpture, 1) - Vec3{0.0, 20.0, 0.0}), 1e-6);
}

void SittingGl::expect_volumes_of_each_step() const {
  const Sculpture placed_two = copy("02-pieces");
  const Sculpture trimmed = copy("03-trim");
  const Sculpture starred = copy("04-star");
  const Sculpture grooved = copy("05-mask");
  const Sculpture seated = copy("06-subtract");

  // The pebble as large as was typed in.
  const auto pebble = io::read_mesh("examples/pebble.ply");
  ASSERT_TRUE(pebble.ok());
  const double larger = 30.0 / bounds(pebble.value()).size().z;
  const double whole = volume_mm3(placed_two.clay(0));
  EXPECT_NEAR(whole / (std::pow(larger, 3) * mesh::check_mesh(pebble.value()).volume_mm3), 1.0,
              0.005);

  // All below the foot is gone, and the foot stands on the bed.
  const double foot = -trimmed.look(0).placement.position_mm.z;
  const double cut_off =
      volume_where(placed_two.clay(0), [&](const Vec3& p) { return p.z < foot; });
  const double flat = volume_mm3(trimmed.clay(0));
  EXPECT_GT(cut_off, 0.1 * whole);
  EXPECT_NEAR(whole - flat, cut_off, 0.02 * cut_off);

  EXPECT_GT(volume_mm3(starred.clay(0)), flat + 5.0);
  const double before_seat = volume_mm3(grooved.clay(0));
  EXPECT_LT(before_seat, volume_mm3(starred.clay(0)) - 20.0);

  const Placement flask = grooved.look(0).placement;
  const Placement stopper = grooved.look(1).placement;
  const double seat = volume_where(grooved.clay(0), [&](const Vec3& p) {
    return grooved.clay(1).distance_at(unplaced(stopper, placed(flask, p))) < 0.0;
  });
  EXPECT_GT(seat, 100.0);
  EXPECT_NEAR(before_seat - volume_mm3(seated.clay(0)), seat, 0.02 * seat);

  for (const Sculpture* each : {&trimmed, &starred, &grooved, &seated})
    EXPECT_EQ(each->clay(1).hash(), placed_two.clay(1).hash()) << "the stopper was not worked on";
  const Vec3 on_bed{0.0, 0.0, -foot};
  expect_places(placed_two, {0.0, 0.0, 6.0}, {0.0, 0.0, 22.5});
  expect_places(grooved, on_bed, {0.0, 0.0, 22.5});
  expect_places(seated, on_bed, {0.0, 0.0, 34.0});
}

/// Along the groove, which ends where the mask begins.
void SittingGl::expect_mask_held() const {
  const Sculpture before = copy("04-star");
  const Sculpture after = copy("05-mask");
  const Placement at = before.look(0).placement;
  double most_left = 0.0;
  double most_right = 0.0;
  for (double x = -16.0; x <= 16.0; x += 0.25) {
    for (double y = -17.0; y < 0.0; y += 0.25) {
      for (double z = 0.5; z < 8.0; z += 0.5) {
        const Vec3 p = unplaced(at, {x, y, z});
        const double removed = after.clay(0).distance_at(p) - before.clay(0).distance_at(p);
        if (std::abs(before.clay(0).distance_at(p)) > 0.1) continue;  // it was the surface
        if (x < -4.0) most_left = std::max(most_left, removed);
        if (x > 5.0) most_right = std::max(most_right, std::abs(removed));
      }
    }
  }
  EXPECT_GT(most_left, 0.5);
  EXPECT_LT(most_right, 0.005);
}

/// From rim to rim of the flask's seat, and through the middle of the stopper; the page says both.
void SittingGl::expect_measured() const {
  const Sculpture sculpture = copy("07-measure");
  ASSERT_EQ(measured_.size(), 2U) << measured_.dump();
  std::ifstream in(kSitting);
  const std::string page(std::istreambuf_iterator<char>(in), {});
  for (std::size_t n = 0; n < 2; ++n) {
    const Placement at = sculpture.look(n).placement;
    std::vector<Vec3> points;
    for (const auto& p : measured_[n].at("points_mm")) {
      points.push_back({p[0].get<double>(), p[1].get<double>(), p[2].get<double>()});
      const double off = sculpture.clay(n).distance_at(unplaced(at, points.back()));
      EXPECT_LT(std::abs(off), 1e-3) << "a point of " << sculpture.look(n).name;
    }
    ASSERT_EQ(points.size(), 2U);
    const double value = measured_[n].at("value");
    EXPECT_NEAR(value, length(points[1] - points[0]), 1e-9);
    char text[32];
    std::snprintf(text, sizeof text, "%.2f mm", value);
    EXPECT_NE(page.find(text), std::string::npos) << text;
  }
  EXPECT_EQ(measured_[0].at("kind"), "distance");
  EXPECT_EQ(measured_[1].at("kind"), "thickness");
  const double ball = volume_mm3(sculpture.clay(1));
  const double across = 2.0 * std::cbrt(0.75 * ball / std::numbers::pi);
  EXPECT_NEAR(measured_[1].at("value").get<double>(), across, 0.1 * kCellMm);
}

void SittingGl::expect_undo_goes_behind_the_opening() const {
  const Sculpture saved = copy("08-saved");
  const Sculpture mistake = copy("10-mistake");
  const Sculpture earlier = copy("05-mask");
  const Sculpture undone = copy("11-undone");
  ASSERT_EQ(undone.piece_count(), 2U);
  for (std::size_t n = 0; n < 2; ++n) {
    EXPECT_EQ(copy("09-reopened").clay(n).hash(), saved.clay(n).hash());
    EXPECT_EQ(undone.clay(n).hash(), earlier.clay(n).hash());
    EXPECT_EQ(copy("12-export").clay(n).hash(), saved.clay(n).hash());
  }
  EXPECT_TRUE(undone.clay(0).has_mask());
  EXPECT_NE(undone.clay(0).hash(), saved.clay(0).hash());
  EXPECT_GT(volume_mm3(mistake.clay(0)), volume_mm3(saved.clay(0)) + 20.0);
}

void SittingGl::expect_pieces_in_the_3mf() const {
  const Sculpture saved = copy("12-export");
  const auto read = io::read_assembly(folder_ / "flask.3mf");
  ASSERT_TRUE(read.ok());
  const io::Assembly& assembly = read.value().assembly;
  const std::vector<io::PlacedPart> parts = io::placed_parts(assembly);
  ASSERT_EQ(parts.size(), 2U);
  for (std::size_t n = 0; n < 2; ++n) {
    EXPECT_EQ(parts[n].name, saved.look(n).name);
    const TriangleMesh& mesh = assembly.objects[parts[n].object].mesh;
    EXPECT_NEAR(mesh::check_mesh(mesh).volume_mm3 / volume_mm3(saved.clay(n)), 1.0, 0.001);
    const Box3 there = io::placed_bounds(mesh, parts[n].to_mm);
    const Box3 wanted = test::placed_surface(saved, n);
    EXPECT_LT(length(there.min - wanted.min), 0.1) << parts[n].name;
    EXPECT_LT(length(there.max - wanted.max), 0.1) << parts[n].name;
  }
}

void SittingGl::expect_pieces_in_blender() const {
  if (!test::has_program("blender")) return;
  const std::map<std::string, Box3> shown = test::blender_boxes(folder_ / "flask.vdb");
  const Sculpture saved = copy("12-export");
  for (std::size_t n = 0; n < 2; ++n) {
    // The level below the finest, which is not everywhere: its voxels measure half a millimetre.
    const auto box = shown.find(saved.look(n).name + "/surface_1");
    ASSERT_NE(box, shown.end()) << saved.look(n).name;
    const Box3 wanted = test::placed_surface(saved, n);
    EXPECT_LT(length(box->second.min - wanted.min), 0.2) << saved.look(n).name;
    EXPECT_LT(length(box->second.max - wanted.max), 0.2) << saved.look(n).name;
  }
}

void SittingGl::expect_pictures() const {
  for (const fs::path& shot : page_.shots) {
    EXPECT_TRUE(test::is_as_committed(folder_ / shot, shot));
    if (shot.stem() == "01-import" || shot.stem() == "02-pieces") continue;  // a dialog, the gizmo
    if (shot.stem() == "07-measure") continue;  // the list, and numbers
    EXPECT_EQ(test::pinholes(test::read_picture(folder_ / shot), 490, 756), 0) << shot;
  }
}

TEST_F(SittingGl, EveryStepDoesToThePiecesWhatThePageSays) {
  expect_volumes_of_each_step();
  expect_mask_held();
  expect_measured();
  expect_undo_goes_behind_the_opening();
  expect_pieces_in_the_3mf();
  expect_pieces_in_blender();
  expect_pictures();
}

TEST(SittingPage, ShowsEveryPictureThatItsScriptTakes) {
  const test::PageScript page = test::read_page_script(kSitting);
  std::vector<fs::path> shown;
  shown.reserve(page.pictures.size());
  for (const fs::path& picture : page.pictures) shown.push_back(kSitting.parent_path() / picture);
  EXPECT_EQ(shown, page.shots);
}

}  // namespace
}  // namespace argil
