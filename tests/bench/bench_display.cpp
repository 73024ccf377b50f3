// SPDX-License-Identifier: GPL-3.0-or-later
// What a renderer pays for: the first surface, whole and with the far half one level coarser, steps
// of a camera and dabs, on balls of some million surface vertices. Prints a markdown table for each
// ball. Usage: bench_display [vertices...]; default 500000 2000000
//        bench_display --picture FILE.svg: the blocks of a small ball, levels as colours
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "argil/core/hash.h"
#include "argil/engine/display_surface.h"

#include "bench/clock.h"
#include "clay/clay_access.h"
#include "support/bumpy_clay.h"
#include "surface/display_choice.h"

namespace argil::bench {
namespace {

constexpr double kVoxelMm = 0.25;
constexpr double kVerticesPerSquareVoxel = 1.5;
constexpr int kSteps = 41;

template <class T>
T median(std::vector<T> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

/// Finest voxels span a pixel in the middle of the ball.
DisplayView view_from(double eye_mm, double limit_mm) {
  DisplayView view;
  view.eye_mm = {eye_mm, 0.0, 0.0};
  view.pixel_rad = kVoxelMm / limit_mm;
  return view;
}

std::uint64_t hash_of(const DisplaySurface& surface) {
  Hash64 hash;
  for (const BlockId& id : surface.blocks()) {
    const DisplayBlock block = surface.block(id);
    hash.update(std::as_bytes(block.vertices));
    hash.update(std::as_bytes(block.triangles));
  }
  return hash.digest();
}

[[noreturn]] void stop(const Error& error) {
  std::fprintf(stderr, "bench_display: %s\n", error.message.c_str());
  std::exit(1);
}

/// Process CPU time in ms of an update.
double update(DisplaySurface& surface, const Clay& clay, const std::optional<DisplayView>& view) {
  const double start = bench::process_cpu_ms();
  if (const auto done = surface.update(clay, view); !done) stop(done.error());
  return bench::process_cpu_ms() - start;
}

void print_whole(const char* name, const DisplaySurface& surface, double ms) {
  const DisplayStats stats = surface.stats();
  std::printf(
      "| %s | %lld triangles, %lld blocks, %.1f MB, %.1f bytes a vertex, %.0f ms | `%016llx` |\n",
      name, static_cast<long long>(stats.triangles), static_cast<long long>(stats.blocks),
      1e-6 * static_cast<double>(stats.bytes),
      static_cast<double>(stats.bytes) / static_cast<double>(stats.vertices), ms,
      static_cast<unsigned long long>(hash_of(surface)));
}

struct Steps {
  std::vector<double> ms;
  std::vector<double> blocks;  ///< listed by each

  void add(const DisplaySurface& surface, double took_ms) {
    ms.push_back(took_ms);
    blocks.push_back(static_cast<double>(surface.changed().size() + surface.gone().size()));
  }
  void print(const char* name, const DisplaySurface& surface) const {
    double all_ms = 0.0;
    double all_blocks = 0.0;
    for (const double m : ms) all_ms += m;
    for (const double b : blocks) all_blocks += b;
    std::printf(
        "| %s | median %.2f ms, most %.2f ms, median %.0f blocks, %.1f us a block | `%016llx` |\n",
        name, median(ms), *std::max_element(ms.begin(), ms.end()), median(blocks),
        1e3 * all_ms / all_blocks, static_cast<unsigned long long>(hash_of(surface)));
  }
};

Stroke dab_at(const Vec3& place) {
  Stroke stroke;
  stroke.tool.action = Action::carve;
  stroke.tool.radii_mm = {3.0, 3.0, 3.0};
  stroke.samples.resize(1);
  stroke.samples[0].position_mm = place;
  return stroke;
}

/// Carves on one side of the ball, `x` = 1 near the eye, -1 far from it.
void time_dabs(const char* name, DisplaySurface& surface, Clay& clay, const DisplayView& view,
               double x, double radius_mm) {
  Steps dabs;
  for (int i = 0; i < kSteps; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / kSteps;
    const Vec3 toward = normalized(Vec3{x, 0.3 * std::cos(turn), 0.3 * std::sin(turn)});
    if (const auto done = clay.apply(dab_at((radius_mm + 1.0) * toward)); !done) stop(done.error());
    dabs.add(surface, update(surface, clay, view));
  }
  dabs.print(name, surface);
}

void time_choice(const Clay& clay, const DisplayView& view) {
  DisplayChoice choice;
  choice.show_all(levels_of(clay));
  choice.choose(view);
  std::vector<double> ms;
  for (int i = 0; i < kSteps; ++i) {
    const double start = bench::process_cpu_ms();
    choice.choose(view);
    ms.push_back(bench::process_cpu_ms() - start);
  }
  std::printf("| choosing again, nothing changes | %.2f ms, %.2f MB | |\n", median(ms),
              1e-6 * static_cast<double>(choice.bytes()));
}

void run(double vertices) {
  const double area = vertices / kVerticesPerSquareVoxel;
  const double radius_mm = kVoxelMm * std::sqrt(area / (4.0 * std::numbers::pi));
  auto made = test::bumpy_ball(radius_mm, kVoxelMm);
  if (!made) stop(made.error());
  Clay clay = std::move(made).value();
  std::printf("\n| ball of %.0f vertices | CPU time, all threads | hash |\n|---|---|---|\n",
              vertices);
  DisplaySurface surface;
  const double whole_ms = update(surface, clay, std::nullopt);
  print_whole("whole", surface, whole_ms);
  double eye = 3.0 * radius_mm;
  const double limit = eye;
  surface = DisplaySurface();
  const double half_ms = update(surface, clay, view_from(eye, limit));
  print_whole("far half one level coarser", surface, half_ms);
  time_choice(clay, view_from(eye, limit));
  eye -= 0.6 * radius_mm;  // past what hysteresis keeps
  update(surface, clay, view_from(eye, limit));
  Steps steps;
  for (int i = 0; i < kSteps; ++i) {
    eye -= 0.004 * radius_mm;
    steps.add(surface, update(surface, clay, view_from(eye, limit)));
  }
  steps.print("step of the eye", surface);
  const DisplayView view = view_from(eye, limit);
  time_dabs("dab of 3 mm on the near side", surface, clay, view, 1.0, radius_mm);
  time_dabs("dab of 3 mm on the far side", surface, clay, view, -1.0, radius_mm);
}

constexpr double kPictureMm = 9.0;  // the ball's radius
constexpr double kPixels = 1000.0;  // the picture's width; of its height the middle is shown

/// A triangle as seen along y, x to the right, shaded by its slope; nothing when it faces away.
void draw(std::FILE* file, const DisplayBlock& block, const Triangle& t, const char* color) {
  const auto corner = [&](std::size_t i) {
    const auto& p = block.vertices[t[i]].position_mm;
    return Vec3{double{p[0]}, double{p[1]}, double{p[2]}};
  };
  const Vec3 n = normalized(cross(corner(1) - corner(0), corner(2) - corner(0)));
  if (n.y >= 0.0) return;
  const double scale = 0.47 * kPixels / kPictureMm;
  std::fprintf(file, "<path fill=\"%s\" fill-opacity=\"%.2f\" d=\"M", color, 0.35 - 0.65 * n.y);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 p = corner(i);
    std::fprintf(file, "%.1f %.1f%s", 0.5 * kPixels + scale * p.x, 0.5 * kPixels - scale * p.z,
                 i < 2 ? "L" : "z\"/>\n");
  }
}

/// The eye is on the left; two levels are hidden one after the other to the right.
void draw_levels(const char* path) {
  constexpr const char* kColors[] = {"#d9a066", "#6fa8a0", "#7d8fc4"};
  auto made = test::bumpy_ball(kPictureMm, kVoxelMm);
  if (!made) stop(made.error());
  DisplaySurface surface;
  DisplayView view = view_from(-1.7 * kPictureMm, 1.05 * kPictureMm);
  view.coarser = 2;
  update(surface, made.value(), view);
  std::FILE* file = std::fopen(path, "w");
  if (file == nullptr) stop({ErrorKind::disk, std::string("cannot write '") + path + "'"});
  std::fprintf(file,
               "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 %.0f %.0f %.0f\">"
               "<rect y=\"200\" width=\"100%%\" height=\"100%%\" fill=\"white\"/>"
               "<g stroke=\"#303030\" stroke-width=\"0.5\" stroke-linejoin=\"round\">\n",
               0.2 * kPixels, kPixels, 0.6 * kPixels);
  for (const BlockId& id : surface.blocks()) {
    const DisplayBlock block = surface.block(id);
    const char* color = kColors[std::min(id.level, 2)];
    for (const Triangle& t : block.triangles) draw(file, block, t, color);
  }
  std::fprintf(file, "</g></svg>\n");
  if (std::fclose(file) != 0) stop({ErrorKind::disk, std::string("cannot write '") + path + "'"});
}

}  // namespace
}  // namespace argil::bench

int main(int argc, char** argv) {
  if (argc == 3 && std::string_view(argv[1]) == "--picture") {
    argil::bench::draw_levels(argv[2]);
    return 0;
  }
  if (argc < 2) {
    argil::bench::run(5e5);
    argil::bench::run(2e6);
  }
  for (int i = 1; i < argc; ++i) argil::bench::run(std::atof(argv[i]));
  return 0;
}
