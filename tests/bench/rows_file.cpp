// SPDX-License-Identifier: GPL-3.0-or-later
// A mesh on its way in and out. The mesh is a bumpy ball made here, so that the row needs no file.
#include <filesystem>
#include <sstream>

#include "argil/engine/import.h"
#include "argil/engine/surface.h"
#include "argil/io/export.h"

#include "bench/row.h"

namespace argil::bench {
namespace {

/// A clay ball of 40 mm radius with bumps and pits, at `voxel_mm`.
Result<Clay> bumpy_ball(double voxel_mm) {
  ClayOptions options;
  options.voxel_mm = voxel_mm;
  auto clay = Clay::ball(40.0, options);
  if (!clay) return clay;
  for (int i = 0; i < 24; ++i) {
    Stroke stroke = dab_on_top(4.0, i % 2 == 0 ? Action::add : Action::carve);
    // Points spread over the sphere by integer steps, so that no library function decides them.
    const Vec3 toward{(i * 7) % 11 - 5.0, (i * 5) % 13 - 6.0, (i * 3) % 7 - 3.0};
    stroke.samples[0].position_mm = 40.0 * normalized(toward);
    auto applied = clay.value().apply(stroke);
    if (!applied) return applied.error();
  }
  return clay;
}

void import_closed(benchmark::State& state) {
  auto made = bumpy_ball(amount(2.0, 0.5));
  const Clay* source = value_or_fail(state, made);
  if (source == nullptr) return;
  const TriangleMesh mesh = extract_surface(*source);
  ClayOptions options;
  options.voxel_mm = amount(1.0, 0.25);
  RowResult row(state);
  for (auto _ : state) {
    auto imported = import_mesh(mesh, options);
    state.PauseTiming();
    const ImportResult* got = value_or_fail(state, imported);
    if (got == nullptr) break;
    row.add(got->clay.hash());
    state.ResumeTiming();
  }
  std::ostringstream size;
  size << mesh.triangles.size() << " triangles to " << options.voxel_mm << " mm";
  row.show(size.str());
}

void export_checked(benchmark::State& state, const char* ending) {
  auto made = bumpy_ball(amount(1.0, 0.25));
  const Clay* clay = value_or_fail(state, made);
  if (clay == nullptr) return;
  const auto file = std::filesystem::temp_directory_path() / (std::string("argil_bench") + ending);
  RowResult row(state);
  std::int64_t triangles = 0;
  for (auto _ : state) {
    auto exported = io::export_mesh(file, *clay);
    state.PauseTiming();
    const io::ExportReport* report = value_or_fail(state, exported);
    if (report == nullptr) break;
    if (!report->verdict.printable) state.SkipWithError("the exported mesh is not printable");
    triangles = report->triangles;
    Hash64 hash;
    hash.update(std::as_bytes(std::span(&report->verdict.volume_mm3, 1)));
    hash.update(std::as_bytes(std::span(&report->triangles, 1)));
    row.add(hash.digest());
    state.ResumeTiming();
  }
  std::filesystem::remove(file);
  row.show(std::to_string(triangles) + " triangles");
}

BENCHMARK(import_closed)->UseRealTime();
BENCHMARK_CAPTURE(export_checked, stl, ".stl")->UseRealTime();
BENCHMARK_CAPTURE(export_checked, 3mf, ".3mf")->UseRealTime();

}  // namespace
}  // namespace argil::bench
