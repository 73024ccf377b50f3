// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/mesh_mirror.h"

#include <cassert>
#include <utility>

namespace argil::haptics {
namespace {

/// Encoded once for all readers.
MeshBytes shared(const MeshMessage& message) {
  return std::make_shared<const std::vector<std::byte>>(encode(message));
}

}  // namespace

MeshMirror::Waiting& MeshMirror::join() {
  const std::lock_guard lock(mutex_);
  Waiting& waiting = readers_.emplace_back();
  waiting.is_behind = mark_.sequence > 0;
  waiting.is_untold = note_.has_value();
  for (const auto& [id, held] : blocks_) waiting.blocks.insert(waiting.blocks.end(), id);
  return waiting;
}

void MeshMirror::leave(const Waiting& waiting) {
  const std::lock_guard lock(mutex_);
  readers_.remove_if([&](const Waiting& one) { return &one == &waiting; });
}

/// Takes a block out of the mirror and of its sums.
void MeshMirror::forget(const MeshBlockId& id) {
  const auto found = blocks_.find(id);
  if (found == blocks_.end()) return;
  assert(mark_.blocks > 0 && bytes_ >= found->second.message->size());
  --mark_.blocks;
  mark_.vertices -= found->second.vertices;
  mark_.triangles -= found->second.triangles;
  bytes_ -= found->second.message->size();
  blocks_.erase(found);
}

void MeshMirror::publish(std::vector<MeshBlock> changed, std::span<const MeshBlockId> gone) {
  if (changed.empty() && gone.empty()) return;
  const std::uint64_t sequence = updates() + 1;
  std::vector<std::pair<MeshBlockId, Held>> encoded;  // before the lock: it is most of the work
  encoded.reserve(changed.size());
  for (MeshBlock& block : changed) {
    block.sequence = sequence;
    const Held held{nullptr, block.positions_mm.size(), block.triangles.size()};
    encoded.emplace_back(block.id, held);
    encoded.back().second.message = shared(std::move(block));
  }
  const std::lock_guard lock(mutex_);
  assert(sequence > mark_.sequence);  // one thread publishes
  mark_.sequence = sequence;
  for (const MeshBlockId& id : gone) forget(id);
  for (auto& [id, held] : encoded) {
    forget(id);
    ++mark_.blocks;
    mark_.vertices += held.vertices;
    mark_.triangles += held.triangles;
    bytes_ += held.message->size();
    for (Waiting& reader : readers_) reader.blocks.insert(id);
    blocks_.emplace(id, std::move(held));
  }
  for (Waiting& reader : readers_) {
    reader.blocks.insert(gone.begin(), gone.end());
    reader.is_behind = true;
  }
}

void MeshMirror::publish(MeshNote note) {
  const std::lock_guard lock(mutex_);
  note.sequence = mark_.sequence;
  note_ = std::move(note);
  for (Waiting& reader : readers_) reader.is_untold = true;
}

MeshMirror::News MeshMirror::take(Waiting& waiting) {
  News news;
  const std::lock_guard lock(mutex_);
  assert(!waiting.is_untold || note_);
  if (waiting.is_untold) news.messages.push_back(shared(*note_));
  waiting.is_untold = false;
  if (!waiting.is_behind) return news;
  news.blocks = waiting.blocks.size();
  for (const MeshBlockId& id : waiting.blocks) {
    const auto found = blocks_.find(id);
    news.messages.push_back(found != blocks_.end()
                                ? found->second.message
                                : shared(MeshBlock{mark_.sequence, id, {}, {}, {}}));
  }
  news.messages.push_back(shared(mark_));
  waiting = {};
  return news;
}

std::uint64_t MeshMirror::updates() const {
  const std::lock_guard lock(mutex_);
  return mark_.sequence;
}

std::size_t MeshMirror::bytes() const {
  const std::lock_guard lock(mutex_);
  return bytes_;
}

}  // namespace argil::haptics
