// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/mesh_offer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "argil/core/no_throw.h"
#include "argil/io/assembly.h"
#include "argil/io/body_parts.h"

namespace argil::viewer {
namespace {

constexpr double kCellsAlong = 160.0;  // of the longest side, more than a small picture shows

/// Cells that something covers.
class SilhouetteGrid {
 public:
  SilhouetteGrid(double width, double height, double cell)
      : cell_(cell), columns_(count_of(width)), rows_(count_of(height)) {
    covered_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), false);
  }

  void cover(double x, double y) {
    const int column = std::clamp(static_cast<int>(x / cell_), 0, columns_ - 1);
    const int row = std::clamp(static_cast<int>(y / cell_), 0, rows_ - 1);
    covered_[at(row, column)] = true;
  }

  Silhouette runs() const {
    Silhouette seen{{}, columns_, rows_};
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        if (!covered_[at(row, column)]) continue;
        const int first = column;
        while (column < columns_ && covered_[at(row, column)]) ++column;
        seen.runs.push_back({row, first, column});
      }
    }
    return seen;
  }

 private:
  int count_of(double length) const {
    return std::max(1, static_cast<int>(std::ceil(length / cell_)));
  }
  std::size_t at(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  double cell_;
  int columns_;
  int rows_;
  std::vector<bool> covered_;
};

/// Points of every triangle, at most a cell's half apart.
void add_silhouettes(const TriangleMesh& mesh, const Box3& box, MeshOffer& offer) {
  const double side = std::max({box.size().x, box.size().y, box.size().z});
  if (!(side > 0.0)) return;
  const double cell = side / kCellsAlong;
  SilhouetteGrid along_y(box.size().x, box.size().z, cell);
  SilhouetteGrid along_z(box.size().x, box.size().y, cell);
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.positions[t[0]] - box.min;
    const Vec3 u = mesh.positions[t[1]] - box.min - a;
    const Vec3 v = mesh.positions[t[2]] - box.min - a;
    const double longest = std::max({length(u), length(v), length(v - u)});
    const int n = std::max(1, static_cast<int>(std::ceil(2.0 * longest / cell)));
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; i + j <= n; ++j) {
        const Vec3 p = a + (static_cast<double>(i) / n) * u + (static_cast<double>(j) / n) * v;
        along_y.cover(p.x, p.z);
        along_z.cover(p.x, p.y);
      }
    }
  }
  offer.along_y = along_y.runs();
  offer.along_z = along_z.runs();
}

MeshOffer offer_of(io::ReadAssembly read, const std::filesystem::path& file) {
  MeshOffer offer;
  offer.file = file;
  offer.frame = read.frame;
  io::Assembly assembly = io::split_into_bodies(std::move(read.assembly));
  offer.parts = io::placed_parts(assembly).size();
  const TriangleMesh mesh = io::joined(std::move(assembly));
  offer.triangles = static_cast<std::int64_t>(mesh.triangles.size());
  Box3 box;
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) box.include(mesh.positions[v]);
  }
  offer.size_mm = box.size();
  offer.outlook = io::ImportOutlook(mesh);
  add_silhouettes(mesh, box, offer);
  return offer;
}

}  // namespace

Result<MeshOffer> look_at_mesh(const std::filesystem::path& file) {
  auto read = io::read_assembly(file);
  if (!read) return read.error();
  return no_throw(file.string(),
                  [&]() -> Result<MeshOffer> { return offer_of(std::move(read).value(), file); });
}

}  // namespace argil::viewer
