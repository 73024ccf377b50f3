// SPDX-License-Identifier: GPL-3.0-or-later
// Where liquid stays: the air of each column in spans, and for each span the level to which it must
// stand before it runs out, found from the outside inward, the lowest first.
#include "argil/mesh/liquid_pockets.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <queue>
#include <utility>

#include "argil/mesh/edges.h"

#include "prepare/columns.h"

namespace argil::mesh {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

struct AirSpan {
  double low = 0.0;
  double high = 0.0;
  double level = kInfinite;  ///< to which liquid stays; -infinite where it all runs out
  std::size_t column = 0;
};

class Flood {
 public:
  Flood(const Columns& columns, const PocketOptions& options)
      : columns_(columns), options_(options) {
    const std::size_t count =
        static_cast<std::size_t>(columns.columns()) * static_cast<std::size_t>(columns.rows());
    for (std::size_t c = 0; c < count; ++c) add_air(c);
    first_.push_back(spans_.size());
  }

  void run(const Pace& pace);
  std::vector<LiquidPocket> pockets() const;

 private:
  void add_air(std::size_t column);
  template <class Use>
  void for_each_beside(std::size_t span, const Use& use) const;
  double held(const AirSpan& air) const noexcept {
    return std::max(0.0, std::min(air.high, air.level) - air.low);
  }
  Vec3 point(const AirSpan& air, double z) const;
  LiquidPocket pocket_of(const std::vector<std::uint32_t>& spans) const;

  const Columns& columns_;
  const PocketOptions& options_;
  std::vector<AirSpan> spans_;
  std::vector<std::size_t> first_;  ///< per column into spans_, one more at the end
};

void Flood::add_air(std::size_t column) {
  first_.push_back(spans_.size());
  double low = -kInfinite;
  for (const SolidSpan& solid : columns_.solid(column)) {
    if (solid.low > low) spans_.push_back({low, solid.low, kInfinite, column});
    low = solid.high;
  }
  spans_.push_back({low, kInfinite, kInfinite, column});
}

/// Of the eight columns around, all spans that are open at a height at which this one is.
template <class Use>
void Flood::for_each_beside(std::size_t span, const Use& use) const {
  const AirSpan& air = spans_[span];
  const int row = static_cast<int>(air.column) / columns_.columns();
  const int column = static_cast<int>(air.column) % columns_.columns();
  for (int r = std::max(row - 1, 0); r <= std::min(row + 1, columns_.rows() - 1); ++r) {
    for (int c = std::max(column - 1, 0); c <= std::min(column + 1, columns_.columns() - 1); ++c) {
      const std::size_t beside = columns_.number(c, r);
      if (beside == air.column) continue;
      for (std::size_t other = first_[beside]; other < first_[beside + 1]; ++other) {
        const double low = std::max(air.low, spans_[other].low);
        if (low < std::min(air.high, spans_[other].high)) use(other, low);
      }
    }
  }
}

void Flood::run(const Pace& pace) {
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  for (std::size_t s = 0; s < spans_.size(); ++s) {
    if (spans_[s].low != -kInfinite) continue;
    spans_[s].level = -kInfinite;
    open.push({-kInfinite, s});
  }
  for (std::size_t steps = 0; !open.empty(); ++steps) {
    constexpr std::size_t kOften = 1U << 14U;
    if (steps % kOften == 0)
      pace.at(std::min(1.0, static_cast<double>(steps) / static_cast<double>(spans_.size())));
    const auto [level, span] = open.top();
    open.pop();
    if (level > spans_[span].level) continue;
    for_each_beside(span, [&, from = level](std::size_t other, double passage) {
      const double risen = std::max(from, passage);
      if (!(risen < spans_[other].level)) return;
      spans_[other].level = risen;
      open.push({risen, other});
    });
  }
}

Vec3 Flood::point(const AirSpan& air, double z) const {
  const int width = columns_.columns();
  return {columns_.x_of(static_cast<int>(air.column) % width),
          columns_.y_of(static_cast<int>(air.column) / width), z};
}

/// Of places that are as low, or as high, within half a pitch the one nearest to their middle: a
/// flat floor has its drain there and not in a corner.
Vec3 middle_most(const std::vector<Vec3>& places, double up, double pitch) {
  double farthest = up * places.front().z;
  for (const Vec3& p : places) farthest = std::max(farthest, up * p.z);
  const auto is_level = [&](const Vec3& p) { return up * p.z >= farthest - 0.5 * pitch; };
  Vec3 sum;
  double count = 0.0;
  for (const Vec3& p : places) {
    if (!is_level(p)) continue;
    sum += p;
    count += 1.0;
  }
  const Vec3 middle = sum / count;
  Vec3 nearest;
  double least = kInfinite;
  for (const Vec3& p : places) {
    if (!is_level(p) || length(p - middle) >= least) continue;
    least = length(p - middle);
    nearest = p;
  }
  return nearest;
}

LiquidPocket Flood::pocket_of(const std::vector<std::uint32_t>& spans) const {
  const double pitch = columns_.pitch_mm();
  LiquidPocket pocket;
  std::vector<Vec3> floor;
  std::vector<Vec3> ceiling;
  for (const std::uint32_t s : spans) {
    const AirSpan& air = spans_[s];
    pocket.closed = air.level == kInfinite;
    pocket.volume_mm3 += pitch * pitch * held(air);
    floor.push_back(point(air, air.low));
    ceiling.push_back(point(air, std::min(air.high, air.level)));
  }
  pocket.lowest_mm = middle_most(floor, -1.0, pitch);
  pocket.highest_mm = middle_most(ceiling, 1.0, pitch);
  return pocket;
}

/// Liquid that hangs together is a pocket.
std::vector<LiquidPocket> Flood::pockets() const {
  DisjointSets sets(spans_.size());
  for (std::uint32_t s = 0; s < spans_.size(); ++s) {
    if (held(spans_[s]) == 0.0) continue;
    for_each_beside(s, [&](std::size_t other, double passage) {
      const AirSpan& beside = spans_[other];
      if (held(beside) > 0.0 && passage < std::min(spans_[s].level, beside.level)) {
        sets.unite(s, static_cast<std::uint32_t>(other));
      }
    });
  }
  std::map<std::uint32_t, std::vector<std::uint32_t>> spans_of;
  for (std::uint32_t s = 0; s < spans_.size(); ++s) {
    if (held(spans_[s]) > 0.0) spans_of[sets.find(s)].push_back(s);
  }
  std::vector<LiquidPocket> large;
  for (const auto& [set, spans] : spans_of) {
    const LiquidPocket pocket = pocket_of(spans);
    if (pocket.volume_mm3 >= options_.least_mm3) large.push_back(pocket);
  }
  std::stable_sort(large.begin(), large.end(), [](const LiquidPocket& a, const LiquidPocket& b) {
    return a.volume_mm3 > b.volume_mm3;
  });
  return large;
}

}  // namespace

std::vector<LiquidPocket> liquid_pockets(const TriangleMesh& mesh, const PocketOptions& options,
                                         const Pace& pace) {
  assert(options.pitch_mm > 0.0);
  if (mesh.triangles.empty()) return {};
  pace.at(0.0);
  const Columns columns(mesh, options.pitch_mm);
  Flood flood(columns, options);
  flood.run(pace.part(0.4, 1.0));
  return flood.pockets();
}

}  // namespace argil::mesh
