// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <openvdb/openvdb.h>

#include "argil/engine/storage.h"

namespace argil::io {

using VdbGrid = openvdb::FloatGrid;
using VdbTree = openvdb::FloatTree;
using VdbRoot = VdbTree::RootNodeType;
using VdbUpperNode = VdbRoot::ChildNodeType;
using VdbLowerNode = VdbUpperNode::ChildNodeType;
using VdbLeaf = VdbTree::LeafNodeType;
using openvdb::Coord;

inline Coord coord_of(const NodeCoord& node) noexcept { return {node[0], node[1], node[2]}; }
inline NodeCoord node_coord(const Coord& node) noexcept { return {node.x(), node.y(), node.z()}; }

}  // namespace argil::io

// The code of the tree is compiled once, in vdb_tree.cpp: left to every source that touches a grid
// it would be most of their compile time.
extern template class openvdb::Grid<argil::io::VdbTree>;
extern template class openvdb::tree::Tree<argil::io::VdbRoot>;
extern template class openvdb::tree::InternalNode<argil::io::VdbLowerNode, 5>;
extern template class openvdb::tree::InternalNode<argil::io::VdbLeaf, 4>;
