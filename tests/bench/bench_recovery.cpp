// SPDX-License-Identifier: GPL-3.0-or-later
// What keeping an operation safe costs, and what repeating it after a kill costs: a ball with
// detail everywhere, each operation recorded by a session, with the line alone and with the
// autosave that follows what is slow. Prints a markdown table; one run each, since each takes
// seconds. Argument: the number of surface vertices, default 500 000.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <string>
#include <thread>

#include "argil/engine/operation.h"
#include "argil/io/project_file.h"
#include "argil/io/session.h"

#include "bench/clock.h"
#include "support/bumpy_clay.h"
#include "support/scratch.h"
#include "support/shapes.h"

namespace {

using namespace argil;

constexpr double kVoxelMm = 0.25;
constexpr double kVerticesPerSquareVoxel = 1.5;

struct Took {
  double wall = 0.0;
  double cpu = 0.0;
};

template <class Work>
Took took(const Work& work) {
  const double wall = 1e-3 * bench::wall_ms();
  const double cpu = 1e-3 * bench::process_cpu_ms();
  work();
  return {1e-3 * bench::wall_ms() - wall, 1e-3 * bench::process_cpu_ms() - cpu};
}

[[noreturn]] void fail(const std::string& why) {
  std::fprintf(stderr, "%s\n", why.c_str());
  std::exit(1);  // NOLINT(concurrency-mt-unsafe): nothing else runs
}

io::Session opened(const std::filesystem::path& file, int autosave_steps) {
  io::SessionOptions options;
  options.autosave_steps = autosave_steps;
  auto session = io::Session::open(file, options);
  if (!session) fail(session.error().message);
  return std::move(session).value();
}

/// The project is as before afterwards.
void row(const test::ScratchFolder& folder, const char* name, const io::ScriptStep& step) {
  const std::filesystem::path project = folder / "piece.vdb";
  Took work, record, safe, recover;
  {
    io::Session session = opened(project, 0);
    work = took([&] {
      if (auto done = io::apply_step(session.sculpture(), step); !done) fail(done.error().message);
    });
    record = took([&] { session.record(step); });
    safe = took([&] {
      if (auto done = session.flush(); !done) fail(done.error().message);
    });
  }
  recover = took([&] {
    if (auto read = io::open_project(project); !read) fail(read.error().message);
  });
  std::filesystem::remove(folder / "piece.journal.jsonl");
  Took pause, from_autosave;
  {
    io::Session session = opened(project, 500);
    if (auto done = io::apply_step(session.sculpture(), step); !done) fail(done.error().message);
    pause = took([&] { session.record(step); });
    for (int n = 0; n < 600 && !std::filesystem::exists(folder / ".piece.autosave.vdb"); ++n) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    from_autosave = took([&] {
      if (auto read = io::open_project(project); !read) fail(read.error().message);
    });
    if (auto gone = session.discard(); !gone) fail(gone.error().message);
  }
  std::printf("| %s | %.2f | %.2f | %.1f | %.1f | %.2f | %.1f | %.2f |\n", name, work.wall,
              work.cpu, 1e3 * record.wall, 1e3 * (record.wall + safe.wall), recover.wall,
              1e3 * pause.wall, from_autosave.wall);
  std::fflush(stdout);
}

void stroke_row(const test::ScratchFolder& folder) {
  Stroke stroke;
  for (int n = 0; n < 1000; ++n) {
    stroke.samples.push_back(
        {1e-3 * n, {0.1 / 3.0 * n, 1.0 / 7.0, 500.0}, normalized(Quat{1.0, 0.1, 0.2, 0.3}), 0.7});
  }
  io::Session session = opened(folder / "piece.vdb", 0);
  const Took record = took([&] { session.record(stroke); });
  std::printf("record() of a stroke of 1000 samples: %.2f ms\n\n", 1e3 * record.wall);
  if (auto gone = session.discard(); !gone) fail(gone.error().message);
}

}  // namespace

int main(int argc, char** argv) {
  const double vertices = argc > 1 ? std::atof(argv[1]) : 500'000.0;
  const double radius =
      kVoxelMm * std::sqrt(vertices / kVerticesPerSquareVoxel / (4.0 * std::numbers::pi));
  const test::ScratchFolder folder;
  {
    const auto clay = test::bumpy_ball(radius, kVoxelMm);
    if (!clay) fail(clay.error().message);
    if (auto saved = io::save_project(folder / "piece.vdb", clay.value()); !saved) {
      fail(saved.error().message);
    }
  }
  stroke_row(folder);
  std::printf(
      "| operation | takes s | CPU s | record ms | safe after ms | repeat s | record with autosave "
      "ms | open from autosave s |\n|---|---|---|---|---|---|---|---|\n");
  const Vec3 top{0.0, 0.0, radius};
  Combine with;
  with.kind = CombineKind::subtract;
  with.placement.position_mm = top;
  row(folder, "cut off a cap", Operation(Cut{top * 0.8, top, false}));
  row(folder, "resample to 1.3 voxels", Operation(Resample{1.3 * kVoxelMm}));
  with.mesh = std::make_shared<const TriangleMesh>(test::ball_mesh(0.3 * radius, 5));
  row(folder, "difference with a mesh of 8192 triangles", Operation(with));
  with.mesh.reset();
  with.clay = std::make_shared<const Clay>(test::bumpy_ball(0.3 * radius, kVoxelMm).value());
  row(folder, "difference with a clay", Operation(with));
  row(folder, "offset by 2 voxels", Operation(Offset{2.0 * kVoxelMm}));
  row(folder, "hollow, a wall of 8 voxels", Operation(Hollow{8.0 * kVoxelMm, {}}));
  return 0;
}
