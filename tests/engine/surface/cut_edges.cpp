// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/cut_edges.h"

#include <random>
#include <set>

#include <gtest/gtest.h>

namespace argil {
namespace {

bool is_inside(const InsideRows& rows, const Coord& node) {
  return (rows[static_cast<std::size_t>(node.x())][static_cast<std::size_t>(node.y())] >> node.z() &
          1) != 0;
}

/// An edge with its low node on a face of the leaf, along another axis than its own.
bool is_on_face(const Coord& low, int axis) {
  for (int a = 0; a < 3; ++a) {
    if (a != axis && (low[a] == 0 || low[a] == kLeafSide)) return true;
  }
  return false;
}

TEST(CutEdges, AreThoseOfTheCellsEachOnce) {
  std::mt19937 dice(2);
  CutEdges edges;
  for (int round = 0; round < 40; ++round) {
    InsideRows rows{};
    CellRows cells{};
    for (auto& plane : rows) {
      for (std::uint16_t& row : plane) row = static_cast<std::uint16_t>(dice() & 0x1ff);
    }
    for (std::uint8_t& row : cells) row = static_cast<std::uint8_t>(dice() & dice());
    const bool is_shared = round % 2 == 0;
    edges.forget_vertices();
    edges.number(rows, cells, is_shared);
    std::set<std::size_t> expected;
    for (int n = 0; n < kLeafNodes; ++n) {
      const Coord cell(n >> 6, n >> 3 & 7, n & 7);
      if ((cells[static_cast<std::size_t>(n >> 3)] >> (n & 7) & 1) == 0) continue;
      for (int edge = 0; edge < 12; ++edge) {
        const int axis = edge / 4;
        Coord low = cell;
        low[(axis + 1) % 3] += edge & 1;
        low[(axis + 2) % 3] += edge >> 1 & 1;
        Coord high = low;
        ++high[axis];
        if (is_inside(rows, low) == is_inside(rows, high)) continue;
        expected.insert(edge_slot(low.x(), low.y(), low.z(), axis));
      }
    }
    ASSERT_EQ(static_cast<std::size_t>(edges.count()), expected.size());
    for (int n = 0; n < edges.count(); ++n) {
      const unsigned code = edges.codes()[n];
      const Coord low = CutEdges::low_of(code);
      const int axis = CutEdges::axis_of(code);
      const std::size_t slot = edge_slot(low.x(), low.y(), low.z(), axis);
      ASSERT_EQ(expected.count(slot), 1U) << low << ' ' << axis;
      ASSERT_EQ(edges.vertex(slot), static_cast<std::uint32_t>(n));
      ASSERT_EQ((code & CutJob::kIsShared) != 0, is_shared || is_on_face(low, axis));
    }
    const int before = edges.count();
    const Coord known = CutEdges::low_of(edges.codes()[0]);
    EXPECT_EQ(edges.find_or_add(known, CutEdges::axis_of(edges.codes()[0])), 0U);
    EXPECT_EQ(edges.count(), before);
  }
}

TEST(CutEdges, AddsWhatACellBesideAFinerOneAsksFor) {
  CutEdges edges;
  edges.forget_vertices();
  edges.number({}, {}, true);
  EXPECT_EQ(edges.count(), 0);
  EXPECT_EQ(edges.find_or_add({8, 8, 7}, 2), 0U);
  EXPECT_EQ(edges.find_or_add({0, 3, 8}, 0), 1U);
  EXPECT_EQ(edges.find_or_add({8, 8, 7}, 2), 0U);
  ASSERT_EQ(edges.count(), 2);
  EXPECT_EQ(CutEdges::low_of(edges.codes()[1]), Coord(0, 3, 8));
  EXPECT_NE(edges.codes()[1] & CutJob::kIsShared, 0U);
}

}  // namespace
}  // namespace argil
