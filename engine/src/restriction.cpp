// SPDX-License-Identifier: GPL-3.0-or-later
#include "restriction.h"

#include <cmath>
#include <cstdlib>
#include <limits>

namespace argil {
namespace {

constexpr int kSide = FineNeighbourhood::kSide;
constexpr float kAbsent = std::numeric_limits<float>::quiet_NaN();

constexpr std::size_t row_of(int i, int j) { return static_cast<std::size_t>(i * kSide + j); }

class EditSource final : public FineSource {
 public:
  explicit EditSource(const LevelEdit& edit) : edit_(edit) {}
  const float* now(const Coord& place) const override { return edit_.values_now(place); }
  const float* changed_from(const Coord& place) const override {
    const LeafEdit* leaf = edit_.find(place);
    return leaf != nullptr && leaf->changed ? leaf->before.data() : nullptr;
  }

 private:
  const LevelEdit& edit_;
};

/// Whether the edit changed one of the finer leaves that decide nodes of the place.
bool finer_changed(const LevelEdit& fine, const Coord& place) {
  const Coord low = (place << 1).offsetBy(-1);
  bool changed = false;
  for_each_place({low, low.offsetBy(kSide - 1)}, [&](const Coord& at) {
    const LeafEdit* leaf = fine.find(at);
    changed = changed || (leaf != nullptr && leaf->changed);
  });
  return changed;
}

/// The part of one fine leaf, `now`, in the block that starts at `origin`.
void gather_leaf(const float* now, const float* before, const Coord& place, const Coord& origin,
                 float band, FineNeighbourhood& out) {
  const Coord lo = Coord::maxComponent(place, origin) - origin;
  const Coord hi =
      Coord::minComponent(place.offsetBy(kLeafSide - 1), origin.offsetBy(kSide - 1)) - origin;
  for (int x = lo.x(); x <= hi.x(); ++x) {
    for (int y = lo.y(); y <= hi.y(); ++y) {
      FineNeighbourhood::Row& row = out.rows[row_of(x, y)];
      const int from = leaf_offset(origin.offsetBy(x, y, lo.z())) - lo.z();
      for (int z = lo.z(); z <= hi.z(); ++z) {
        const float value = now[from + z];
        float& to = (z % 2 == 0 ? row.odd : row.even)[static_cast<std::size_t>(z / 2)];
        to = std::abs(value) < band ? value : kAbsent;
      }
      if (before == nullptr) continue;
      std::uint32_t& changed = out.changed[row_of(x, y)];
      for (int z = lo.z(); z <= hi.z(); ++z) {
        if (before[from + z] != now[from + z]) changed |= 1U << z;
      }
      out.any_changed = out.any_changed || changed != 0;
    }
  }
}

/// Adds the nodes of row (a, b) of the 3^2 rows around eight coarse nodes, nearest first along z.
void add_row(const FineNeighbourhood::Row& row, int halvings, std::array<float, kLeafSide>& sum) {
  const float beside = 1.0F / static_cast<float>(1 << (halvings + 1));
  const float straight = 1.0F / static_cast<float>(1 << halvings);
  for (std::size_t k = 0; k < kLeafSide; ++k) {
    sum[k] += row.odd[k] * beside;
    sum[k] += row.even[k] * straight;
    sum[k] += row.odd[k + 1] * beside;
  }
}

std::uint8_t changed_nodes(const FineNeighbourhood& fine, int i, int j) {
  std::uint32_t rows = 0;
  for (int a = 0; a <= 2; ++a) {
    for (int b = 0; b <= 2; ++b) rows |= fine.changed[row_of(2 * i + a, 2 * j + b)];
  }
  unsigned nodes = 0;
  for (unsigned k = 0; k < kLeafSide; ++k) nodes |= ((rows >> 2 * k & 7U) != 0 ? 1U : 0U) << k;
  return static_cast<std::uint8_t>(nodes);
}

}  // namespace

void gather_fine(const FineSource& fine, const Coord& coarse_place, float fine_band,
                 FineNeighbourhood& out) {
  for (FineNeighbourhood::Row& row : out.rows) {
    row.odd.fill(kAbsent);
    row.even.fill(kAbsent);
  }
  out.changed.fill(0);
  out.any_present = out.any_changed = false;
  const Coord origin = (coarse_place << 1).offsetBy(-1);
  for_each_place({origin, origin.offsetBy(kSide - 1)}, [&](const Coord& place) {
    const float* now = fine.now(place);
    if (now == nullptr) return;
    out.any_present = true;
    gather_leaf(now, fine.changed_from(place), place, origin, fine_band, out);
  });
}

void restrict_leaf(const FineNeighbourhood& fine, Restricted& out) {
  for (int i = 0; i < kLeafSide; ++i) {
    for (int j = 0; j < kLeafSide; ++j) {
      std::array<float, kLeafSide> sum{};
      for (int a = 0; a <= 2; ++a) {
        for (int b = 0; b <= 2; ++b) {
          add_row(fine.rows[row_of(2 * i + a, 2 * j + b)], 3 + std::abs(a - 1) + std::abs(b - 1),
                  sum);
        }
      }
      const auto& same = fine.rows[row_of(2 * i + 1, 2 * j + 1)].even;
      unsigned decided = 0;
      unsigned averaged = 0;
      const auto row = static_cast<std::size_t>(i * kLeafSide + j);
      for (std::size_t k = 0; k < kLeafSide; ++k) {
        const bool is_averaged = !std::isnan(sum[k]);
        out.value[row * kLeafSide + k] = is_averaged ? sum[k] : same[k];
        averaged |= (is_averaged ? 1U : 0U) << k;
        decided |= (std::isnan(same[k]) ? 0U : 1U) << k;
      }
      out.decided[row] = static_cast<std::uint8_t>(decided);
      out.averaged[row] = static_cast<std::uint8_t>(averaged);
      out.changed[row] = fine.any_changed ? changed_nodes(fine, i, j) : std::uint8_t{0};
    }
  }
}

void restrict_edit(const LevelEdit& fine, LevelEdit& coarse, RestrictedLeaves which) {
  const EditSource source(fine);
  const float allowed = 0.5F * kRestrictionTolerance * static_cast<float>(fine.voxel_mm());
  std::vector<LeafEdit>& leaves = coarse.leaves();
  for_each_leaf(leaves.size(), [&](std::size_t n) {
    LeafEdit& leaf = leaves[n];
    if (which == RestrictedLeaves::touched && !leaf.changed && !finer_changed(fine, leaf.place)) {
      return;
    }
    FineNeighbourhood around;
    gather_fine(source, leaf.place, fine.band_mm(), around);
    if (!around.any_present) return;
    Restricted restricted;
    restrict_leaf(around, restricted);
    for (std::size_t node = 0; node < kLeafNodes; ++node) {
      const auto bit = [&](const NodeRows& rows) { return (rows[node / 8] >> node % 8 & 1) != 0; };
      if (!bit(restricted.decided)) continue;
      leaf.restricted.set(node);
      // Restricting what no edit changed would smooth the coarse level a little each time.
      const bool off = std::abs(leaf.now[node] - restricted.value[node]) > allowed;
      if (off || bit(restricted.changed)) leaf.now[node] = restricted.value[node];
    }
  });
}

}  // namespace argil
