// SPDX-License-Identifier: GPL-3.0-or-later
// What a window costs and what it does to the force, by the tool's radius: made of nothing, after a
// move of four nodes, after a dab as wide as the tool; and its force against that of the exact
// window. Times are of the thread's CPU, p50 / p99 in ms.
// Usage: bench_window [MODEL | --extremes]: that mesh, 100 mm large, with voxels of 0.25 mm; or
// what windows find hardest, a sheet of four voxels, the middle of a ball, where all of the surface
// is as near, and a tool as large as the piece; else a bumpy ball of 2 M vertices
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "argil/engine/import.h"
#include "argil/engine/window.h"
#include "argil/haptics/force/lattice_force.h"
#include "argil/io/prepared_mesh.h"

#include "bench/ball_session.h"
#include "bench/clock.h"
#include "bench/quantile.h"

namespace argil::bench {
namespace {

constexpr double kModelMm = 100.0;
constexpr int kPlaces = 40;
constexpr int kExactPlaces = 5;
constexpr int kMoves = 4;
constexpr int kDabs = 5;

Result<Clay> clay_of_model(const char* file) {
  io::MeshPreparation wanted;
  wanted.size_mm = kModelMm;
  auto prepared = io::read_prepared_mesh(file, wanted);
  if (!prepared) return prepared.error();
  ClayOptions options;
  options.voxel_mm = kVoxelMm;
  auto imported = import_mesh(prepared.value().mesh, options);
  if (!imported) return imported.error();
  return std::move(imported.value().clay);
}

struct Row {
  std::vector<double> fresh;  ///< of nothing that was kept
  std::vector<double> moved;
  std::vector<double> after_dab;
  std::vector<double> error_percent;
  int held = 0;  ///< forces whose error_n says no less than their error
};

/// A tool at places on a clay.
class Measurement {
 public:
  Measurement(Clay& clay, double radius_mm) : clay_(clay) {
    tool_.radii_mm = {radius_mm, radius_mm, radius_mm};
    lattice_ = haptics::choose_lattice(tool_);
  }

  Result<void> measure(const Vec3& place, const Vec3& normal, bool is_exact, Row& row) {
    const double radius = tool_.radii_mm.x;
    const Vec3 center = place + normal * (radius * height_(random_));
    double before = thread_cpu_ms();
    const auto window = read_window(clay_, request(center), Extension::layers);
    row.fresh.push_back(thread_cpu_ms() - before);
    if (!window) return window.error();
    if (is_exact) {
      if (auto done = compare(window.value(), center, row); !done) return done;
    }
    WindowPublisher publisher(channel_);
    if (auto done = publisher.publish(clay_, request(center)); !done) return done;
    const Vec3 aside = normalized(cross(normal, Vec3{0.3, 0.5, 0.8}));
    for (int n = 1; n <= kMoves; ++n) {
      before = thread_cpu_ms();
      const auto done =
          publisher.publish(clay_, request(center + aside * (4.0 * n * lattice_.voxel_mm)));
      row.moved.push_back(thread_cpu_ms() - before);
      if (!done) return done;
    }
    return work(place, normal, aside, publisher, row);
  }

 private:
  WindowRequest request(const Vec3& center) const {
    haptics::ForceTool tool = tool_;
    tool.position_mm = center;
    return {center, lattice_.voxel_mm, haptics::window_reach_mm(tool, lattice_, tool_.radii_mm.x),
            haptics::window_depth_mm(tool, {}, lattice_)};
  }

  Result<void> compare(const FieldWindow& window, const Vec3& center, Row& row) {
    const auto exact = read_window(clay_, request(center), Extension::exact);
    if (!exact) return exact.error();
    haptics::ForceTool tool = tool_;
    tool.position_mm = center;
    for (const double exponent : {1.0, 2.0, 4.0}) {
      haptics::ForceMaterial material;
      material.exponent = exponent;
      const haptics::LatticeForce force(tool, material, haptics::ForceLaw::energy,
                                        lattice_.voxel_mm);
      const auto felt = force.evaluate(window.view, tool);
      const Vec3 wanted = force.evaluate(exact.value().view, tool).contact_n;
      const double off = length(felt.contact_n - wanted);
      const double scale = std::max(length(wanted), 0.05 * material.surface_force_n);
      row.error_percent.push_back(100.0 * off / scale);
      row.held += off <= felt.error_n ? 1 : 0;
    }
    return {};
  }

  /// A short stroke of carving, taken back.
  Result<void> work(const Vec3& place, const Vec3& normal, const Vec3& aside,
                    WindowPublisher& publisher, Row& row) {
    const double radius = tool_.radii_mm.x;
    const Vec3 center = place + normal * (0.6 * radius);
    Tool tool;
    tool.radii_mm = tool_.radii_mm;
    if (auto done = publisher.publish(clay_, request(center)); !done) return done;
    if (auto begun = clay_.begin_stroke(tool); !begun) return begun;
    for (int n = 0; n <= kDabs; ++n) {
      const StrokeSample sample{0.01 * n, center + (0.1 * radius * n) * aside, {}, 1.0};
      const auto dabs = clay_.extend_stroke({&sample, 1});
      if (!dabs) return dabs.error();
      if (dabs.value() == 0) continue;
      const double before = thread_cpu_ms();
      const auto done = publisher.publish(clay_, request(center));
      row.after_dab.push_back(thread_cpu_ms() - before);
      if (!done) return done;
    }
    if (auto ended = clay_.end_stroke(); !ended) return ended.error();
    clay_.undo();
    return {};
  }

  Clay& clay_;
  haptics::ForceTool tool_;
  haptics::Lattice lattice_;
  WindowChannel channel_;
  std::mt19937 random_{3};
  std::uniform_real_distribution<double> height_{-1.0, 0.9};
};

void print(double radius_mm, const Row& row) {
  const auto pair = [](const std::vector<double>& ms) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f / %.2f", quantile(ms, 0.5), quantile(ms, 0.99));
    return std::string(text);
  };
  std::printf("| %g | %s | %s | %s | %.3f / %.3f | %d of %zu |\n", radius_mm,
              pair(row.fresh).c_str(), pair(row.moved).c_str(), pair(row.after_dab).c_str(),
              quantile(row.error_percent, 0.5), quantile(row.error_percent, 0.95), row.held,
              row.error_percent.size());
  std::fflush(stdout);
}

/// Where a tool is put: its centre up to R below the place and 0.9 R above it.
struct Station {
  Vec3 place;
  Vec3 normal;
};

std::vector<Station> stations_on(const Clay& clay) {
  Surface surface;
  surface.update(clay);
  const std::vector<Vec3> vertices = surface.weld().positions;
  std::mt19937 random(7);
  std::vector<Station> stations(kPlaces);
  for (Station& station : stations) {
    station.place = vertices[random() % vertices.size()];
    Vec3 slope;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Vec3 step;
      step[axis] = kVoxelMm;
      slope[axis] = clay.distance_at(station.place + step) - clay.distance_at(station.place - step);
    }
    station.normal = normalized(slope);
  }
  return stations;
}

Result<void> run(Clay& clay, const std::vector<Station>& stations,
                 const std::vector<double>& radii) {
  std::printf("| R, mm | fresh | moved 4 nodes | after a dab | error, %%: p50 / p95 | held |\n");
  std::printf("|---|---|---|---|---|---|\n");
  for (const double radius : radii) {
    Measurement measurement(clay, radius);
    Row row;
    for (std::size_t n = 0; n < stations.size(); ++n) {
      const auto done =
          measurement.measure(stations[n].place, stations[n].normal, n < kExactPlaces, row);
      if (!done) return done;
    }
    print(radius, row);
  }
  return {};
}

Result<void> run_extremes() {
  ClayOptions options;
  options.voxel_mm = kVoxelMm;
  const auto distance = [](const Vec3& p) {
    return std::max({std::abs(p.x) - 20.0, std::abs(p.y) - 20.0, std::abs(p.z) - 2.0 * kVoxelMm});
  };
  auto sheet = Clay::from_distance(distance, {{-21.0, -21.0, -2.0}, {21.0, 21.0, 2.0}}, options);
  if (!sheet) return sheet.error();
  std::printf("A sheet of four voxels:\n\n");
  auto done = run(sheet.value(), stations_on(sheet.value()), {1.0, 4.0, 16.0});
  if (!done) return done;
  constexpr double kBallMm = 12.0;
  auto ball = Clay::ball(kBallMm, options);
  if (!ball) return ball.error();
  std::printf("\nIn the middle of a ball of %g mm:\n\n", kBallMm);
  done = run(ball.value(), std::vector<Station>(kPlaces, {Vec3{}, {0.0, 0.0, 1.0}}), {1.0, 4.0});
  if (!done) return done;
  std::printf("\nA tool as large as the ball:\n\n");
  return run(ball.value(), stations_on(ball.value()), {kBallMm});
}

Result<void> run_clay(Result<Clay> clay) {
  if (!clay) return clay.error();
  return run(clay.value(), stations_on(clay.value()), {1.0, 1.3, 4.0, 5.2, 16.0, 32.0});
}

Result<void> run_ball() {
  auto ball = made_ball(2'000'000);
  if (!ball) return ball.error();
  return run_clay(std::move(ball.value().clay));
}

int main_of(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  const auto done = what == "--extremes" ? run_extremes()
                    : what.empty()       ? run_ball()
                                         : run_clay(clay_of_model(argv[1]));
  if (done) return 0;
  std::fprintf(stderr, "bench_window: %s\n", done.error().message.c_str());
  return 1;
}

}  // namespace
}  // namespace argil::bench

int main(int argc, char** argv) { return argil::bench::main_of(argc, argv); }
