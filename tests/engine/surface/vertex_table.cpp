// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/vertex_table.h"

#include <gtest/gtest.h>

namespace argil {
namespace {

TEST(VertexTable, GrowsAndForgets) {
  VertexTable table(2);
  for (std::uint32_t round = 0; round < 3; ++round) {
    for (std::uint32_t n = 0; n < 1000; ++n) {
      const std::uint64_t key = std::uint64_t{n} << 40 | n;
      ASSERT_EQ(table.find_or_insert(key, n + round), n + round);
      ASSERT_EQ(table.find_or_insert(key, 77777), n + round);
    }
    table.clear();
  }
}

}  // namespace
}  // namespace argil
