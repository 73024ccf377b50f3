// SPDX-License-Identifier: GPL-3.0-or-later
// What opening and saving a project cost, and when the window shows it: balls with detail
// everywhere, of half a million, two and eight million surface vertices, or the projects named as
// arguments. Prints a markdown table: medians of five runs; peaks are what the process took beyond
// what it had before.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>

#include "argil/engine/clay.h"
#include "argil/io/project_file.h"

#include "bench/clock.h"
#include "bench/memory.h"
#include "clay/clay_access.h"
#include "document/document_thread.h"
#include "field/nesting.h"
#include "support/bumpy_clay.h"
#include "support/scratch.h"

namespace {

using namespace argil;
namespace fs = std::filesystem;

constexpr int kRuns = 5;
constexpr double kVoxelMm = 0.25;
constexpr double kVerticesPerSquareVoxel = 1.5;

struct Took {
  double cpu_s = 0.0;
  double wall_s = 0.0;
  double peak_mb = 0.0;
};

[[noreturn]] void fail(const std::string& why) {
  std::fprintf(stderr, "%s\n", why.c_str());
  std::exit(1);  // NOLINT(concurrency-mt-unsafe): nothing else runs
}

/// What `work` returns is freed after the clocks are read.
template <class Work>
Took once(const Work& work) {
  const double before = bench::begin_peak();
  const double wall = bench::wall_ms();
  const double cpu = bench::process_cpu_ms();
  [[maybe_unused]] const auto made = work();
  return {1e-3 * (bench::process_cpu_ms() - cpu), 1e-3 * (bench::wall_ms() - wall),
          bench::status_mb("VmHWM") - before};
}

template <class Work>
Took median(const Work& work) {
  std::array<Took, kRuns> runs;
  for (Took& run : runs) run = once(work);
  const auto middle = [&](double Took::*of) {
    std::sort(runs.begin(), runs.end(),
              [&](const Took& a, const Took& b) { return a.*of < b.*of; });
    return runs[kRuns / 2].*of;
  };
  return {middle(&Took::cpu_s), middle(&Took::wall_s), middle(&Took::peak_mb)};
}

Clay loaded(const fs::path& project) {
  auto read = io::load_project(project);
  if (!read) fail(read.error().message);
  return std::move(read).value();
}

/// From asking for a project to the first blocks, and to the last.
struct Shown {
  double first_s = 0.0;
  double all_s = 0.0;
};

/// As a window of 800 lines does that frames the clay once it knows how large it is.
Shown shown_once(const fs::path& project) {
  const test::ScratchFolder folder;
  fs::create_hard_link(project, folder / "shown.vdb");
  viewer::DocumentThread document({folder.path()});
  const double begin = bench::wall_ms();
  document.send(viewer::OpenFile{folder / "shown.vdb"});
  std::vector<double> inputs;
  Shown shown;
  bool has_looked = false;
  do {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (!document.take_blocks(inputs).empty() && shown.first_s == 0.0) {
      shown.first_s = 1e-3 * (bench::wall_ms() - begin);
    }
    if (has_looked || !document.state().has_clay) continue;
    const Box3 box = document.state().bounds_mm;
    DisplayView view;
    view.eye_mm = 0.5 * (box.min + box.max) + Vec3{0.0, -1.2 * length(box.size()), 0.0};
    view.pixel_rad = 0.7 / 800.0;
    document.look(view);
    has_looked = true;
  } while (!document.is_idle());
  shown.all_s = 1e-3 * (bench::wall_ms() - begin);
  return shown;
}

Shown median_shown(const fs::path& project) {
  std::array<Shown, kRuns> runs;
  for (Shown& run : runs) run = shown_once(project);
  const auto middle = [&](double Shown::*of) {
    std::sort(runs.begin(), runs.end(),
              [&](const Shown& a, const Shown& b) { return a.*of < b.*of; });
    return runs[kRuns / 2].*of;
  };
  return {middle(&Shown::first_s), middle(&Shown::all_s)};
}

void row(const std::string& name, const fs::path& project) {
  const Took open = median([&] { return loaded(project); });
  // OpenVDB's own reader, which trusts the file and checks nothing.
  const Took theirs = median([&] {
    openvdb::initialize();
    std::ifstream file(project, std::ios::binary);
    return openvdb::io::Stream(file, false).getGrids();
  });
  const Shown shown = median_shown(project);
  const Clay clay = loaded(project);
  const Took nesting = median([&] { return first_nesting_fault(levels_of(clay)); });
  const test::ScratchFolder folder;
  const Took save = median([&] {
    auto saved = io::save_project(folder / "saved.vdb", clay);
    if (!saved) fail(saved.error().message);
    return saved;
  });
  std::int64_t leaves = 0;
  std::int64_t bytes = 0;
  for (const LevelStats& level : clay.level_stats()) {
    leaves += level.leaves;
    bytes += level.bytes;
  }
  std::printf(
      "| %s | %lld | %.0f | %.0f | %.2f / %.2f | %.3f | %.0f | %.2f / %.2f | %.2f | %.2f | "
      "%.2f / %.2f | %.0f |\n",
      name.c_str(), static_cast<long long>(leaves), static_cast<double>(bytes) / 1048576.0,
      1e-6 * static_cast<double>(fs::file_size(project)), open.cpu_s, open.wall_s, nesting.cpu_s,
      open.peak_mb, theirs.cpu_s, theirs.wall_s, shown.first_s, shown.all_s, save.cpu_s,
      save.wall_s, save.peak_mb);
  std::fflush(stdout);
}

void ball_row(double vertices) {
  const double radius =
      kVoxelMm * std::sqrt(vertices / kVerticesPerSquareVoxel / (4.0 * std::numbers::pi));
  const test::ScratchFolder folder;
  {
    auto clay = test::bumpy_ball(radius, kVoxelMm);
    if (!clay) fail(clay.error().message);
    if (auto saved = io::save_project(folder / "ball.vdb", clay.value()); !saved) {
      fail(saved.error().message);
    }
  }
  std::array<char, 64> name{};
  std::snprintf(name.data(), name.size(), "ball, %.1f M vertices", 1e-6 * vertices);
  row(name.data(), folder / "ball.vdb");
}

}  // namespace

int main(int count, char** projects) {
  std::printf(
      "| project | leaves | clay MB | file MB | open: CPU / wall s | nesting of it: CPU s | "
      "peak MB | OpenVDB reads: CPU / wall s | first picture s | all of it s | "
      "save: CPU / wall s | peak MB |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (int n = 1; n < count; ++n) row(fs::path(projects[n]).filename(), projects[n]);
  if (count == 1) {
    for (const double vertices : {0.5e6, 2e6, 8e6}) ball_row(vertices);
  }
  return 0;
}
