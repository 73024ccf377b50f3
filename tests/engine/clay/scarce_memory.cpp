// SPDX-License-Identifier: GPL-3.0-or-later
// Each reservation of a stroke, an undo and a redo fails once: the clay is as it was, and works on.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <new>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "argil/engine/clay.h"

#include "support/effort.h"

namespace {

/// Reservations of this thread until one fails; none does while it is negative.
thread_local std::int64_t t_until_failure = -1;

}  // namespace

// Not inlined, or GCC takes one half of the pair for a mismatch of the other. What the libraries
// reserve by it is this one too.
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (t_until_failure >= 0 && t_until_failure-- == 0) throw std::bad_alloc();
  void* memory = std::malloc(size > 0 ? size : 1);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace argil {
namespace {

/// Two dabs and their images on a ball of 8 mm.
Stroke small_stroke(Action action) {
  Stroke stroke;
  stroke.tool = {action, Shape::ball, {2.0, 2.0, 2.0}, 1.0};
  stroke.mirror.x = true;
  stroke.samples = {{0.0, {3.0, 7.4, 0.0}, {}, 1.0}, {0.1, {2.4, 7.5, 0.3}, {}, 1.0}};
  return stroke;
}

/// Does `work` again and again, each time with a later reservation that fails, until none does.
/// After each failure `is_as_before` has to hold; where the work was done without what failed,
/// `take_back` takes it back. Returns how many failed.
template <class Work, class TakeBack, class AsBefore>
int fail_each(const Work& work, const TakeBack& take_back, const AsBefore& is_as_before) {
  const bool is_thorough = test::effort(false, true);
  int failures = 0;
  for (std::int64_t n = 0;; n += is_thorough ? 1 : 1 + n / 20) {
    t_until_failure = n;
    const bool is_done = work();
    const bool has_failed = t_until_failure < 0;
    t_until_failure = -1;
    if (!has_failed) {
      EXPECT_TRUE(is_done) << "with all memory";
      return failures;
    }
    ++failures;
    if (is_done) take_back();
    if (!is_as_before()) {
      ADD_FAILURE() << "reservation " << n;
      return failures;
    }
  }
}

TEST(ScarceMemory, LeavesTheClayAsItWasWhereverAStrokeFails) {
  const tbb::global_control alone(tbb::global_control::max_allowed_parallelism, 1);
  for (const Action action : {Action::carve, Action::add, Action::smooth, Action::inflate,
                              Action::crease, Action::grab, Action::layer}) {
    Clay clay = Clay::ball(8.0, {.voxel_mm = 0.4}).value();
    const std::uint64_t before = clay.hash();
    const Stroke stroke = small_stroke(action);
    const auto is_as_before = [&] {
      return clay.hash() == before && clay.undo_depth() == 0 && !clay.is_stroke_open() &&
             clay.validate().empty();
    };
    const int failures =
        fail_each([&] { return clay.apply(stroke).ok(); }, [&] { clay.undo(); }, is_as_before);
    std::printf("action %d: %d failures\n", static_cast<int>(action), failures);
    EXPECT_GT(failures, 50);
    EXPECT_NE(clay.hash(), before);
    Clay once = Clay::ball(8.0, {.voxel_mm = 0.4}).value();
    ASSERT_TRUE(once.apply(stroke).ok());
    EXPECT_EQ(clay.hash(), once.hash()) << static_cast<int>(action);
    EXPECT_EQ(clay.undo_depth(), 1);
  }
}

TEST(ScarceMemory, LeavesTheClayAsItWasWhereverUndoAndRedoFail) {
  const tbb::global_control alone(tbb::global_control::max_allowed_parallelism, 1);
  Clay clay = Clay::ball(8.0, {.voxel_mm = 0.4}).value();
  const std::uint64_t before = clay.hash();
  ASSERT_TRUE(clay.apply(small_stroke(Action::carve)).ok());
  const std::uint64_t after = clay.hash();
  const auto is_now = [&](std::uint64_t hash, int depth) {
    return clay.hash() == hash && clay.undo_depth() == depth && clay.validate().empty();
  };
  const auto without_throwing = [](const auto& work) {
    try {
      return work();
    } catch (const std::bad_alloc&) {
      return false;
    }
  };
  const auto undo = [&] { return without_throwing([&] { return clay.undo(); }); };
  const auto redo = [&] { return without_throwing([&] { return clay.redo(); }); };
  EXPECT_GT(fail_each(undo, redo, [&] { return is_now(after, 1); }), 2);
  EXPECT_TRUE(is_now(before, 0));
  EXPECT_GT(fail_each(redo, undo, [&] { return is_now(before, 0); }), 2);
  EXPECT_TRUE(is_now(after, 1));
}

}  // namespace
}  // namespace argil
