// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "vdb/vdb_tree.h"

namespace argil::io {

/// Makes an OpenVDB tree of what it is handed.
class VdbTreeSink final : public LevelSink {
 public:
  explicit VdbTreeSink(VdbTree& tree) : tree_(tree) {}

  void add_tile(const NodeCoord& origin, float value, bool is_active) override;
  void add_branch(const StoredBranch& branch) override;
  std::vector<float*> add_leaves(std::span<const StoredLeaf> leaves) override;
  void leaf_is_filled(std::size_t) override {}

 private:
  template <class Node>
  std::unique_ptr<Node> node_of(const StoredBranch& branch) const;

  VdbTree& tree_;
};

}  // namespace argil::io
