// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "argil/haptics/bridge/bridge_mesh.h"

namespace argil::haptics {

/// A message that readers share.
using MeshBytes = std::shared_ptr<const std::vector<std::byte>>;

/// The newest content of each block as it is sent, and what each reader has not been sent of it
/// yet.
///
/// Threads  any, but one at a time for publish: a lock, held for the moment in which an update is
/// put
///          in or taken out.
class MeshMirror {
 public:
  /// What a reader has to be told of; owned by the mirror.
  struct Waiting {
    std::set<MeshBlockId> blocks;
    bool is_behind = false;  ///< there was an update that it was not told of
    bool is_untold = false;  ///< there was a note
  };

  /// A reader that has nothing yet: all blocks wait for it.
  Waiting& join();
  void leave(const Waiting& waiting);

  /// One update: blocks that are new or have changed, and those that are gone.
  void publish(std::vector<MeshBlock> changed, std::span<const MeshBlockId> gone);

  /// The newest note on the strokes, which replaces the one before.
  void publish(MeshNote note);

  /// The messages that bring a reader up to date: a note, blocks and a mark, as far as it has not
  /// been sent them.
  struct News {
    std::deque<MeshBytes> messages;
    std::size_t blocks = 0;  ///< of them
  };
  /// Takes all that waits for this reader.
  News take(Waiting& waiting);

  std::uint64_t updates() const;
  std::size_t bytes() const;  ///< of all blocks

 private:
  struct Held {
    MeshBytes message;
    std::size_t vertices = 0;
    std::size_t triangles = 0;
  };
  void forget(const MeshBlockId& id);

  mutable std::mutex mutex_;
  std::map<MeshBlockId, Held> blocks_;
  std::list<Waiting> readers_;
  MeshMark mark_;
  std::optional<MeshNote> note_;
  std::size_t bytes_ = 0;
};

}  // namespace argil::haptics
