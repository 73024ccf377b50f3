// SPDX-License-Identifier: GPL-3.0-or-later
#include "restriction.h"

#include <cmath>

#include <tbb/parallel_for.h>

namespace argil {
namespace {

constexpr int kSide = FineNeighbourhood::kSide;

constexpr std::size_t at(int i, int j, int k) {
  return static_cast<std::size_t>((i * kSide + j) * kSide + k);
}

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

bool any_change_near(const FineNeighbourhood& fine, int i, int j, int k) {
  for (int a = 2 * i; a <= 2 * i + 2; ++a) {
    for (int b = 2 * j; b <= 2 * j + 2; ++b) {
      for (int c = 2 * k; c <= 2 * k + 2; ++c) {
        if (fine.changed[at(a, b, c)]) return true;
      }
    }
  }
  return false;
}

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

}  // namespace

void gather_fine(const FineSource& fine, const Coord& coarse_place, FineNeighbourhood& out) {
  out.present.reset();
  out.changed.reset();
  out.any_present = out.any_changed = false;
  const Coord origin = (coarse_place << 1).offsetBy(-1);
  const openvdb::CoordBBox box(origin, origin.offsetBy(kSide - 1));
  for_each_place(box, [&](const Coord& place) {
    const float* now = fine.now(place);
    if (now == nullptr) return;
    const float* before = fine.changed_from(place);
    out.any_present = true;
    const Coord lo = Coord::maxComponent(place, box.min());
    const Coord hi = Coord::minComponent(place.offsetBy(kLeafSide - 1), box.max());
    for (int x = lo.x(); x <= hi.x(); ++x) {
      for (int y = lo.y(); y <= hi.y(); ++y) {
        for (int z = lo.z(); z <= hi.z(); ++z) {
          const auto from = static_cast<std::size_t>(leaf_offset(Coord(x, y, z)));
          const std::size_t to = at(x - origin.x(), y - origin.y(), z - origin.z());
          out.value[to] = now[from];
          out.present.set(to);
          if (before != nullptr && before[from] != now[from]) {
            out.changed.set(to);
            out.any_changed = true;
          }
        }
      }
    }
  });
}

bool restrict_node(const FineNeighbourhood& fine, float fine_band, int i, int j, int k, float& out,
                   bool* full) {
  const int ci = 2 * i + 1;
  const int cj = 2 * j + 1;
  const int ck = 2 * k + 1;
  const float center = fine.value[at(ci, cj, ck)];
  if (!fine.present[at(ci, cj, ck)] || !(std::abs(center) < fine_band)) return false;
  float sum = 0.0F;
  for (int a = -1; a <= 1; ++a) {
    for (int b = -1; b <= 1; ++b) {
      for (int c = -1; c <= 1; ++c) {
        const std::size_t n = at(ci + a, cj + b, ck + c);
        if (!fine.present[n] || !(std::abs(fine.value[n]) < fine_band)) {
          out = center;
          if (full != nullptr) *full = false;
          return true;
        }
        const int halvings = 3 + std::abs(a) + std::abs(b) + std::abs(c);
        sum += fine.value[n] / static_cast<float>(1 << halvings);
      }
    }
  }
  out = sum;
  if (full != nullptr) *full = true;
  return true;
}

void restrict_edit(const LevelEdit& fine, LevelEdit& coarse, RestrictedLeaves which) {
  const EditSource source(fine);
  const float band = fine.band_mm();
  const float allowed = 0.5F * kRestrictionTolerance * static_cast<float>(fine.voxel_mm());
  std::vector<LeafEdit>& leaves = coarse.leaves();
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    LeafEdit& leaf = leaves[n];
    if (which == RestrictedLeaves::touched && !leaf.changed && !finer_changed(fine, leaf.place)) {
      return;
    }
    FineNeighbourhood around;
    gather_fine(source, leaf.place, around);
    if (!around.any_present) return;
    for (int i = 0; i < kLeafSide; ++i) {
      for (int j = 0; j < kLeafSide; ++j) {
        for (int k = 0; k < kLeafSide; ++k) {
          const auto node = static_cast<std::size_t>((i * kLeafSide + j) * kLeafSide + k);
          float value = 0.0F;
          if (!restrict_node(around, band, i, j, k, value)) continue;
          leaf.restricted.set(node);
          // Restricting what no edit changed would smooth the coarse level a little each time.
          const bool off = std::abs(leaf.now[node] - value) > allowed;
          if (off || (around.any_changed && any_change_near(around, i, j, k))) {
            leaf.now[node] = value;
          }
        }
      }
    }
  });
}

}  // namespace argil
