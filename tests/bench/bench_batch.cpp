// SPDX-License-Identifier: GPL-3.0-or-later
// Rays and points by the array from C++, as bench_python.py asks for them, which gives the arrays
// and compares: what Python's calls cost beyond this is what Python costs. Prints us of CPU of the
// process for each ray and each point, and writes the distances that it found.
// Usage: bench_batch PROJECT.vdb RAYS POINTS OUT; RAYS: raw doubles, six a ray; POINTS: three each
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "argil/core/result.h"
#include "argil/core/vec3.h"
#include "argil/engine/clay.h"
#include "argil/engine/display_surface.h"
#include "argil/engine/field_sampler.h"
#include "argil/engine/surface_picker.h"
#include "argil/io/project_file.h"

#include "bench/clock.h"

namespace argil::bench {
namespace {

[[noreturn]] void stop(const std::string& message) {
  std::fprintf(stderr, "bench_batch: %s\n", message.c_str());
  std::exit(1);
}
template <class T>
T value_of(Result<T> result) {
  if (!result) stop(result.error().message);
  return std::move(result).value();
}

std::vector<Vec3> read_points(const char* file) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  if (!in) stop(std::string(file) + " cannot be read");
  std::vector<Vec3> points(static_cast<std::size_t>(in.tellg()) / sizeof(Vec3));
  in.seekg(0);
  in.read(reinterpret_cast<char*>(points.data()),
          static_cast<std::streamsize>(points.size() * sizeof(Vec3)));
  return points;
}

void append(std::ofstream& out, const std::vector<double>& numbers) {
  out.write(reinterpret_cast<const char*>(numbers.data()),
            static_cast<std::streamsize>(numbers.size() * sizeof(double)));
}

/// As a row of picks has them.
struct Picked {
  std::vector<double> distances;
  std::vector<Vec3> points;
  std::vector<Vec3> normals;
  std::vector<int> levels;
};

Picked pick_all(const DisplaySurface& surface, SurfacePicker& picker,
                const std::vector<Vec3>& rays) {
  const std::size_t count = rays.size() / 2;
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  Picked all{std::vector<double>(count), std::vector<Vec3>(count), std::vector<Vec3>(count),
             std::vector<int>(count)};
  for (std::size_t n = 0; n < count; ++n) {
    const auto pick = value_of(picker.pick(surface, {rays[2 * n], rays[2 * n + 1]}));
    all.distances[n] = pick ? pick->distance_mm : std::numeric_limits<double>::infinity();
    all.points[n] = pick ? pick->point_mm : Vec3{kNone, kNone, kNone};
    all.normals[n] = pick ? pick->normal : Vec3{kNone, kNone, kNone};
    all.levels[n] = pick ? pick->level : -1;
  }
  return all;
}

void run(char** files) {
  const Clay clay = value_of(io::load_project(files[0]));
  const std::vector<Vec3> rays = read_points(files[1]);
  const std::vector<Vec3> points = read_points(files[2]);
  DisplaySurface surface;
  value_of(surface.update(clay));
  SurfacePicker picker;
  if (auto updated = picker.update(surface); !updated) stop(updated.error().message);
  std::ofstream out(files[3], std::ios::binary);
  constexpr int kRounds = 7;
  for (int round = 0; round < kRounds; ++round) {
    double start = process_cpu_ms();
    const Picked picks = pick_all(surface, picker, rays);
    const double pick_us = 2e3 * (process_cpu_ms() - start) / static_cast<double>(rays.size());
    start = process_cpu_ms();
    FieldSampler sampler(clay);
    std::vector<double> distances(points.size());
    for (std::size_t n = 0; n < points.size(); ++n) distances[n] = sampler.distance_mm(points[n]);
    const double distance_us =
        1e3 * (process_cpu_ms() - start) / static_cast<double>(points.size());
    std::printf("%.6f %.6f\n", pick_us, distance_us);
    if (round > 0) continue;
    append(out, picks.distances);
    append(out, distances);
  }
}

}  // namespace
}  // namespace argil::bench

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fprintf(stderr, "usage: bench_batch PROJECT.vdb RAYS POINTS OUT\n");
    return 2;
  }
  argil::bench::run(argv + 1);
}
