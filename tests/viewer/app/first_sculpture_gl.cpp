// SPDX-License-Identifier: GPL-3.0-or-later
// docs/first-sculpture.md is a script: it is played, and what the page promises is there.
#include <algorithm>

#include <gtest/gtest.h>

#include "argil/io/mesh_file.h"
#include "argil/io/project_file.h"
#include "argil/mesh/check.h"

#include "viewer/support/page_script.h"
#include "viewer/support/picture_alike.h"
#include "viewer/support/window_run.h"

namespace argil {
namespace {

namespace fs = std::filesystem;

const fs::path kPage = "docs/first-sculpture.md";

/// Area of what lies on the bed.
double foot_mm2(const TriangleMesh& mesh) {
  const double bed = bounds(mesh).min.z;
  double area = 0.0;
  for (const auto& triangle : mesh.triangles) {
    const Vec3 a = mesh.positions[triangle[0]];
    const Vec3 b = mesh.positions[triangle[1]];
    const Vec3 c = mesh.positions[triangle[2]];
    if (std::max({a.z, b.z, c.z}) < bed + 0.02) area += 0.5 * length(cross(b - a, c - a));
  }
  return area;
}

class FirstSculptureGl : public test::WindowTest {};

TEST_F(FirstSculptureGl, ThePageEndsInAPrintablePartAndShowsWhatAPersonSees) {
  const test::PageScript page = test::read_page_script(kPage);
  ASSERT_GE(page.shots.size(), 8U);
  for (const fs::path& shot : page.shots)
    fs::create_directories((folder_.path() / shot).parent_path());

  const test::WindowRun run = play(page.script, "", "--width 960 --height 640");
  ASSERT_EQ(run.status, 0) << run.words;
  EXPECT_EQ(run.report.at("gl_errors"), 0);
  EXPECT_EQ(run.report.at("complaints").size(), 0U) << run.report.dump();

  const auto project = io::load_project(folder_ / "owl.vdb");
  ASSERT_TRUE(project.ok());
  // Cut flat; ears and beak stand out of what was a ball of 25 mm.
  const Clay& owl = project.value();
  EXPECT_NEAR(owl.bounds_mm().min.z, -22.0, 0.05);
  EXPECT_GT(owl.bounds_mm().max.z, 28.0);
  EXPECT_LT(owl.bounds_mm().min.y, -26.0);
  const auto mesh = io::read_mesh(folder_ / "owl.3mf");
  ASSERT_TRUE(mesh.ok());
  const mesh::MeshVerdict verdict = mesh::check_mesh(mesh.value());
  EXPECT_TRUE(verdict.printable);
  EXPECT_EQ(verdict.components, 1);
  EXPECT_GT(foot_mm2(mesh.value()), 300.0);

  for (const fs::path& shot : page.shots) EXPECT_TRUE(test::is_as_committed(folder_ / shot, shot));
}

TEST(FirstSculpturePage, ShowsEveryPictureThatItsScriptTakes) {
  const test::PageScript page = test::read_page_script(kPage);
  std::vector<fs::path> shown;
  shown.reserve(page.pictures.size());
  for (const fs::path& picture : page.pictures) shown.push_back(kPage.parent_path() / picture);
  EXPECT_EQ(shown, page.shots);
}

}  // namespace
}  // namespace argil
