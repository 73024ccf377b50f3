// SPDX-License-Identifier: GPL-3.0-or-later
// From a dab to the blocks that it changed at a simulator, over TCP: the edit, the surface of the
// blocks that it touched, their bytes, and the reader's last one.
#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "argil/core/hash.h"
#include "argil/engine/display_surface.h"
#include "argil/haptics/bridge/bridge_mesh_server.h"

#include "bench/row.h"
#include "haptics/bridge/mesh_reader.h"

namespace argil::bench {
namespace {

using haptics::BridgeMeshServer;
using haptics::MeshBlock;
using haptics::scenes::MeshReader;

MeshBlock content_of(const BlockId& id, const DisplayBlock& block) {
  MeshBlock content;
  content.id = {id.level, id.origin};
  for (const DisplayVertex& vertex : block.vertices) {
    content.positions_mm.push_back(vertex.position_mm);
    content.normals.push_back(vertex.normal);
  }
  content.triangles.assign(block.triangles.begin(), block.triangles.end());
  return content;
}

/// Of all that the reader holds.
std::uint64_t hash_of(const MeshReader& reader) {
  Hash64 hash;
  for (const auto& [id, block] : reader.blocks) {
    hash.update(std::as_bytes(std::span(block.positions_mm)));
    hash.update(std::as_bytes(std::span(block.triangles)));
  }
  return hash.digest();
}

/// Brings the reader to the clay as it is now. False when that fails.
bool show(const Clay& clay, DisplaySurface& surface, BridgeMeshServer& server, MeshReader& reader) {
  if (!surface.update(clay)) return false;
  std::vector<MeshBlock> changed;
  for (const BlockId& id : surface.changed()) {
    changed.push_back(content_of(id, surface.block(id)));
  }
  std::vector<haptics::MeshBlockId> gone;
  for (const BlockId& id : surface.gone()) gone.push_back({id.level, id.origin});
  server.publish(std::move(changed), gone);
  while (reader.mark.sequence < server.counts().updates) {
    if (!reader.update()) return false;
  }
  return true;
}

void bridge_clay_dab(benchmark::State& state) {
  auto made = ball_to_edit();
  Clay* const clay = value_or_fail(state, made);
  auto opened =
      BridgeMeshServer::open({haptics::kLoopbackHost, 0}, haptics::scenes::test_key(), {});
  auto* const server = value_or_fail(state, opened);
  if (clay == nullptr || server == nullptr) return;
  MeshReader reader((*server)->port());
  reader.ask();
  DisplaySurface surface;
  const Stroke dab = dab_on_top(static_cast<double>(state.range(0)), Action::carve);
  bool is_good = show(*clay, surface, **server, reader);
  RowResult row(state);
  std::string size;
  while (is_good && state.KeepRunning()) {
    const std::size_t bytes = reader.bytes;
    const std::size_t taken = reader.taken;
    const auto start = std::chrono::steady_clock::now();
    is_good = clay->apply(dab).ok() && show(*clay, surface, **server, reader);
    state.SetIterationTime(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    size = std::to_string(reader.taken - taken) + " blocks, " +
           std::to_string(reader.bytes - bytes) + " bytes";
    row.add(hash_of(reader));
    is_good = is_good && clay->undo() && show(*clay, surface, **server, reader);
  }
  if (!is_good) state.SkipWithError("the reader did not get the clay");
  row.show(size);
}

BENCHMARK(bridge_clay_dab)->Arg(2)->Arg(4)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace argil::bench
