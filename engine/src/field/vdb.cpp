// SPDX-License-Identifier: GPL-3.0-or-later
#include "field/vdb.h"

template class openvdb::Grid<argil::VdbTree>;
template class openvdb::tree::Tree<argil::VdbRoot>;
template class openvdb::tree::InternalNode<argil::VdbLowerNode, 5>;
template class openvdb::tree::InternalNode<argil::VdbLeaf, 4>;
