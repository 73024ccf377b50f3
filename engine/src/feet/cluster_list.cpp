// SPDX-License-Identifier: GPL-3.0-or-later
#include "feet/cluster_list.h"

#include <cassert>
#include <limits>

#include "feet/layer_feet.h"

namespace argil {
namespace {

constexpr float kUnsure = std::numeric_limits<float>::infinity();

}  // namespace

void ClusterList::append(const LayerCluster& cluster, const ClusterBoxes& feet, std::size_t n) {
  assert(n < ClusterBoxes::kClusters && cluster.count % kRowNodes == 0);
  reserve(clusters_ + 1);
  of_[clusters_] = cluster;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    low_[axis][clusters_] = feet.low[axis][n] + cluster.offset[axis];
    high_[axis][clusters_] = feet.high[axis][n] + cluster.offset[axis];
  }
  unsure_[clusters_] = 0.0F;
  count_ += static_cast<std::size_t>(cluster.count);
  ++clusters_;
}

void ClusterList::set_last_unsure() noexcept {
  assert(clusters_ > 0);
  unsure_[clusters_ - 1] = kUnsure;
}

/// Room for so many clusters and those that fill the last vector.
void ClusterList::reserve(std::size_t clusters) {
  const std::size_t needed = clusters + kRowNodes;
  if (of_.size() >= needed) return;
  of_.resize(2 * needed);
  for (auto& values : low_) values.resize(2 * needed);
  for (auto& values : high_) values.resize(2 * needed);
  unsure_.resize(2 * needed);
  nearness_.resize(2 * needed);
}

/// Fills the last eight clusters up, and makes room for what lower_to_layer() keeps.
void ClusterList::close() {
  reserve(clusters_);
  const std::size_t filled = (clusters_ + kRowNodes - 1) / kRowNodes * kRowNodes;
  for (std::size_t n = clusters_; n < filled; ++n) {
    for (auto& values : low_) values[n] = kNowhere;
    for (auto& values : high_) values[n] = kNowhere;
    unsure_[n] = kUnsure;
  }
  const std::size_t needed = count_ + kRowNodes;
  if (which_.size() >= needed) return;
  which_.resize(2 * needed);
  chosen_.resize(2 * needed);
  for (auto& values : kept_) values.resize(2 * needed);
}

LayerJob ClusterList::job_for(const std::array<float, 3>& first, float step, float layer,
                              float patch, std::uint64_t& labels) {
  assert(!is_empty() && step > 0.0F && layer >= 0.0F);
  LayerJob job{};
  job.cluster = of_.data();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    job.low[axis] = low_[axis].data();
    job.high[axis] = high_[axis].data();
    job.first[axis] = first[axis];
    job.kept[axis] = kept_[axis].data();
  }
  job.unsure = unsure_.data();
  job.clusters = static_cast<int>((clusters_ + kRowNodes - 1) / kRowNodes * kRowNodes);
  job.step = step;
  job.layer = layer;
  job.patch = patch;
  job.which = which_.data();
  job.chosen = chosen_.data();
  job.nearness = nearness_.data();
  job.labels = &labels;
  return job;
}

}  // namespace argil
