// SPDX-License-Identifier: GPL-3.0-or-later
// What one dab of a sculpting session costs with everything that belongs to it: the edit of all
// levels, the undo record and the surface with its normals; and, beside it, what picking costs
// after it. Rows: balls of 0.5, 2 and 8 million surface vertices, tools that cover 1 000, 10 000
// and 50 000 of them. Prints a markdown table; all figures are counters of the rows
// (--benchmark_out=FILE keeps them as JSON). Usage: bench_session [Google Benchmark's options]; the
// largest ball takes some 4 GB.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <tbb/parallel_for.h>

#include "argil/engine/pick.h"

#include "bench/ball_session.h"
#include "bench/clock.h"
#include "bench/hand.h"
#include "bench/quantile.h"
#include "bench/row.h"
#include "clay/clay_access.h"

namespace argil::bench {
namespace {

// Notation: V vertices of the whole ball, N of them under a tool, B the ball's radius, R the
// tool's.

constexpr double kSpacing = 0.25;
/// Of a row; with fewer than 100 dabs the 99th percentile is the slowest one.
struct Length {
  int strokes;
  int dabs;  ///< of each stroke
};
constexpr Length kLength{5, 20};
constexpr int kRays = 16;                                     ///< further picks after that of a dab
constexpr double kLeafBytes = 512 * sizeof(float) + 512 / 8;  // values and the active mask
/// A vertex with its normal and key, and its share of the triangles (two for each vertex).
constexpr double kVertexBytes = 2 * sizeof(Vec3) + 8 + 2 * sizeof(Triangle);

struct Target {
  int vertices;
  double median_ms;
};
constexpr std::array<Target, 3> kTargets{{{1'000, 0.25}, {10'000, 0.9}, {50'000, 4.5}}};

/// The best of five copies of 256 MB with all cores, counting what is read and what is written.
double bytes_per_ms() {
  constexpr std::size_t kSize = std::size_t{256} << 20;
  constexpr std::size_t kPieces = 64;
  static const double measured = [] {
    std::vector<char> from(kSize, 1);
    std::vector<char> to(kSize, 2);
    double best = 0.0;
    for (int run = 0; run < 5; ++run) {
      const double start = bench::wall_ms();
      tbb::parallel_for(std::size_t{0}, kPieces, [&](std::size_t n) {
        const std::size_t piece = kSize / kPieces;
        std::memcpy(to.data() + n * piece, from.data() + n * piece, piece);
      });
      benchmark::DoNotOptimize(to.data());
      best = std::max(best, 2.0 * static_cast<double>(kSize) / (bench::wall_ms() - start));
    }
    return best;
  }();
  return measured;
}

/// The edges that dabs leave: as the clay's voxels want them, or sharp.
enum class Edges { usual, sharp };

/// The ball with about this many vertices; made once, and only one kept at a time.
Ball* ball_of(benchmark::State& state, std::int64_t vertices, Edges edges) {
  static std::int64_t kept_size = 0;
  static Edges kept_edges = Edges::usual;
  static std::unique_ptr<Ball> kept;
  if (kept_size == vertices && kept_edges == edges && kept) return kept.get();
  kept.reset();
  auto made = edges == Edges::usual ? made_ball(vertices) : made_ball(vertices, 0.0);
  if (value_or_fail(state, made) == nullptr) return nullptr;
  kept = std::make_unique<Ball>(std::move(made.value()));
  kept_size = vertices;
  kept_edges = edges;
  return kept.get();
}

/// What the dabs of a row cost, in order.
struct Costs {
  std::vector<double> cpu_ms;
  std::vector<double> wall_ms;
  std::vector<double> edit_ms;     ///< wall: all levels and the undo record
  std::vector<double> surface_ms;  ///< wall: the blocks that changed, and their normals
  std::vector<double> end_ms;      ///< wall: end of a stroke and the surface after it, by stroke
  std::vector<double> pick_us;     ///< CPU: the first pick after the dab, at its point
  std::vector<double> ray_us;      ///< CPU: a pick after that, of kRays around that point
  double leaves = 0.0;             ///< written, all dabs
  double saved = 0.0;              ///< of these, kept for undo
  double blocks = 0.0;             ///< of the surface, rebuilt
};

/// One dab on an open stroke. False: it failed, and the row is ended.
bool dab(benchmark::State& state, Ball& ball, const StrokeSample& sample, Costs& costs) {
  const double cpu = bench::process_cpu_ms();
  const double start = bench::wall_ms();
  auto dabs = ball.clay.extend_stroke({&sample, 1});
  const double edited = bench::wall_ms();
  const std::int64_t blocks = ball.surface.update(ball.clay);
  const double end = bench::wall_ms();
  costs.cpu_ms.push_back(bench::process_cpu_ms() - cpu);
  costs.wall_ms.push_back(end - start);
  costs.edit_ms.push_back(edited - start);
  costs.surface_ms.push_back(end - edited);
  costs.blocks += static_cast<double>(blocks);
  const int* count = value_or_fail(state, dabs);
  if (count != nullptr && *count != 1) state.SkipWithError("a sample did not give one dab");
  return count != nullptr && *count == 1;
}

/// What the mouse asks for in the frame after a dab. False: a ray missed, and the row is ended.
bool picks(benchmark::State& state, const Clay& clay, const StrokeSample& sample, const Tool& tool,
           Costs& costs) {
  int hits = 0;
  double first = 0.0;
  const double start = bench::process_cpu_ms();
  for (int n = 0; n <= kRays; ++n) {
    const auto picked = pick(clay, ray_over_dab(sample, tool, n, kRays));
    if (n == 0) first = bench::process_cpu_ms();
    hits += picked.ok() && picked.value() ? 1 : 0;
  }
  costs.pick_us.push_back(1e3 * (first - start));
  costs.ray_us.push_back(1e3 * (bench::process_cpu_ms() - first) / kRays);
  if (hits != kRays + 1) state.SkipWithError("a ray missed the clay");
  return hits == kRays + 1;
}

/// Runs the strokes of a row, a dab for each iteration of Google Benchmark.
class Session {
 public:
  Session(benchmark::State& state, Ball& ball, const Tool& tool)
      : state_(state), ball_(ball), tool_(tool) {}

  bool next_dab() {
    const auto dabs = static_cast<std::size_t>(kLength.dabs);
    const std::size_t at = costs_.wall_ms.size() % dabs;
    if (at == 0) {
      state_.PauseTiming();
      if (!begin()) return false;
      state_.ResumeTiming();
    }
    const std::uint64_t before = revision(ball_.clay);
    bool done = dab(state_, ball_, samples_[at], costs_);
    state_.PauseTiming();
    if (done) count_leaves(before);
    if (done) done = picks(state_, ball_.clay, samples_[at], tool_, costs_);
    if (done && at + 1 == dabs) end();
    if (done) state_.ResumeTiming();
    return done;
  }
  const Costs& costs() const noexcept { return costs_; }
  std::uint64_t hash() const noexcept { return hash_; }

  /// Mean over the strokes of the untouched vertices within the tool at their first dab.
  double vertices_in_reach() const {
    double sum = 0.0;
    for (int stroke = 0; stroke < kLength.strokes; ++stroke) {
      const Vec3 at = samples_of(stroke)[0].position_mm;
      const double radius = smallest_radius(tool_);
      const auto near = [&](const Vec3& p) { return dot(p - at, p - at) < radius * radius; };
      sum += static_cast<double>(std::count_if(ball_.vertices.begin(), ball_.vertices.end(), near));
    }
    return sum / kLength.strokes;
  }

 private:
  std::vector<StrokeSample> samples_of(int stroke) const {
    return wandering_samples(start_of_stroke(stroke), tool_, kSpacing, ball_.radius_mm,
                             kLength.dabs);
  }
  bool begin() {
    samples_ = samples_of(stroke_++);
    saved_.clear();
    auto begun = ball_.clay.begin_stroke(tool_, {.spacing = kSpacing});
    if (!begun) state_.SkipWithError(begun.error().message.c_str());
    return static_cast<bool>(begun);
  }
  void count_leaves(std::uint64_t since) {
    const auto changes = changes_since(ball_.clay, since);
    if (!changes) return;
    costs_.leaves += static_cast<double>(changes->size());
    const std::size_t saved = saved_.size();
    for (const LeafChange& change : *changes) saved_.insert(change.where());
    costs_.saved += static_cast<double>(saved_.size() - saved);
  }
  void end() {
    const double start = bench::wall_ms();
    auto report = ball_.clay.end_stroke();
    ball_.surface.update(ball_.clay);
    costs_.end_ms.push_back(bench::wall_ms() - start);
    if (value_or_fail(state_, report) == nullptr) return;
    if (stroke_ == kLength.strokes) hash_ = hash_of_all();
    ball_.clay.undo();
    ball_.surface.update(ball_.clay);
  }
  std::uint64_t hash_of_all() const {
    Hash64 hash;
    const std::array<std::uint64_t, 2> both{ball_.clay.hash(), hash_of(ball_.surface.weld())};
    hash.update(std::as_bytes(std::span(both)));
    return hash.digest();
  }

  benchmark::State& state_;
  Ball& ball_;
  Tool tool_;
  Costs costs_;
  int stroke_ = 0;
  std::vector<StrokeSample> samples_;
  std::set<LeafKey> saved_;  ///< leaves that the stroke's undo record holds
  std::uint64_t hash_ = 0;
};

double target_ms(std::int64_t vertices) {
  for (const Target& target : kTargets) {
    if (target.vertices == vertices) return target.median_ms;
  }
  return 0.0;
}

void show(benchmark::State& state, const Session& session, double vertices) {
  const Costs& costs = session.costs();
  const auto dabs = static_cast<double>(costs.wall_ms.size());
  const double covered = session.vertices_in_reach();
  const double bytes =
      (2.0 * costs.leaves + costs.saved) / dabs * kLeafBytes + covered * kVertexBytes;
  const double median = quantile(costs.wall_ms, 0.5);
  const double floor = bytes / bytes_per_ms();
  auto& counters = state.counters;
  counters["vertices"] = vertices;
  counters["covered"] = covered;
  counters["cpu_ms"] = quantile(costs.cpu_ms, 0.5);
  counters["cpu_p99_ms"] = quantile(costs.cpu_ms, 0.99);
  counters["wall_ms"] = median;
  counters["wall_p99_ms"] = quantile(costs.wall_ms, 0.99);
  counters["edit_ms"] = quantile(costs.edit_ms, 0.5);
  counters["surface_ms"] = quantile(costs.surface_ms, 0.5);
  counters["end_ms"] = quantile(costs.end_ms, 0.5);
  counters["pick_us"] = quantile(costs.pick_us, 0.5);
  counters["pick_p99_us"] = quantile(costs.pick_us, 0.99);
  counters["ray_us"] = quantile(costs.ray_us, 0.5);
  counters["leaves"] = costs.leaves / dabs;
  counters["blocks"] = costs.blocks / dabs;
  counters["bytes"] = bytes;
  counters["floor_ms"] = floor;
  counters["to_floor"] = median / floor;
  counters["to_target"] = median / target_ms(state.range(1));
  counters["p99_to_median"] = quantile(costs.wall_ms, 0.99) / median;
}

/// Arguments: V, N.
void session(benchmark::State& state, Action action, Edges edges) {
  Ball* ball = ball_of(state, state.range(0), edges);
  if (ball == nullptr) return;
  const Tool tool = tool_covering(static_cast<double>(state.range(1)), action, ball->radius_mm);
  Session run(state, *ball, tool);
  for (auto _ : state) {
    if (!run.next_dab()) return;
  }
  show(state, run, static_cast<double>(ball->vertices.size()));
  RowResult row(state);
  row.add(run.hash());
  char size[40];
  std::snprintf(size, sizeof size, "R %.3g mm", smallest_radius(tool));
  row.show(size);
}

/// The counters as a markdown table, a row at a time.
class Table : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override {
    std::printf(
        "Times in ms of one dab, all included but picking; wall time of all cores; a copy of 256 "
        "MB moves "
        "%.1f GB/s.\n\n"
        "| row | ball | covered | CPU median | CPU p99 | wall median | wall p99 | edit | surface | "
        "end of stroke | pick us | pick p99 us | us a ray | leaves | blocks | MB | floor | to "
        "floor | to target | hash |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
        bytes_per_ms() / 1e6);
    return true;
  }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration) continue;
      if (run.error_occurred) {
        std::printf("%s failed: %s\n", run.benchmark_name().c_str(), run.error_message.c_str());
        continue;
      }
      print(run);
    }
    std::fflush(stdout);
  }

 private:
  static void print(const Run& run) {
    const auto value = [&](const char* name) { return run.counters.at(name).value; };
    const std::string name = run.run_name.function_name;
    std::printf("| %s | %.0f | %.0f ", name.c_str(), value("vertices"), value("covered"));
    for (const char* time : {"cpu_ms", "cpu_p99_ms", "wall_ms", "wall_p99_ms", "edit_ms",
                             "surface_ms", "end_ms", "pick_us", "pick_p99_us", "ray_us"}) {
      std::printf("| %.3g ", value(time));
    }
    const std::string hash = run.report_label.substr(run.report_label.find('|') + 1);
    std::printf("| %.0f | %.0f | %.2f | %.4f | %.0f | %.1f | `%s` |\n", value("leaves"),
                value("blocks"), 1e-6 * value("bytes"), value("floor_ms"), value("to_floor"),
                value("to_target"), hash.c_str());
  }
};

/// Rows of one ball stand together: it is made once.
void register_rows() {
  const auto add = [](const char* name, Action action, std::int64_t ball, int vertices,
                      Edges edges = Edges::usual) {
    benchmark::RegisterBenchmark(name,
                                 [=](benchmark::State& state) { session(state, action, edges); })
        ->Args({ball, vertices})
        ->ArgNames({"ball", "covered"})
        ->Iterations(kLength.strokes * kLength.dabs)
        ->Unit(benchmark::kMillisecond)
        ->MeasureProcessCPUTime()
        ->UseRealTime();
  };
  for (const std::int64_t ball : {500'000, 2'000'000, 8'000'000}) {
    for (const Target& target : kTargets) {
      add("session/carve", Action::carve, ball, target.vertices);
    }
    add("session/add", Action::add, ball, 10'000);
    add("session/smooth", Action::smooth, ball, 10'000);
    add("session/inflate", Action::inflate, ball, 10'000);
    add("session/flatten", Action::flatten, ball, 10'000);
    add("session/crease", Action::crease, ball, 10'000);
    add("session/carve_sharp", Action::carve, ball, 10'000, Edges::sharp);
    add("session/add_sharp", Action::add, ball, 10'000, Edges::sharp);
  }
}

}  // namespace
}  // namespace argil::bench

int main(int argc, char** argv) {
  argil::bench::register_rows();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  argil::bench::Table table;
  return benchmark::RunSpecifiedBenchmarks(&table) > 0 ? 0 : 1;
}
