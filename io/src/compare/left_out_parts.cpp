// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare/left_out_parts.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "argil/engine/field_sampler.h"

#include "compare/distance_sums.h"
#include "compare/lattice_edge.h"

namespace argil::io {
namespace {

constexpr int kBoxes = LeftOutParts::kBoxes;

std::size_t number_of(int i, int j, int k) {
  return static_cast<std::size_t>((i * kBoxes + j) * kBoxes + k);
}
/// The box that a place is in, and the last one that ends there.
int box_of(double fraction) {
  return std::clamp(static_cast<int>(std::floor(kBoxes * fraction)), 0, kBoxes - 1);
}
int box_before(double fraction) {
  return std::clamp(static_cast<int>(std::ceil(kBoxes * fraction)) - 1, 0, kBoxes - 1);
}

}  // namespace

/// The edges, of all levels, that vertices of what was left out lie on and none that is kept does.
/// Where finer cells cut an edge in parts, phi = 0 may pass through several of these. Between ends
/// of different signs that is an odd number: where an even number of them is of what was left out,
/// one that is kept must be among the others, though its vertex was moved off the edge.
class LeftOutParts::Edges {
 public:
  Edges(const TriangleMesh& surface, const TriangleMesh& left_out, std::int8_t coarsest,
        double voxel_mm, const Pace& pace);

  struct Cut {
    LatticeEdge edge;
    std::uint32_t vertex = 0;  ///< of what was left out, the first on the edge
    bool has_kept = false;     ///< something that is kept passes through it as well
  };

  /// Null where no vertex of what was left out lies on the edge.
  const Cut* on(const LatticeEdge& edge) const {
    const std::size_t place = place_of(edge);
    return place == edges_.size() ? nullptr : &edges_[place];
  }

 private:
  std::size_t place_of(const LatticeEdge& edge) const {
    const auto found =
        std::lower_bound(edges_.begin(), edges_.end(), edge,
                         [](const Cut& cut, const LatticeEdge& e) { return cut.edge < e; });
    if (found == edges_.end() || found->edge != edge) return edges_.size();
    return static_cast<std::size_t>(found - edges_.begin());
  }
  void join_parts();
  void forget_kept(const TriangleMesh& surface, std::int8_t coarsest, double voxel_mm,
                   const Pace& pace);

  std::vector<Cut> edges_;  ///< by edge, each once
};

/// A vertex lies on edges of several levels where these run along each other: a cell beside finer
/// ones has edges that are cut in parts.
LeftOutParts::Edges::Edges(const TriangleMesh& surface, const TriangleMesh& left_out,
                           std::int8_t coarsest, double voxel_mm, const Pace& pace) {
  for (std::uint32_t v = 0; v < left_out.positions.size(); ++v) {
    for (std::int8_t level = 0; level <= coarsest; ++level) {
      const std::optional<LatticeEdge> edge = edge_at(left_out.positions[v], level, voxel_mm);
      if (edge) edges_.push_back({*edge, v});
    }
  }
  std::stable_sort(edges_.begin(), edges_.end(),
                   [](const Cut& a, const Cut& b) { return a.edge < b.edge; });
  join_parts();
  forget_kept(surface, coarsest, voxel_mm, pace);
}

/// Of an edge that several vertices lie on one Cut stays, with the first of them.
void LeftOutParts::Edges::join_parts() {
  std::size_t count = 0;
  for (std::size_t begin = 0, end = 0; begin < edges_.size(); begin = end) {
    while (end < edges_.size() && edges_[end].edge == edges_[begin].edge) ++end;
    Cut joined = edges_[begin];
    joined.has_kept = (end - begin) % 2 == 0;
    edges_[count++] = joined;
  }
  edges_.resize(count);
}

/// Of an edge that finer cells cut in parts, some may have a vertex that is kept.
void LeftOutParts::Edges::forget_kept(const TriangleMesh& surface, std::int8_t coarsest,
                                      double voxel_mm, const Pace& pace) {
  const std::vector<Vec3>& kept = surface.positions;
  std::vector<std::vector<std::size_t>> blocks(block_count(kept.size()));
  in_blocks(kept.size(), pace, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      for (std::int8_t level = 0; level <= coarsest; ++level) {
        const std::optional<LatticeEdge> edge = edge_at(kept[v], level, voxel_mm);
        const std::size_t place = edge ? place_of(*edge) : edges_.size();
        if (place < edges_.size()) blocks[begin / kDistanceBlock].push_back(place);
      }
    }
  });
  std::vector<std::uint8_t> has_kept(edges_.size(), 0);
  for (const std::vector<std::size_t>& block : blocks) {
    for (const std::size_t place : block) has_kept[place] = 1;
  }
  std::size_t place = 0;
  std::erase_if(edges_, [&](const Cut&) { return has_kept[place++] != 0; });
}

/// The pieces of phi = 0 in one cell.
class LeftOutParts::Pieces {
 public:
  explicit Pieces(const Trilinear& phi);

  const Boxes& all() const noexcept { return crossed_; }
  /// The boxes of the piece that passes through a place on an edge, and of what they touch.
  Boxes at(const Vec3& place) const;

 private:
  template <class Use>
  static void for_each_touching(std::size_t box, const Use& use);

  Boxes crossed_;
};

LeftOutParts::Pieces::Pieces(const Trilinear& phi) {
  constexpr int kNodes = kBoxes + 1;
  const double rounding = phi.rounding();
  // Bit 0: not outside, bit 1: not inside, where rounding may make it either.
  std::array<std::uint8_t, std::size_t{kNodes} * kNodes * kNodes> signs{};
  const auto node = [](int i, int j, int k) {
    return static_cast<std::size_t>((i * kNodes + j) * kNodes + k);
  };
  for (int n = 0; n < kNodes * kNodes * kNodes; ++n) {
    const Vec3 at{1.0 * (n / (kNodes * kNodes)), 1.0 * (n / kNodes % kNodes), 1.0 * (n % kNodes)};
    const double value = phi.value((1.0 / kBoxes) * at);
    signs[static_cast<std::size_t>(n)] =
        static_cast<std::uint8_t>((value <= rounding ? 1 : 0) | (value >= -rounding ? 2 : 0));
  }
  for (int n = 0; n < kBoxes * kBoxes * kBoxes; ++n) {
    const int i = n / (kBoxes * kBoxes);
    const int j = n / kBoxes % kBoxes;
    const int k = n % kBoxes;
    unsigned both = 0;
    for (int corner = 0; corner < 8; ++corner) {
      both |= signs[node(i + (corner >> 2), j + (corner >> 1 & 1), k + (corner & 1))];
    }
    crossed_[static_cast<std::size_t>(n)] = both == 3;
  }
}

/// The boxes that have a corner in common with this one.
template <class Use>
void LeftOutParts::Pieces::for_each_touching(std::size_t box, const Use& use) {
  const int n = static_cast<int>(box);
  const std::array<int, 3> at{n / (kBoxes * kBoxes), n / kBoxes % kBoxes, n % kBoxes};
  const auto low = [&](std::size_t axis) { return std::max(at[axis] - 1, 0); };
  const auto high = [&](std::size_t axis) { return std::min(at[axis] + 1, kBoxes - 1); };
  for (int i = low(0); i <= high(0); ++i) {
    for (int j = low(1); j <= high(1); ++j) {
      for (int k = low(2); k <= high(2); ++k) use(number_of(i, j, k));
    }
  }
}

LeftOutParts::Boxes LeftOutParts::Pieces::at(const Vec3& place) const {
  const std::size_t first = number_of(box_of(place.x), box_of(place.y), box_of(place.z));
  Boxes piece;
  std::vector<std::size_t> open{first};
  piece.set(first);
  while (!open.empty()) {
    const std::size_t box = open.back();
    open.pop_back();
    for_each_touching(box, [&](std::size_t beside) {
      if (!crossed_[beside] || piece[beside]) return;
      piece.set(beside);
      open.push_back(beside);
    });
  }
  return piece & crossed_;
}

LeftOutParts::LeftOutParts(const TriangleMesh& surface, const TriangleMesh& left_out,
                           const std::vector<SurfaceCell>& cells, double voxel_mm,
                           const Pace& pace) {
  std::int8_t coarsest = 0;
  for (const SurfaceCell& cell : cells) coarsest = std::max(coarsest, cell.level);
  const Edges edges(surface, left_out, coarsest, voxel_mm, pace.part(0.0, 0.5));
  struct Found {
    std::vector<Mixed> mixed;
    std::vector<std::uint32_t> ambiguous;
  };
  std::vector<Found> blocks(block_count(cells.size()));
  in_blocks(cells.size(), pace.part(0.5, 1.0), [&](std::size_t begin, std::size_t end) {
    Found& found = blocks[begin / kDistanceBlock];
    for (std::size_t c = begin; c < end; ++c) {
      Mixed mixed = mixed_in(cells[c], edges, found.ambiguous);
      mixed.cell = static_cast<std::uint32_t>(c);
      if (mixed.left_out.any()) found.mixed.push_back(mixed);
    }
  });
  for (const Found& found : blocks) {
    mixed_.insert(mixed_.end(), found.mixed.begin(), found.mixed.end());
    ambiguous_.insert(ambiguous_.end(), found.ambiguous.begin(), found.ambiguous.end());
  }
  std::sort(ambiguous_.begin(), ambiguous_.end());
  ambiguous_.erase(std::unique(ambiguous_.begin(), ambiguous_.end()), ambiguous_.end());
}

/// Adds to `ambiguous` what ambiguous() is to have of the cell.
LeftOutParts::Mixed LeftOutParts::mixed_in(const SurfaceCell& cell, const Edges& left_out,
                                           std::vector<std::uint32_t>& ambiguous) {
  struct Cut {
    Vec3 place;
    std::uint32_t vertex = 0;
  };
  std::array<Cut, 12> out;
  std::array<Vec3, 12> kept;
  std::size_t count_out = 0;
  std::size_t count_kept = 0;
  for_each_cut_edge(cell, [&](const LatticeEdge& edge, const Vec3& p) {
    const Edges::Cut* const cut = left_out.on(edge);
    if (cut != nullptr && !cut->has_kept) {
      out[count_out++] = {p, cut->vertex};
      return;
    }
    if (cut != nullptr) ambiguous.push_back(cut->vertex);
    kept[count_kept++] = p;
  });
  Mixed mixed;
  if (count_out == 0) return mixed;
  const Pieces pieces{Trilinear(cell.corners)};
  Boxes with_kept;
  for (std::size_t n = 0; n < count_kept; ++n) with_kept |= pieces.at(kept[n]);
  for (std::size_t n = 0; n < count_out; ++n) {
    const Boxes piece = pieces.at(out[n].place);
    if ((piece & with_kept).any()) {
      ambiguous.push_back(out[n].vertex);
    } else {
      mixed.left_out |= piece;
    }
  }
  mixed.kept = pieces.all() & ~mixed.left_out;
  return mixed;
}

bool LeftOutParts::has_all(std::uint32_t cell, const Vec3& low, double side) const {
  assert(side >= 0.0);
  const auto mixed =
      std::lower_bound(mixed_.begin(), mixed_.end(), cell,
                       [](const Mixed& m, std::uint32_t number) { return m.cell < number; });
  if (mixed == mixed_.end() || mixed->cell != cell) return false;
  std::array<int, 3> first{};
  std::array<int, 3> last{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    first[axis] = box_of(low[axis]);
    last[axis] = std::max(first[axis], box_before(low[axis] + side));
  }
  bool has_any = false;
  for (int i = first[0]; i <= last[0]; ++i) {
    for (int j = first[1]; j <= last[1]; ++j) {
      for (int k = first[2]; k <= last[2]; ++k) {
        const std::size_t box = number_of(i, j, k);
        if (mixed->kept[box]) return false;
        has_any = has_any || mixed->left_out[box];
      }
    }
  }
  return has_any;
}

}  // namespace argil::io
