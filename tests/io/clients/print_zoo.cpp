// SPDX-License-Identifier: GPL-3.0-or-later
// Clay that breaks other exporters, and random strokes: after export every program must agree that
// the file is sound. ARGIL_ZOO_STROKES says how many random sequences are looked at (3, in a
// thorough run 60); usually one of the clays is sliced.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "argil/engine/import.h"
#include "argil/io/export.h"
#include "argil/io/mesh_file.h"
#include "argil/io/project_file.h"
#include "argil/io/volume_file.h"

#include "io/support/lib3mf_file.h"
#include "support/clients.h"
#include "support/effort.h"
#include "support/scratch.h"
#include "support/shapes.h"
#include "support/stroke_maker.h"

namespace argil {
namespace {

using testing::Each;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kZooVoxelMm = 0.5;

/// Inside or outside by chance at every node of a ball, usually a smaller one.
Clay noise() {
  const double radius_mm = test::effort(3.0, 7.0);
  const auto sign = [](const Vec3& p) {
    const auto cell = [](double x) {
      return static_cast<std::uint64_t>(
          static_cast<std::int64_t>(std::floor(x / kZooVoxelMm + 0.25)));
    };
    std::uint64_t h = cell(p.x) * 0x9e3779b97f4a7c15ULL ^ cell(p.y) * 0xc2b2ae3d27d4eb4fULL ^
                      cell(p.z) * 0x165667b19e3779f9ULL;
    h = (h ^ h >> 29) * 0xbf58476d1ce4e5b9ULL;
    return (h >> 40 & 1U) != 0 ? 0.4 * kZooVoxelMm : -0.4 * kZooVoxelMm;
  };
  Box3 box;
  box.include(Vec3{-8, -8, -8});
  box.include(Vec3{8, 8, 8});
  return Clay::from_distance(
             [=](const Vec3& p) { return std::max(length(p) - radius_mm, sign(p)); }, box,
             {kZooVoxelMm})
      .value();
}

/// Sheets from a half to three voxels thick, side by side.
Clay sheets() {
  Box3 box;
  box.include(Vec3{-10, -6, -6});
  box.include(Vec3{10, 6, 6});
  const auto distance = [](const Vec3& p) {
    double nearest = 1e3;
    for (int n = 0; n < 6; ++n) {
      const double x = std::abs(p.x - (3.0 * n - 7.5)) - 0.25 * kZooVoxelMm * (n + 1);
      nearest = std::min(nearest, std::max({x, std::abs(p.y) - 5.0, std::abs(p.z) - 5.0}));
    }
    return nearest;
  };
  return Clay::from_distance(distance, box, {kZooVoxelMm}).value();
}

/// Balls that touch in a node, in a cell's middle, and nearly.
Clay touching_balls() {
  Box3 box;
  box.include(Vec3{-13, -5, -5});
  box.include(Vec3{14, 5, 5});
  const auto distance = [](const Vec3& p) {
    const double first = length(p - Vec3{-8, 0, 0}) - 4.0;
    const double second = length(p) - 4.0;
    return std::min({first, second, length(p - Vec3{8.26, 0.13, 0.26}) - 4.25});
  };
  return Clay::from_distance(distance, box, {kZooVoxelMm}).value();
}

Clay self_crossing() {
  return std::move(import_mesh(test::self_crossing_mesh(), {kZooVoxelMm}).value().clay);
}

/// "As many objects as said, each closed, two-manifold and facing one way", says lib3mf.
void expect_manifold_by_lib3mf(const std::filesystem::path& threemf, std::int64_t objects) {
  const test::Lib3mfFile file = test::lib3mf_file(threemf);
  EXPECT_TRUE(file.is_read) << threemf;
  EXPECT_EQ(static_cast<std::int64_t>(file.objects.size()), objects) << threemf;
  for (const test::Lib3mfObject& object : file.objects) {
    EXPECT_TRUE(object.manifold) << threemf << ": " << object.name;
  }
}

/// The project and the field.
void expect_vdb_is_read(const Clay& clay, const test::ScratchFolder& folder) {
  ASSERT_TRUE(io::save_project(folder / "p.vdb", clay));
  ASSERT_TRUE(io::export_volume(folder / "v.vdb", clay));
  for (const auto& [file, grid] : {std::pair{"p.vdb", "surface_0"}, {"v.vdb", "surface"}}) {
    const test::ProgramRun vdb = test::run_program({"vdb_print", (folder / file).string()});
    EXPECT_EQ(vdb.status, 0) << vdb.output;
    EXPECT_NE(vdb.output.find(grid), std::string::npos) << vdb.output;
  }
}

/// Whether strokes left a piece that floats above the rest: where a layer falls between, a slicer
/// warns of it, and rightly.
bool has_gap_in_height(const TriangleMesh& mesh) {
  std::vector<std::pair<double, double>> heights;
  for (const Triangle& t : mesh.triangles) {
    const auto z = [&](std::size_t k) { return mesh.positions[t[k]].z; };
    heights.emplace_back(std::min({z(0), z(1), z(2)}), std::max({z(0), z(1), z(2)}));
  }
  std::sort(heights.begin(), heights.end());
  double reached = heights.front().second;
  for (const auto& [low, high] : heights) {
    if (low > reached) return true;
    reached = std::max(reached, high);
  }
  return false;
}

void expect_sliced(const std::filesystem::path& threemf) {
  const std::vector<std::string> slicing = test::slicing_complaints(threemf);
  if (has_gap_in_height(io::read_mesh(threemf).value())) {
    EXPECT_THAT(slicing, Each(HasSubstr("Empty layer"))) << threemf;
  } else {
    EXPECT_THAT(slicing, IsEmpty()) << threemf;
  }
}

/// Sparing: what a slicer must open takes a tenth of a second each.
void expect_all_agree(const Clay& clay, const std::string& name, bool with_slicer) {
  const test::ScratchFolder folder;
  for (const char* ending : {".stl", ".3mf", ".obj", ".ply", ".glb"}) {
    const auto file = folder / (name + ending);
    const auto report = io::export_mesh(file, clay);
    ASSERT_TRUE(report.ok()) << name << ending << ": " << report.error().message;
    EXPECT_TRUE(report.value().verdict.printable) << name << ending;
    if (!with_slicer) continue;
    if (std::string(ending) == ".glb") {
      EXPECT_THAT(test::gltf_complaints(file), IsEmpty()) << name;
    } else if (std::string(ending) != ".ply") {
      EXPECT_THAT(test::slicer_info(file).complaints, IsEmpty()) << name << ending;
    }
  }
  EXPECT_THAT(test::admesh_complaints(folder / (name + ".stl")), IsEmpty()) << name;
  expect_manifold_by_lib3mf(folder / (name + ".3mf"), 1);
  if (!with_slicer) return;
  if (test::effort(name == "balls", true)) expect_sliced(folder / (name + ".3mf"));
  io::ExportOptions options;
  options.parts = true;
  const auto parts = io::export_mesh(folder / "parts.3mf", clay, options);
  ASSERT_TRUE(parts.ok()) << name << ": " << parts.error().message;
  EXPECT_TRUE(parts.value().verdict.printable) << name;
  expect_manifold_by_lib3mf(folder / "parts.3mf", parts.value().parts);
  EXPECT_THAT(test::slicer_info(folder / "parts.3mf").complaints, IsEmpty()) << name;
  expect_vdb_is_read(clay, folder);
}

class PrintZooClient : public testing::Test {
 protected:
  void SetUp() override {
    ARGIL_CLIENT_OR_SKIP("admesh");
    ARGIL_CLIENT_OR_SKIP("prusa-slicer");
    ARGIL_CLIENT_OR_SKIP("vdb_print");
    ARGIL_CLIENT_OR_SKIP("node");
    if (!std::filesystem::exists(test::gltf_validator())) {
      GTEST_SKIP() << "client gltf-validator of npm is not installed; ./tests/run.sh installs it";
    }
  }
};

TEST_F(PrintZooClient, AgreesOnNoise) { expect_all_agree(noise(), "noise", true); }
TEST_F(PrintZooClient, AgreesOnThinSheets) { expect_all_agree(sheets(), "sheets", true); }
TEST_F(PrintZooClient, AgreesOnTouchingBalls) { expect_all_agree(touching_balls(), "balls", true); }
TEST_F(PrintZooClient, AgreesOnWhatWentThroughItself) {
  expect_all_agree(self_crossing(), "knot", true);
}

/// Six strokes of any action on a small ball or block each.
TEST_F(PrintZooClient, AgreesOnRandomStrokes) {
  const char* asked = std::getenv("ARGIL_ZOO_STROKES");
  const int sequences = asked != nullptr ? std::atoi(asked) : test::effort(3, 60);
  ASSERT_GT(sequences, 0);
  int judged = 0;
  for (int seed = 0; seed < sequences; ++seed) {
    std::mt19937 random(static_cast<unsigned>(seed));
    Clay clay = random_start(random);
    for (int n = 0; n < 6; ++n) {
      Stroke stroke = random_dab(random, 9.0);
      stroke.tool.action = actions_on_levels()[random() % actions_on_levels().size()];
      stroke.tool.strength = std::abs(stroke.tool.strength);
      ASSERT_TRUE(clay.apply(stroke).ok()) << describe(stroke);
    }
    if (clay.bounds_mm().empty()) continue;  // all carved away
    expect_all_agree(clay, "seed" + std::to_string(seed), seed % 20 == 0);
    ++judged;
  }
  EXPECT_GT(judged, sequences / 2);
}

}  // namespace
}  // namespace argil
