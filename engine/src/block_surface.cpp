// SPDX-License-Identifier: GPL-3.0-or-later
#include "block_surface.h"

#include <bit>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

namespace argil {

namespace {

struct Range {
  Coord low;
  Coord high;
};

// Floor and ceiling of v * 2^from / 2^to.
int scaled_down(int v, int from, int to) {
  return from >= to ? v << (from - to) : v >> (to - from);
}
int scaled_up(int v, int from, int to) { return -scaled_down(-v, from, to); }

// The places of level `to` whose blocks look at nodes or cells from `low` to `high` of level
// `from`.
Range places_that_see(const Coord& low, const Coord& high, int from, int to) {
  Range range;
  for (int axis = 0; axis < 3; ++axis) {
    range.low[axis] = (scaled_down(low[axis], from, to) - 9 + 7) & ~7;
    range.high[axis] = (scaled_up(high[axis], from, to) + 1) & ~7;
  }
  return range;
}

bool contains(const Range& range, const Coord& place) {
  for (int axis = 0; axis < 3; ++axis) {
    if (place[axis] < range.low[axis] || place[axis] > range.high[axis]) return false;
  }
  return true;
}

template <class Do>
void for_each_place(const Range& range, const Do& act) {
  for (int x = range.low.x(); x <= range.high.x(); x += kLeafSide) {
    for (int y = range.low.y(); y <= range.high.y(); y += kLeafSide) {
      for (int z = range.low.z(); z <= range.high.z(); z += kLeafSide) act(Coord(x, y, z));
    }
  }
}

// Finer leaves that may take values from a leaf through interpolation, level by level: a leaf lies
// in one of the next coarser level, so only the children of those found need a look.
template <class Do>
void for_each_finer_reader(const LevelStack& stack, const LeafChange& change, const Do& act) {
  const Coord low = change.place.offsetBy(-1);
  const Coord high = change.place.offsetBy(kLeafSide);
  std::vector<Coord> found;
  for_each_place(places_that_see(low, high, change.level, change.level), [&](const Coord& place) {
    if (stack.has_leaf(change.level, place)) found.push_back(place);
  });
  for (int level = change.level - 1; level >= 0 && !found.empty(); --level) {
    const Range range = places_that_see(low, high, change.level, level);
    std::vector<Coord> finer;
    for (const Coord& parent : found) {
      for_each_place({parent << 1, (parent << 1).offsetBy(kLeafSide)}, [&](const Coord& place) {
        if (contains(range, place) && stack.has_leaf(level, place)) finer.push_back(place);
      });
    }
    for (const Coord& place : finer) act(LeafChange{level, place});
    found = std::move(finer);
  }
}

// Vertices by key: open addressing over a power of two at least twice the keys.
class KeyTable {
 public:
  explicit KeyTable(std::size_t keys)
      : slots_(std::bit_ceil(2 * keys + 1), {ContourMesh::kNoKey, 0}) {}

  // The vertex of `key`, or `fresh` when there was none, which then is it.
  std::uint32_t find_or_insert(std::uint64_t key, std::uint32_t fresh) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = static_cast<std::size_t>((key * 0x9e3779b97f4a7c15ULL) >> 20) & mask;
    while (slots_[at].first != ContourMesh::kNoKey && slots_[at].first != key) at = (at + 1) & mask;
    if (slots_[at].first == ContourMesh::kNoKey) slots_[at] = {key, fresh};
    return slots_[at].second;
  }

 private:
  std::vector<std::pair<std::uint64_t, std::uint32_t>> slots_;
};

void append_block(const ContourMesh& block, KeyTable& table, std::vector<std::uint32_t>& to,
                  TriangleMesh& mesh) {
  to.resize(block.keys.size());
  for (std::size_t i = 0; i < block.keys.size(); ++i) {
    const auto fresh = static_cast<std::uint32_t>(mesh.positions.size());
    const std::uint64_t key = block.keys[i];
    to[i] = key == ContourMesh::kNoKey ? fresh : table.find_or_insert(key, fresh);
    if (to[i] != fresh) continue;
    mesh.positions.push_back(block.positions[i]);
    mesh.normals.push_back(block.normals[i]);
  }
  for (const Triangle& t : block.triangles)
    mesh.triangles.push_back({to[t[0]], to[t[1]], to[t[2]]});
}

}  // namespace

std::int64_t BlockSurface::rebuild_all(const LevelStack& stack) {
  blocks_.clear();
  triangles_ = 0;
  std::vector<Job> jobs;
  for (int level = 0; level < stack.count(); ++level) {
    for (const Coord& place : stack.sorted_places(level)) jobs.push_back({{level, place}, false});
  }
  return run(stack, jobs);
}

std::int64_t BlockSurface::update(const LevelStack& stack, std::span<const LeafChange> changes) {
  std::map<LeafChange, bool> wanted;  // true: only if signs changed
  for (const LeafChange& change : changes) {
    for (int level = change.level; level < stack.count(); ++level) {
      const Range range =
          places_that_see(change.place, change.place.offsetBy(kLeafSide), change.level, level);
      for_each_place(range, [&](const Coord& place) { wanted[{level, place}] = false; });
    }
    for_each_finer_reader(stack, change, [&](const LeafChange& reader) {
      const auto block = blocks_.find(reader);
      if (block == blocks_.end() || !block->second.reads_coarser) return;
      bool& lazily = wanted.try_emplace(reader, true).first->second;
      if (block->second.values_coarser) lazily = false;
    });
  }
  std::vector<Job> jobs;
  jobs.reserve(wanted.size());
  for (const auto& [where, lazily] : wanted) jobs.push_back({where, lazily});
  return run(stack, jobs);
}

std::int64_t BlockSurface::run(const LevelStack& stack, std::span<const Job> jobs) {
  enum class Outcome : std::uint8_t { unchanged, absent, made };
  std::vector<Outcome> outcomes(jobs.size(), Outcome::unchanged);
  std::vector<SurfaceBlock> made(jobs.size());
  tbb::enumerable_thread_specific<BlockExtractor> extractors(stack);
  const auto work = [&](const tbb::blocked_range<std::size_t>& range) {
    BlockExtractor& extractor = extractors.local();
    extractor.set_path(path_);
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const auto& [level, place] = jobs[i].where;
      if (jobs[i].only_if_signs_changed &&
          extractor.signs(level, place) == blocks_.at(jobs[i].where).signs) {
        continue;
      }
      outcomes[i] = extractor.extract(level, place, made[i]) ? Outcome::made : Outcome::absent;
    }
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, jobs.size(), 8), work);
  std::int64_t count = 0;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    if (outcomes[i] == Outcome::unchanged) continue;
    put(jobs[i].where, outcomes[i] == Outcome::made, std::move(made[i]));
    if (outcomes[i] == Outcome::made) ++count;
  }
  return count;
}

void BlockSurface::put(const LeafChange& where, bool present, SurfaceBlock&& block) {
  const auto size = [](const SurfaceBlock& b) {
    return static_cast<std::int64_t>(b.mesh.triangles.size());
  };
  const auto old = blocks_.find(where);
  if (old != blocks_.end()) triangles_ -= size(old->second);
  if (present) {
    triangles_ += size(block);
    if (old != blocks_.end()) {
      old->second = std::move(block);
    } else {
      blocks_.emplace_hint(blocks_.end(), where, std::move(block));
    }
  } else if (old != blocks_.end()) {
    blocks_.erase(old);
  }
}

TriangleMesh BlockSurface::weld() const {
  std::size_t keyed = 0;
  std::size_t vertices = 0;
  for (const auto& [where, block] : blocks_) {
    vertices += block.mesh.keys.size();
    for (const std::uint64_t key : block.mesh.keys) keyed += key != ContourMesh::kNoKey ? 1 : 0;
  }
  TriangleMesh mesh;
  mesh.positions.reserve(vertices);
  mesh.normals.reserve(vertices);
  mesh.triangles.reserve(static_cast<std::size_t>(triangles_));
  KeyTable table(keyed);
  std::vector<std::uint32_t> to;
  for (const auto& [where, block] : blocks_) append_block(block.mesh, table, to, mesh);
  return mesh;
}

}  // namespace argil
