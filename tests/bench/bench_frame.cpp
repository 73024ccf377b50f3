// SPDX-License-Identifier: GPL-3.0-or-later
// What a frame takes, without a window or display: on the graphics card that EGL finds, or in
// software. Bumpy balls of some million triangles in 1920 x 1080, turned from frame to frame, in
// each shading; beside it what the first upload takes, and that of the blocks around a dab.
// Usage: bench_frame [MILLIONS OF TRIANGLES...]; default 1 4
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <epoxy/gl.h>

#include "argil/engine/display_surface.h"

#include "bench/clock.h"
#include "bench/quantile.h"
#include "gl/gl_renderer.h"
#include "picture/camera.h"
#include "support/bumpy_clay.h"
#include "viewer/support/offscreen.h"

namespace argil::bench {
namespace {

using viewer::BlockMesh;
using viewer::Shading;

constexpr int kWidth = 1920;
constexpr int kHeight = 1080;
constexpr int kFrames = 50;
constexpr double kVoxelMm = 0.25;
constexpr double kRadiusMm = 39.5;  // a million triangles
constexpr std::size_t kDabBlocks = 200;

[[noreturn]] void stop(const std::string& message) {
  std::fprintf(stderr, "bench_frame: %s\n", message.c_str());
  std::exit(1);
}

std::vector<BlockMesh> blocks_of(const Clay& clay) {
  DisplaySurface surface;
  if (const auto done = surface.update(clay, {}); !done) stop(done.error().message);
  std::vector<BlockMesh> blocks;
  for (const BlockId& id : surface.blocks()) {
    const DisplayBlock from = surface.block(id);
    blocks.push_back({id,
                      {from.vertices.begin(), from.vertices.end()},
                      {from.triangles.begin(), from.triangles.end()},
                      {},
                      from.bounds_mm});
  }
  return blocks;
}

/// Until the card has done it, in ms.
double put_ms(viewer::Renderer& renderer, std::span<const BlockMesh> blocks) {
  const double before = wall_ms();
  for (const BlockMesh& block : blocks) {
    if (const auto done = renderer.put(0, block); !done) stop(done.error().message);
  }
  glFinish();
  return wall_ms() - before;
}

void frames(viewer::Renderer& renderer, const test::Offscreen& screen, const Box3& content_mm,
            const char* name, const viewer::Picture& wanted) {
  viewer::Camera camera;
  camera.resize(kWidth, kHeight);
  camera.look_from({0.0, -1.0, 0.0}, {0.0, 0.0, 1.0});
  camera.frame(content_mm);
  std::vector<double> ms;
  std::vector<double> cpu_ms;
  viewer::Picture picture = wanted;
  for (int n = -5; n < kFrames; ++n) {
    camera.orbit(3.0, 0.5);
    picture.lens = camera.lens(content_mm);
    const double before = wall_ms();
    const double before_cpu = process_cpu_ms();
    if (const auto done = renderer.draw(picture, screen.framebuffer(), kWidth, kHeight); !done)
      stop(done.error().message);
    glFinish();
    if (n < 0) continue;  // the first ones make shaders and targets
    ms.push_back(wall_ms() - before);
    cpu_ms.push_back(process_cpu_ms() - before_cpu);
  }
  std::printf("| %s | %.2f | %.2f | %.2f |\n", name, quantile(ms, 0.5), quantile(ms, 0.99),
              quantile(cpu_ms, 0.5));
}

void measure(const test::Offscreen& screen, double millions) {
  const auto clay = test::bumpy_ball(kRadiusMm * std::sqrt(millions), kVoxelMm);
  if (!clay) stop(clay.error().message);
  const std::vector<BlockMesh> blocks = blocks_of(clay.value());
  auto made = viewer::make_gl_renderer();
  if (!made) stop(made.error().message);
  viewer::Renderer& renderer = *made.value();

  const double first_ms = put_ms(renderer, blocks);
  Box3 content_mm;
  for (const BlockMesh& block : blocks) {
    content_mm.include(block.bounds_mm.min);
    content_mm.include(block.bounds_mm.max);
  }
  const auto counts = renderer.counts();
  std::printf(
      "\n%.2f million triangles in %lld blocks, %.0f MB on the card; first upload %.1f ms\n\n"
      "| shading | frame ms, median | p99 | CPU ms |\n|---|---|---|---|\n",
      static_cast<double>(counts.triangles) * 1e-6, static_cast<long long>(counts.blocks),
      static_cast<double>(counts.memory_bytes) * 1e-6, first_ms);
  viewer::Picture picture;
  frames(renderer, screen, content_mm, "Clay", picture);
  picture.is_moving = true;
  frames(renderer, screen, content_mm, "Clay in motion", picture);
  picture.is_moving = false;
  picture.has_wires = true;
  frames(renderer, screen, content_mm, "Clay with wires", picture);
  picture.has_wires = false;
  picture.shading = Shading::plain;
  frames(renderer, screen, content_mm, "Plain with occlusion", picture);
  picture.shading = Shading::curvature;
  frames(renderer, screen, content_mm, "Curvature", picture);

  std::vector<double> upload_ms;
  for (std::size_t n = 0; n + kDabBlocks <= blocks.size() && n < 50 * kDabBlocks; n += kDabBlocks)
    upload_ms.push_back(put_ms(renderer, std::span(blocks).subspan(n, kDabBlocks)));
  std::printf("\nupload of %zu blocks, as of a dab over 10 000 vertices: %.2f ms, p99 %.2f\n",
              kDabBlocks, quantile(upload_ms, 0.5), quantile(upload_ms, 0.99));
}

int run(int count, char** words) {
  std::vector<double> sizes;
  for (int n = 1; n < count; ++n) sizes.push_back(std::strtod(words[n], nullptr));
  if (sizes.empty()) sizes = {1.0, 4.0};
  if (!std::all_of(sizes.begin(), sizes.end(), [](double m) { return m > 0.0 && m <= 100.0; })) {
    std::fprintf(stderr, "usage: bench_frame [MILLIONS OF TRIANGLES...], each at most 100\n");
    return 2;
  }
  std::string why_not;
  const auto screen = test::Offscreen::make(kWidth, kHeight, why_not);
  if (screen == nullptr) stop(why_not);
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // each row as soon as it is known
  std::printf("%s, %d x %d\n", reinterpret_cast<const char*>(glGetString(GL_RENDERER)), kWidth,
              kHeight);
  for (const double millions : sizes) measure(*screen, millions);
  return 0;
}

}  // namespace
}  // namespace argil::bench

int main(int count, char** words) { return argil::bench::run(count, words); }
