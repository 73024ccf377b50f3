// SPDX-License-Identifier: GPL-3.0-or-later
// What a million triangles cost on their way to a printer: the verdict, decimation to a tenth, its
// certificate. Prints a markdown table with the error beside the time.
// Usage: bench_printing [triangles]; default 1 million, a minute
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <utility>
#include <vector>

#include "argil/engine/surface.h"
#include "argil/io/decimate.h"
#include "argil/io/measure_error.h"
#include "argil/mesh/check.h"

#include "bench/clock.h"
#include "bench/quantile.h"
#include "support/bumpy_clay.h"

namespace argil::bench {
namespace {

constexpr double kVoxelMm = 0.25;
/// Of the surface of a ball, per voxel^2 (bench_session has half of it, vertices).
constexpr double kTrianglesPerSquareVoxel = 3.0;
constexpr int kRuns = 3;

template <class T>
T value_of(Result<T> result) {
  if (result) return std::move(result).value();
  std::fprintf(stderr, "bench_printing: %s\n", result.error().message.c_str());
  std::exit(1);
}

/// The median CPU time of all threads, in seconds.
template <class Act>
double seconds(const Act& act) {
  std::vector<double> times;
  for (int n = 0; n < kRuns; ++n) {
    const double start = process_cpu_ms();
    act();
    times.push_back(1e-3 * (process_cpu_ms() - start));
  }
  return quantile(times, 0.5);
}

void run(double triangles) {
  const double area = triangles / kTrianglesPerSquareVoxel;
  const double radius = kVoxelMm * std::sqrt(area / (4.0 * std::numbers::pi));
  const Clay clay = value_of(test::bumpy_ball(radius, kVoxelMm));
  const TriangleMesh surface = extract_surface(clay);
  const auto count = static_cast<std::int64_t>(surface.triangles.size());
  std::printf(
      "| what | triangles | CPU s | s per million | mesh to clay, voxels: mean (most) | "
      "clay to mesh |\n|---|---|---|---|---|---|\n");
  const auto row = [&](const char* what, std::int64_t left, double s) {
    std::printf("| %s | %lld | %.2f | %.2f |", what, static_cast<long long>(left), s,
                1e6 * s / static_cast<double>(count));
    std::fflush(stdout);
  };
  mesh::MeshVerdict verdict;
  row("verdict", count, seconds([&] { verdict = mesh::check_mesh(surface); }));
  std::printf(" %s | |\n", verdict.printable ? "printable" : "NOT printable");
  row("verdict with walls of 1 mm", count,
      seconds([&] { verdict = mesh::check_mesh(surface, 1.0); }));
  std::printf(" %s | |\n", verdict.printable ? "printable" : "NOT printable");
  mesh::Decimated tenth;
  row("decimation to a tenth", count / 10,
      seconds([&] { tenth = value_of(io::decimate(surface, clay, {.triangles = count / 10})); }));
  std::printf(" | |\n");
  mesh::MeshError error;
  row("its certificate", static_cast<std::int64_t>(tenth.mesh.triangles.size()),
      seconds([&] { error = value_of(io::measure_error(tenth.mesh, surface, clay)); }));
  const auto& there = error.mesh_to_field;
  const auto& back = error.field_to_mesh;
  std::printf(" %.4f (%.3f) | %.4f (%.3f) |\n", there.mean_mm / kVoxelMm, there.max_mm / kVoxelMm,
              back.mean_mm / kVoxelMm, back.max_mm / kVoxelMm);
}

}  // namespace
}  // namespace argil::bench

int main(int argc, char** argv) {
  argil::bench::run(argc > 1 ? std::atof(argv[1]) : 1e6);
  return 0;
}
