// SPDX-License-Identifier: GPL-3.0-or-later
// What a printer asks of a mesh beyond being a sound surface: its size, walls, overhangs, and parts
// that fall off or hold liquid.
#include "check/print_check.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "argil/mesh/compact.h"
#include "argil/mesh/triangle_geometry.h"

namespace argil::mesh {
namespace {

/// What lies that low stands on the bed.
constexpr double kOnBedMm = 0.1;

class PrintCheck {
 public:
  PrintCheck(const TriangleMesh& mesh, const EdgeTable& edges, const PartsAndVolumes& parts,
             const Printer& printer)
      : mesh_(mesh), edges_(edges), parts_(parts), printer_(printer), box_(used_bounds(mesh)) {}

  PrintFindings judge(std::int64_t file_bytes, const WallMeasure& walls, const Pace& pace) {
    judge_parts();
    judge_size(file_bytes);
    if (printer_.min_wall_mm > 0.0) judge_walls(walls, pace.part(0.0, 0.5));
    if (printer_.min_gap_mm > 0.0) judge_gaps(pace.part(0.5, 1.0));
    if (printer_.max_overhang_deg > 0.0) judge_overhangs();
    return std::move(found_);
  }

 private:
  void judge_parts();
  void judge_size(std::int64_t file_bytes);
  void judge_overhangs();
  std::vector<double> overhang_areas() const;
  DisjointSets joined(const std::vector<double>& areas) const;
  void judge_walls(const WallMeasure& measure, const Pace& pace);
  void add_thin_parts(double least_mm, std::vector<TriangleThickness>& walls) const;
  void judge_gaps(const Pace& pace);
  std::vector<std::uint32_t> thin_triangles(const std::vector<TriangleThickness>& found,
                                            double least_mm) const;
  bool is_to_print(std::uint32_t part) const {
    return part != kNoPart && part_marks_[part] != Mark::small_component;
  }
  Vec3 normal_of(std::size_t t) const { return area_normal(corners_of(mesh_, t)); }
  void refuse(const char* kind, double size_mm) {
    found_.prints = false;
    found_.problems.push_back({kind, box_.center(), size_mm});
  }

  const TriangleMesh& mesh_;
  const EdgeTable& edges_;
  const PartsAndVolumes& parts_;
  const Printer& printer_;
  Box3 box_;
  std::vector<Mark> part_marks_;
  PrintFindings found_;
};

/// Closed parts that face inward hold what the printer leaves in them; an open mesh has no inside.
void PrintCheck::judge_parts() {
  const auto& [parts, volumes] = parts_;
  part_marks_.assign(volumes.size(), Mark::none);
  std::vector<bool> is_open(volumes.size(), false);
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    if (edges_.uses(e).size() == 2) continue;
    is_open[parts.of_triangle[triangle_of(edges_.uses(e)[0])]] = true;
  }
  for (std::size_t p = 0; p < volumes.size(); ++p) {
    // A single part is the piece itself, however small.
    if (is_open[p] || parts.count == 1) continue;
    if (volumes[p] < 0.0) {
      ++found_.cavities;
      if (printer_.needs_drains) part_marks_[p] = Mark::trapped;
    } else if (volumes[p] < printer_.min_part_mm3) {
      ++found_.small_components;
      part_marks_[p] = Mark::small_component;
    }
  }
  std::vector<Box3> boxes(volumes.size());
  for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
    const std::uint32_t p = parts.of_triangle[t];
    if (p == kNoPart || part_marks_[p] == Mark::none) continue;
    found_.marks.emplace_back(t, part_marks_[p]);
    for (const std::uint32_t v : mesh_.triangles[t]) boxes[p].include(mesh_.positions[v]);
  }
  for (std::size_t p = 0; p < volumes.size(); ++p) {
    if (part_marks_[p] == Mark::none) continue;
    const bool is_cavity = part_marks_[p] == Mark::trapped;
    found_.prints = found_.prints && !is_cavity;
    found_.problems.push_back(
        {is_cavity ? "trapped_volume" : "crumb", boxes[p].center(), length(boxes[p].size())});
  }
}

void PrintCheck::judge_size(std::int64_t file_bytes) {
  const Vec3 size = box_.size();
  const Vec3& bed = printer_.bed_mm;
  if (bed.z > 0.0) {
    const double straight = std::max(size.x - bed.x, size.y - bed.y);
    // Turned by a quarter about z it may fit where it does not straight.
    const double turned = std::max(size.x - bed.y, size.y - bed.x);
    const double over = std::max(size.z - bed.z, std::min(straight, turned));
    if (over > 0.0) refuse("too_large", over);
  }
  const auto triangles = static_cast<std::int64_t>(mesh_.triangles.size());
  if (printer_.max_triangles > 0 && triangles > printer_.max_triangles) {
    refuse("too_many_triangles", length(size));
  }
  // max_file_mb counts 2^20 bytes.
  const double megabytes = static_cast<double>(file_bytes) / 1048576.0;
  if (printer_.max_file_mb > 0.0 && megabytes > printer_.max_file_mb) {
    refuse("file_too_large", length(size));
  }
}

/// Of each triangle; 0 for those that print without support.
std::vector<double> PrintCheck::overhang_areas() const {
  assert(printer_.max_overhang_deg > 0.0 && printer_.max_overhang_deg < 90.0);
  // The limit is measured from the vertical: 0 degrees is a wall, 90 a ceiling.
  const double least = std::sin(printer_.max_overhang_deg * std::numbers::pi / 180.0);
  std::vector<double> areas(mesh_.triangles.size(), 0.0);
  for (std::size_t t = 0; t < areas.size(); ++t) {
    double highest = box_.min.z;
    for (const std::uint32_t v : mesh_.triangles[t]) {
      highest = std::max(highest, mesh_.positions[v].z);
    }
    const Vec3 normal = normal_of(t);
    const bool is_on_bed = highest <= box_.min.z + kOnBedMm;
    if (!is_on_bed && -normal.z > least * length(normal)) areas[t] = 0.5 * length(normal);
  }
  return areas;
}

/// Triangles with an area here that hang together, in sets named by their first triangle.
DisjointSets PrintCheck::joined(const std::vector<double>& areas) const {
  assert(areas.size() == mesh_.triangles.size());
  DisjointSets sets(areas.size());
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const auto uses = edges_.uses(e);
    const auto first = static_cast<std::uint32_t>(triangle_of(uses[0]));
    for (const HalfEdge h : uses.subspan(1)) {
      const auto other = static_cast<std::uint32_t>(triangle_of(h));
      if (areas[first] > 0.0 && areas[other] > 0.0) sets.unite(first, other);
    }
  }
  return sets;
}

double least_of(const std::vector<TriangleThickness>& found) {
  double least = std::numeric_limits<double>::infinity();
  for (const TriangleThickness& each : found) least = std::min(least, each.least_mm);
  return least;
}

/// Creases have thin specks as well: only what is thin over a square of the least thickness counts,
/// or over most of a part. It must hang together: thin triangles scattered over a fine mesh are not
/// one thin wall. Parts too small to print can be left off, and are told as such.
std::vector<std::uint32_t> PrintCheck::thin_triangles(const std::vector<TriangleThickness>& found,
                                                      double least_mm) const {
  assert(found.size() == mesh_.triangles.size());
  std::vector<double> areas(found.size());
  std::vector<double> of_part(parts_.parts.count, 0.0);
  for (std::uint32_t t = 0; t < areas.size(); ++t) {
    areas[t] = found[t].thin_mm2;
    const std::uint32_t part = parts_.parts.of_triangle[t];
    if (part != kNoPart) of_part[part] += 0.5 * length(normal_of(t));
  }
  DisjointSets sets = joined(areas);
  std::map<std::uint32_t, double> patches;
  for (std::uint32_t t = 0; t < areas.size(); ++t) {
    if (areas[t] > 0.0) patches[sets.find(t)] += areas[t];
  }
  // Of a closed part that is thin all over; at its edges, where it faces nothing, none is.
  constexpr double kMostOfPart = 0.5;
  std::vector<std::uint32_t> thin;
  for (std::uint32_t t = 0; t < areas.size(); ++t) {
    if (areas[t] == 0.0) continue;
    const double patch = patches[sets.find(t)];
    const std::uint32_t part = parts_.parts.of_triangle[t];
    const bool is_most = is_to_print(part) && patch >= kMostOfPart * of_part[part];
    if (is_most || patch >= least_mm * least_mm) thin.push_back(t);
  }
  return thin;
}

/// A solid part that is thinner along an axis is so all over, also where no sides lie opposite each
/// other. What a cavity's surface is across says nothing.
void PrintCheck::add_thin_parts(double least_mm, std::vector<TriangleThickness>& walls) const {
  const MeshParts& parts = parts_.parts;
  std::vector<Box3> boxes(parts.count);
  std::vector<bool> is_told(parts.count, false);
  for (std::uint32_t t = 0; t < walls.size(); ++t) {
    if (parts.of_triangle[t] == kNoPart) continue;
    if (walls[t].thin_mm2 > 0.0) is_told[parts.of_triangle[t]] = true;
    for (const std::uint32_t v : mesh_.triangles[t]) {
      boxes[parts.of_triangle[t]].include(mesh_.positions[v]);
    }
  }
  for (std::uint32_t t = 0; t < walls.size(); ++t) {
    const std::uint32_t part = parts.of_triangle[t];
    if (!is_to_print(part) || is_told[part] || !(parts_.volumes[part] > 0.0)) continue;
    const Vec3 size = boxes[part].size();
    const double side = std::min({size.x, size.y, size.z});
    if (side >= least_mm) continue;
    walls[t] = {side, middle(corners_of(mesh_, t)), 0.5 * length(normal_of(t))};
  }
}

void PrintCheck::judge_walls(const WallMeasure& measure, const Pace& pace) {
  std::vector<TriangleThickness> walls = measure(mesh_, printer_.min_wall_mm, pace);
  add_thin_parts(printer_.min_wall_mm, walls);
  found_.min_wall_mm = least_of(walls);
  for (const std::uint32_t t : thin_triangles(walls, printer_.min_wall_mm)) {
    found_.prints = false;
    found_.marks.emplace_back(t, Mark::thin_wall);
    found_.problems.push_back({"thin_wall", walls[t].at_mm, walls[t].least_mm});
  }
}

void PrintCheck::judge_gaps(const Pace& pace) {
  const auto gaps = gap_width(mesh_, printer_.min_gap_mm, pace);
  found_.min_gap_mm = least_of(gaps);
  for (const std::uint32_t t : thin_triangles(gaps, printer_.min_gap_mm)) {
    found_.marks.emplace_back(t, Mark::narrow_gap);
    found_.problems.push_back({"narrow_gap", gaps[t].at_mm, gaps[t].least_mm});
  }
}

void PrintCheck::judge_overhangs() {
  struct Overhang {
    double area = 0.0;
    double lowest = 2.0;  ///< z of a normal
    Vec3 at;
  };
  const std::vector<double> areas = overhang_areas();
  DisjointSets sets = joined(areas);
  std::map<std::uint32_t, Overhang> overhangs;
  for (std::uint32_t t = 0; t < areas.size(); ++t) {
    if (areas[t] == 0.0) continue;
    found_.marks.emplace_back(t, Mark::overhang);
    found_.overhang_mm2 += areas[t];
    Overhang& overhang = overhangs[sets.find(t)];
    overhang.area += areas[t];
    const double down = normalized(normal_of(t)).z;
    if (down >= overhang.lowest) continue;
    overhang.lowest = down;
    overhang.at = middle(corners_of(mesh_, t));
  }
  std::vector<Overhang> by_area;
  for (const auto& [first, overhang] : overhangs) by_area.push_back(overhang);
  std::stable_sort(by_area.begin(), by_area.end(),
                   [](const Overhang& a, const Overhang& b) { return a.area > b.area; });
  for (const Overhang& o : by_area) {
    found_.problems.push_back({"overhang", o.at, std::sqrt(o.area)});
  }
}

}  // namespace

PrintFindings print_findings(const TriangleMesh& mesh, const EdgeTable& edges,
                             const PartsAndVolumes& parts, const Printer& printer,
                             std::int64_t file_bytes, const WallMeasure& walls, const Pace& pace) {
  assert(edges.is_of(mesh) && parts.volumes.size() == parts.parts.count);
  return PrintCheck(mesh, edges, parts, printer).judge(file_bytes, walls, pace);
}

}  // namespace argil::mesh
