// SPDX-License-Identifier: GPL-3.0-or-later
// Mesh files: judging a mesh, fewer triangles, writing it, and the whole export of a clay.
#include <filesystem>

#include <unistd.h>

#include "argil/engine/surface.h"
#include "argil/io/decimate.h"
#include "argil/io/export.h"
#include "argil/io/mesh_file.h"
#include "argil/mesh/check.h"

#include "bench/row.h"
#include "support/bumpy_clay.h"

namespace argil::bench {
namespace {

/// A file of this process in the temporary folder, removed at the end.
class BenchFile {
 public:
  explicit BenchFile(const std::string& ending)
      : path_(std::filesystem::temp_directory_path() /
              ("argil-bench-" + std::to_string(::getpid()) + ending)) {}
  ~BenchFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  BenchFile(const BenchFile&) = delete;
  BenchFile& operator=(const BenchFile&) = delete;
  const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
};

std::string triangles(std::size_t count) { return std::to_string(count) + " triangles"; }

void mesh_check(benchmark::State& state) {
  auto made = ball_to_edit();
  const Clay* clay = value_or_fail(state, made);
  if (clay == nullptr) return;
  const TriangleMesh mesh = extract_surface(*clay);
  RowResult row(state);
  for (auto _ : state) {
    const mesh::MeshVerdict verdict = mesh::check_mesh(mesh);
    if (!verdict.printable) state.SkipWithError("the surface is not printable");
    Hash64 hash;
    hash.update(std::as_bytes(std::span(&verdict.volume_mm3, 1)));
    row.add(hash.digest());
  }
  row.show(triangles(mesh.triangles.size()));
}

void mesh_write(benchmark::State& state, const std::string& ending) {
  auto made = ball_to_edit();
  const Clay* clay = value_or_fail(state, made);
  if (clay == nullptr) return;
  const TriangleMesh mesh = extract_surface(*clay);
  const BenchFile file(ending);
  for (auto _ : state) {
    if (!io::write_mesh(file.path(), mesh)) state.SkipWithError("not written");
  }
  auto read = io::read_mesh(file.path());
  const TriangleMesh* back = value_or_fail(state, read);
  if (back == nullptr) return;
  RowResult row(state);
  row.add(hash_of(*back));
  row.show(triangles(mesh.triangles.size()));
}

void mesh_export(benchmark::State& state) {
  auto made = ball_to_edit();
  const Clay* clay = value_or_fail(state, made);
  if (clay == nullptr) return;
  const BenchFile file(".3mf");
  RowResult row(state);
  std::int64_t count = 0;
  for (auto _ : state) {
    auto exported = io::export_mesh(file.path(), *clay);
    const io::ExportReport* report = value_or_fail(state, exported);
    if (report == nullptr) return;
    count = report->triangles;
    Hash64 hash;
    hash.update(std::as_bytes(std::span(&report->rms_error_mm, 1)));
    row.add(hash.digest());
  }
  row.show(triangles(static_cast<std::size_t>(count)));
}

/// A surface with detail everywhere, to a tenth of its triangles or within a voxel.
void mesh_decimate(benchmark::State& state, bool to_count) {
  auto made = test::bumpy_ball(amount(10.0, 46.0), 0.25);
  const Clay* clay = value_or_fail(state, made);
  if (clay == nullptr) return;
  TriangleMesh surface = extract_surface(*clay);
  surface.normals.clear();
  mesh::DecimateOptions options;
  if (to_count) options.triangles = static_cast<std::int64_t>(surface.triangles.size() / 10);
  if (!to_count) options.max_error_mm = 0.25;
  RowResult row(state);
  for (auto _ : state) {
    auto decimated = io::decimate(surface, *clay, options);
    const mesh::Decimated* fewer = value_or_fail(state, decimated);
    if (fewer == nullptr) return;
    row.add(hash_of(fewer->mesh));
  }
  row.show(triangles(surface.triangles.size()));
}

BENCHMARK(mesh_check)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(mesh_write, threemf, ".3mf")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(mesh_write, stl, ".stl")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(mesh_decimate, tenth, true)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(mesh_decimate, within, false)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(mesh_export)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace argil::bench
