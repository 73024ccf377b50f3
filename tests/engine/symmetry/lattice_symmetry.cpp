// SPDX-License-Identifier: GPL-3.0-or-later
#include "symmetry/lattice_symmetry.h"

#include <gtest/gtest.h>

namespace argil {
namespace {

TEST(LatticeSymmetry, ClosesOverItsMirrorsAndTurns) {
  EXPECT_TRUE(LatticeSymmetry({}, {5, 2}).is_none());
  EXPECT_EQ(LatticeSymmetry({}, {6, 0}).maps().size(), 2U);
  EXPECT_EQ(LatticeSymmetry({}, {4, 2}).maps().size(), 4U);
  EXPECT_EQ(LatticeSymmetry({true, true, true}, {}).maps().size(), 8U);
  EXPECT_EQ(LatticeSymmetry({true, false, false}, {4, 0}).maps().size(), 8U);
  EXPECT_EQ(LatticeSymmetry({true, false, false}, {4, 2}).maps().size(), 8U);
}

TEST(LatticeSymmetry, TakesPlacesOfCellsToPlacesOfCells) {
  const LatticeSymmetry mirror({true, false, false}, {});
  EXPECT_EQ(mirror.representative_leaf(Coord(-8, 16, 0)), Coord(0, 16, 0));
  EXPECT_EQ(mirror.representative_node(Coord(-8, 16, 0)), Coord(8, 16, 0));
  EXPECT_FALSE(mirror.is_representative_leaf(Coord(-8, 16, 0)));
  EXPECT_TRUE(mirror.is_representative_leaf(Coord(0, 16, 0)));
  EXPECT_FALSE(mirror.is_representative_node(Coord(-8, 16, 0)));
  EXPECT_TRUE(mirror.is_representative_node(Coord(8, 16, 0)));
  const LatticeSymmetry quarter({}, {4, 2});
  EXPECT_EQ(quarter.maps()[1].node(Coord(3, 1, 7)), Coord(-1, 3, 7));
  EXPECT_EQ(quarter.maps()[1].leaf(Coord(8, 0, 0)), Coord(-8, 8, 0));
}

}  // namespace
}  // namespace argil
