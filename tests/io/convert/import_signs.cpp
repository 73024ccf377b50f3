// SPDX-License-Identifier: GPL-3.0-or-later
// Signs of the finest level of an import against the winding number by its definition: the sum of
// the solid angles of all triangles.
#include <atomic>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include "argil/core/triangle_mesh.h"
#include "argil/core/winding_number.h"
#include "argil/io/mesh_file.h"
#include "argil/mesh/close.h"

#include "import/import_field.h"
#include "import/machine_memory.h"
#include "support/effort.h"
#include "support/models.h"
#include "support/shapes.h"

namespace argil {
namespace {

/// The winding number, every triangle counted. Angles are added by multiplying complex numbers, and
/// whole turns counted.
class SummedAngles {
 public:
  explicit SummedAngles(const TriangleMesh& mesh) : mesh_(mesh) {}

  double at(const Vec3& p) const {
    thread_local std::vector<Vec3> to;
    thread_local std::vector<double> far;
    to.resize(mesh_.positions.size());
    far.resize(to.size());
    for (std::size_t v = 0; v < to.size(); ++v) {
      to[v] = mesh_.positions[v] - p;
      far[v] = length(to[v]);
    }
    double re = 1.0;
    double im = 0.0;
    int turns = 0;
    for (const auto& [i, j, k] : mesh_.triangles) {
      const double y = dot(to[i], cross(to[j], to[k]));
      const double x = far[i] * far[j] * far[k] + dot(to[i], to[j]) * far[k] +
                       dot(to[j], to[k]) * far[i] + dot(to[k], to[i]) * far[j];
      const double next_re = re * x - im * y;
      const double next_im = re * y + im * x;
      if (y > 0.0 && im >= 0.0 && next_im < 0.0) ++turns;
      if (y < 0.0 && im < 0.0 && next_im >= 0.0) --turns;
      const double size = std::abs(next_re) + std::abs(next_im);
      re = size > 0.0 ? next_re / size : re;
      im = size > 0.0 ? next_im / size : im;
    }
    return turns + std::atan2(im, re) / (2.0 * std::numbers::pi);
  }

 private:
  const TriangleMesh& mesh_;
};

/// Of so many nodes of the finest level the sign is asked.
const int kAsked = test::effort(400, 100000);
/// A node as near to the surface, or w as near to 1/2, has either.
constexpr double kSureVoxels = 1e-3;
constexpr double kSureTurns = 2e-3;  // twice what the sum over open edges promises

void expect_right_signs(const TriangleMesh& mesh, double voxel_mm) {
  const auto input = prepare_import(mesh, {voxel_mm, 0.1});
  ASSERT_TRUE(input.ok()) << input.error().message;
  const auto finest = build_finest_level(input.value(), {}, available_bytes());
  ASSERT_TRUE(finest.ok()) << finest.error().message;
  std::vector<std::pair<Coord, float>> nodes;
  for (auto leaf = finest.value().grid->tree().cbeginLeaf(); leaf; ++leaf) {
    for (auto value = leaf->cbeginValueAll(); value; ++value) {
      if (static_cast<double>(std::abs(*value)) > kSureVoxels * voxel_mm) {
        nodes.emplace_back(value.getCoord(), *value);
      }
    }
  }
  std::mt19937_64 dice(11);
  const SummedAngles angles(mesh);
  std::vector<std::size_t> asked(static_cast<std::size_t>(kAsked));
  for (std::size_t& each : asked) each = dice() % nodes.size();
  std::atomic<int> wrong = 0;
  std::atomic<int> unsure = 0;
  tbb::parallel_for(std::size_t{0}, asked.size(), [&](std::size_t n) {
    const auto& [node, value] = nodes[asked[n]];
    const double w = angles.at({node.x() * voxel_mm, node.y() * voxel_mm, node.z() * voxel_mm});
    if (std::abs(w - 0.5) < kSureTurns) {
      ++unsure;
    } else if ((w > 0.5) != (value < 0.0F)) {
      ++wrong;
    }
  });
  EXPECT_EQ(wrong, 0);
  EXPECT_LT(unsure, kAsked / 20);
}

TriangleMesh model_of(const std::filesystem::path& path) {
  auto read = io::read_mesh(path);
  EXPECT_TRUE(read.ok()) << (read.ok() ? "" : read.error().message);
  TriangleMesh mesh = std::move(read).value();
  const Vec3 size = bounds(mesh).size();
  for (Vec3& p : mesh.positions) p *= 80.0 / std::max({size.x, size.y, size.z});
  return mesh;
}

class ImportSigns : public ::testing::TestWithParam<const char*> {};

TEST_P(ImportSigns, AreThoseOfAllSolidAngles) {
  ARGIL_MODEL_OR_SKIP(path, GetParam());
  const TriangleMesh mesh = model_of(path);
  expect_right_signs(mesh, test::effort(0.8, 0.4));
  const auto closed = mesh::close_mesh(mesh);
  ASSERT_TRUE(closed.ok()) << closed.error().message;
  if (closed.value().report.holes_closed > 0) {
    expect_right_signs(closed.value().mesh, test::effort(0.8, 0.4));
  }
}

INSTANTIATE_TEST_SUITE_P(Shared, ImportSigns,
                         ::testing::Values("stanford-bunny.obj", "spot.obj", "rocker-arm.obj",
                                           "cow.obj", "fandisk.obj", "teapot.obj"),
                         [](const auto& given) { return test::name_of_model(given.param); });

TEST(ImportSignsOf, ShapesAreThoseOfAllSolidAngles) {
  expect_right_signs(test::self_crossing_mesh(), 0.25);
  expect_right_signs(test::torus_mesh(10.0, 3.0, 60, 24), 0.3);
  const TriangleMesh balls =
      test::joined(test::ball_mesh(8.0, 3), test::ball_mesh(6.0, 3, {7.0, 1.0, 2.0}));
  expect_right_signs(balls, 0.4);
  expect_right_signs(test::joined(balls, test::inside_out(test::ball_mesh(3.0, 3))), 0.4);
  expect_right_signs(test::cut_above(test::ball_mesh(8.0, 3, {0.1, 0.2, 0.3}), -3.0), 0.4);
  expect_right_signs(test::without(test::ball_mesh(8.0, 2), 17), 0.4);
}

}  // namespace
}  // namespace argil
