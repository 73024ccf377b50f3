// SPDX-License-Identifier: GPL-3.0-or-later
// Clay at the bridge: a session whose clay is felt and worked by the device, and whose surface goes
// to the simulator block by block.
#include "bridge/clay.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "argil/engine/path_on_clay.h"
#include "argil/engine/pick.h"
#include "argil/io/safe_file.h"

#include "common/output.h"
#include "common/project.h"
#include "common/tool_option.h"

namespace argil::cli::bridge {
namespace {

/// How often what changed is published in real time: as often as anybody draws.
constexpr std::chrono::microseconds kShowEvery{16'667};
/// How long a reader may take none of what waits for it at the end; how long all may take, and from
/// when the program was told to end.
constexpr double kMostSilenceS = 5.0;
constexpr std::chrono::seconds kMostEnd{30};
constexpr std::chrono::milliseconds kMostToldEnd{500};

Result<void> check_project(const std::filesystem::path& project) {
  std::error_code error;
  if (std::filesystem::exists(project, error)) return {};
  return Error{ErrorKind::bad_input,
               "--clay '" + project.string() +
                   "': no such project; make one with 'argil import' or 'argil sculpt', or check "
                   "the name"};
}

/// Where the hand comes down on it.
Result<Vec3> top_of(const Clay& clay) {
  const Box3 bounds = clay.bounds_mm();
  const Vec3 middle = bounds.center();
  // Straight down from a mm above: z is up in a project.
  const auto found = pick(clay, {{middle.x, middle.y, bounds.max.z + 1.0}, {0.0, 0.0, -1.0}});
  if (!found) return found.error();
  if (found.value()) return found.value()->point_mm;
  return Error{ErrorKind::bad_input,
               "there is no clay over the middle of the project, where the hand would press; use "
               "another project"};
}

haptics::ClaySceneOptions felt_as(const BridgeOptions& options, const Tool& tool) {
  haptics::ClaySceneOptions felt;
  felt.tool = options.clay.tool;
  felt.material = options.clay.material;
  felt.mix = options.feel.mix;
  felt.mix_ramp_s = options.feel.mix_ramp_s;
  if (tool.action == Action::carve && tool.shape == Shape::ball) felt.own_cut_mm = tool.radii_mm.x;
  return felt;
}

ClayWorkerOptions worked_with(const Tool& tool, KeptStrokes& kept) {
  ClayWorkerOptions worker;
  worker.tool = tool;
  worker.on_stroke = [&kept](const Stroke& stroke) { kept.record(stroke); };
  worker.may_begin = [&kept] { return kept.may_begin(); };
  return worker;
}

/// The bridge serves the piece that was selected last.
void note_piece(const Sculpture& sculpture) {
  if (sculpture.piece_count() == 1) return;
  print_notes({"the project has several pieces; this is '" +
               sculpture.look(sculpture.active()).name + "', in its own frame"});
}

haptics::MeshBlockId block_name(const BlockId& id) { return {id.level, id.origin}; }

haptics::MeshBlock content_of(const BlockId& id, const DisplayBlock& block) {
  haptics::MeshBlock content;
  content.id = block_name(id);
  content.positions_mm.reserve(block.vertices.size());
  content.normals.reserve(block.vertices.size());
  for (const DisplayVertex& vertex : block.vertices) {
    content.positions_mm.push_back(vertex.position_mm);
    content.normals.push_back(vertex.normal);
  }
  content.triangles.assign(block.triangles.begin(), block.triangles.end());
  return content;
}

}  // namespace

BridgeClay::BridgeClay(const BridgeOptions& options, const Tool& tool, io::Session session,
                       const haptics::Placement& place,
                       std::unique_ptr<haptics::BridgeMeshServer> server)
    : session_(std::move(session)),
      kept_(session_),
      place_(place),
      server_(std::move(server)),
      is_lockstep_(options.is_lockstep),
      served_(session_.clay(), worked_with(tool, kept_), felt_as(options, tool),
              [this] { return after_step(); }) {}

Result<std::unique_ptr<BridgeClay>> BridgeClay::open(const BridgeOptions& options,
                                                     const haptics::BridgeAddress& at,
                                                     const haptics::BridgeKey& key,
                                                     const std::vector<Vec3>& path_mm,
                                                     const Progress& progress) {
  if (auto good = check_project(options.clay.project); !good) return good.error();
  const auto tool = working_tool(options.clay.tool, options.clay.action);
  if (!tool) return tool.error();
  auto session = io::Session::open(options.clay.project, {}, progress);
  if (!session) return session.error();
  print_notes(session.value().notes());
  note_piece(session.value().sculpture());
  auto opened = serve(options, tool.value(), session.value(), at, key, path_mm);
  // Nothing was done to it, so that no journal needs to tell of a session.
  if (!opened) static_cast<void>(session.value().discard().ok());
  return opened;
}

Result<std::unique_ptr<BridgeClay>> BridgeClay::serve(const BridgeOptions& options,
                                                      const Tool& tool, io::Session& session,
                                                      const haptics::BridgeAddress& at,
                                                      const haptics::BridgeKey& key,
                                                      const std::vector<Vec3>& path_mm) {
  // Opening may have recovered a long journal.
  if (auto goes_on = check_interrupt(); !goes_on) return goes_on.error();
  if (auto free = session.sculpture().check_unlocked(); !free) return free.error();
  if (auto on_clay = check_path_on_clay(session.clay(), path_mm); !on_clay) return on_clay.error();
  const auto top = top_of(session.clay());
  if (!top) return top.error();
  const haptics::Placement place{options.scale, top.value(), true};
  auto server = haptics::BridgeMeshServer::open(
      at, key, {0, place.scale, place.offset_mm, session.clay().options().voxel_mm, tool.radii_mm});
  if (!server) return server.error();
  std::unique_ptr<BridgeClay> clay(
      new BridgeClay(options, tool, std::move(session), place, std::move(server).value()));
  auto shown = clay->show();
  if (shown) shown = check_interrupt();  // which nobody heard while it was extracted
  if (shown) return clay;
  // Back to the caller, who discards it.
  session = std::move(clay->session_);
  return shown.error();
}

Result<void> BridgeClay::after_step() {
  if (kept_.look()) server_->publish(kept_.note());
  const auto now = std::chrono::steady_clock::now();
  if (!is_lockstep_ && now - shown_ < kShowEvery) return {};
  shown_ = now;
  return show();
}

/// Publishes what changed since the last time.
Result<void> BridgeClay::show() {
  if (auto updated = surface_.update(session_.clay()); !updated) return updated.error();
  std::vector<haptics::MeshBlock> changed;
  changed.reserve(surface_.changed().size());
  for (const BlockId& id : surface_.changed()) {
    changed.push_back(content_of(id, surface_.block(id)));
  }
  std::vector<haptics::MeshBlockId> gone(surface_.gone().size());
  std::ranges::transform(surface_.gone(), gone.begin(), block_name);
  server_->publish(std::move(changed), gone);
  return {};
}

Result<void> BridgeClay::end_work() {
  const Result<void> stopped = served_.stop();
  kept_.finish();
  server_->publish(kept_.note());
  const Result<void> shown = show();
  return stopped ? shown : stopped;
}

void BridgeClay::finish() {
  using Clock = std::chrono::steady_clock;
  const auto begun = Clock::now();
  std::optional<Clock::time_point> told;
  server_->finish(kMostSilenceS, [&] {
    const auto now = Clock::now();
    if (io::interrupted() && !told) told = now;
    return now - begun < kMostEnd && !(told && now - *told >= kMostToldEnd);
  });
}

Result<void> BridgeClay::close() {
  closed_ = {{"recovered_strokes", session_.recovered_steps()},
             {"triangles", surface_.stats().triangles},
             {"hash", hex(session_.clay().hash())},
             {"kept_strokes", kept_.note().kept},
             {"refused_strokes", kept_.note().refused}};
  return session_.close();
}

Json BridgeClay::report() const {
  Json json = served_.report();
  json.update(closed_);
  const haptics::MeshCounts counts = server_->counts();
  json["updates"] = counts.updates;
  json["readers"] = counts.readers;
  json["dropped_readers"] = counts.malformed + counts.forged + counts.refused;
  json["blocks_sent"] = counts.blocks;
  json["bytes_sent"] = counts.bytes;
  return json;
}

}  // namespace argil::cli::bridge
