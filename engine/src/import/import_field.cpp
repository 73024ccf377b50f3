// SPDX-License-Identifier: GPL-3.0-or-later
// The finest level in waves: the leaves near triangles first, then around walls inside overlapping
// parts, then along the membrane that closes gaps, until no wave adds a leaf.
#include "import/import_field.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include <openvdb/tools/SignedFloodFill.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include "import/scatter.h"

namespace argil {
namespace {

Error interrupted() { return {ErrorKind::interrupted, "the import was interrupted"}; }

constexpr std::size_t kTasksPerReport = 32;

/// Calls work(n) for n below `count` on all threads and tells `progress` from this one, in between,
/// how much of weight(n) is done: as often whatever the threads do.
template <class Weight, class Work>
Result<void> for_each_told(std::size_t count, const Weight& weight, const Work& work,
                           std::string_view stage, const Progress& progress) {
  double all = 0.0;
  for (std::size_t n = 0; n < count; ++n) all += weight(n);
  double done = 0.0;
  for (std::size_t begin = 0; begin < count; begin += kTasksPerReport) {
    if (progress && !progress(stage, std::min(done / all, 1.0))) return interrupted();
    const std::size_t end = std::min(count, begin + kTasksPerReport);
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(begin, end, 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
          for (std::size_t n = range.begin(); n < range.end(); ++n) work(n);
        },
        tbb::simple_partitioner());
    for (std::size_t n = begin; n < end; ++n) done += weight(n);
  }
  return {};
}

constexpr std::size_t kLeavesPerTask = 64;

/// The same for leaves, many at a time.
template <class Work>
Result<void> for_each_leaf_told(std::size_t count, const Work& work, std::string_view stage,
                                const Progress& progress) {
  const auto end = [count](std::size_t task) {
    return std::min(count, (task + 1) * kLeavesPerTask);
  };
  return for_each_told(
      (count + kLeavesPerTask - 1) / kLeavesPerTask,
      [&](std::size_t task) { return static_cast<double>(end(task) - task * kLeavesPerTask); },
      [&](std::size_t task) {
        for (std::size_t n = task * kLeavesPerTask; n < end(task); ++n) work(n);
      },
      stage, progress);
}

/// All leaves that triangles come near to.
Result<ImportField> scattered(const ImportSampler& sampler, const Progress& progress) {
  const Scatter scatter(sampler.input());
  struct Made {
    Coord origin;
    ImportLeaf leaf;
  };
  std::vector<std::vector<Made>> bricks(scatter.bricks());
  auto ok = for_each_told(
      bricks.size(), [&](std::size_t n) { return scatter.work(n); },
      [&](std::size_t n) {
        scatter.measure(n, [&](const Coord& origin, const float* squares) {
          bricks[n].push_back({origin, signed_leaf(sampler, origin, squares)});
        });
      },
      "distance", progress);
  if (!ok) return ok.error();
  std::vector<Made*> made;
  for (auto& brick : bricks) {
    for (Made& each : brick) made.push_back(&each);
  }
  std::sort(made.begin(), made.end(),
            [](const Made* a, const Made* b) { return a->origin < b->origin; });
  ImportField field;
  field.origins.reserve(made.size());
  field.leaves.reserve(made.size());
  for (Made* each : made) {
    field.origins.push_back(each->origin);
    field.leaves.push_back(std::move(each->leaf));
  }
  return field;
}

/// Follows the membrane from the open edges, wave by wave, until the field holds all of it.
Result<void> follow_membrane(const ImportSampler& sampler, const Progress& progress,
                             std::uint64_t limit_bytes, ImportField& field) {
  while (true) {
    const std::vector<Coord> beside = leaves_beside_membrane(sampler, field);
    if (beside.empty()) return {};
    if ((field.origins.size() + beside.size()) * kBytesPerLeaf > limit_bytes) {
      return Error{ErrorKind::memory,
                   "closing the gaps of the mesh takes more memory than is free (" +
                       std::to_string(limit_bytes / 1000000) +
                       " MB); close its holes first, or choose larger voxels"};
    }
    std::vector<ImportLeaf> leaves(beside.size());
    if (auto ok = for_each_leaf_told(
            beside.size(), [&](std::size_t n) { leaves[n] = leaf_of_gap(sampler, beside[n]); },
            "gaps", progress);
        !ok) {
      return ok;
    }
    field.merge(beside, std::move(leaves));
  }
}

bool has_wall(const ImportLeaf& leaf) { return leaf.wall; }

/// Asks the suspicious nodes of these leaves.
Result<void> ask_leaves(const ImportSampler& sampler, const std::vector<std::size_t>& leaves,
                        const Progress& progress, ImportField& field) {
  return for_each_leaf_told(
      leaves.size(),
      [&](std::size_t n) { ask_walls(sampler, field.origins[leaves[n]], field.leaves[leaves[n]]); },
      "overlaps", progress);
}

/// Asks suspicious nodes, then every node of the leaves around a wall, and on from those where one
/// was found.
Result<void> follow_walls(ImportSampler& sampler, const Progress& progress, ImportField& field) {
  std::vector<std::size_t> asked;
  for (std::size_t n = 0; n < field.leaves.size(); ++n) {
    const ImportLeaf& leaf = field.leaves[n];
    if (!leaf.suspicious.isOff() || leaf.bridged > 0) asked.push_back(n);
  }
  if (asked.empty()) return {};
  if (progress && !progress("trees", 0.0)) return interrupted();
  sampler.build_trees();
  if (auto ok = ask_leaves(sampler, asked, progress, field); !ok) return ok;
  std::vector<char> is_done(field.leaves.size());
  while (true) {
    std::vector<Coord> met;
    for (const std::size_t n : asked) {
      if (has_wall(field.leaves[n])) met.push_back(field.origins[n]);
    }
    asked.clear();
    for (const Coord& origin : widened(met)) {
      const std::ptrdiff_t found = field.find(origin);
      if (found < 0 || is_done[static_cast<std::size_t>(found)] != 0) continue;
      asked.push_back(static_cast<std::size_t>(found));
      is_done[asked.back()] = 1;
      suspect_all(field.leaves[asked.back()]);
    }
    if (asked.empty()) return {};
    if (auto ok = ask_leaves(sampler, asked, progress, field); !ok) return ok;
  }
}

/// Leaves without a node in the band say nothing that a tile does not say.
VdbGrid::Ptr grid_of(const ImportSampler& sampler, ImportField& field) {
  assert(field.origins.size() == field.leaves.size());
  const float band = static_cast<float>(sampler.band());
  tbb::parallel_for(std::size_t{0}, field.leaves.size(), [&](std::size_t i) {
    VdbLeaf& leaf = *field.leaves[i].leaf;
    const float* values = leaf.buffer().data();
    for (int n = 0; n < kLeafNodes; ++n) {
      if (std::abs(values[n]) < band) leaf.setValueOn(static_cast<openvdb::Index>(n));
    }
  });
  auto grid = VdbGrid::create(band);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(sampler.voxel()));
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  grid->setName("surface_0");
  for (ImportLeaf& made : field.leaves) {
    if (!made.leaf->isEmpty()) grid->tree().addLeaf(made.leaf.release());
    made.leaf.reset();
  }
  // Tiles only: the leaves tell their sides themselves.
  openvdb::tools::signedFloodFill(grid->tree(), true, 1, 1);
  return grid;
}

/// Else there is no solid.
bool any_inside(const ImportField& field) {
  return std::any_of(field.leaves.begin(), field.leaves.end(), [](const ImportLeaf& leaf) {
    const float* values = leaf.leaf->buffer().data();
    return std::any_of(values, values + kLeafNodes, [](float value) { return value < 0.0F; });
  });
}

Error no_volume(double voxel_mm) {
  std::string size = std::to_string(voxel_mm);
  size.erase(size.find_last_not_of('0') + 1);
  return {
      ErrorKind::bad_input,
      "the mesh encloses no volume that voxels of " + size +
          " mm can hold (flat, too thin, or its triangles face inward); import a solid, turn its "
          "triangles outward or choose smaller voxels"};
}

}  // namespace

Result<FinestLevel> build_finest_level(const ImportInput& input, const Progress& progress,
                                       std::uint64_t limit_bytes) {
  openvdb::initialize();
  if (progress && !progress("signs", 0.0)) return interrupted();
  ImportSampler sampler(input);
  FinestLevel out;
  auto made = scattered(sampler, progress);
  if (!made) return made.error();
  ImportField field = std::move(made).value();
  if (auto ok = follow_walls(sampler, progress, field); !ok) return ok.error();
  out.walls = std::any_of(field.leaves.begin(), field.leaves.end(), has_wall);
  if (!input.closed) {
    if (auto ok = follow_membrane(sampler, progress, limit_bytes, field); !ok) return ok.error();
  }
  if (!any_inside(field)) return no_volume(input.voxel_mm);
  if (!input.closed || out.walls) {
    if (progress && !progress("redistance", 0.0)) return interrupted();
    sampler.build_trees();  // where a membrane meets no suspicious node, they were not asked before
    solve_doubtful(sampler, field);
  }
  for (const ImportLeaf& leaf : field.leaves) out.bridged_nodes += leaf.bridged;
  out.grid = grid_of(sampler, field);
  return out;
}

}  // namespace argil
