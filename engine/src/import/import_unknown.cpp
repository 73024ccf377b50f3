// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes whose nearest triangle is no surface (a wall inside overlapping parts) or where a gap is
// closed by the membrane: their distance is found from the crossings of w = 1/2 and by marching, in
// chunks with a halo, from the nodes that are known.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>

#include "field/fast_march.h"
#include "import/import_field.h"

namespace argil {
namespace {

constexpr int kBisections = 12;             // to 1/4096 of an edge where w jumps
constexpr double kSmallestFraction = 1e-3;  // of an edge, as the surface cuts them
constexpr int kChunkLeaves = 4;             // leaves along a side of what is marched at once
constexpr int kHaloNodes = 8;               // read around it: more than the band and its stencil
constexpr int kBlockSide = kChunkLeaves * kLeafSide + 2 * kHaloNodes;

bool is_inside(float value) { return value < 0.0F; }

/// A leaf and its six face neighbours, to read values across its faces.
class LeafAndFaces {
 public:
  LeafAndFaces(const ImportField& field, std::size_t index)
      : origin_(field.origins[index]), values_(field.leaves[index].leaf->buffer().data()) {
    for (int face = 0; face < 6; ++face) {
      Coord beside = origin_;
      beside[face / 2] += (face & 1) != 0 ? kLeafSide : -kLeafSide;
      const std::ptrdiff_t found = field.find(beside);
      faces_[static_cast<std::size_t>(face)] =
          found < 0 ? nullptr : field.leaves[static_cast<std::size_t>(found)].leaf->buffer().data();
    }
  }
  Coord node(int n) const { return origin_.offsetBy(n >> 6, (n >> 3) & 7, n & 7); }
  float value(int n) const { return values_[n]; }

  /// The value one step along `face` (2 * axis + 1 upward); that of the node where there is none.
  float beside(int n, int face) const {
    assert(n >= 0 && n < kLeafNodes && face >= 0 && face < 6);
    const int shift = 6 - 3 * (face / 2);
    const int i = (n >> shift) & 7;
    const int next = (face & 1) != 0 ? i + 1 : i - 1;
    const int m = (n & ~(7 << shift)) | ((next & 7) << shift);
    if (next == (next & 7)) return values_[m];
    const float* there = faces_[static_cast<std::size_t>(face)];
    return there == nullptr ? values_[n] : there[m];
  }

 private:
  Coord origin_;
  const float* values_;
  std::array<const float*, 6> faces_{};
};

/// Whether the edge changes side though no triangle can cross it.
bool passes_membrane(float a, float b, double voxel) {
  return is_inside(a) != is_inside(b) &&
         static_cast<double>(std::abs(a)) + static_cast<double>(std::abs(b)) > voxel * (1.0 + 1e-5);
}

/// Where w passes 1/2 between a node and its neighbour, as a fraction of the edge from the node:
/// secant and bisection in turn, since w is smooth across the membrane and jumps at a triangle.
double crossing_fraction(const ImportSampler& sampler, const Vec3& from, const Vec3& to) {
  assert(is_finite(from) && is_finite(to));
  double low = 0.0;
  double high = 1.0;
  double at_low = sampler.winding(from) - 0.5;
  double at_high = sampler.winding(to) - 0.5;
  const bool start_inside = at_low > 0.0;
  for (int i = 0; i < kBisections && high - low > 2.0 * kSmallestFraction; ++i) {
    const double secant = low + (high - low) * at_low / (at_low - at_high);
    const bool usable = i % 2 == 0 && secant > low && secant < high;
    const double middle = usable ? secant : 0.5 * (low + high);
    const double value = sampler.winding(from + (to - from) * middle) - 0.5;
    if (std::abs(value) < 1e-5) return middle;
    if ((value > 0.0) == start_inside) {
      low = middle;
      at_low = value;
    } else {
      high = middle;
      at_high = value;
    }
  }
  return 0.5 * (low + high);
}

/// The distance of a node to the plane through the crossings on its edges, at most the band.
double crossing_distance(const ImportSampler& sampler, const LeafAndFaces& leaf, int n) {
  const Coord node = leaf.node(n);
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    double fraction = std::numeric_limits<double>::infinity();
    for (int up = 0; up < 2; ++up) {
      if (is_inside(leaf.beside(n, 2 * axis + up)) == is_inside(leaf.value(n))) continue;
      Coord next = node;
      next[axis] += up != 0 ? 1 : -1;
      fraction = std::min(
          fraction, crossing_fraction(sampler, sampler.position(node), sampler.position(next)));
    }
    fraction = std::max(fraction, kSmallestFraction);
    sum += 1.0 / (fraction * fraction);
  }
  return sum > 0.0 ? std::min(sampler.band(), sampler.voxel() / std::sqrt(sum)) : sampler.band();
}

/// New values of some nodes of a leaf.
struct Update {
  std::vector<std::pair<int, float>> values;
};

/// Whether the crossings beside a node say more about its distance than its nearest triangle.
bool wants_crossings(const ImportSampler& sampler, const LeafAndFaces& leaf, bool unknown, int n) {
  const float band = static_cast<float>(sampler.band());
  for (int face = 0; face < 6; ++face) {
    const float beside = leaf.beside(n, face);
    if (unknown && is_inside(beside) != is_inside(leaf.value(n))) return true;
    if (!unknown && std::abs(beside) < band &&
        passes_membrane(leaf.value(n), beside, sampler.voxel())) {
      return true;
    }
  }
  return false;
}

/// What changes is returned and written later, so that all leaves see the same state.
Update crossings_of_leaf(const ImportSampler& sampler, const ImportField& field,
                         std::size_t index) {
  Update update;
  const LeafAndFaces leaf(field, index);
  for (int n = 0; n < kLeafNodes; ++n) {
    const bool unknown = field.leaves[index].unknown.isOn(static_cast<openvdb::Index32>(n));
    if (!wants_crossings(sampler, leaf, unknown, n)) continue;
    const float distance =
        std::min(std::abs(leaf.value(n)), static_cast<float>(crossing_distance(sampler, leaf, n)));
    update.values.emplace_back(n, is_inside(leaf.value(n)) ? -distance : distance);
  }
  return update;
}

void solve_beside_crossings(const ImportSampler& sampler, ImportField& field) {
  std::vector<Update> updates(field.origins.size());
  tbb::parallel_for(std::size_t{0}, updates.size(),
                    [&](std::size_t i) { updates[i] = crossings_of_leaf(sampler, field, i); });
  for (std::size_t i = 0; i < updates.size(); ++i) {
    ImportLeaf& leaf = field.leaves[i];
    for (const auto& [n, value] : updates[i].values) {
      leaf.leaf->buffer().data()[n] = value;
      leaf.unknown.setOff(static_cast<openvdb::Index32>(n));
      leaf.doubtful = true;  // what lies around it may now be nearer than its bound
    }
  }
}

/// Copies what a leaf has of a block whose lowest node is `low`.
void copy_to_block(const ImportLeaf& leaf, const Coord& origin, const Coord& low,
                   MarchBlock& block) {
  const float* values = leaf.leaf->buffer().data();
  for (int n = 0; n < kLeafNodes; ++n) {
    const Coord at = origin.offsetBy(n >> 6, (n >> 3) & 7, n & 7) - low;
    const auto k = static_cast<std::size_t>((at.x() * kBlockSide + at.y()) * kBlockSide + at.z());
    const bool unknown = leaf.unknown.isOn(static_cast<openvdb::Index32>(n));
    block.value[k] = values[n];
    block.state[k] = unknown ? MarchBlock::kUnknown : MarchBlock::kFixed;
  }
}

/// The leaves of a chunk and of the halo around it, -1 where there is none.
std::vector<std::ptrdiff_t> leaves_around(const ImportField& field, const Coord& chunk) {
  std::vector<std::ptrdiff_t> found;
  for (int x = -1; x <= kChunkLeaves; ++x) {
    for (int y = -1; y <= kChunkLeaves; ++y) {
      for (int z = -1; z <= kChunkLeaves; ++z) {
        const std::ptrdiff_t i = field.find(chunk.offsetBy(x * 8, y * 8, z * 8));
        if (i >= 0) found.push_back(i);
      }
    }
  }
  return found;
}

/// Marches one chunk; returns the new values of the unknown nodes of its own leaves.
std::vector<std::pair<std::ptrdiff_t, Update>> march_chunk(const ImportSampler& sampler,
                                                           const ImportField& field,
                                                           const Coord& chunk) {
  std::vector<std::pair<std::ptrdiff_t, Update>> updates;
  const auto around = leaves_around(field, chunk);
  const auto leaf_at = [&](std::ptrdiff_t i) -> const ImportLeaf& {
    return field.leaves[static_cast<std::size_t>(i)];
  };
  if (std::none_of(around.begin(), around.end(),
                   [&](std::ptrdiff_t i) { return leaf_at(i).doubtful; })) {
    return updates;
  }
  constexpr std::size_t kNodes = std::size_t{kBlockSide} * kBlockSide * kBlockSide;
  const float band = static_cast<float>(sampler.band());
  const Coord low = chunk.offsetBy(-kHaloNodes);
  MarchBlock block{{kBlockSide, kBlockSide, kBlockSide},
                   static_cast<float>(sampler.voxel()),
                   std::vector<float>(kNodes, band),
                   std::vector<std::uint8_t>(kNodes, MarchBlock::kWall)};
  for (const std::ptrdiff_t i : around) {
    copy_to_block(leaf_at(i), field.origins[static_cast<std::size_t>(i)], low, block);
  }
  fast_march(block, band);
  for (const std::ptrdiff_t i : around) {
    const Coord origin = field.origins[static_cast<std::size_t>(i)];
    if ((origin & ~(kChunkLeaves * kLeafSide - 1)) != chunk) continue;
    Update update;
    for (auto n = leaf_at(i).unknown.beginOn(); n; ++n) {
      const int m = static_cast<int>(n.pos());
      const Coord at = origin.offsetBy(m >> 6, (m >> 3) & 7, m & 7) - low;
      const auto k = static_cast<std::size_t>((at.x() * kBlockSide + at.y()) * kBlockSide + at.z());
      const float bound = leaf_at(i).leaf->buffer().data()[m];
      if (std::abs(block.value[k]) < std::abs(bound)) {
        const float distance = std::abs(block.value[k]);
        update.values.emplace_back(m, is_inside(bound) ? -distance : distance);
      }
    }
    updates.emplace_back(i, std::move(update));
  }
  return updates;
}

/// The chunks that have a leaf, by the origin of their first.
std::vector<Coord> chunks_of(const ImportField& field) {
  std::vector<Coord> chunks;
  for (const Coord& origin : field.origins) {
    chunks.push_back(origin & ~(kChunkLeaves * kLeafSide - 1));
  }
  std::sort(chunks.begin(), chunks.end());
  chunks.erase(std::unique(chunks.begin(), chunks.end()), chunks.end());
  return chunks;
}

}  // namespace

std::ptrdiff_t ImportField::find(const Coord& origin) const {
  const auto found = std::lower_bound(origins.begin(), origins.end(), origin);
  return found != origins.end() && *found == origin ? found - origins.begin() : -1;
}

void ImportField::merge(const std::vector<Coord>& more_origins,
                        std::vector<ImportLeaf> more_leaves) {
  assert(are_sorted_origins(origins) && origins.size() == leaves.size());
  assert(are_sorted_origins(more_origins) && more_origins.size() == more_leaves.size());
  std::vector<Coord> all_origins;
  std::vector<ImportLeaf> all_leaves;
  all_origins.reserve(origins.size() + more_origins.size());
  all_leaves.reserve(origins.size() + more_origins.size());
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < origins.size() || j < more_origins.size()) {
    const bool old =
        j == more_origins.size() || (i < origins.size() && origins[i] < more_origins[j]);
    if (!old && i < origins.size() && origins[i] == more_origins[j]) ++i;
    all_origins.push_back(old ? origins[i] : more_origins[j]);
    all_leaves.push_back(std::move(old ? leaves[i] : more_leaves[j]));
    ++(old ? i : j);
  }
  origins = std::move(all_origins);
  leaves = std::move(all_leaves);
}

std::vector<Coord> widened(const std::vector<Coord>& origins) {
  std::vector<Coord> wide;
  for (const Coord& origin : origins) {
    for (int k = 0; k < 27; ++k) {
      wide.push_back(origin.offsetBy((k / 9 - 1) * 8, (k / 3 % 3 - 1) * 8, (k % 3 - 1) * 8));
    }
  }
  std::sort(wide.begin(), wide.end());
  wide.erase(std::unique(wide.begin(), wide.end()), wide.end());
  return wide;
}

/// Where an edge changes side though no triangle is near enough to cross it, the membrane passes.
std::vector<Coord> leaves_beside_membrane(const ImportSampler& sampler, const ImportField& field) {
  std::vector<char> passed(field.origins.size());
  tbb::parallel_for(std::size_t{0}, passed.size(), [&](std::size_t i) {
    const LeafAndFaces leaf(field, i);
    for (int n = 0; n < kLeafNodes && passed[i] == 0; ++n) {
      for (int face = 0; face < 6 && passed[i] == 0; ++face) {
        passed[i] = passes_membrane(leaf.value(n), leaf.beside(n, face), sampler.voxel()) ? 1 : 0;
      }
    }
  });
  std::vector<Coord> holding;
  for (std::size_t i = 0; i < passed.size(); ++i) {
    if (passed[i] != 0) holding.push_back(field.origins[i]);
  }
  std::vector<Coord> beside = widened(holding);
  std::erase_if(beside, [&](const Coord& origin) { return field.find(origin) >= 0; });
  return beside;
}

void solve_doubtful(const ImportSampler& sampler, ImportField& field) {
  assert(are_sorted_origins(field.origins) && field.origins.size() == field.leaves.size());
  solve_beside_crossings(sampler, field);
  const std::vector<Coord> chunks = chunks_of(field);
  std::vector<std::vector<std::pair<std::ptrdiff_t, Update>>> updates(chunks.size());
  tbb::parallel_for(std::size_t{0}, chunks.size(),
                    [&](std::size_t c) { updates[c] = march_chunk(sampler, field, chunks[c]); });
  for (const auto& chunk : updates) {
    for (const auto& [i, update] : chunk) {
      float* values = field.leaves[static_cast<std::size_t>(i)].leaf->buffer().data();
      for (const auto& [n, value] : update.values) values[n] = value;
    }
  }
}

}  // namespace argil
