// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/engine/display_surface.h"
#include "argil/haptics/bridge/bridge_mesh_server.h"
#include "argil/haptics/scene/scene_placed.h"
#include "argil/io/session.h"

#include "bridge/bridge.h"
#include "bridge/kept_strokes.h"
#include "common/served_clay.h"

namespace argil::cli::bridge {

/// A project that is felt and worked at the bridge: its strokes are kept by a session, and what
/// they change of its surface goes to whoever shows it.
///
/// Threads  one, but for what ServedClay does in a thread of its own from start to end_work.
class BridgeClay {  // NOLINT(clang-analyzer-optin.performance.Padding): the ring's cache lines
 public:
  /// Opens the project and listens there. The device's 0 lies on the clay's top, over its
  /// middle.
  /// Errors  bad_input for a project that is not there, or no clay over its middle; as
  ///         io::Session::open and BridgeMeshServer::open.
  static Result<std::unique_ptr<BridgeClay>> open(const BridgeOptions& options,
                                                  const haptics::BridgeAddress& at,
                                                  const haptics::BridgeKey& key,
                                                  const Progress& progress);

  haptics::ForceScene& scene() noexcept { return served_.scene(); }
  const haptics::Placement& place() const noexcept { return place_; }

  /// As ServedClay.
  Result<void> start() { return served_.start(); }
  Result<void> after_tick(double now_s) { return served_.after_tick(now_s); }

  /// Once no tick will follow: ends thread and stroke, and publishes what is new.
  Result<void> end_work();

  /// After it: readers get what they have not got yet, as long as they read, for half a minute at
  /// most, and for half a second once the program was told to end.
  void finish();

  /// After that: saves the project.
  /// Errors  as io::Session::close: the journal stays and has every stroke.
  Result<void> close();

  /// What ServedClay reports, "recovered_strokes", "triangles", "hash", "kept_strokes",
  /// "refused_strokes", "updates", "readers", "dropped_readers", "blocks_sent", "bytes_sent".
  Json report() const;

 private:
  BridgeClay(const BridgeOptions& options, const Tool& tool, io::Session session,
             const haptics::Placement& place, std::unique_ptr<haptics::BridgeMeshServer> server);
  static Result<std::unique_ptr<BridgeClay>> serve(const BridgeOptions& options, const Tool& tool,
                                                   io::Session& session,
                                                   const haptics::BridgeAddress& at,
                                                   const haptics::BridgeKey& key);
  Result<void> after_step();
  Result<void> show();

  io::Session session_;
  KeptStrokes kept_;
  haptics::Placement place_;
  std::unique_ptr<haptics::BridgeMeshServer> server_;
  DisplaySurface surface_;
  bool is_lockstep_;
  std::chrono::steady_clock::time_point shown_;
  Json closed_;  ///< of the clay, which is gone with its session
  ServedClay served_;
};

}  // namespace argil::cli::bridge
