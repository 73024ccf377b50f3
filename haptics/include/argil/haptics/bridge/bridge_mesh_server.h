// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "argil/core/result.h"
#include "argil/haptics/bridge/bridge_key.h"
#include "argil/haptics/bridge/bridge_link.h"
#include "argil/haptics/bridge/bridge_mesh.h"

namespace argil::haptics {

struct MeshCounts {
  /// Updates that were published.
  std::uint64_t updates = 0;
  /// Readers that asked as they should.
  std::uint64_t readers = 0;
  /// Connections dropped because they said something else, more, or nothing in time.
  std::uint64_t malformed = 0;
  /// Connections dropped because they did not have the key.
  std::uint64_t forged = 0;
  /// Connections dropped because there were kMostReaders already.
  std::uint64_t refused = 0;
  /// Blocks sent, to all readers together; those that are gone included.
  std::uint64_t blocks = 0;
  /// Bytes sent, to all readers together.
  std::uint64_t bytes = 0;
};

/// Shows clay to simulators over TCP: keeps the newest content of each block and sends each reader
/// all of it first, then what changed. Between two marks a reader gets one state of the clay as a
/// whole; what changes while it reads coalesces, block by block, until it is ready for the next.
///
/// Both sides prove that they have the key. The server begins with a nonce of 16 bytes; a reader
/// answers with MeshAsk, with any sequence, and the tag of a simulator for nonce and MeshAsk; the
/// server answers with the tag of a bridge for the same, and then with messages. These have no tag:
/// whoever sits between two machines can alter them.
///
/// It listens on 127.0.0.1 unless it is told another address, so that no other machine can reach it
/// (BridgeMeshServer.ListensOnLoopbackOnly).
///
/// Threads  publish and finish: one thread, which never waits for a reader, only for the moment in
///          which another state is picked. counts and held_bytes: any. Sending is done by a thread
///          of its own.
/// Memory   every block once, and once more for each reader that is behind
///          (BridgeMeshServer.HoldsNoMoreForAReaderThatReadsNothing).
/// Cost     publish copies its blocks; sending 1 GB/s and more.
class BridgeMeshServer {
 public:
  static constexpr int kMostReaders = 4;
  /// Connections that have not asked yet; beyond these the oldest is dropped.
  static constexpr int kMostSilent = 32;
  /// A connection that has not asked after this time is dropped.
  static constexpr double kAskWithinS = 5.0;

  /// What a reader has to say: MeshAsk and its tag.
  static constexpr std::size_t kAskBytes = kMeshAskBytes + BridgeKey::kTagBytes;

  /// Begins to listen; port 0: any that is free.
  ///
  /// Errors  device when the port is taken; internal when the system gives no thread.
  static Result<std::unique_ptr<BridgeMeshServer>> open(const BridgeAddress& at,
                                                        const BridgeKey& key,
                                                        const MeshPlace& place);

  /// Ends at once, whatever was not sent yet.
  ~BridgeMeshServer();

  std::uint16_t port() const noexcept;

  /// One update: blocks that are new or have changed, and those that are gone. Their sequence is
  /// set here. With neither there is no update.
  void publish(std::vector<MeshBlock> changed, std::span<const MeshBlockId> gone);

  /// Tells readers what became of the strokes. Its sequence is set here; a text longer than
  /// kMostMeshText is cut.
  void publish(MeshNote note);

  /// Sends the readers all that was published and MeshEnd, and waits for that: no longer than
  /// `most_silence_s` without any progress, and no longer than `goes_on`, where given and asked
  /// every few ms, returns true, since a reader that takes a little again and again would hold it
  /// for hours. Nothing may be published after it.
  void finish(double most_silence_s, const std::function<bool()>& goes_on = {});

  MeshCounts counts() const noexcept;
  /// Upper bound of what all blocks and unsent messages occupy.
  std::size_t held_bytes() const noexcept;

 private:
  struct State;
  void end() noexcept;
  explicit BridgeMeshServer(std::unique_ptr<State> state) noexcept;
  std::unique_ptr<State> state_;
};

}  // namespace argil::haptics
