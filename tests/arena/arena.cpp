// SPDX-License-Identifier: GPL-3.0-or-later
#include "arena/arena.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>
#include <utility>

#include "argil/io/mesh_file.h"
#include "argil/mesh/rounding.h"

#include "arena/faults.h"
#include "support/clients.h"
#include "support/scratch.h"

namespace argil::arena {
namespace {

template <class T>
bool is_wanted(const std::vector<T>& wanted, const T& one) {
  return wanted.empty() || std::find(wanted.begin(), wanted.end(), one) != wanted.end();
}

/// A number for each mesh that does not depend on which others are made.
std::uint64_t seed_of(const std::string& text) {
  std::uint64_t hash = 14'695'981'039'346'656'037ULL;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1'099'511'628'211ULL;
  return hash;
}

std::optional<Broken> broken_by(const Fault& fault, const Solid& solid, int strength) {
  Random random(seed_of(fault.kind + ("/" + solid.name) + "/" + std::to_string(strength)));
  auto broken = fault.make(solid, strength, random);
  if (!broken) return std::nullopt;
  broken->kind = fault.kind;
  broken->strength = strength;
  broken->mesh = mesh::rounded_to_float(std::move(broken->mesh));
  return broken;
}

/// So many evenly from all.
void limit_to(std::vector<Broken>& meshes, std::size_t limit) {
  if (limit == 0 || meshes.size() <= limit) return;
  std::vector<Broken> some;
  for (std::size_t i = 0; i < limit; ++i) {
    some.push_back(std::move(meshes[i * meshes.size() / limit]));
  }
  meshes = std::move(some);
}

Row run_one(const Broken& broken, const Contestant& contestant, const ArenaOptions& options) {
  const test::ScratchFolder folder;
  const std::filesystem::path file = folder / "broken.ply";
  Row row{contestant.name,
          broken.kind,
          broken.model,
          broken.strength,
          broken.mesh.triangles.size(),
          {},
          {}};
  if (!io::write_mesh(file, broken.mesh)) {
    row.judged.why = "the disk is full";
    return row;
  }
  row.attempt = contestant.run(folder.path(), file);
  row.judged = judge(row.attempt.mesh.value_or(TriangleMesh{}), broken);
  if (row.attempt.crashed) row.judged.why = "crashed";
  if (row.attempt.hung) row.judged.why = "hung";
  const bool is_kept = !options.keep_failed.empty() && row.contestant == "argil" && !row.is_right();
  if (is_kept) {
    write_case(options.keep_failed, broken);
    const std::filesystem::path result = options.keep_failed / (broken.name() + ".result.ply");
    if (row.attempt.mesh) (void)io::write_mesh(result, *row.attempt.mesh);
  }
  row.attempt.mesh.reset();
  return row;
}

}  // namespace

void write_case(const std::filesystem::path& folder, const Broken& broken) {
  const std::string base = (folder / broken.name()).string();
  (void)io::write_mesh(base + ".ply", broken.mesh);
  (void)io::write_mesh(base + ".truth.ply", broken.truth.must);
}

std::vector<Broken> broken_meshes(const ArenaOptions& options, const Say& say) {
  const std::vector<Solid> solids =
      options.only_simple ? simple_solids() : sound_solids(options.most_triangles, say);
  std::vector<Broken> meshes;
  std::size_t turn = 0;
  for (const Fault& fault : faults()) {
    for (int strength = 1; strength <= fault.strengths; ++strength, turn += 5) {
      int made = 0;
      for (std::size_t i = 0; i < solids.size() && made < options.models_each; ++i) {
        const Solid& solid = solids[(turn + i) % solids.size()];
        // What is not wanted is counted, so that a selection has the meshes of the whole.
        if (!is_wanted(options.kinds, std::string(fault.kind)) ||
            !is_wanted(options.strengths, strength)) {
          continue;
        }
        auto broken = broken_by(fault, solid, strength);
        if (!broken) continue;
        ++made;
        if (is_wanted(options.models, solid.name)) meshes.push_back(std::move(*broken));
      }
    }
  }
  limit_to(meshes, options.limit);
  return meshes;
}

std::vector<Row> run_arena(const std::vector<Broken>& meshes, const ArenaOptions& options,
                           const Say& say, const std::function<void(const Row&)>& done) {
  std::vector<Contestant> present;
  for (const Contestant& one : contestants()) {
    if (!is_wanted(options.contestants, std::string(one.name))) continue;
    if (*one.program != '\0' && !test::has_program(one.program)) {
      say(std::string(one.program) + " is not installed; " + one.name + " is left out");
      continue;
    }
    present.push_back(one);
  }
  std::vector<Row> rows(meshes.size() * present.size());
  Random random(1);
  const std::vector<std::size_t> order = pick_some(random, meshes.size(), meshes.size());
  std::atomic<std::size_t> next{0};
  std::mutex saying;
  const auto work = [&] {
    for (std::size_t i = next++; i < rows.size(); i = next++) {
      const std::size_t at = order[i / present.size()];
      const std::size_t by = i % present.size();
      const Broken& broken = meshes[at];
      Row& row = rows[at * present.size() + by];
      row = run_one(broken, present[by], options);
      const std::lock_guard lock(saying);
      if (done) done(row);
      if (row.contestant != "argil" || row.is_right()) continue;
      say(broken.name() + ": status " + std::to_string(row.attempt.status) + ", " + row.judged.why +
          " " + row.attempt.said);
    }
  };
  std::vector<std::jthread> workers;
  for (int i = 0; i < options.jobs; ++i) workers.emplace_back(work);
  workers.clear();
  return rows;
}

}  // namespace argil::arena
