// SPDX-License-Identifier: GPL-3.0-or-later
// What fewer triangles cost and how good they are: a model made clay, to a share of its triangles
// or within a bound. Prints a line a run with a hash of the result, so that two builds can be run
// in turn. MODEL is a file or `ball`, one with bumps. Usage: bench_decimate MODEL SIZE_MM VOXEL_MM
// within|to AMOUNT [runs [--error]]; AMOUNT is mm or a share of the triangles, SIZE_MM the longest
// side; --error measures the result as well
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "argil/engine/import.h"
#include "argil/engine/surface.h"
#include "argil/io/decimate.h"
#include "argil/io/measure_error.h"
#include "argil/io/mesh_file.h"
#include "argil/mesh/close.h"

#include "bench/clock.h"
#include "bench/row.h"
#include "support/bumpy_clay.h"

namespace argil::bench {
namespace {

template <class T>
T value_or_exit(Result<T> result) {
  if (result) return std::move(result).value();
  std::fprintf(stderr, "bench_decimate: %s\n", result.error().message.c_str());
  std::exit(1);
}

Clay clay_of_model(const char* file, double size_mm, double voxel_mm) {
  if (std::string_view(file) == "ball") {
    return value_or_exit(test::bumpy_ball(0.5 * size_mm, voxel_mm));
  }
  TriangleMesh mesh = value_or_exit(mesh::close_mesh(value_or_exit(io::read_mesh(file)))).mesh;
  const Vec3 size = bounds(mesh).size();
  for (Vec3& p : mesh.positions) p *= size_mm / std::max({size.x, size.y, size.z});
  ClayOptions options;
  options.voxel_mm = voxel_mm;
  return std::move(value_or_exit(import_mesh(mesh, options)).clay);
}

void print_error(const TriangleMesh& mesh, const TriangleMesh& surface, const Clay& clay) {
  const mesh::MeshError error = value_or_exit(io::measure_error(mesh, surface, clay));
  std::printf("error mm: mesh to clay rms %.5f most %.5f, clay to mesh rms %.5f most %.5f\n",
              error.mesh_to_field.rms_mm, error.mesh_to_field.max_mm, error.field_to_mesh.rms_mm,
              error.field_to_mesh.max_mm);
}

int run(int argc, char** argv) {
  const Clay clay = clay_of_model(argv[1], std::atof(argv[2]), std::atof(argv[3]));
  TriangleMesh surface = extract_surface(clay);
  surface.normals.clear();
  mesh::DecimateOptions options;
  const double amount = std::atof(argv[5]);
  const bool is_within = std::string_view(argv[4]) == "within";
  if (is_within) options.max_error_mm = amount;
  if (!is_within) {
    options.triangles = std::llround(amount * static_cast<double>(surface.triangles.size()));
  }
  std::printf("%zu triangles\n", surface.triangles.size());
  for (int n = argc > 6 ? std::atoi(argv[6]) : 1; n > 0; --n) {
    const double cpu_ms = process_cpu_ms();
    const double start_ms = wall_ms();
    const mesh::Decimated fewer = value_or_exit(io::decimate(surface, clay, options));
    std::printf("%.3f CPU s, %.3f wall s, %zu triangles, hash %016llx\n",
                1e-3 * (process_cpu_ms() - cpu_ms), 1e-3 * (wall_ms() - start_ms),
                fewer.mesh.triangles.size(), static_cast<unsigned long long>(hash_of(fewer.mesh)));
    std::fflush(stdout);
    if (argc > 7 && n == 1) print_error(fewer.mesh, surface, clay);
  }
  return 0;
}

}  // namespace
}  // namespace argil::bench

int main(int argc, char** argv) {
  if (argc < 6) {
    std::fprintf(stderr,
                 "usage: bench_decimate MODEL SIZE_MM VOXEL_MM within|to AMOUNT [runs "
                 "[--error]]\n");
    return 2;
  }
  return argil::bench::run(argc, argv);
}
