// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/bridge/sealed_link.h"

#include <algorithm>
#include <cassert>

#include "bridge/wire_fields.h"

namespace argil::haptics {
namespace {

std::uint64_t sequence_of(std::span<const std::byte> datagram) noexcept {
  assert(datagram.size() >= kBridgeHeaderBytes);
  FieldReader reader(datagram.subspan(kBridgeSequenceAt), 0.0);
  std::uint64_t sequence = 0;
  reader.field(sequence);
  return sequence;
}

constexpr std::size_t kTag = BridgeKey::kTagBytes;

/// The tag of the first `size` bytes of the buffer followed by the port, which is written behind
/// them.
BridgeKey::Tag tag_of(const BridgeKey& key, BridgeSender sender, std::span<std::byte> buffer,
                      std::size_t size, std::uint16_t port) noexcept {
  assert(size + sizeof port <= buffer.size());
  FieldWriter(buffer.subspan(size)).field(port);
  return key.tag(sender, buffer.first(size + sizeof port));
}

}  // namespace

bool SealedLink::is_new(const BridgeAddress& from, std::uint64_t sequence) noexcept {
  auto found = std::ranges::find(senders_, from, &Sender::address);
  if (sequence <= (found != senders_.end() ? found->newest : newest_)) return false;
  // The sender that was silent longest makes room; if it sends again it counts as new.
  if (found == senders_.end()) found = std::ranges::min_element(senders_, {}, &Sender::newest);
  *found = {from, sequence};
  newest_ = std::max(newest_, sequence);
  return true;
}

std::size_t SealedLink::receive(std::span<std::byte> into, BridgeAddress& from) noexcept {
  std::array<std::byte, kMostBytes> buffer;
  const std::size_t size = carrier_.receive(buffer, from);
  if (size == 0 || size == kDropped) return size;
  const auto other = self_ == BridgeSender::bridge ? BridgeSender::simulator : BridgeSender::bridge;
  bool fits = size >= kBridgeHeaderBytes + kTag && size <= buffer.size();
  if (fits) {
    BridgeKey::Tag tag;
    std::copy_n(buffer.begin() + static_cast<std::ptrdiff_t>(size - kTag), kTag, tag.begin());
    fits = is_same(tag, tag_of(key_, other, buffer, size - kTag, from.port));
  }
  if (!fits) {
    ++counts_.forged;
    return kDropped;
  }
  const std::span datagram = std::span<const std::byte>(buffer).first(size - kTag);
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
  const BridgeKey::Tag tag = tag_of(key_, self_, buffer, datagram.size(), port_);
  std::ranges::copy(tag, end);
  carrier_.send(std::span<const std::byte>(buffer).first(datagram.size() + tag.size()), to);
}

}  // namespace argil::haptics
