// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/vertex_table.h"

#include <bit>
#include <cassert>

namespace argil {

VertexTable::VertexTable(std::size_t keys) : slots_(std::bit_ceil(2 * keys + 2)) {}

void VertexTable::clear() {
  filled_ = 0;
  if (++round_ != 0) return;
  round_ = 1;  // after four billion blocks
  for (Slot& slot : slots_) slot.round = 0;
}

VertexTable::Slot& VertexTable::slot_of(std::uint64_t key) {
  assert(std::has_single_bit(slots_.size()));
  const std::size_t mask = slots_.size() - 1;
  std::size_t at = static_cast<std::size_t>((key * 0x9e3779b97f4a7c15ULL) >> 20) & mask;
  while (slots_[at].round == round_ && slots_[at].key != key) at = (at + 1) & mask;
  return slots_[at];
}

std::uint32_t VertexTable::find_or_insert(std::uint64_t key, std::uint32_t fresh) {
  if (2 * (filled_ + 1) > slots_.size()) grow();
  Slot& slot = slot_of(key);
  if (slot.round != round_) {
    slot = {key, fresh, round_};
    ++filled_;
  }
  return slot.vertex;
}

void VertexTable::grow() {
  std::vector<Slot> old(2 * slots_.size());
  slots_.swap(old);
  for (const Slot& slot : old) {
    if (slot.round == round_) slot_of(slot.key) = slot;
  }
}

}  // namespace argil
