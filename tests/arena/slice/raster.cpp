// SPDX-License-Identifier: GPL-3.0-or-later
#include "arena/slice/raster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace argil::arena {
namespace {

constexpr double kMarginMm = 1.0;

std::size_t cells_along(double side, double cell) {
  return static_cast<std::size_t>(std::ceil((side + 2.0 * kMarginMm) / cell));
}

/// From the line from a to b.
double distance2(double x, double y, const Vec3& a, const Vec3& b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double along2 = dx * dx + dy * dy;
  const double t =
      along2 > 0.0 ? std::clamp(((x - a.x) * dx + (y - a.y) * dy) / along2, 0.0, 1.0) : 0.0;
  const double off_x = x - a.x - t * dx;
  const double off_y = y - a.y - t * dy;
  return off_x * off_x + off_y * off_y;
}

}  // namespace

Raster::Raster(const Box3& box, double cell_mm)
    : origin_(box.min - Vec3{kMarginMm, kMarginMm, 0.0}),
      cell_(cell_mm),
      columns_(cells_along(box.size().x, cell_mm)),
      rows_(cells_along(box.size().y, cell_mm)),
      set_(columns_ * rows_, 0) {}

double Raster::x_of(std::size_t column) const {
  return origin_.x + (static_cast<double>(column) + 0.5) * cell_;
}
double Raster::y_of(std::size_t row) const {
  return origin_.y + (static_cast<double>(row) + 0.5) * cell_;
}

void Raster::add_section(const TriangleMesh& solid, double z_mm) {
  // Where the plane cuts triangles, and from there where rows of cells cut the outline.
  std::vector<std::vector<std::pair<double, int>>> cuts(rows_);
  for (const Triangle& t : solid.triangles) {
    std::array<Vec3, 2> ends;
    std::size_t found = 0;
    bool goes_up = false;
    for (std::size_t k = 0; k < 3 && found < 2; ++k) {
      const Vec3& a = solid.positions[t[k]];
      const Vec3& b = solid.positions[t[(k + 1) % 3]];
      if ((a.z < z_mm) == (b.z < z_mm)) continue;
      if (found == 0) goes_up = a.z < z_mm;
      ends[found++] = a + (z_mm - a.z) / (b.z - a.z) * (b - a);
    }
    if (found < 2) continue;
    if (goes_up) std::swap(ends[0], ends[1]);
    const auto [low, high] = std::minmax(ends[0].y, ends[1].y);
    const auto first =
        static_cast<std::size_t>(std::max(0.0, std::floor((low - origin_.y) / cell_ - 0.5)));
    for (std::size_t row = first; row < rows_ && y_of(row) <= high; ++row) {
      const double y = y_of(row);
      if ((ends[0].y <= y) == (ends[1].y <= y)) continue;
      const double part = (y - ends[0].y) / (ends[1].y - ends[0].y);
      cuts[row].emplace_back(ends[0].x + part * (ends[1].x - ends[0].x), ends[0].y <= y ? 1 : -1);
    }
  }
  for (std::size_t row = 0; row < rows_; ++row) {
    std::sort(cuts[row].begin(), cuts[row].end());
    std::size_t next = 0;
    int winding = 0;
    for (std::size_t column = 0; column < columns_; ++column) {
      for (; next < cuts[row].size() && cuts[row][next].first < x_of(column); ++next) {
        winding += cuts[row][next].second;
      }
      if (winding != 0) set_[row * columns_ + column] = 1;
    }
  }
}

void Raster::add_bead(const Bead& bead, double reach) {
  const auto cells = [&](double low, double high, double from, std::size_t most) {
    const double first = std::floor((low - reach - from) / cell_);
    const double last = std::ceil((high + reach - from) / cell_);
    const auto limit = static_cast<double>(most);
    return std::pair{static_cast<std::size_t>(std::clamp(first, 0.0, limit)),
                     static_cast<std::size_t>(std::clamp(last, 0.0, limit))};
  };
  const auto [low_x, high_x] = std::minmax(bead.from.x, bead.to.x);
  const auto [low_y, high_y] = std::minmax(bead.from.y, bead.to.y);
  const auto [left, right] = cells(low_x, high_x, origin_.x, columns_);
  const auto [bottom, top] = cells(low_y, high_y, origin_.y, rows_);
  for (std::size_t row = bottom; row < top; ++row) {
    for (std::size_t column = left; column < right; ++column) {
      const double off2 = distance2(x_of(column), y_of(row), bead.from, bead.to);
      if (off2 <= reach * reach) set_[row * columns_ + column] = 1;
    }
  }
}

void Raster::add_beads(const PrintedLayer& layer, double more_mm, const Vec3& by) {
  for (const Bead& bead : layer.beads) {
    add_bead({bead.from + by, bead.to + by, bead.width_mm}, 0.5 * bead.width_mm + more_mm);
  }
}

std::size_t Raster::count() const {
  return static_cast<std::size_t>(std::count(set_.begin(), set_.end(), 1));
}

Raster Raster::without(const Raster& other) const {
  Raster rest = *this;
  for (std::size_t i = 0; i < set_.size(); ++i) {
    if (other.set_[i] != 0) rest.set_[i] = 0;
  }
  return rest;
}

std::vector<std::size_t> Raster::regions(std::size_t least) const {
  std::vector<std::size_t> sizes;
  std::vector<std::uint8_t> left = set_;
  std::vector<std::size_t> reached;
  for (std::size_t start = 0; start < left.size(); ++start) {
    if (left[start] == 0) continue;
    left[start] = 0;
    reached.assign(1, start);
    for (std::size_t i = 0; i < reached.size(); ++i) {
      const std::size_t column = reached[i] % columns_;
      const auto visit = [&](bool is_there, std::size_t at) {
        if (!is_there || left[at] == 0) return;
        left[at] = 0;
        reached.push_back(at);
      };
      visit(column > 0, reached[i] - 1);
      visit(column + 1 < columns_, reached[i] + 1);
      visit(reached[i] >= columns_, reached[i] - columns_);
      visit(reached[i] + columns_ < left.size(), reached[i] + columns_);
    }
    if (reached.size() >= least) sizes.push_back(reached.size());
  }
  return sizes;
}

}  // namespace argil::arena
