// SPDX-License-Identifier: GPL-3.0-or-later
// A source of its own, in C++17: as C++20, GridTransformer.h is refused by Debian 12's oneTBB.
#include "rivals/openvdb_turned.h"

#include <openvdb/tools/GridTransformer.h>

namespace argil::evaluation {

openvdb::FloatGrid::Ptr transformed_to(const openvdb::math::Transform& to,
                                       const openvdb::FloatGrid& levels) {
  auto on_lattice = openvdb::FloatGrid::create(levels.background());
  on_lattice->setTransform(to.copy());
  on_lattice->setGridClass(openvdb::GRID_LEVEL_SET);
  openvdb::util::NullInterrupter interrupter;
  openvdb::tools::doResampleToMatch<openvdb::tools::BoxSampler>(levels, *on_lattice, interrupter);
  return on_lattice;
}

}  // namespace argil::evaluation
