// SPDX-License-Identifier: GPL-3.0-or-later
// What the small picture of a project costs: the copy that it is drawn from, which is made on the
// document thread, and drawing, writing and reading it, which nobody waits for. Bumpy balls with
// detail everywhere, of half a million to eight million surface vertices. Prints a markdown table:
// CPU milliseconds of all threads, medians of seven.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "argil/engine/sculpture.h"

#include "bench/clock.h"
#include "document/picture_shot.h"
#include "settings/thumbnail.h"
#include "support/bumpy_clay.h"
#include "support/scratch.h"

namespace {

using namespace argil;
using namespace argil::viewer;

constexpr int kRuns = 7;
constexpr double kVoxelMm = 0.25;

template <class T>
T take(Result<T> result) {
  if (result) return std::move(result).value();
  std::fprintf(stderr, "%s\n", result.error().message.c_str());
  std::exit(1);  // NOLINT(concurrency-mt-unsafe): nothing else runs
}

template <class Work>
double median_cpu_ms(const Work& work) {
  std::array<double, kRuns> runs{};
  for (double& run : runs) {
    const double begin = bench::process_cpu_ms();
    work();
    run = bench::process_cpu_ms() - begin;
  }
  std::sort(runs.begin(), runs.end());
  return runs[kRuns / 2];
}

void print_row(double vertices) {
  const double area = vertices / 1.5 * kVoxelMm * kVoxelMm;  // of so many by square voxel
  const double radius_mm = std::sqrt(area / (4.0 * std::numbers::pi));
  const Sculpture sculpture(take(test::bumpy_ball(radius_mm, kVoxelMm)));
  const test::ScratchFolder folder;
  const auto file = folder / "p.vdb";
  test::fill(file, "a project");
  const FileStamp stamp = stamp_of(file).value();
  std::optional<PictureShot> shot;
  const double shoot_ms = median_cpu_ms([&] { shot = shoot(sculpture, {}); });
  Image image;
  const double draw_ms = median_cpu_ms([&] { image = take(draw(shot.value(), {})); });
  const PicturePlaces places{folder / "large", folder / "work"};
  const double write_ms = median_cpu_ms([&] {
    if (!write_picture(places.saved, file, stamp, image)) std::abort();
  });
  const double read_ms = median_cpu_ms([&] {
    if (!look_at_file(places, file).picture) std::abort();
  });
  std::printf(
      "| %.2f M | %zu | %.1f | %.0f | %.1f | %.1f | %.0f |\n", 1e-6 * vertices,
      shot->mesh.triangles.size(), shoot_ms, draw_ms, write_ms, read_ms,
      1e-3 * static_cast<double>(std::filesystem::file_size(picture_file(places.saved, file))));
}

}  // namespace

int main() {
  std::puts("| vertices | triangles of the copy | copy ms | draw ms | write ms | read ms | kB |");
  std::puts("|---|---|---|---|---|---|---|");
  for (const double vertices : {0.05e6, 0.5e6, 2e6, 8e6}) print_row(vertices);
  return 0;
}
