// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of what is wrong with a mesh: its triangles in the colours of their marks.
#include "marked_mesh.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <string_view>
#include <vector>

#include "argil/engine/render.h"
#include "argil/io/mesh_file.h"
#include "argil/io/png.h"

namespace argil::cli {
namespace {

using mesh::Mark;

/// By Mark, in sRGB.
constexpr std::array<std::array<std::uint8_t, 3>, 7> kColors{{{188, 136, 108},
                                                              {235, 205, 40},
                                                              {40, 170, 160},
                                                              {40, 90, 220},
                                                              {245, 130, 20},
                                                              {200, 30, 190},
                                                              {225, 20, 25}}};
/// The least radius of a mark in a picture, in diagonals of the mesh.
constexpr double kLeastMark = 0.008;

std::size_t number_of(Mark mark) {
  assert(static_cast<std::size_t>(mark) < kColors.size());
  return static_cast<std::size_t>(mark);
}

Vec3 linear(const std::array<std::uint8_t, 3>& srgb) {
  Vec3 color;
  for (std::size_t a = 0; a < 3; ++a) {
    const double s = srgb[a] / 255.0;
    // The transfer function of sRGB (IEC 61966-2-1): rendering computes with light itself.
    color[a] = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
  }
  return color;
}

Mark mark_of(std::string_view kind) {
  if (kind == "overhang") return Mark::overhang;
  if (kind == "narrow_gap") return Mark::narrow_gap;
  if (kind == "crumb") return Mark::small_component;
  if (kind == "thin_wall") return Mark::thin_wall;
  if (kind == "trapped_volume") return Mark::trapped;
  const bool is_of_all = kind == "inward" || kind == "too_large" || kind == "too_many_triangles" ||
                         kind == "file_too_large";
  return is_of_all ? Mark::none : Mark::broken;
}

Vec3 middle_of(const TriangleMesh& mesh, const Triangle& t) {
  return (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3.0;
}

Vec3 area_of(const TriangleMesh& mesh, const Triangle& t) {
  const Vec3& p = mesh.positions[t[0]];
  return 0.5 * cross(mesh.positions[t[1]] - p, mesh.positions[t[2]] - p);
}

/// The marks, and around each problem as much as can be seen.
std::vector<Mark> widened(const TriangleMesh& mesh, const mesh::MeshVerdict& verdict) {
  assert(verdict.marks.size() == mesh.triangles.size());
  const double reach = kLeastMark * length(bounds(mesh).size());
  std::vector<mesh::MeshProblem> problems;
  for (const mesh::MeshProblem& p : verdict.problems) {
    if (mark_of(p.kind) != Mark::none) problems.push_back(p);
  }
  const auto is_before = [](const mesh::MeshProblem& p, double x) { return p.at_mm.x < x; };
  std::sort(
      problems.begin(), problems.end(),
      [](const mesh::MeshProblem& a, const mesh::MeshProblem& b) { return a.at_mm.x < b.at_mm.x; });
  std::vector<Mark> marks = verdict.marks;
  for (std::size_t t = 0; t < marks.size(); ++t) {
    const Vec3 at = middle_of(mesh, mesh.triangles[t]);
    auto near = std::lower_bound(problems.begin(), problems.end(), at.x - reach, is_before);
    for (; near != problems.end() && near->at_mm.x <= at.x + reach; ++near) {
      if (length(near->at_mm - at) <= reach) marks[t] = std::max(marks[t], mark_of(near->kind));
    }
  }
  return marks;
}

/// Of a corner's view and the usual one, from above and below, the one that sees most of what is
/// marked, the worst first.
Vec3 view_of(const TriangleMesh& mesh, const std::vector<Mark>& marks) {
  assert(!marks.empty());
  const Mark worst = *std::max_element(marks.begin(), marks.end());
  Vec3 best{0.55, -1.0, 0.42};
  if (worst == Mark::none) return best;
  double most = 0.0;
  for (const double z : {0.42, -0.5}) {
    for (const Vec3& toward :
         {Vec3{0.55, -1.0, z}, Vec3{-1.0, -0.55, z}, Vec3{1.0, 0.55, z}, Vec3{-0.55, 1.0, z}}) {
      double seen = 0.0;
      for (std::size_t t = 0; t < marks.size(); ++t) {
        if (marks[t] != worst) continue;
        seen += std::max(0.0, dot(area_of(mesh, mesh.triangles[t]), normalized(toward)));
      }
      // Views that see as much but for rounding: the first one stays, on every machine.
      if (seen <= 1.001 * most) continue;
      most = seen;
      best = toward;
    }
  }
  return best;
}

}  // namespace

Vec3 mark_color(Mark mark) noexcept {
  return mark == Mark::none ? kClayColor : linear(kColors[number_of(mark)]);
}

Result<void> write_marked_picture(const std::filesystem::path& file, const TriangleMesh& mesh_mm,
                                  const mesh::MeshVerdict& verdict, const Progress& progress) {
  RenderOptions options;
  if (!verdict.marks.empty()) {
    const std::vector<Mark> marks = widened(mesh_mm, verdict);
    options.toward = view_of(mesh_mm, marks);
    options.colors.reserve(marks.size());
    for (const Mark mark : marks) options.colors.push_back(mark_color(mark));
  }
  const auto image = render(mesh_mm, options, progress);
  if (!image) return image.error();
  return io::write_png(file, image.value(), progress);
}

Result<void> write_marked_ply(const std::filesystem::path& file, const TriangleMesh& mesh_mm,
                              const mesh::MeshVerdict& verdict) {
  std::vector<Mark> of_vertex(mesh_mm.positions.size(), Mark::none);
  for (std::size_t t = 0; t < verdict.marks.size(); ++t) {
    for (const std::uint32_t v : mesh_mm.triangles[t]) {
      of_vertex[v] = std::max(of_vertex[v], verdict.marks[t]);
    }
  }
  io::WriteOptions options;
  for (const Mark mark : of_vertex) options.colors.push_back(kColors[number_of(mark)]);
  return io::write_mesh(file, mesh_mm, options);
}

}  // namespace argil::cli
