// SPDX-License-Identifier: GPL-3.0-or-later
// Import of a ball to clays of so many surface vertices, and of one whose triangles are much finer
// than the voxels.
#include <cmath>
#include <string>

#include "argil/engine/import.h"

#include "bench/row.h"
#include "support/shapes.h"

namespace argil::bench {
namespace {

constexpr double kRadiusMm = 40.0;

void import_row(benchmark::State& state, const TriangleMesh& mesh, double voxel_mm) {
  RowResult row(state);
  for (auto _ : state) {
    auto imported = import_mesh(mesh, {.voxel_mm = voxel_mm});
    const ImportResult* result = value_or_fail(state, imported);
    if (result == nullptr) return;
    row.add(result->clay.hash());
  }
  row.show(std::to_string(mesh.triangles.size()) + " triangles");
}

/// The surface has 1.5 vertices a square voxel.
void import_to(benchmark::State& state, double vertices) {
  const double area = 4.0 * 3.14159265358979 * kRadiusMm * kRadiusMm;
  const double wanted = amount(0.02, 1.0) * vertices;
  import_row(state, test::ball_mesh(kRadiusMm, 6), std::sqrt(1.5 * area / wanted));
}

/// 2 097 152 triangles at 300 voxels; briefly 131 072 at 75.
void import_of_fine(benchmark::State& state) {
  const bool is_brief = amount(1.0, 0.0) > 0.5;
  import_row(state, test::ball_mesh(kRadiusMm, is_brief ? 7 : 9),
             2.0 * kRadiusMm / (is_brief ? 75.0 : 300.0));
}

BENCHMARK_CAPTURE(import_to, 100k, 0.1e6)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(import_to, 500k, 0.5e6)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(import_to, 2m, 2e6)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(import_of_fine)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace argil::bench
