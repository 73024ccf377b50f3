// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "arena/table.h"
#include "arena/truth.h"

namespace argil::arena {

/// What is run. Empty lists: all.
struct ArenaOptions {
  std::vector<std::string> kinds;
  std::vector<std::string> models;
  std::vector<std::string> contestants;
  std::vector<int> strengths;
  bool only_simple = false;  ///< no models from files, so that the meshes are the same everywhere
  int models_each = 6;       ///< of each kind and strength
  std::size_t most_triangles = 12'000;  ///< of a sound solid
  std::size_t limit = 0;                ///< so many meshes, spread over all; 0: no limit
  std::filesystem::path keep_failed;    ///< gets the meshes that argil failed at; "": nowhere
  std::filesystem::path write_to;       ///< gets all meshes, and nothing is run; "": they are run
  std::vector<std::string> rows;  ///< files whose rows are told instead of running; empty: none
  int jobs = 2;
};

using Say = std::function<void(const std::string&)>;

/// The same meshes every time.
std::vector<Broken> broken_meshes(const ArenaOptions& options, const Say& say);

/// Writes NAME.ply, and NAME.truth.ply with the surface that a right repair must have.
void write_case(const std::filesystem::path& folder, const Broken& broken);

/// Runs all of them, `options.jobs` at a time, in an order in which kinds are mixed, so that what
/// is done before an end says something of all. `say` hears of each that argil failed at, `done` of
/// each run, one at a time.
std::vector<Row> run_arena(const std::vector<Broken>& meshes, const ArenaOptions& options,
                           const Say& say, const std::function<void(const Row&)>& done = {});

}  // namespace argil::arena
