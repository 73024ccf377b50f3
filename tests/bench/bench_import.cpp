// SPDX-License-Identifier: GPL-3.0-or-later
// What an import costs: bench_import MESH|ball VOXELS [SUBDIVISIONS [RUNS]]. A mesh from a file is
// closed first, as `argil import` does, and each triangle split into four SUBDIVISIONS times; a
// ball has 8 * 4^SUBDIVISIONS triangles. VOXELS along the longest side. Prints a markdown row: the
// medians of RUNS (3), the peak of the process, and a hash that changes only when the clay does.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include <sys/resource.h>

#include "argil/engine/import.h"
#include "argil/io/mesh_file.h"
#include "argil/mesh/close.h"

#include "bench/clock.h"
#include "support/models.h"
#include "support/shapes.h"

namespace {

using namespace argil;

constexpr double kSizeMm = 80.0;

TriangleMesh subdivided(const TriangleMesh& mesh) {
  TriangleMesh fine{mesh.positions, {}, {}};
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [at, fresh] =
        middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(fine.positions.size()));
    if (fresh) fine.positions.push_back((mesh.positions[a] + mesh.positions[b]) * 0.5);
    return at->second;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::uint32_t ab = middle(a, b);
    const std::uint32_t bc = middle(b, c);
    const std::uint32_t ca = middle(c, a);
    for (const Triangle& t : {Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) {
      fine.triangles.push_back(t);
    }
  }
  return fine;
}

Result<TriangleMesh> mesh_of(const std::string& name, int subdivisions) {
  if (name == "ball") return test::ball_mesh(0.5 * kSizeMm, subdivisions);
  const bool is_open = name.ends_with(":open");
  const auto found = test::find_model(is_open ? name.substr(0, name.size() - 5) : name);
  auto read = io::read_mesh(found ? *found : std::filesystem::path(name));
  if (!read) return read;
  TriangleMesh mesh = std::move(read).value();
  if (!is_open) {
    auto closed = mesh::close_mesh(mesh);
    if (!closed) return closed.error();
    mesh = std::move(closed).value().mesh;
  }
  mesh.normals.clear();
  const Vec3 size = bounds(mesh).size();
  for (Vec3& p : mesh.positions) p *= kSizeMm / std::max({size.x, size.y, size.z});
  for (int n = 0; n < subdivisions; ++n) mesh = subdivided(mesh);
  return mesh;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Wall seconds by stage, as the import reports them.
struct Stages {
  std::string stage;
  double since = 0.0;
  std::string text;

  void enter(const std::string& next) {
    const double now = 1e-3 * bench::wall_ms();
    char part[64];
    if (!stage.empty()) {
      std::snprintf(part, sizeof part, " %s %.2f", stage.c_str(), now - since);
      text += part;
    }
    stage = next;
    since = now;
  }
};

int run(const std::string& name, double voxels, int subdivisions, int runs) {
  const auto mesh = mesh_of(name, subdivisions);
  if (!mesh) {
    std::fprintf(stderr, "%s\n", mesh.error().message.c_str());
    return 1;
  }
  std::vector<double> cpu;
  std::vector<double> wall;
  std::string stages;
  rusage before{};
  getrusage(RUSAGE_SELF, &before);
  for (int n = 0; n < runs; ++n) {
    Stages told;
    const double cpu_start = 1e-3 * bench::process_cpu_ms();
    const double wall_start = 1e-3 * bench::wall_ms();
    auto imported = import_mesh(mesh.value(), {.voxel_mm = kSizeMm / voxels},
                                [&](std::string_view stage, double) {
                                  if (stage != told.stage) told.enter(std::string(stage));
                                  return true;
                                });
    wall.push_back(1e-3 * bench::wall_ms() - wall_start);
    cpu.push_back(1e-3 * bench::process_cpu_ms() - cpu_start);
    if (!imported) {
      std::fprintf(stderr, "%s\n", imported.error().message.c_str());
      return 1;
    }
    told.enter("");
    stages = told.text;
    if (n + 1 < runs) continue;
    rusage after{};
    getrusage(RUSAGE_SELF, &after);
    std::int64_t bytes = 0;
    std::int64_t leaves = 0;
    const Clay& clay = imported.value().clay;
    for (const LevelStats& level : clay.level_stats()) {
      bytes += level.bytes;
      leaves += level.leaves;
    }
    std::printf("| %s | %zu | %.0f | %.2f | %.2f | %lld | %.0f | %ld | %016llx |%s\n", name.c_str(),
                mesh.value().triangles.size(), voxels, median(cpu), median(wall),
                static_cast<long long>(leaves), 1e-6 * static_cast<double>(bytes),
                (after.ru_maxrss - before.ru_maxrss) / 1000,
                static_cast<unsigned long long>(clay.hash()), stages.c_str());
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 3) {
    std::fputs("usage: bench_import MESH|ball VOXELS [SUBDIVISIONS [RUNS]]\n", stderr);
    return 2;
  }
  return run(arguments[1], std::atof(arguments[2]), count > 3 ? std::atoi(arguments[3]) : 0,
             count > 4 ? std::atoi(arguments[4]) : 3);
}
