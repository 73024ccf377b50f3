// SPDX-License-Identifier: GPL-3.0-or-later
// What a pick costs in three arrangements: the walk through the field, cubes of 64^3 nodes over the
// drawn surface (SurfacePicker), and a scene of all triangles that is built from nothing. After
// each dab of a stroke: bringing the cubes up to date, the first pick, each more; then 10 000 rays
// at once. Balls of 0.5 and 2 million surface vertices; tools that cover 1 000, 10 000 and 50 000
// of them. Prints markdown tables; CPU of one thread, medians, unless they say otherwise.
// Usage: bench_pick [--large]; with it also 8 million vertices, which take some 6 GB
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "argil/core/hash.h"
#include "argil/engine/surface.h"
#include "argil/engine/surface_picker.h"

#include "bench/ball_session.h"
#include "bench/clock.h"
#include "bench/quantile.h"
#include "raycast/ray_scene.h"

namespace argil::bench {
namespace {

constexpr double kSpacing = 0.25;
constexpr int kStrokes = 5;
constexpr int kDabs = 24;  ///< of each
constexpr int kRays = 16;  ///< after the first of a dab
constexpr int kBundle = 10'000;

[[noreturn]] void stop(const Error& error) {
  std::fprintf(stderr, "bench_pick: %s\n", error.message.c_str());
  std::exit(1);
}
template <class T>
T value_of(Result<T> result) {
  if (!result) stop(result.error());
  return std::move(result).value();
}
void check(const Result<void>& result) {
  if (!result) stop(result.error());
}

/// µs of this thread.
template <class Do>
double timed_us(const Do& act) {
  const double start = thread_cpu_ms();
  act();
  return 1e3 * (thread_cpu_ms() - start);
}

/// Answers of one arrangement: the distance, or nothing.
using Caster = std::function<std::optional<double>(const Ray&)>;

std::optional<double> distance_of(Result<std::optional<Pick>> picked) {
  const std::optional<Pick> found = value_of(std::move(picked));
  return found ? std::optional(found->distance_mm) : std::nullopt;
}

/// A ball, its drawn surface and what picks on them.
struct Scene {
  Clay clay;
  double radius_mm;
  DisplaySurface surface;
  SurfacePicker picker;

  Caster walk() {
    return [this](const Ray& ray) { return distance_of(pick(clay, ray)); };
  }
  Caster cubes() {
    return [this](const Ray& ray) { return distance_of(picker.pick(surface, ray)); };
  }
};

/// First and further picks after the dabs of a row.
struct PickTimes {
  std::vector<double> first_us;
  std::vector<double> more_us;
  int hits = 0;

  void add(const Caster& cast, const StrokeSample& sample, const Tool& tool) {
    const auto shoot = [&](int n) {
      hits += cast(ray_over_dab(sample, tool, n, kRays)).has_value() ? 1 : 0;
    };
    first_us.push_back(timed_us([&] { shoot(0); }));
    const double more = timed_us([&] {
      for (int n = 1; n <= kRays; ++n) shoot(n);
    });
    more_us.push_back(more / kRays);
  }
};

struct Row {
  std::vector<double> update_us;
  PickTimes cubes;
  PickTimes walk;
};

Row measure(Scene& scene, const Tool& tool) {
  Row row;
  for (int stroke = 0; stroke < kStrokes; ++stroke) {
    check(scene.clay.begin_stroke(tool, {.spacing = kSpacing}));
    for (const StrokeSample& sample :
         wandering_samples(start_of_stroke(stroke), tool, kSpacing, scene.radius_mm, kDabs)) {
      value_of(scene.clay.extend_stroke({&sample, 1}));
      value_of(scene.surface.update(scene.clay));
      row.update_us.push_back(timed_us([&] { check(scene.picker.update(scene.surface)); }));
      row.cubes.add(scene.cubes(), sample, tool);
      row.walk.add(scene.walk(), sample, tool);
    }
    value_of(scene.clay.end_stroke());
    scene.clay.undo();
    value_of(scene.surface.update(scene.clay));
    check(scene.picker.update(scene.surface));
  }
  return row;
}

/// From which pick of a dab on the cubes have cost less than the walk; 0: never.
int crossing(const Row& row) {
  const double ahead = quantile(row.update_us, 0.5) + quantile(row.cubes.first_us, 0.5) -
                       quantile(row.walk.first_us, 0.5);
  const double gain = quantile(row.walk.more_us, 0.5) - quantile(row.cubes.more_us, 0.5);
  if (ahead <= 0.0) return 1;
  return gain <= 0.0 ? 0 : 1 + static_cast<int>(std::ceil(ahead / gain));
}

void print(const Row& row, int covered) {
  const auto cell = [](const std::vector<double>& us) {
    std::printf("| %.1f (%.0f) ", quantile(us, 0.5), quantile(us, 0.99));
  };
  std::printf("| %d ", covered);
  cell(row.update_us);
  cell(row.cubes.first_us);
  std::printf("| %.2f ", quantile(row.cubes.more_us, 0.5));
  cell(row.walk.first_us);
  std::printf("| %.2f | %d | %d, %d |\n", quantile(row.walk.more_us, 0.5), crossing(row),
              row.cubes.hits, row.walk.hits);
  std::fflush(stdout);
}

// ---- many rays at once --------------------------------------------------------------------------

/// A picture's: a square of parallel rays over the middle of the ball.
std::vector<Ray> coherent_rays(double radius_mm) {
  std::vector<Ray> rays;
  const int side = static_cast<int>(std::sqrt(kBundle));
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const double x = radius_mm * (1.2 * i / side - 0.6);
      const double y = radius_mm * (1.2 * j / side - 0.6);
      rays.push_back({{x, y, 3.0 * radius_mm}, {0.01, 0.02, -1.0}});
    }
  }
  return rays;
}

/// From all around, at points within the ball.
std::vector<Ray> scattered_rays(double radius_mm) {
  std::vector<Ray> rays;
  for (int i = 0; i < kBundle; ++i) {
    const Vec3 from = 3.0 * radius_mm * normalized(start_of_stroke(i));
    const Vec3 at = 0.9 * radius_mm * normalized(start_of_stroke(7 * i + 3));
    rays.push_back({from, at - from});
  }
  return rays;
}

/// Returns what a coherent ray costs, in us.
double print_bundle(const char* name, const Caster& cast, double radius_mm) {
  std::printf("| %s ", name);
  Hash64 hash;
  std::vector<double> each_us;
  for (const auto& rays : {coherent_rays(radius_mm), scattered_rays(radius_mm)}) {
    std::vector<double> distances(rays.size());
    const double us = timed_us([&] {
      for (std::size_t i = 0; i < rays.size(); ++i) distances[i] = cast(rays[i]).value_or(-1.0);
    });
    hash.update(std::as_bytes(std::span(distances)));
    each_us.push_back(us / static_cast<double>(rays.size()));
    std::printf("| %.2f ", each_us.back());
  }
  std::printf("| `%016llx` |\n", static_cast<unsigned long long>(hash.digest()));
  std::fflush(stdout);
  return each_us.front();
}

struct Built {
  double cpu_ms;  ///< of all threads
  double wall_ms;
};
template <class Do>
Built timed(const Do& act) {
  const double wall = wall_ms();
  const double cpu = process_cpu_ms();
  act();
  return {process_cpu_ms() - cpu, wall_ms() - wall};
}

void compare_bundles(Scene& scene) {
  TriangleMesh mesh;
  const Built extracted = timed([&] { mesh = extract_surface(scene.clay); });
  std::optional<RayScene> triangles;
  const Built built = timed([&] { triangles.emplace(value_of(RayScene::build(mesh))); });
  SurfacePicker picker;
  const Built cubes = timed([&] {
    check(picker.update(scene.surface));
    value_of(picker.pick(scene.surface, coherent_rays(scene.radius_mm)[0]));
  });
  const SurfacePickerStats stats = picker.stats();
  std::printf(
      "\nFrom nothing, ms of CPU of all threads (wall): cubes %.1f (%.1f), %lld of them, %.2f "
      "bytes "
      "a vertex; triangles %.0f (%.0f), after %.0f (%.0f) to extract them.\n\n"
      "| 10 000 rays, us each | coherent | scattered | hash |\n|---|---|---|---|\n",
      cubes.cpu_ms, cubes.wall_ms, static_cast<long long>(stats.cubes),
      static_cast<double>(stats.bytes) / static_cast<double>(scene.surface.stats().vertices),
      built.cpu_ms, built.wall_ms, extracted.cpu_ms, extracted.wall_ms);
  print_bundle("walk", scene.walk(), scene.radius_mm);
  const double of_cubes_us = print_bundle("cubes", scene.cubes(), scene.radius_mm);
  const Caster cast = [&](const Ray& ray) -> std::optional<double> {
    const auto hit = triangles->closest(ray.origin_mm, normalized(ray.direction));
    return hit ? std::optional(hit->distance) : std::nullopt;
  };
  const double of_triangles_us = print_bundle("triangles", cast, scene.radius_mm);
  const double ahead_us = 1e3 * (extracted.cpu_ms + built.cpu_ms - cubes.cpu_ms);
  std::printf("\nFrom nothing, triangles cost less than cubes from %.0f coherent rays on.\n",
              ahead_us / (of_cubes_us - of_triangles_us));
}

void run(std::int64_t vertices) {
  const double area = static_cast<double>(vertices) / kVerticesPerSquareVoxel;
  const double radius_mm = kVoxelMm * std::sqrt(area / (4.0 * std::numbers::pi));
  Scene scene{value_of(test::bumpy_ball(radius_mm, kVoxelMm)), radius_mm, {}, {}};
  value_of(scene.surface.update(scene.clay));
  check(scene.picker.update(scene.surface));
  std::printf(
      "\nBall of %.1f M vertices, %.2f M in its blocks, which share those on their borders; us, "
      "median (99th percentile) of %d dabs.\n\n"
      "| covered | cubes: update | first pick | each more | walk: first pick | each more | cubes "
      "cost less from pick | hits |\n|---|---|---|---|---|---|---|---|\n",
      1e-6 * static_cast<double>(vertices),
      1e-6 * static_cast<double>(scene.surface.stats().vertices), kStrokes * kDabs);
  for (const int covered : {1'000, 10'000, 50'000}) {
    print(measure(scene, tool_covering(covered, Action::carve, radius_mm)), covered);
  }
  compare_bundles(scene);
}

}  // namespace
}  // namespace argil::bench

int main(int argc, char** argv) {
  const bool is_large = argc == 2 && std::string_view(argv[1]) == "--large";
  if (argc > 2 || (argc == 2 && !is_large)) {
    std::fprintf(stderr, "usage: bench_pick [--large]\n");
    return 2;
  }
  argil::bench::run(500'000);
  argil::bench::run(2'000'000);
  if (is_large) argil::bench::run(8'000'000);
}
