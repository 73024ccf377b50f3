// SPDX-License-Identifier: GPL-3.0-or-later
// Figure 2 of Blanch et al. 2004: the cubes with a positive density, those that cross the surface,
// and the surface, of a small clay cut open.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "argil/engine/clay.h"
#include "argil/engine/surface.h"

#include "common/output.h"
#include "report/parts.h"
#include "scene/distance.h"

namespace argil::evaluation {
namespace {

constexpr double kCubeMm = 1.0;
/// Where the density falls to 0, two cubes outside.
constexpr double kCubeSkinMm = 2.0;
constexpr int kHalf = 9;  ///< cubes from the middle to the border of what is looked at
constexpr int kSide = 2 * kHalf;
/// Towards the eye, as `set view 60,30` has it.
constexpr Vec3 kEye{0.4330127, -0.75, 0.5};

/// Which cubes of the box are shown.
using CubeSet = std::vector<bool>;

std::size_t cube_index(int i, int j, int k) {
  return (static_cast<std::size_t>(i) * kSide + static_cast<std::size_t>(j)) * kSide +
         static_cast<std::size_t>(k);
}

/// The low corner of a cube, in cubes from the middle.
Vec3 node_at(int i, int j, int k) {
  return {static_cast<double>(i - kHalf), static_cast<double>(j - kHalf),
          static_cast<double>(k - kHalf)};
}

/// The quarter that is cut away so that one sees the inside.
bool is_cut_away(int i, int j, int k) { return i >= kHalf && j < kHalf && k >= kHalf; }

/// The least and the greatest distance at the corners of a cube.
std::pair<double, double> corner_distances(const Clay& clay, int i, int j, int k) {
  double least = 1e9;
  double most = -1e9;
  for (int corner = 0; corner < 8; ++corner) {
    const double phi = clay.distance_at(
        kCubeMm * node_at(i + (corner >> 2), j + ((corner >> 1) & 1), k + (corner & 1)));
    least = std::min(least, phi);
    most = std::max(most, phi);
  }
  return {least, most};
}

template <class Keep>
CubeSet cubes_where(const Clay& clay, const Keep& keep) {
  CubeSet cubes(static_cast<std::size_t>(kSide) * kSide * kSide);
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      for (int k = 0; k < kSide; ++k) {
        const auto [least, most] = corner_distances(clay, i, j, k);
        cubes[cube_index(i, j, k)] = keep(least, most);
      }
    }
  }
  return cubes;
}

bool is_shown(const CubeSet& cubes, int i, int j, int k) {
  const auto is_inside = [](int n) { return n >= 0 && n < kSide; };
  if (!is_inside(i) || !is_inside(j) || !is_inside(k)) return false;
  return cubes[cube_index(i, j, k)] && !is_cut_away(i, j, k);
}

std::string corner_text(const Vec3& p) {
  return cli::number(p.x) + " " + cli::number(p.y) + " " + cli::number(p.z) + "\n";
}

std::string polygon_text(const std::vector<Vec3>& corners) {
  std::string text;
  for (const Vec3& corner : corners) text += corner_text(corner);
  return text + "\n";
}

/// The faces towards the eye, to one of the axes' directions.
std::string faces_text(const CubeSet& cubes, std::size_t axis, int side) {
  std::string text;
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      for (int k = 0; k < kSide; ++k) {
        std::array<int, 3> beside{i, j, k};
        beside[axis] += side;
        if (!is_shown(cubes, i, j, k) || is_shown(cubes, beside[0], beside[1], beside[2])) continue;
        Vec3 low = node_at(i, j, k);
        if (side > 0) low[axis] += 1.0;
        Vec3 across;
        Vec3 up;
        across[(axis + 1) % 3] = 1.0;
        up[(axis + 2) % 3] = 1.0;
        text += polygon_text({low, low + across, low + across + up, low + up});
      }
    }
  }
  return text;
}

/// Polygons of one colour each, drawn with the farthest first.
class Solids {
 public:
  void add(const std::string& polygons, const std::string& colour) {
    if (polygons.empty()) return;
    const std::string name = "$s" + std::to_string(count_++);
    blocks_ += name + " << EOD\n" + polygons + "EOD\n";
    plots_ += (count_ == 1 ? "splot " : ", ") + name + " with polygons fs solid 1 fc rgb '" +
              colour + "' notitle";
  }
  std::string text() const { return blocks_ + plots_ + "\n"; }

 private:
  std::string blocks_;
  std::string plots_;
  int count_ = 0;
};

std::string cubes_text(const CubeSet& cubes, const std::array<const char*, 3>& colours) {
  Solids solids;
  solids.add(faces_text(cubes, 2, 1), colours[0]);
  solids.add(faces_text(cubes, 1, -1), colours[1]);
  solids.add(faces_text(cubes, 0, 1), colours[2]);
  return solids.text();
}

/// From dark to bright by how a face is turned to a light over the eye's shoulder.
std::string surface_text(const TriangleMesh& mesh) {
  constexpr int kShades = 12;
  const Vec3 light = normalized(kEye + Vec3{-0.3, 0.0, 0.5});
  std::array<std::string, kShades> shades;
  for (const auto& triangle : mesh.triangles) {
    const std::vector<Vec3> corners{mesh.positions[triangle[0]], mesh.positions[triangle[1]],
                                    mesh.positions[triangle[2]]};
    const Vec3 across = cross(corners[1] - corners[0], corners[2] - corners[0]);
    if (length(across) == 0.0 || dot(across, kEye) <= 0.0) continue;
    const double lit = std::max(0.0, dot(normalized(across), light));
    const auto shade = static_cast<std::size_t>(std::min(kShades - 1.0, lit * kShades));
    shades[shade] += polygon_text(corners);
  }
  Solids solids;
  for (std::size_t n = 0; n < shades.size(); ++n) {
    char colour[8];
    const double lit = 0.35 + 0.65 * (static_cast<double>(n) + 0.5) / kShades;
    std::snprintf(colour, sizeof colour, "#%02x%02x%02x", static_cast<int>(214 * lit),
                  static_cast<int>(150 * lit), static_cast<int>(106 * lit));
    solids.add(shades[n], colour);
  }
  return solids.text();
}

std::string solid_panel(int place, const std::string& title, const std::string& solids) {
  // Titles of space pictures stand far off them: labels of the sheet instead.
  const double left = 0.01 + 0.33 * place;
  return "set origin " + cli::number(left) + ",-0.12\nset size 0.32,0.98\nset label " +
         std::to_string(3 + place) + " '" + title + "' at screen " + cli::number(left + 0.02) +
         ",0.84 font ',12'\n" + solids + "unset label\n";
}

}  // namespace

Result<ReportFigure> cubes_figure() {
  const auto shape = [](const Vec3& p) {
    return std::min(length(p) - 5.0, length(p - Vec3{-4.0, -3.0, 3.0}) - 2.6);
  };
  ClayOptions options;
  options.voxel_mm = kCubeMm;
  const auto clay = Clay::from_distance(shape, {{-9.0, -9.0, -9.0}, {9.0, 9.0, 9.0}}, options);
  if (!clay) return clay.error();
  const CubeSet dense =
      cubes_where(clay.value(), [](double least, double) { return least < kCubeSkinMm; });
  const CubeSet crossing = cubes_where(
      clay.value(), [](double least, double most) { return least < 0.0 && most >= 0.0; });
  const TriangleMesh mesh = extract_surface(clay.value());
  const auto count = [](const CubeSet& cubes) {
    return static_cast<double>(std::count(cubes.begin(), cubes.end(), true));
  };
  const Sheet sheet{"report_blanch_2", 1280, 430, "A field sampled over a grid",
                    "Cubes of 1 mm, a quarter cut away from the first two."};
  const std::string head =
      "unset border\nunset tics\nunset grid\nunset key\nset view 60,30,1.5\nset view equal xyz\n"
      "set xrange [-9:9]\nset yrange [-9:9]\nset zrange [-9:9]\nset pm3d depthorder border lc rgb "
      "'#404040' lw 0.4\n";
  ReportFigure figure;
  figure.title = "Blanch et al. 2004, figure 2: the field over its grid";
  figure.printed =
      "Cubes with a positive value, cubes that cross the isosurface, and the isosurface.";
  figure.ours =
      "The same of a clay: cubes whose density is positive (up to 2 mm outside the surface), cubes "
      "between whose corners the distance changes its sign, and the surface. What is stored is the "
      "distance in a band around the surface, and coarser levels of it, not a density: deep inside "
      "nothing needs to be stored.";
  figure.numbers = {{"cubes with a positive value", "", "", count(dense), ""},
                    {"cubes that cross the surface", "", "", count(crossing), ""},
                    {"triangles of the surface", "", "", static_cast<double>(mesh.triangles.size()),
                     "vertices of the engine's surface, one in each cube that crosses it"}};
  figure.script =
      finished(sheet, head +
                          solid_panel(0, "(a) a positive value",
                                      cubes_text(dense, {"#d7e6f2", "#9dbfd8", "#6f9cbd"})) +
                          solid_panel(1, "(b) across the surface",
                                      cubes_text(crossing, {"#f6dcc2", "#dfae7d", "#bf8a56"})) +
                          "set pm3d depthorder noborder\n" +
                          solid_panel(2, "(c) the surface", surface_text(mesh)));
  return figure;
}

}  // namespace argil::evaluation
