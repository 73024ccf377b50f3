// SPDX-License-Identifier: GPL-3.0-or-later
// Hours of sculpting in miniature. ARGIL_SESSION_STROKES says how many strokes the long one takes
// (3000).
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <random>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <malloc.h>

#include "argil/io/export.h"
#include "argil/io/project_file.h"
#include "argil/io/session.h"

#include "support/scratch.h"

namespace argil::io {
namespace {

namespace fs = std::filesystem;

/// Memory that this process holds of its heap, in MB. Not its resident pages: the system takes
/// those back and gives them again as it likes, and both would look like memory that changed.
double used_mb() {
  const struct mallinfo2 info = ::mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd) / 1e6;
}

int open_handles() {
  int handles = 0;
  for (const auto& entry : fs::directory_iterator("/proc/self/fd")) {
    handles += entry.path().empty() ? 0 : 1;
  }
  return handles;
}

/// Small strokes all over a ball, adding about as much as they take away, so that what the clay
/// needs does not grow.
Stroke small_stroke(int n) {
  std::mt19937 random(static_cast<unsigned>(n));
  const auto uniform = [&] { return static_cast<double>(random()) / 2147483648.0 - 1.0; };
  Vec3 at{uniform(), uniform(), uniform()};
  at = at * (10.0 / std::max(length(at), 0.1));
  Stroke stroke;
  constexpr Action kActions[] = {Action::add, Action::smooth, Action::carve, Action::smooth};
  stroke.tool.action = kActions[n % 4];
  const double radius = 1.0 + 0.5 * uniform();
  stroke.tool.radii_mm = {radius, radius, radius};
  stroke.tool.strength = 0.7;
  stroke.spacing = 0.5;
  stroke.samples = {{0.0, at, {}, 1.0},
                    {0.1, at + Vec3{uniform(), uniform(), uniform()} * 0.5, {}, 1.0}};
  return stroke;
}

/// `undo_bytes` are reached in the first half.
void expect_flat_and_printable(int strokes, std::int64_t undo_bytes) {
  const test::ScratchFolder folder;
  SessionOptions options;
  options.autosave_steps = std::max(strokes / 40, 1);
  options.limits.undo_bytes = undo_bytes;
  auto created =
      Session::create(folder / "piece.vdb", Clay::ball(10.0, {0.5, 0.1}).value(), options);
  ASSERT_TRUE(created) << created.error().message;
  Session& session = created.value();
  std::array<double, 8> most_mb{};  // of each eighth
  int half_handles = 0;
  for (int n = 0; n < strokes; ++n) {
    ScriptStep step = small_stroke(n);
    if (n % 50 == 49) step = HistoryStep::undo;
    const auto done = apply_step(session.sculpture(), step);
    ASSERT_TRUE(done) << done.error().message;
    session.record(step);
    if (n % std::max(strokes / 8, 1) == 0) {
      ASSERT_TRUE(session.save());
    }
    if (n == strokes / 2) half_handles = open_handles();
    // What is being written is held until it is, which takes as long as the machine likes.
    if (n % 4 == 3) {
      ASSERT_TRUE(session.flush());
      auto& most = most_mb.at(static_cast<std::size_t>(8L * n / strokes));
      most = std::max(most, used_mb());
    }
  }
  ASSERT_TRUE(session.flush());
  ASSERT_TRUE(session.problem());
  const int end_handles = open_handles();
  std::printf("%d strokes, handles %d then %d, MB in each eighth:", strokes, half_handles,
              end_handles);
  for (const double most : most_mb) std::printf(" %.1f", most);
  std::printf("\n");
#ifndef __SANITIZE_ADDRESS__  // its heap is not the one that mallinfo2 tells of
  // That it takes less for a while, as on a busy machine, is no growth.
  const double third = std::max(most_mb[4], most_mb[5]);
  const double last = std::max(most_mb[6], most_mb[7]);
  constexpr double kOfUndoMb = 2.0;  // at what moment the oldest steps are let go
  EXPECT_LE(last, third + kOfUndoMb) << "from the third quarter to the last";
#endif
  // An autosave that is running at one of the two moments has a file open.
  EXPECT_NEAR(end_handles, half_handles, 1);
  EXPECT_THAT(session.clay().validate(), testing::IsEmpty());
  const std::uint64_t hash = session.clay().hash();
  ASSERT_TRUE(session.close());
  const auto clay = load_project(folder / "piece.vdb");
  ASSERT_TRUE(clay) << clay.error().message;
  EXPECT_EQ(clay.value().hash(), hash);
  const auto report = export_mesh(folder / "piece.stl", clay.value());
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_TRUE(report.value().verdict.printable);
}

TEST(LongSession, KeepsMemoryFlatAndTheClayPrintable) { expect_flat_and_printable(150, 1 << 20); }

/// What the clay and its steps need grows for some 1500 strokes, from 15 MB to 26.
TEST(LongSessionSlow, KeepsMemoryFlatAndTheClayPrintable) {
  const char* asked = std::getenv("ARGIL_SESSION_STROKES");
  expect_flat_and_printable(asked != nullptr ? std::atoi(asked) : 3000, 4 << 20);
}

}  // namespace
}  // namespace argil::io
