// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "argil/core/result.h"
#include "argil/haptics/bridge_key.h"
#include "argil/haptics/bridge_link.h"
#include "argil/haptics/bridge_mesh.h"

namespace argil::haptics {

struct MeshCounts {
  std::uint64_t updates = 0;    ///< published
  std::uint64_t readers = 0;    ///< that asked as they should
  std::uint64_t malformed = 0;  ///< dropped: said something else, more, or nothing while it could
  std::uint64_t forged = 0;     ///< dropped: had not the key
  std::uint64_t refused = 0;    ///< dropped: there were kMostReaders
  std::uint64_t blocks = 0;     ///< sent, to all readers; those that went included
  std::uint64_t bytes = 0;      ///< sent, to all readers
};

/// Shows clay to simulators: keeps the newest content of each block and sends each reader first all
/// of it, then what changed. Between two marks a reader gets one state of the clay as a whole; what
/// changes while it reads coalesces, block by block, until it is ready for the next.
///
/// Both prove that they have the key. The server begins with a nonce of 16 bytes; a reader says
/// MeshAsk, with any sequence, and the tag of a simulator for nonce and MeshAsk; the server says
/// the tag of a bridge for the same, and then messages. What follows has no tag: whoever is on the
/// way between two machines can alter it.
///
/// TCP. Bound to 127.0.0.1 unless it is told another address, so that no other machine can reach it
/// (BridgeMeshServer.ListensOnLoopbackOnly).
///
/// Threads  publish and finish: one thread, which never waits for a reader, only for the moment in
///          which another state is picked. counts and held_bytes: any. Sending is done by a thread
///          of its own.
/// Memory   every block once, and once more for each reader that is behind
///          (BridgeMeshServer.HoldsNoMoreForAReaderThatReadsNothing).
/// Cost     publish: copies its blocks; sending 1 GB/s and more.
class BridgeMeshServer {
 public:
  static constexpr int kMostReaders = 4;
  static constexpr int kMostSilent = 32;      ///< connections that have not asked yet
  static constexpr double kAskWithinS = 5.0;  ///< or the reader is dropped

  static constexpr std::size_t kAskBytes = kMeshAskBytes + BridgeKey::kTagBytes;

  /// Listens; port 0: any that is free.
  /// Errors  device when the port is taken; internal when the system gives no thread.
  static Result<std::unique_ptr<BridgeMeshServer>> open(const BridgeAddress& at,
                                                        const BridgeKey& key,
                                                        const MeshPlace& place);

  /// Ends at once, whatever was sent.
  ~BridgeMeshServer();

  std::uint16_t port() const noexcept;

  /// One update: blocks that came or have another content, and those that went. Their sequence is
  /// set here. Nothing of both: no update.
  void publish(std::vector<MeshBlock> changed, std::span<const MeshBlockId> gone);

  /// Tells readers what became of the strokes. Its sequence is set here; a text beyond
  /// kMostMeshText is cut.
  void publish(MeshNote note);

  /// Gives the readers that are there all that was published and says that it ends; waits for that,
  /// but no longer than this without any progress, and no longer than `goes_on`, where given, which
  /// is asked every few ms, says so: a reader that takes a little again and again would hold it for
  /// hours. Nothing may be published after it.
  void finish(double most_silence_s, const std::function<bool()>& goes_on = {});

  MeshCounts counts() const noexcept;
  std::size_t held_bytes() const noexcept;  ///< of blocks, at most

 private:
  struct State;
  void end() noexcept;
  explicit BridgeMeshServer(std::unique_ptr<State> state) noexcept;
  std::unique_ptr<State> state_;
};

}  // namespace argil::haptics
