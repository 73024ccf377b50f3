// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of a preparation: things in a row on one ground, some triangles coloured.
#include "preparation_pictures.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "argil/engine/render.h"
#include "argil/io/png.h"
#include "argil/mesh/compact.h"
#include "argil/mesh/print_orientation.h"
#include "argil/mesh/triangle_geometry.h"

#include "marked_mesh.h"

namespace argil::cli {
namespace {

using mesh::Mark;

/// Of the diagonal: marks around places are that large.
constexpr double kPlaceRadius = 0.012;

/// Things side by side along x, standing on z = 0.
class Row {
 public:
  template <class ColorOf>
  void add(const TriangleMesh& mesh, const ColorOf& color_of) {
    const Box3 box = bounds(mesh);
    constexpr double kGap = 0.12;
    const double gap = all_.positions.empty() ? 0.0 : kGap * std::max(box.size().x, widest_);
    widest_ = std::max(widest_, box.size().x);
    const Vec3 shift{end_ + gap - box.min.x, -box.center().y, -box.min.z};
    end_ += gap + box.size().x;
    const auto first = static_cast<std::uint32_t>(all_.positions.size());
    for (const Vec3& p : mesh.positions) all_.positions.push_back(p + shift);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      all_.triangles.push_back({a + first, b + first, c + first});
      options_.colors.push_back(color_of(t));
    }
  }

  Result<void> save(const std::filesystem::path& file, const Vec3& toward,
                    const Progress& progress) {
    const Vec3 size = bounds(all_).size();
    // As high as the row is, seen a little from above or below, and the depth before it.
    constexpr double kWidth = 1280.0;
    const double high = kWidth * (1.1 * size.z + 0.1 * size.y) / std::max(size.x, size.z);
    options_.width = static_cast<int>(kWidth);
    options_.height = static_cast<int>(std::clamp(high, 400.0, 1280.0));
    options_.toward = toward;
    const auto image = render(all_, options_, progress);
    if (!image) return image.error();
    return io::write_png(file, image.value(), progress);
  }

 private:
  TriangleMesh all_;
  RenderOptions options_;
  double end_ = 0.0;
  double widest_ = 0.0;
};

/// Of a triangle near one of the places, the colour of the mark.
Vec3 color_near(const TriangleMesh& mesh, std::size_t t, const std::vector<Vec3>& places,
                double reach, Mark mark) {
  const Vec3 at = mesh::middle(mesh::corners_of(mesh, t));
  const bool is_near = std::any_of(places.begin(), places.end(),
                                   [&](const Vec3& p) { return length(p - at) <= reach; });
  return mark_color(is_near ? mark : Mark::none);
}

class PreparationPictures {
 public:
  PreparationPictures(std::filesystem::path folder, const io::PrintPreparation& made,
                      double max_overhang_deg, const Progress& progress)
      : folder_(std::move(folder)), made_(made), progress_(progress) {
    least_ = std::sin(max_overhang_deg * std::numbers::pi / 180.0);
  }

  Result<std::vector<std::filesystem::path>> write() {
    for (const auto draw : {&PreparationPictures::orientations, &PreparationPictures::pieces,
                            &PreparationPictures::islands, &PreparationPictures::drains}) {
      if (Result<void> drawn = (this->*draw)(); !drawn) return drawn.error();
    }
    return std::move(files_);
  }

 private:
  static constexpr Vec3 kFromFront{0.35, -1.0, 0.3};

  Result<void> save(Row& row, const std::string& name, const Vec3& toward) {
    files_.push_back(folder_ / (name + ".png"));
    return row.save(files_.back(), toward, progress_);
  }

  Result<void> orientations() {
    Row row;
    for (const mesh::PrintOrientation& each : made_.orientations) {
      TriangleMesh turned = made_.surface;
      const Quat turn = mesh::turn_up(each.up);
      for (Vec3& p : turned.positions) p = rotate(turn, p);
      const double bed = bounds(turned).min.z + std::max(made_.cut_mm, mesh::kOnBedMm);
      row.add(turned, [&](std::size_t t) {
        const mesh::Corners c = mesh::corners_of(turned, t);
        const Vec3 normal = mesh::area_normal(c);
        const bool is_high = std::max({c[0].z, c[1].z, c[2].z}) > bed;
        const bool is_overhang = is_high && -normal.z > least_ * length(normal);
        return mark_color(is_overhang ? Mark::overhang : Mark::none);
      });
    }
    // A little from below, where overhangs are.
    return save(row, "orientations", {0.25, -1.0, -0.2});
  }

  Result<void> pieces() {
    Row row;
    for (const io::PreparedPiece& piece : made_.pieces) {
      const std::vector<Mark>& marks = piece.verdict.marks;
      row.add(piece.mesh,
              [&](std::size_t t) { return mark_color(marks.empty() ? Mark::none : marks[t]); });
    }
    return save(row, "pieces", kFromFront);
  }

  Result<void> islands() {
    Row row;
    bool has_islands = false;
    for (const io::PreparedPiece& piece : made_.pieces) {
      std::vector<Vec3> places;
      for (const mesh::PrintIsland& island : piece.islands) places.push_back(island.at_mm);
      has_islands = has_islands || !places.empty();
      const double reach = kPlaceRadius * length(bounds(piece.mesh).size());
      row.add(piece.mesh, [&](std::size_t t) {
        return color_near(piece.mesh, t, places, reach, Mark::broken);
      });
    }
    if (!has_islands) return {};
    return save(row, "islands", {0.3, -1.0, -0.6});
  }

  /// The first piece whole, and without what is before its middle.
  Result<void> drains() {
    if (made_.holes.empty()) return {};
    const TriangleMesh& whole = made_.pieces.front().mesh;
    const double middle = bounds(whole).center().y;
    const TriangleMesh open = mesh::only_triangles(
        whole, [&](std::size_t t) { return mesh::middle(mesh::corners_of(whole, t)).y >= middle; });
    std::vector<Vec3> mouths;
    for (const io::PrintHole& hole : made_.holes) mouths.push_back(hole.mouth_mm);
    const double reach = 2.0 * kPlaceRadius * length(bounds(whole).size());
    Row row;
    for (const TriangleMesh* each : {&whole, &open}) {
      row.add(*each, [&](std::size_t t) {
        return color_near(*each, t, mouths, reach, Mark::small_component);
      });
    }
    return save(row, "drains", {0.2, -1.0, -0.35});
  }

  std::filesystem::path folder_;
  const io::PrintPreparation& made_;
  const Progress& progress_;
  double least_ = 0.0;
  std::vector<std::filesystem::path> files_;
};

}  // namespace

Result<std::vector<std::filesystem::path>> write_preparation_pictures(
    const std::filesystem::path& folder, const io::PrintPreparation& made, double max_overhang_deg,
    const Progress& progress) {
  assert(!made.pieces.empty());
  return PreparationPictures(folder, made, max_overhang_deg, progress).write();
}

}  // namespace argil::cli
