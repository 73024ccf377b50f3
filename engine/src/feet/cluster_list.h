// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "rows/rows.h"

namespace argil {

/// Clusters of feet of one layer and the memory that RowLoops::lower_to_layer takes, kept for the
/// next ones. For one thread.
class ClusterList {
 public:
  void clear() noexcept {
    clusters_ = 0;
    count_ = 0;
  }
  bool is_empty() const noexcept { return clusters_ == 0; }
  std::size_t size() const noexcept { return clusters_; }
  LayerCluster& cluster(std::size_t n) noexcept { return of_[n]; }

  /// `n` of the boxes around its feet, seen as `cluster.offset` says.
  void append(const LayerCluster& cluster, const ClusterBoxes& feet, std::size_t n);
  /// Some feet of the last one are nowhere.
  void set_last_unsure() noexcept;
  /// To be called after the last append().
  void close();

  /// What a block from the node `first` asks of them, the layer being `layer` from the surface and
  /// feet `patch` around theirs; the rest as LayerJob has it. Refers to this and to `labels`.
  LayerJob job_for(const std::array<float, 3>& first, float step, float layer, float patch,
                   std::uint64_t& labels);

 private:
  void reserve(std::size_t clusters);

  std::size_t count_ = 0;     ///< feet
  std::size_t clusters_ = 0;  ///< theirs
  std::vector<LayerCluster> of_;
  std::array<std::vector<float>, 3> low_;  ///< of their boxes
  std::array<std::vector<float>, 3> high_;
  std::vector<float> unsure_;
  std::array<std::vector<float>, 3> kept_;
  std::vector<int> which_;
  std::vector<int> chosen_;
  std::vector<float> nearness_;
};

}  // namespace argil
