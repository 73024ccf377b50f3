// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include "argil/haptics/bridge/bridge_key.h"
#include "argil/haptics/bridge/bridge_mesh.h"

namespace argil::haptics::scenes {

/// The key of bridges in tests.
inline BridgeKey test_key() { return *BridgeKey::from_text("000102030405060708090a0b0c0d0e0f"); }

/// A MeshAsk that was never said before, so that neither was what answers it.
inline MeshAsk new_ask() {
  MeshAsk ask;
  const BridgeKey::Nonce random = BridgeKey::nonce();
  std::memcpy(&ask.sequence, random.data(), sizeof ask.sequence);
  return ask;
}

/// A simulator's end of the stream that waits for what it reads, half a minute at most.
class MeshReader {
 public:
  explicit MeshReader(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    is_connected =
        ::connect(socket_, std::bit_cast<const sockaddr*>(&address), sizeof address) == 0;
    const timeval most{30, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &most, sizeof most);
  }
  ~MeshReader() { ::close(socket_); }
  MeshReader(const MeshReader&) = delete;
  MeshReader& operator=(const MeshReader&) = delete;

  void say(std::span<const std::byte> words) {
    ::send(socket_, words.data(), words.size(), MSG_NOSIGNAL);
  }
  void ask() { say(asking()); }
  /// The nonce's answer. Whoever has another key is dropped.
  std::vector<std::byte> asking(const BridgeKey& key = test_key(),
                                std::vector<std::byte> words = encode(new_ask())) {
    proven_.resize(sizeof(BridgeKey::Nonce));
    read(proven_);
    bytes += proven_.size();
    proven_.insert(proven_.end(), words.begin(), words.end());
    const BridgeKey::Tag tag = key.tag(BridgeSender::simulator, proven_);
    words.insert(words.end(), tag.begin(), tag.end());
    return words;
  }

  /// As if it had asked this: what the server proves itself for must be the same.
  void expect(const MeshAsk& ask) {
    const std::vector<std::byte> words = encode(ask);
    proven_.resize(sizeof(BridgeKey::Nonce));
    proven_.insert(proven_.end(), words.begin(), words.end());
  }

  /// The next message; nothing when the stream has ended, or what came is not one.
  std::optional<MeshMessage> next() {
    if (!is_proven && !(is_proven = takes_proof())) return std::nullopt;
    std::vector<std::byte> message(kMeshHeaderBytes);
    if (!read(message)) return std::nullopt;
    const auto size = mesh_message_bytes(message);
    if (!size) return std::nullopt;
    message.resize(*size);
    if (!read(std::span(message).subspan(kMeshHeaderBytes))) return std::nullopt;
    bytes += message.size();
    return decode_mesh(message);
  }

  /// Takes blocks up to the next mark. False when the stream ends before it.
  bool update() {
    while (const auto message = next()) {
      if (const auto* at = std::get_if<MeshPlace>(&*message)) place = *at;
      if (const auto* block = std::get_if<MeshBlock>(&*message)) take(*block);
      if (const auto* said = std::get_if<MeshNote>(&*message)) note = *said;
      has_ended = std::holds_alternative<MeshEnd>(*message);
      if (const auto* now = std::get_if<MeshMark>(&*message)) {
        mark = *now;
        return true;
      }
    }
    return false;
  }

  bool is_connected = false;
  bool is_proven = false;  ///< the other end has the key too
  bool has_ended = false;  ///< by MeshEnd
  std::size_t bytes = 0;   ///< of nonce, proof and messages
  std::size_t taken = 0;   ///< blocks, those that went included
  std::map<MeshBlockId, MeshBlock> blocks;
  MeshPlace place;
  MeshMark mark;
  MeshNote note;

 private:
  bool takes_proof() {
    BridgeKey::Tag tag;
    bytes += tag.size();
    return read(tag) && test_key().fits(BridgeSender::bridge, proven_, tag);
  }
  void take(const MeshBlock& block) {
    ++taken;
    if (block.triangles.empty()) {
      blocks.erase(block.id);
    } else {
      blocks[block.id] = block;
    }
  }
  bool read(std::span<std::byte> into) {
    const auto got = ::recv(socket_, into.data(), into.size(), MSG_WAITALL);
    return into.empty() || got == static_cast<ssize_t>(into.size());
  }
  int socket_;
  std::vector<std::byte> proven_;  ///< what both ends' tags are of
};

}  // namespace argil::haptics::scenes
