// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/sealed_link.h"

#include <algorithm>
#include <cassert>

#include "wire_fields.h"

namespace argil::haptics {
namespace {

std::uint64_t sequence_of(std::span<const std::byte> datagram) noexcept {
  FieldReader reader(datagram.subspan(kBridgeSequenceAt), 0.0);
  std::uint64_t sequence = 0;
  reader.field(sequence);
  return sequence;
}

}  // namespace

bool SealedLink::is_new(const BridgeAddress& from, std::uint64_t sequence) noexcept {
  auto found = std::ranges::find(senders_, from, &Sender::address);
  if (sequence <= (found != senders_.end() ? found->newest : newest_)) return false;
  // The sender that was silent longest makes room; if it speaks again it is as new as any.
  if (found == senders_.end()) found = std::ranges::min_element(senders_, {}, &Sender::newest);
  *found = {from, sequence};
  newest_ = std::max(newest_, sequence);
  return true;
}

std::size_t SealedLink::receive(std::span<std::byte> into, BridgeAddress& from) noexcept {
  std::array<std::byte, kMostBytes> buffer;
  const std::size_t size = carrier_.receive(buffer, from);
  if (size == 0 || size == kDropped) return size;
  constexpr std::size_t kTag = BridgeKey::kTagBytes;
  const bool has_length = size >= kBridgeHeaderBytes + kTag && size <= buffer.size();
  const std::span all = std::span<const std::byte>(buffer).first(has_length ? size : 0);
  const auto other = self_ == BridgeSender::bridge ? BridgeSender::simulator : BridgeSender::bridge;
  if (!has_length || !key_.fits(other, all.first(size - kTag), all.last(kTag))) {
    ++counts_.forged;
    return kDropped;
  }
  const std::span datagram = all.first(size - kTag);
  if (!is_new(from, sequence_of(datagram))) {
    ++counts_.replayed;
    return kDropped;
  }
  std::copy_n(datagram.begin(), std::min(datagram.size(), into.size()), into.begin());
  return datagram.size();
}

void SealedLink::send(std::span<const std::byte> datagram, const BridgeAddress& to) noexcept {
  assert(datagram.size() <= kBridgeMostBytes);
  std::array<std::byte, kMostBytes> buffer;
  const auto end = std::ranges::copy(datagram, buffer.begin()).out;
  const BridgeKey::Tag tag = key_.tag(self_, datagram);
  std::ranges::copy(tag, end);
  carrier_.send(std::span<const std::byte>(buffer).first(datagram.size() + tag.size()), to);
}

}  // namespace argil::haptics
