// SPDX-License-Identifier: GPL-3.0-or-later
// Which way closes an open mesh best: CGAL's alpha wrapping, or the importer's winding number?
// Usage: bench_closing [MESH...]; without arguments the shared bunny and teapot. Prints the table
// of docs/import.md.
#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>

#include "argil/engine/import.h"
#include "argil/engine/mesh_distance.h"
#include "argil/engine/surface.h"
#include "argil/io/mesh_file.h"
#include "argil/mesh/close.h"

#include "support/models.h"

namespace {

using argil::TriangleMesh;
using argil::Vec3;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

constexpr double kSizeMm = 80.0;
constexpr double kVoxelMm = 0.25;

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

TriangleMesh wrapped(const TriangleMesh& mesh, double alpha_mm) {
  std::vector<Kernel::Point_3> points;
  for (const Vec3& p : mesh.positions) points.emplace_back(p.x, p.y, p.z);
  std::vector<std::array<std::size_t, 3>> faces;
  for (const auto& t : mesh.triangles) faces.push_back({t[0], t[1], t[2]});
  CGAL::Surface_mesh<Kernel::Point_3> wrap;
  CGAL::alpha_wrap_3(points, faces, alpha_mm, alpha_mm / 10.0, wrap);
  TriangleMesh out;
  for (const auto v : wrap.vertices()) {
    const auto& p = wrap.point(v);
    out.positions.push_back({p.x(), p.y(), p.z()});
  }
  for (const auto f : wrap.faces()) {
    argil::Triangle t{};
    std::size_t i = 0;
    for (const auto v : wrap.vertices_around_face(wrap.halfedge(f))) {
      t[i++] = static_cast<std::uint32_t>(v.idx());
    }
    out.triangles.push_back(t);
  }
  return out;
}

void print_row(const char* model, const char* method, double seconds, const TriangleMesh& input,
               const TriangleMesh& surface) {
  const argil::MeshDistance distance(surface.positions, surface.triangles);
  std::vector<double> voxels;
  std::vector<char> used(input.positions.size());
  for (const auto& t : input.triangles) {
    for (const auto v : t) used[v] = 1;
  }
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (used[v] != 0) {
      voxels.push_back(distance.closest(input.positions[v], kSizeMm).distance / kVoxelMm);
    }
  }
  std::sort(voxels.begin(), voxels.end());
  std::printf("| %s | %s | %.1f | %zu | %.0f | %.3f | %.3f | %.3f |\n", model, method, seconds,
              surface.triangles.size(), signed_volume(surface), voxels[voxels.size() / 2],
              voxels[voxels.size() * 99 / 100], voxels.back());
  std::fflush(stdout);
}

void print_ours(const char* model, const char* method, const TriangleMesh& input, bool fill) {
  const double start = cpu_seconds();
  TriangleMesh mesh = input;
  if (fill) {
    auto closed = argil::mesh::close_mesh(input);
    if (!closed) return static_cast<void>(std::puts(closed.error().message.c_str()));
    mesh = std::move(closed).value().mesh;
  }
  auto imported = argil::import_mesh(mesh, {kVoxelMm, 0.1});
  if (!imported) return static_cast<void>(std::puts(imported.error().message.c_str()));
  const TriangleMesh surface = argil::extract_surface(imported.value().clay);
  print_row(model, method, cpu_seconds() - start, input, surface);
}

int compare(const std::filesystem::path& file) {
  auto read = argil::io::read_mesh(file);
  if (!read) {
    std::fprintf(stderr, "%s\n", read.error().message.c_str());
    return 1;
  }
  TriangleMesh input = std::move(read).value();
  const Vec3 size = bounds(input).size();
  const double scale = kSizeMm / std::max({size.x, size.y, size.z});
  for (Vec3& p : input.positions) p *= scale;
  const std::string model = file.stem().string();
  for (const int alpha : {2, 3, 5}) {
    const double start = cpu_seconds();
    const TriangleMesh wrap = wrapped(input, alpha * kVoxelMm);
    const std::string method = "alpha wrap, " + std::to_string(alpha) + " voxels";
    print_row(model.c_str(), method.c_str(), cpu_seconds() - start, input, wrap);
  }
  print_ours(model.c_str(), "winding number", input, false);
  print_ours(model.c_str(), "holes filled, then winding number", input, true);
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  std::vector<std::filesystem::path> files(arguments + 1, arguments + count);
  if (files.empty()) {
    files = {argil::test::shared_models() / "teapot.obj",
             argil::test::shared_models() / "stanford-bunny.obj"};
  }
  std::puts("| model | closed by | CPU s | triangles | mm3 | p50 | p99 | max (voxels) |");
  std::puts("|---|---|---|---|---|---|---|---|");
  int status = 0;
  for (const auto& file : files) status |= compare(file);
  return status;
}
