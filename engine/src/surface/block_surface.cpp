// SPDX-License-Identifier: GPL-3.0-or-later
// Which blocks a change concerns, and the extraction of those in parallel. A block reads its own
// level, the next finer and the next coarser one, so each change marks up to three ranges of
// blocks; a block that reads coarser values only for the sides of nodes is compared by a hash
// first.
#include "surface/block_surface.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <utility>

#include "field/leaf_finder.h"
#include "field/leaf_map.h"
#include "field/parallel.h"
#include "surface/vertex_table.h"

namespace argil {

namespace {

struct Range {
  Coord low;
  Coord high;

  bool is_empty() const { return high.x() < low.x(); }
  bool contains(const Coord& origin) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (origin[axis] < low[axis] || origin[axis] > high[axis]) return false;
    }
    return true;
  }
};

// The leaves whose blocks look at nodes or cells of their own level.
Range leaves_seeing(const Range& nodes) {
  if (nodes.is_empty()) return nodes;
  Range range;
  for (int axis = 0; axis < 3; ++axis) {
    range.low[axis] = (nodes.low[axis] - 9 + 7) & ~7;
    range.high[axis] = (nodes.high[axis] + 1) & ~7;
  }
  return range;
}

// The same nodes as the next coarser level, and the next finer one, counts them.
Range coarser_nodes(const Range& nodes) {
  if (nodes.is_empty()) return nodes;
  return {nodes.low >> 1, (nodes.high + Coord(1)) >> 1};
}
Range finer_nodes(const Range& nodes) {
  if (nodes.is_empty()) return nodes;
  return {(nodes.low << 1).offsetBy(-1), (nodes.high << 1).offsetBy(1)};
}

template <class Do>
void for_each_origin_in(const Range& range, const Do& act) {
  for (int x = range.low.x(); x <= range.high.x(); x += kLeafSide) {
    for (int y = range.low.y(); y <= range.high.y(); y += kLeafSide) {
      for (int z = range.low.z(); z <= range.high.z(); z += kLeafSide) act(Coord(x, y, z));
    }
  }
}

// Which of 27 leaves of a level are shown: bit 9 a + 3 b + c of the one so many after `first`.
constexpr std::uint32_t kAllOf27 = (1U << 27) - 1;
std::uint32_t shown_of_27(const ShownLeaves& leaves, LeafFinder& finder, int level,
                          const Coord& first) {
  std::uint32_t shown = 0;
  unsigned bit = 0;
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      for (int c = 0; c < 3; ++c, ++bit) {
        const Coord at = first.offsetBy(kLeafSide * a, kLeafSide * b, kLeafSide * c);
        if (finder.has_leaf(at) && leaves.shows(level, at)) shown |= 1U << bit;
      }
    }
  }
  return shown;
}

// Nodes of a leaf: bit 8 y + z of plane x.
using NodePlanes = std::array<std::uint64_t, kLeafSide>;
constexpr NodePlanes kAllNodes{~0ULL, ~0ULL, ~0ULL, ~0ULL, ~0ULL, ~0ULL, ~0ULL, ~0ULL};

// What blocks of the next coarser level read of a leaf where a neighbour of it is not shown, by the
// direction in which that lies, below, beside or above: values no farther than two nodes from it,
// and sides of the nodes on its faces.
using RowsByDirection = std::array<unsigned, 3>;
constexpr RowsByDirection kValuesRead{0x07, 0xff, 0xc0};
constexpr RowsByDirection kSidesRead{0x01, 0xff, 0x00};

NodePlanes read_by_coarser(std::uint32_t shown_of_27, const RowsByDirection& read) {
  NodePlanes planes{};
  for (unsigned n = 0; n < 27; ++n) {
    if ((shown_of_27 >> n & 1U) != 0) continue;
    std::uint64_t plane = 0;
    for (std::size_t y = 0; y < kLeafSide; ++y) {
      if ((read[n / 3 % 3] >> y & 1U) != 0) plane |= std::uint64_t{read[n % 3]} << (8 * y);
    }
    for (std::size_t x = 0; x < kLeafSide; ++x) {
      if ((read[n / 9] >> x & 1U) != 0) planes[x] |= plane;
    }
  }
  return planes;
}

// The first and last octant, -1 to 1, that a node with this coordinate touches.
std::pair<int, int> octants_of(int node) {
  assert(node >= 0 && node < kLeafSide);
  if (node % 4 == 0) return {node / 4 - 1, node / 4};
  return {node / 4, node / 4};
}

// The nodes z of row (x, y) that touch none but covered octants: whatever reads there, reads finer
// values.
std::uint8_t hidden_nodes(std::uint32_t covered, int x, int y) {
  const auto [x0, x1] = octants_of(x);
  const auto [y0, y1] = octants_of(y);
  std::array<bool, 3> all{true, true, true};  // by octant along z
  for (int a = x0; a <= x1; ++a) {
    for (int b = y0; b <= y1; ++b) {
      const unsigned row = covered >> static_cast<unsigned>(9 * (a + 1) + 3 * (b + 1));
      for (std::size_t c = 0; c < 3; ++c) all[c] = all[c] && (row >> c & 1U) != 0;
    }
  }
  unsigned hidden = 0;
  if (all[1]) hidden |= 0x0eU;
  if (all[2]) hidden |= 0xe0U;
  if (all[0] && all[1]) hidden |= 0x01U;
  if (all[1] && all[2]) hidden |= 0x10U;
  return static_cast<std::uint8_t>(hidden);
}

// The same for all rows of a leaf. A coordinate touches the octants that 0, 1, 4 or 5 touches.
class HiddenNodes {
 public:
  explicit HiddenNodes(std::uint32_t covered) {
    constexpr std::array<int, 4> kLike{0, 1, 4, 5};
    if (covered == 0) return;
    for (std::size_t x = 0; x < 4; ++x) {
      for (std::size_t y = 0; y < 4; ++y) {
        rows_[4 * x + y] = hidden_nodes(covered, kLike[x], kLike[y]);
      }
    }
  }
  std::uint64_t plane(std::size_t x) const {
    std::uint64_t rows = 0;
    for (std::size_t y = 0; y < kLeafSide; ++y) {
      rows |= std::uint64_t{rows_[4 * kKind[x] + kKind[y]]} << (8 * y);
    }
    return rows;
  }

 private:
  static constexpr std::array<std::size_t, 8> kKind{0, 1, 1, 1, 2, 3, 3, 3};
  std::array<std::uint8_t, 16> rows_{};
};

// The box of those of a change's `rows` that some block may read, if it reads `read` of the leaf;
// empty when there are none.
Range visible_box(const LeafChange& change, const NodeRows& rows, const HiddenNodes& hidden,
                  const NodePlanes& read) {
  Range box{Coord(kLeafSide), Coord(-1)};
  if (change.is_whole) box = {Coord(0), Coord(kLeafSide)};
  for (std::size_t x = 0; x < kLeafSide && !change.is_whole; ++x) {
    std::uint64_t plane = 0;  // bit 8 y + z
    for (std::size_t y = 0; y < kLeafSide; ++y) {
      plane |= std::uint64_t{rows[kLeafSide * x + y]} << (8 * y);
    }
    plane &= read[x];
    if (plane != 0) plane &= ~hidden.plane(x);
    if (plane == 0) continue;
    std::uint64_t any_y = plane | plane >> 32;
    any_y |= any_y >> 16;
    const auto along_z = static_cast<std::uint8_t>(any_y | any_y >> 8);
    const auto at = static_cast<int>(x);
    box.low.minComponent(Coord(at, std::countr_zero(plane) / kLeafSide, std::countr_zero(along_z)));
    box.high.maxComponent(Coord(at, (static_cast<int>(std::bit_width(plane)) - 1) / kLeafSide,
                                static_cast<int>(std::bit_width(along_z)) - 1));
  }
  if (!box.is_empty()) box = {box.low + change.origin, box.high + change.origin};
  return box;
}

// Shared vertices are found by the name of their lattice edge; vertices inside a leaf have none.
void append_block(const ContourMesh& block, VertexTable& table, std::vector<std::uint32_t>& to,
                  TriangleMesh& mesh) {
  assert(block.keys.size() == block.positions.size() && block.keys.size() == block.normals.size());
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

/// What a block sees of some changes, in itself or in the levels beside its own.
enum SeenChange : std::uint8_t {
  kWhole = 1,          // a leaf came or went
  kValues = 2,         // values of its own level or the next finer one changed
  kFlips = 4,          // and their sides
  kCoarserValues = 8,  // values of the next coarser level changed
  kCoarserFlips = 16   // and their sides
};

/// What the blocks of each level see of some changes.
using Marks = std::vector<LeafMap<std::uint8_t>>;

/// Marks the blocks that may see changes.
class Marking {
 public:
  explicit Marking(const ShownLeaves& leaves)
      : leaves_(leaves), marks_(static_cast<std::size_t>(leaves.stack().count())) {
    for (int level = 0; level < leaves.stack().count(); ++level) {
      finders_.emplace_back(leaves.stack(), level);
    }
  }

  void add(const LeafChange& change) {
    assert(leaves_.stack().is_level(change.level) && is_leaf_origin(change.origin));
    const int level = change.level;
    const int flags = change.is_whole ? kValues | kWhole : kValues;
    const HiddenNodes hidden(
        !change.is_whole && level > 0 ? shown_around(level - 1, change.origin << 1) : 0);
    const Range nodes = visible_box(change, change.nodes, hidden, kAllNodes);
    if (nodes.is_empty()) return;
    const Range flipped = visible_box(change, change.flipped, hidden, kAllNodes);
    mark(level, nodes, flags);
    mark(level, flipped, kFlips);
    if (level > 0) {
      mark(level - 1, finer_nodes(nodes), kCoarserValues);
      mark(level - 1, finer_nodes(flipped), kCoarserFlips);
    }
    if (level == leaves_.stack().top()) return;
    const std::uint32_t shown = change.is_whole ? 0 : shown_around(level, change.origin);
    if (shown == kAllOf27) return;
    const auto box = [&](const NodeRows& rows, const RowsByDirection& read) {
      return coarser_nodes(visible_box(change, rows, hidden, read_by_coarser(shown, read)));
    };
    mark(level + 1, box(change.nodes, kValuesRead), flags);
    mark(level + 1, box(change.flipped, kSidesRead), kFlips);
  }

  const Marks& marks() const noexcept { return marks_; }
  Marks take() noexcept { return std::move(marks_); }

 private:
  // Of the leaf at `origin` and its neighbours.
  std::uint32_t shown_around(int level, const Coord& origin) {
    return shown_of_27(leaves_, finders_[static_cast<std::size_t>(level)], level,
                       origin.offsetBy(-kLeafSide));
  }
  void mark(int level, const Range& range, int seen) {
    if (range.is_empty()) return;
    LeafMap<std::uint8_t>& map = marks_[static_cast<std::size_t>(level)];
    for_each_origin_in(leaves_seeing(range), [&](const Coord& origin) {
      std::uint8_t& flags = map.at(origin);
      flags = static_cast<std::uint8_t>(flags | seen);
    });
  }

  const ShownLeaves& leaves_;
  std::vector<LeafFinder> finders_;  // by level
  Marks marks_;
};

}  // namespace

std::vector<LeafMap<std::uint8_t>> leaves_that_see(const ShownLeaves& leaves,
                                                   std::span<const LeafChange> changes) {
  Marking marking(leaves);
  for (const LeafChange& change : changes) marking.add(change);
  return marking.take();
}

template <class Block>
void BlocksOf<Block>::clear() {
  blocks_.clear();
  index_.clear();
  triangles_ = 0;
  changed_.clear();
  gone_.clear();
  seen_.clear();
  extractors_of_.reset();
}

template <class Block>
void BlocksOf<Block>::begin_with_changes(const ShownLeaves& leaves) {
  clear();
  seen_.resize(static_cast<std::size_t>(leaves.stack().count()));
}

template <class Block>
std::int64_t BlocksOf<Block>::rebuild_all(const ShownLeaves& leaves) {
  return run(leaves, all_jobs(leaves));
}

template <class Block>
std::optional<std::int64_t> BlocksOf<Block>::rebuild_all(const ShownLeaves& leaves,
                                                         const Progress& progress) {
  return run(leaves, all_jobs(leaves), progress);
}

/// Forgets what was known of other leaves, and lists a job for each of these.
template <class Block>
std::vector<typename BlocksOf<Block>::Job> BlocksOf<Block>::all_jobs(const ShownLeaves& leaves) {
  changed_.clear();
  gone_.clear();
  seen_.clear();
  extractors_of_.reset();  // another stack may lie where the last one lay
  drop_without_leaf(leaves);
  std::vector<Job> jobs;
  for (int level = 0; level < leaves.stack().count(); ++level) {
    for (const Coord& origin : leaves.stack().sorted_origins(level)) {
      if (!leaves.shows(level, origin)) continue;
      jobs.push_back({{level, origin}, false, find({level, origin})});
    }
  }
  return jobs;
}

template <class Block>
Block& BlocksOf<Block>::insert(const LeafKey& at, Block&& block) {
  const auto level = static_cast<std::size_t>(at.level);
  if (index_.size() <= level) index_.resize(level + 1);
  Block*& slot = index_[level].at(at.origin);
  slot = &blocks_.emplace(at, std::move(block)).first->second;
  return *slot;
}

template <class Block>
typename BlocksOf<Block>::Blocks::iterator BlocksOf<Block>::erase(typename Blocks::iterator at) {
  index_[static_cast<std::size_t>(at->first.level)].at(at->first.origin) = nullptr;
  return blocks_.erase(at);
}

template <class Block>
void BlocksOf<Block>::drop_without_leaf(const ShownLeaves& leaves) {
  for (auto at = blocks_.begin(); at != blocks_.end();) {
    const LeafKey& where = at->first;
    if (where.level < leaves.stack().count() && leaves.has_leaf(where.level, where.origin)) {
      ++at;
      continue;
    }
    const bool was_drawn = at->second.triangle_count() > 0;
    triangles_ -= at->second.triangle_count();
    list(where, {true, true, true, was_drawn}, false);
    at = erase(at);
  }
  std::sort(gone_.begin(), gone_.end());
}

/// Blocks come and go with leaves only: a change of values concerns those there are, and where
/// nothing went from inside to outside only those that have a surface.
template <class Block>
std::optional<typename BlocksOf<Block>::Job> BlocksOf<Block>::job_at(const ShownLeaves& leaves,
                                                                     const LeafKey& where,
                                                                     int seen) {
  Block* const found = find(where);
  if (found == nullptr) {
    const bool is_new = is_first_change(where) || (seen & kWhole) != 0;
    if (!is_new || !leaves.has_leaf(where.level, where.origin)) return std::nullopt;
    return Job{where, false, nullptr};
  }
  Block& block = *found;
  const BlockTrace& trace = block.trace;
  const bool has_surface = block.triangle_count() > 0;
  if ((seen & kFlips) != 0 || ((seen & kValues) != 0 && has_surface)) {
    return Job{where, false, &block};
  }
  // Only what the next coarser level says changed: that concerns blocks that read it.
  if (!trace.reads_coarser) return std::nullopt;
  const bool by_values = (seen & kCoarserValues) != 0 && trace.values_coarser && has_surface;
  if (!by_values && (seen & kCoarserFlips) == 0) return std::nullopt;
  return Job{where, !trace.values_coarser, &block};
}

template <class Block>
std::int64_t BlocksOf<Block>::update(const ShownLeaves& leaves,
                                     std::span<const LeafChange> changes) {
  changed_.clear();
  gone_.clear();
  Marking marking(leaves);
  for (const LeafChange& change : changes) marking.add(change);
  std::vector<Job> jobs;
  for (int level = 0; level < leaves.stack().count(); ++level) {
    marking.marks()[static_cast<std::size_t>(level)].for_each(
        [&](const Coord& origin, std::uint8_t seen) {
          if (const auto job = job_at(leaves, {level, origin}, seen)) jobs.push_back(*job);
          if (!seen_.empty()) seen_[static_cast<std::size_t>(level)].at(origin) = 1;
        });
  }
  return run(leaves, jobs);
}

template <class Block>
typename BlocksOf<Block>::Extractors& BlocksOf<Block>::extractors_for(const ShownLeaves& leaves) {
  if (extractors_of_ != leaves) {
    extractors_ = std::make_unique<Extractors>(leaves);
    extractors_of_ = leaves;
  }
  for (BlockExtractor& extractor : *extractors_) extractor.forget();
  return *extractors_;
}

/// Blocks that are there are made in place, which keeps their memory.
template <class Block>
std::optional<std::int64_t> BlocksOf<Block>::run(const ShownLeaves& leaves,
                                                 std::span<const Job> jobs,
                                                 const Progress& progress) {
  assert(std::adjacent_find(jobs.begin(), jobs.end(), [](const Job& a, const Job& b) {
           return a.where == b.where;
         }) == jobs.end());
  std::vector<Done> done(jobs.size());
  std::vector<Block> made(jobs.size());
  for (const Job& job : jobs) {
    if (job.block != nullptr) triangles_ -= job.block->triangle_count();
  }
  Extractors& extractors = extractors_for(leaves);
  // A look takes as long as a hundred blocks; four thousand take some 20 ms.
  const std::size_t stride = progress ? 4096 : jobs.size();
  for (std::size_t begin = 0; begin < jobs.size(); begin += stride) {
    const auto all = static_cast<double>(jobs.size());
    if (progress && !progress("surface", static_cast<double>(begin) / all)) {
      clear();
      return std::nullopt;
    }
    for_each_leaf(std::min(stride, jobs.size() - begin), [&](std::size_t i) {
      BlockExtractor& extractor = extractors.local();
      extractor.set_path(path_);
      done[begin + i] = work(extractor, jobs[begin + i], made[begin + i]);
    });
  }
  std::int64_t count = 0;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    Block* block = jobs[i].block;
    if (done[i].is_absent) {
      if (block != nullptr) erase(blocks_.find(jobs[i].where));
      list(jobs[i].where, done[i], false);
      continue;
    }
    if (block == nullptr) block = &insert(jobs[i].where, std::move(made[i]));
    triangles_ += block->triangle_count();
    if (done[i].is_extracted) ++count;
    list(jobs[i].where, done[i], block->triangle_count() > 0);
  }
  return count;
}

template <class Block>
typename BlocksOf<Block>::Done BlocksOf<Block>::work(BlockExtractor& extractor, const Job& job,
                                                     Block& fresh) const {
  const auto& [where, only_if_signs_changed, block] = job;
  assert(!only_if_signs_changed || block != nullptr);
  if (only_if_signs_changed && extractor.signs(where.level, where.origin) == block->trace.signs) {
    return {};
  }
  Done done;
  done.was_drawn = block != nullptr && block->triangle_count() > 0;
  const SurfaceBlock* extracted = extractor.extract(where.level, where.origin);
  done.is_extracted = extracted != nullptr;
  done.is_absent = extracted == nullptr;
  done.differs = done.is_absent || (block != nullptr ? *block : fresh).assign(*extracted);
  return done;
}

template <class Block>
void BlocksOf<Block>::list(const LeafKey& where, const Done& done, bool is_drawn) {
  if constexpr (!Block::kIsListed) return;
  if (!done.differs) return;
  if (is_drawn) {
    changed_.push_back(where);
  } else if (done.was_drawn) {
    gone_.push_back(where);
  }
}

template class BlocksOf<SurfaceBlock>;
template class BlocksOf<DrawnBlock>;

std::optional<TriangleMesh> BlockSurface::weld(const Progress& progress) const {
  std::size_t keyed = 0;
  std::size_t vertices = 0;
  std::vector<const Blocks::value_type*> sorted;
  sorted.reserve(blocks().size());
  for (const auto& entry : blocks()) {
    const SurfaceBlock& block = entry.second;
    sorted.push_back(&entry);
    vertices += block.mesh.keys.size();
    for (const std::uint64_t key : block.mesh.keys) keyed += key != ContourMesh::kNoKey ? 1 : 0;
  }
  std::sort(sorted.begin(), sorted.end(),
            [](const auto* a, const auto* b) { return a->first < b->first; });
  TriangleMesh mesh;
  mesh.positions.reserve(vertices);
  mesh.normals.reserve(vertices);
  mesh.triangles.reserve(static_cast<std::size_t>(triangle_count()));
  VertexTable table(keyed);
  std::vector<std::uint32_t> to;
  constexpr std::size_t kBetweenLooks = 4096;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const double done = static_cast<double>(i) / static_cast<double>(sorted.size());
    if (i % kBetweenLooks == 0 && progress && !progress("weld", done)) return std::nullopt;
    append_block(sorted[i]->second.mesh, table, to, mesh);
  }
  return mesh;
}

}  // namespace argil
