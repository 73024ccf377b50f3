// SPDX-License-Identifier: GPL-3.0-or-later
// A hash table with open addressing over the positions themselves: four bytes a slot, at most two
// thirds full.
#include "argil/mesh/point_welder.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>

namespace argil::mesh {
namespace {

constexpr std::uint32_t kFree = std::numeric_limits<std::uint32_t>::max();

std::uint64_t mixed(std::uint64_t value) noexcept {
  value ^= value >> 32;
  // 2^64 over the golden ratio (D. Knuth, The Art of Computer Programming 3, 6.4). The shifts bring
  // the high bits down: coordinates of few digits differ only there.
  value *= 0x9E3779B97F4A7C15ULL;
  return value ^ (value >> 29);
}

std::uint64_t hash_of(const Vec3& p) noexcept {
  std::uint64_t hash = mixed(std::bit_cast<std::uint64_t>(p.x));
  hash = mixed(hash + std::bit_cast<std::uint64_t>(p.y));
  return mixed(hash + std::bit_cast<std::uint64_t>(p.z));
}

}  // namespace

void PointWelder::grow() {
  constexpr std::size_t kFewest = 64;
  slots_.assign(std::max(kFewest, 2 * slots_.size()), kFree);
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    std::size_t slot = hash_of(positions_[i]) & mask;
    while (slots_[slot] != kFree) slot = (slot + 1) & mask;
    slots_[slot] = static_cast<std::uint32_t>(i);
  }
}

std::uint32_t PointWelder::add(const Vec3& point) {
  if (3 * positions_.size() >= 2 * slots_.size()) grow();
  const Vec3 key = point + Vec3{};  // -0 + 0 is +0
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = hash_of(key) & mask;
  while (slots_[slot] != kFree) {
    if (positions_[slots_[slot]] == key) return slots_[slot];
    slot = (slot + 1) & mask;
  }
  assert(positions_.size() < kFree && 3 * positions_.size() < 2 * slots_.size());
  slots_[slot] = static_cast<std::uint32_t>(positions_.size());
  positions_.push_back(key);
  return slots_[slot];
}

}  // namespace argil::mesh
