// SPDX-License-Identifier: GPL-3.0-or-later
#include "vdb/vdb_tree.h"

template class openvdb::Grid<argil::io::VdbTree>;
template class openvdb::tree::Tree<argil::io::VdbRoot>;
template class openvdb::tree::InternalNode<argil::io::VdbLowerNode, 5>;
template class openvdb::tree::InternalNode<argil::io::VdbLeaf, 4>;
