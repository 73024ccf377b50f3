// SPDX-License-Identifier: GPL-3.0-or-later
// The whole path on real meshes: imported at 80 mm and 0.25 mm, 200 strokes of mixed size and
// action (usually at 20 mm with strokes as much smaller, 20 of them), exported as STL and 3MF, then
// judged by the programs that people print with. The ordinary run takes two models and slices one.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "argil/engine/import.h"
#include "argil/io/export.h"
#include "argil/io/mesh_file.h"
#include "argil/mesh/close.h"

#include "io/support/lib3mf_file.h"
#include "support/clients.h"
#include "support/effort.h"
#include "support/models.h"
#include "support/scratch.h"

namespace argil {
namespace {

int strokes() { return test::effort(20, 200); }

constexpr double kFullSizeMm = 80.0;
double size_mm() { return test::effort(20.0, kFullSizeMm); }

TriangleMesh print_sized(TriangleMesh mesh) {
  const Vec3 size = bounds(mesh).size();
  const double scale = size_mm() / std::max({size.x, size.y, size.z});
  for (Vec3& p : mesh.positions) p *= scale;
  return mesh;
}

double uniform(std::mt19937& random, double lo, double hi) {
  return lo + (hi - lo) * (static_cast<double>(random()) / 4294967296.0);
}

/// Between two vertices of the original mesh: on, above and below the surface.
Stroke stroke_on(const TriangleMesh& mesh, std::mt19937& random) {
  Stroke stroke;
  stroke.tool.action = static_cast<Action>(random() % 4);
  // At full size 1 to 10 mm.
  const double radius = std::exp2(uniform(random, 0.0, 3.3)) * size_mm() / kFullSizeMm;
  stroke.tool.radii_mm = {radius, radius, radius};
  if (random() % 3 == 0) {
    stroke.tool.shape = Shape::ellipsoid;
    stroke.tool.radii_mm.z *= uniform(random, 0.4, 1.0);
  }
  stroke.tool.strength = uniform(random, 0.3, 1.0);
  stroke.spacing = 0.5;
  const Vec3 start = mesh.positions[random() % mesh.positions.size()];
  const Vec3 aim = mesh.positions[random() % mesh.positions.size()];
  const double way = std::min(2.0 * radius, length(aim - start));
  const Quat turn = normalized(Quat{uniform(random, -1, 1), uniform(random, -1, 1),
                                    uniform(random, -1, 1), uniform(random, -1, 1)});
  stroke.samples = {{0.0, start, turn, 1.0},
                    {1.0, start + normalized(aim - start) * way, turn, 1.0}};
  return stroke;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string all;
  for (const std::string& line : lines) all += line + "\n";
  return all;
}

constexpr const char* kSlicedModel = "stanford-bunny.obj";
constexpr std::array kModels{kSlicedModel, "fandisk.obj"};
constexpr std::array kMoreModels{"spot.obj", "rocker-arm.obj", "cow.obj", "teapot.obj"};

bool is_sliced(const std::string& model) { return test::effort(model == kSlicedModel, true); }

void expect_printable_when_sculpted(const char* model) {
  ARGIL_CLIENT_OR_SKIP("admesh");
  ARGIL_CLIENT_OR_SKIP("prusa-slicer");
  ARGIL_MODEL_OR_SKIP(file, model);
  auto read = io::read_mesh(file);
  ASSERT_TRUE(read.ok());
  auto closed = mesh::close_mesh(print_sized(std::move(read).value()));
  ASSERT_TRUE(closed.ok());
  const TriangleMesh& mesh = closed.value().mesh;
  auto imported = import_mesh(mesh, ClayOptions{});
  ASSERT_TRUE(imported.ok()) << imported.error().message;
  Clay& clay = imported.value().clay;
  std::mt19937 random(2026);
  for (int i = 0; i < strokes(); ++i) {
    const auto applied = clay.apply(stroke_on(mesh, random));
    ASSERT_TRUE(applied.ok()) << applied.error().message;
  }
  EXPECT_EQ(joined(clay.validate()), "");

  const test::ScratchFolder scratch;
  const auto stl = scratch / "part.stl";
  const auto threemf = scratch / "part.3mf";
  for (const auto& part : {stl, threemf}) {
    const auto written = io::export_mesh(part, clay);
    ASSERT_TRUE(written.ok()) << written.error().message;
    EXPECT_TRUE(written.value().verdict.printable);
    std::printf("%s %s: %lld triangles, max error %.4f mm, collapsed %lld\n", model,
                part.extension().c_str(), static_cast<long long>(written.value().triangles),
                written.value().max_error_mm,
                static_cast<long long>(written.value().collapsed_edges));
  }
  EXPECT_EQ(joined(test::admesh_complaints(stl)), "");
  const test::SlicerInfo as_stl = test::slicer_info(stl);
  const test::SlicerInfo as_3mf = test::slicer_info(threemf);
  EXPECT_EQ(joined(as_stl.complaints), "");
  EXPECT_EQ(joined(as_3mf.complaints), "");
  EXPECT_EQ(as_stl.facets, as_3mf.facets);
  const test::Lib3mfFile by_lib3mf = test::lib3mf_file(threemf);
  ASSERT_TRUE(by_lib3mf.is_read);
  ASSERT_EQ(by_lib3mf.objects.size(), 1U);
  EXPECT_TRUE(by_lib3mf.objects[0].manifold);
  EXPECT_EQ(by_lib3mf.objects[0].triangles, as_3mf.facets);
  EXPECT_NEAR(length(as_stl.size_mm - as_3mf.size_mm), 0.0, 1e-3);
  // The same facets as the other's.
  if (test::effort(false, true)) {
    EXPECT_EQ(joined(test::slicing_complaints(stl)), "");
  }
  if (is_sliced(model)) {
    EXPECT_EQ(joined(test::slicing_complaints(threemf)), "");
  }
}

class SculptedModelClient : public testing::TestWithParam<const char*> {};
class SculptedModelSlow : public testing::TestWithParam<const char*> {};

TEST_P(SculptedModelClient, IsPrintableInEveryProgramsEyes) {
  expect_printable_when_sculpted(GetParam());
}
TEST_P(SculptedModelSlow, IsPrintableInEveryProgramsEyes) {
  expect_printable_when_sculpted(GetParam());
}

const auto name_of_given = [](const auto& given) { return test::name_of_model(given.param); };
INSTANTIATE_TEST_SUITE_P(Models, SculptedModelClient, testing::ValuesIn(kModels), name_of_given);
INSTANTIATE_TEST_SUITE_P(Models, SculptedModelSlow, testing::ValuesIn(kMoreModels), name_of_given);

}  // namespace
}  // namespace argil
