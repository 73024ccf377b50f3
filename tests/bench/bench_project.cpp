// SPDX-License-Identifier: GPL-3.0-or-later
// What opening and saving a project cost: balls with detail everywhere, of half a million, two and
// eight million surface vertices, or the projects named as arguments. Prints a markdown table:
// medians of the runs, and the most memory that a run took beyond the clay's own.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <numbers>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include <malloc.h>
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>

#include "argil/engine/clay.h"
#include "argil/io/project_file.h"

#include "bench/clock.h"
#include "support/bumpy_clay.h"
#include "support/scratch.h"

namespace {

using namespace argil;

constexpr int kRuns = 5;
constexpr double kVoxelMm = 0.25;
constexpr double kVerticesPerSquareVoxel = 1.5;

struct Took {
  double wall_s = 0.0;
  double cpu_s = 0.0;
  double peak_mb = 0.0;  ///< of the process
};

[[noreturn]] void fail(const std::string& why) {
  std::fprintf(stderr, "%s\n", why.c_str());
  std::exit(1);  // NOLINT(concurrency-mt-unsafe): nothing else runs
}

/// A line of /proc/self/status, such as VmHWM.
double status_mb(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double kb = 0.0;
    if (word == name + ":" && status >> kb) return kb / 1024.0;
  }
  return 0.0;
}

/// Gives back what is free, and makes the present use the greatest so far.
void forget_peak() {
  ::malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << 5;
}

Took once(const std::function<void()>& work) {
  forget_peak();
  const double wall = bench::wall_ms();
  const double cpu = bench::process_cpu_ms();
  work();
  return {1e-3 * (bench::wall_ms() - wall), 1e-3 * (bench::process_cpu_ms() - cpu),
          status_mb("VmHWM")};
}

double median(const std::vector<Took>& runs, double Took::*of) {
  std::vector<double> sorted;
  for (const Took& run : runs) sorted.push_back(run.*of);
  std::sort(sorted.begin(), sorted.end());
  return sorted[sorted.size() / 2];
}

Took medians(const std::function<void()>& work) {
  std::vector<Took> runs;
  for (int n = 0; n < kRuns; ++n) runs.push_back(once(work));
  return {median(runs, &Took::wall_s), median(runs, &Took::cpu_s), median(runs, &Took::peak_mb)};
}

Clay loaded(const std::filesystem::path& project) {
  auto read = io::load_project(project);
  if (!read) fail(read.error().message);
  return std::move(read).value();
}

/// OpenVDB's own reader, which trusts the file and checks nothing.
Took read_by_openvdb(const std::filesystem::path& project) {
  openvdb::initialize();
  return medians([&] {
    std::ifstream file(project, std::ios::binary);
    openvdb::io::Stream(file, false).getGrids();
  });
}

void row(const std::string& name, const std::filesystem::path& project, const Clay& clay) {
  std::int64_t leaves = 0;
  std::int64_t bytes = 0;
  for (const LevelStats& level : clay.level_stats()) {
    leaves += level.leaves;
    bytes += level.bytes;
  }
  const double mb = 1e-6 * static_cast<double>(std::filesystem::file_size(project));
  const test::ScratchFolder folder;
  const double before_save = status_mb("VmRSS");
  const Took save = medians([&] {
    if (auto saved = io::save_project(folder / "saved.vdb", clay); !saved) {
      fail(saved.error().message);
    }
  });
  const Took hash = medians([&] { static_cast<void>(clay.hash()); });
  ::malloc_trim(0);
  const double before_open = status_mb("VmRSS");
  const Took open = medians([&] { static_cast<void>(loaded(project)); });
  const Took theirs = read_by_openvdb(project);
  const double clay_mb = static_cast<double>(bytes) / 1048576.0;
  std::printf(
      "| %s | %lld | %.0f | %.0f | %.2f / %.2f | %.0f | %.2f / %.2f | %.2f / %.2f | %.0f | "
      "%.2f / %.2f |\n",
      name.c_str(), static_cast<long long>(leaves), clay_mb, mb, open.cpu_s, open.wall_s,
      open.peak_mb - before_open, hash.cpu_s, hash.wall_s, save.cpu_s, save.wall_s,
      save.peak_mb - before_save, theirs.cpu_s, theirs.wall_s);
  std::fflush(stdout);
}

void ball_row(double vertices) {
  const double radius =
      kVoxelMm * std::sqrt(vertices / kVerticesPerSquareVoxel / (4.0 * std::numbers::pi));
  auto clay = test::bumpy_ball(radius, kVoxelMm);
  if (!clay) fail(clay.error().message);
  const test::ScratchFolder folder;
  if (auto saved = io::save_project(folder / "ball.vdb", clay.value()); !saved) {
    fail(saved.error().message);
  }
  char name[64];
  std::snprintf(name, sizeof name, "ball, %.1f M vertices", 1e-6 * vertices);
  row(name, folder / "ball.vdb", clay.value());
}

}  // namespace

int main(int argc, char** argv) {
  std::printf(
      "| project | leaves | clay MB | file MB | open: CPU / wall s | peak MB | hash | "
      "save | peak MB beyond the clay | OpenVDB reads "
      "|\n|---|---|---|---|---|---|---|---|---|---|\n");
  for (const char* project : std::span(argv + 1, static_cast<std::size_t>(argc - 1))) {
    row(std::filesystem::path(project).filename(), project, loaded(project));
  }
  if (argc == 1) {
    for (const double vertices : {0.5e6, 2e6, 8e6}) ball_row(vertices);
  }
  return 0;
}
