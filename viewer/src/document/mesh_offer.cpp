// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/mesh_offer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "argil/core/no_throw.h"
#include "argil/core/pace.h"
#include "argil/io/assembly.h"
#include "argil/io/body_parts.h"

namespace argil::viewer {
namespace {

constexpr double kCellsAlong = 160.0;  // of the longest side, more than a small picture shows
constexpr std::size_t kTrianglesATime = 4096;  // between two looks whether to stop

double largest(const Vec3& size) { return std::max({size.x, size.y, size.z}); }

/// A corner as it is seen along an axis, in cells: to the right and up.
using SeenCorner = std::array<double, 2>;

/// Cells that something covers.
class SilhouetteGrid {
 public:
  SilhouetteGrid(double width, double height, double cell)
      : cell_(cell), columns_(count_of(width)), rows_(count_of(height)) {
    covered_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), false);
  }

  /// All cells that the triangle touches, row by row: what it costs follows them, however thin it
  /// is.
  void cover(const std::array<SeenCorner, 3>& t) {
    const auto [low, high] = std::minmax({t[0][1], t[1][1], t[2][1]});
    const int last = index(high, rows_);
    for (int row = index(low, rows_); row <= last; ++row) {
      double left = columns_;
      double right = 0.0;
      for (std::size_t n = 0; n < 3; ++n) widen(t[n], t[(n + 1) % 3], row, left, right);
      if (left > right) continue;
      const int end = index(right, columns_) + 1;
      for (int column = index(left, columns_); column < end; ++column) {
        covered_[at(row, column)] = true;
      }
    }
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
  /// Takes in what of a side lies in a row.
  static void widen(SeenCorner a, SeenCorner b, int row, double& left, double& right) {
    if (a[1] > b[1]) std::swap(a, b);
    if (b[1] < row || a[1] > row + 1) return;
    const double rise = b[1] - a[1];
    for (const double y : {std::max(a[1], static_cast<double>(row)), std::min(b[1], row + 1.0)}) {
      const double t = rise > 0.0 ? (y - a[1]) / rise : 0.0;
      left = std::min(left, a[0] + t * (b[0] - a[0]));
      right = std::max(right, a[0] + t * (b[0] - a[0]));
    }
    if (rise > 0.0) return;
    left = std::min(left, b[0]);
    right = std::max(right, b[0]);
  }
  static int index(double place, int count) {
    return std::clamp(static_cast<int>(place), 0, count - 1);
  }
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

void add_silhouettes(const TriangleMesh& mesh, const Box3& box, const Pace& pace,
                     MeshOffer& offer) {
  const double cell = largest(box.size()) / kCellsAlong;
  SilhouetteGrid along_y(box.size().x, box.size().z, cell);
  SilhouetteGrid along_z(box.size().x, box.size().y, cell);
  for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
    if (n % kTrianglesATime == 0) {
      pace.at(static_cast<double>(n) / static_cast<double>(mesh.triangles.size()));
    }
    std::array<SeenCorner, 3> y{};
    std::array<SeenCorner, 3> z{};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vec3 p = (mesh.positions[mesh.triangles[n][corner]] - box.min) / cell;
      y[corner] = {p.x, p.z};
      z[corner] = {p.x, p.y};
    }
    along_y.cover(y);
    along_z.cover(z);
  }
  offer.along_y = along_y.runs();
  offer.along_z = along_z.runs();
}

Result<MeshOffer> offer_of(io::ReadAssembly read, const std::filesystem::path& file,
                           const Pace& pace) {
  MeshOffer offer;
  offer.file = file;
  offer.frame = read.frame;
  io::Assembly assembly = io::split_into_bodies(std::move(read.assembly));
  pace.at(0.3);
  offer.parts = io::placed_parts(assembly).size();
  const TriangleMesh mesh = io::joined(std::move(assembly));
  offer.triangles = static_cast<std::int64_t>(mesh.triangles.size());
  Box3 box;
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) box.include(mesh.positions[v]);
  }
  offer.size_mm = box.size();
  if (!(largest(offer.size_mm) > 0.0)) {
    return Error{ErrorKind::bad_input,
                 file.string() +
                     ": all its triangles lie in one point, 0 mm across; write it anew "
                     "with the program that made it"};
  }
  offer.outlook = io::ImportOutlook(mesh, pace.part(0.4, 0.9).progress());
  add_silhouettes(mesh, box, pace.part(0.9, 1.0), offer);
  return offer;
}

}  // namespace

Result<MeshOffer> look_at_mesh(const std::filesystem::path& file, const Progress& progress) {
  return no_throw(file.string(), [&]() -> Result<MeshOffer> {
    const Pace pace(progress, "look at the mesh");
    auto read = io::read_assembly(file);
    if (!read) return read.error();
    pace.at(0.5);
    return offer_of(std::move(read).value(), file, pace.part(0.5, 1.0));
  });
}

}  // namespace argil::viewer
