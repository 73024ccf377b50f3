// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <openvdb/openvdb.h>

namespace argil {

using VdbGrid = openvdb::FloatGrid;
using VdbTree = openvdb::FloatTree;
using VdbRoot = VdbTree::RootNodeType;
using VdbUpperNode = VdbRoot::ChildNodeType;
using VdbLowerNode = VdbUpperNode::ChildNodeType;
using VdbLeaf = VdbTree::LeafNodeType;
using openvdb::Coord;

}  // namespace argil

// The code of the tree is compiled once, in vdb.cpp: left to every source that touches a level it
// took half of the engine's compile time.
extern template class openvdb::Grid<argil::VdbTree>;
extern template class openvdb::tree::Tree<argil::VdbRoot>;
extern template class openvdb::tree::InternalNode<argil::VdbLowerNode, 5>;
extern template class openvdb::tree::InternalNode<argil::VdbLeaf, 4>;
