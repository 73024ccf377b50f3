// SPDX-License-Identifier: GPL-3.0-or-later
#include "repair/library_call.h"

#include <new>
#include <stdexcept>

#include <gtest/gtest.h>

namespace argil::mesh {
namespace {

TEST(LibraryCall, SaysWhetherALibraryDidIt) {
  int done = 0;
  EXPECT_TRUE(is_done_by_library([&] { ++done; }));
  EXPECT_EQ(done, 1);
  EXPECT_FALSE(is_done_by_library([] { throw std::logic_error("precondition violated"); }));
}

TEST(LibraryCall, LeavesMemoryAndInterruptsToOthers) {
  EXPECT_THROW(is_done_by_library([] { throw std::bad_alloc(); }), std::bad_alloc);
  EXPECT_THROW(is_done_by_library([] { throw Interrupted(); }), Interrupted);
}

}  // namespace
}  // namespace argil::mesh
