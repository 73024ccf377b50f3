// SPDX-License-Identifier: GPL-3.0-or-later
// One heap-ordered front over a padded copy of the block. A node's value is the larger root of the
// upwind quadratic over its axes; a node that was taken from the heap is final. Ties go to the
// lower node index (it is part of the heap's key), so that no order of insertion shows in the bits.
#include "field/fast_march.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>

namespace argil {
namespace {

// Notation: T is the value of a node in its own sign's frame (|phi|, positive); a is the smaller of
// its two neighbours along an axis and b the node behind that, both in the same frame, so that they
// are negative across the surface. The block is copied into one with two walls around, so that no
// neighbour lookup needs a bounds check.

constexpr int kPad = 2;
constexpr float kNotKnown = std::numeric_limits<float>::max();
constexpr float kSmallestVoxels = 1e-3F;  ///< no solved node comes nearer to the surface than this
/// b is taken for a second-order difference only while it lies at most this many voxels below a: a
/// distance never falls faster than 1, so beyond it the data are no distance and b would overshoot.
constexpr float kSteepestVoxels = 1.25F;

using Index = std::int32_t;

/// Trial nodes by (value, index), smallest first: a 4-ary heap that knows where each node is. A key
/// holds the bits of the value, positive floats sort as their bits do, above the index.
class TrialHeap {
 public:
  static constexpr Index kOutside = -1;  ///< never pushed, or popped

  explicit TrialHeap(std::size_t nodes) : slot_(nodes, kOutside) {}

  bool empty() const noexcept { return keys_.empty(); }

  /// Inserts the node, or moves it to where its new value belongs, larger or smaller.
  void set(Index node, float value) {
    assert(value > 0.0F);  // or its bits would not sort as it does
    const std::uint64_t key = key_of(node, value);
    Index& slot = slot_[static_cast<std::size_t>(node)];
    if (slot == kOutside) {
      slot = static_cast<Index>(keys_.size());
      keys_.push_back(key);
      rise(static_cast<std::size_t>(slot), key);
    } else if (key < keys_[static_cast<std::size_t>(slot)]) {
      rise(static_cast<std::size_t>(slot), key);
    } else {
      sink(static_cast<std::size_t>(slot), key);
    }
  }

  float top_value() const noexcept {
    return std::bit_cast<float>(static_cast<std::uint32_t>(keys_[0] >> 32));
  }

  Index pop() {
    assert(!keys_.empty());
    const Index node = node_of(keys_[0]);
    slot_[static_cast<std::size_t>(node)] = kOutside;
    const std::uint64_t last = keys_.back();
    keys_.pop_back();
    if (!keys_.empty()) sink(0, last);
    return node;
  }

 private:
  static std::uint64_t key_of(Index node, float value) noexcept {
    return (static_cast<std::uint64_t>(std::bit_cast<std::uint32_t>(value)) << 32) |
           static_cast<std::uint32_t>(node);
  }
  static Index node_of(std::uint64_t key) noexcept {
    return static_cast<Index>(static_cast<std::uint32_t>(key));
  }
  void put(std::size_t at, std::uint64_t key) noexcept {
    keys_[at] = key;
    slot_[static_cast<std::size_t>(node_of(key))] = static_cast<Index>(at);
  }

  void rise(std::size_t at, std::uint64_t key) noexcept {
    while (at > 0) {
      const std::size_t parent = (at - 1) / 4;
      if (keys_[parent] < key) break;
      put(at, keys_[parent]);
      at = parent;
    }
    put(at, key);
  }

  void sink(std::size_t at, std::uint64_t key) noexcept {
    const std::size_t size = keys_.size();
    for (;;) {
      const std::size_t first = 4 * at + 1;
      if (first >= size) break;
      const std::size_t last = std::min(first + 4, size);
      std::size_t least = first;
      for (std::size_t c = first + 1; c < last; ++c) {
        if (keys_[c] < keys_[least]) least = c;
      }
      if (key < keys_[least]) break;
      put(at, keys_[least]);
      at = least;
    }
    put(at, key);
  }

  std::vector<std::uint64_t> keys_;
  std::vector<Index> slot_;
};

/// What one axis contributes to weight * (T - from)^2 summed over axes = voxel^2.
struct AxisTerm {
  float near = 0.0F;    ///< a: the axis counts only while T lies above it
  float from = 0.0F;    ///< a, or (4a - b) / 3 for the second-order difference
  float weight = 1.0F;  ///< 1, or (3/2)^2 for the second-order difference
};

/// The larger root of the sum over terms[0..count), or -max when it has none. Solved for the
/// difference to terms[0].from, so that large distances do not cancel.
float solve_terms(const std::array<AxisTerm, 3>& terms, int count, float voxel) noexcept {
  float a = 0.0F;
  float b = 0.0F;
  float c = -voxel * voxel;
  for (int i = 0; i < count; ++i) {
    const AxisTerm& term = terms[static_cast<std::size_t>(i)];
    const float d = term.from - terms[0].from;
    a += term.weight;
    b += term.weight * d;
    c += term.weight * d * d;
  }
  assert(count >= 1 && a > 0.0F);
  const float discriminant = b * b - a * c;
  if (discriminant < 0.0F) return -kNotKnown;
  return terms[0].from + (b + std::sqrt(discriminant)) / a;
}

class March {
 public:
  March(const MarchBlock& block, float limit);
  std::int64_t run();
  void write_back(MarchBlock& block) const;

 private:
  enum Kind : std::uint8_t { kClosed, kPositive, kNegative };  // wall or known; unknown by sign

  Index padded(int i, int j, int k) const noexcept {
    return static_cast<Index>((i + kPad) * stride_[0] + (j + kPad) * stride_[1] + (k + kPad));
  }
  float known(Index node) const noexcept { return known_[static_cast<std::size_t>(node)]; }
  bool is_open(Index node) const noexcept {
    return kind_[static_cast<std::size_t>(node)] != kClosed;
  }
  void seed(const MarchBlock& block);
  void update(Index node);
  bool axis_term(Index node, Index stride, float sign, AxisTerm& term) const noexcept;

  float voxel_;
  float limit_;
  std::array<Index, 3> stride_;
  std::vector<float> known_;  ///< signed value of fixed and solved nodes, else kNotKnown
  std::vector<std::uint8_t> kind_;
  TrialHeap trial_;
};

std::size_t padded_size(const std::array<int, 3>& n) noexcept {
  std::size_t size = 1;
  for (const int side : n) size *= static_cast<std::size_t>(side + 2 * kPad);
  assert(size <= static_cast<std::size_t>(std::numeric_limits<Index>::max()));
  return size;
}

/// Calls visit(i, j, k, index in the block) for every node in memory order.
template <class Visit>
void for_each_block_node(const std::array<int, 3>& n, const Visit& visit) {
  std::size_t at = 0;
  for (int i = 0; i < n[0]; ++i) {
    for (int j = 0; j < n[1]; ++j) {
      for (int k = 0; k < n[2]; ++k, ++at) visit(i, j, k, at);
    }
  }
}

March::March(const MarchBlock& block, float limit)
    : voxel_(block.voxel),
      limit_(limit),
      stride_{static_cast<Index>((block.n[1] + 2 * kPad) * (block.n[2] + 2 * kPad)),
              static_cast<Index>(block.n[2] + 2 * kPad), 1},
      known_(padded_size(block.n), kNotKnown),
      kind_(known_.size(), kClosed),
      trial_(known_.size()) {
  for_each_block_node(block.n, [&](int i, int j, int k, std::size_t at) {
    const auto node = static_cast<std::size_t>(padded(i, j, k));
    const float value = block.value[at];
    if (block.state[at] == MarchBlock::kFixed) known_[node] = value;
    if (block.state[at] == MarchBlock::kUnknown) kind_[node] = value < 0.0F ? kNegative : kPositive;
  });
  seed(block);
}

/// Every unknown node next to a fixed one becomes a trial node.
void March::seed(const MarchBlock& block) {
  for_each_block_node(block.n, [&](int i, int j, int k, std::size_t at) {
    if (block.state[at] == MarchBlock::kUnknown) update(padded(i, j, k));
  });
}

bool March::axis_term(Index node, Index stride, float sign, AxisTerm& term) const noexcept {
  const float low = known(node - stride);
  const float high = known(node + stride);
  if (low == kNotKnown && high == kNotKnown) return false;
  const bool take_low = high == kNotKnown || (low != kNotKnown && sign * low <= sign * high);
  const float a = sign * (take_low ? low : high);
  const float behind = known(take_low ? node - 2 * stride : node + 2 * stride);
  term = {a, a, 1.0F};
  if (behind == kNotKnown) return true;
  const float b = sign * behind;
  if (b <= a && a - b <= kSteepestVoxels * voxel_) term = {a, (4.0F * a - b) / 3.0F, 2.25F};
  return true;
}

/// Solves a trial node again from its known neighbours: upwind, so axes are dropped, the farthest
/// first, until the result lies above all that are left.
void March::update(Index node) {
  const float sign = kind_[static_cast<std::size_t>(node)] == kNegative ? -1.0F : 1.0F;
  std::array<AxisTerm, 3> terms;
  int count = 0;
  for (const Index stride : stride_) {
    AxisTerm term;
    if (!axis_term(node, stride, sign, term)) continue;
    int at = count++;
    for (; at > 0 && term.near < terms[static_cast<std::size_t>(at - 1)].near; --at) {
      terms[static_cast<std::size_t>(at)] = terms[static_cast<std::size_t>(at - 1)];
    }
    terms[static_cast<std::size_t>(at)] = term;
  }
  if (count == 0) return;
  float result = solve_terms(terms, count, voxel_);
  while (count > 1 && result < terms[static_cast<std::size_t>(count - 1)].near) {
    result = solve_terms(terms, --count, voxel_);
  }
  trial_.set(node, std::max(result, kSmallestVoxels * voxel_));
}

std::int64_t March::run() {
  std::int64_t solved = 0;
  while (!trial_.empty() && trial_.top_value() <= limit_) {
    const float value = trial_.top_value();
    const Index node = trial_.pop();
    auto& kind = kind_[static_cast<std::size_t>(node)];
    known_[static_cast<std::size_t>(node)] = kind == kNegative ? -value : value;
    kind = kClosed;
    ++solved;
    for (const Index stride : stride_) {
      if (is_open(node - stride)) update(node - stride);
      if (is_open(node + stride)) update(node + stride);
    }
  }
  return solved;
}

void March::write_back(MarchBlock& block) const {
  for_each_block_node(block.n, [&](int i, int j, int k, std::size_t at) {
    if (block.state[at] != MarchBlock::kUnknown) return;
    const float value = known(padded(i, j, k));
    const float unreached = block.value[at] < 0.0F ? -limit_ : limit_;
    block.value[at] = value == kNotKnown ? unreached : value;
  });
}

}  // namespace

std::int64_t fast_march(MarchBlock& block, float limit) {
  assert(block.voxel > 0.0F && limit > 0.0F);
  assert(block.value.size() == static_cast<std::size_t>(block.n[0]) *
                                   static_cast<std::size_t>(block.n[1]) *
                                   static_cast<std::size_t>(block.n[2]));
  assert(block.value.size() == block.state.size());
  March march(block, limit);
  const std::int64_t solved = march.run();
  march.write_back(block);
  return solved;
}

}  // namespace argil
