// SPDX-License-Identifier: GPL-3.0-or-later
// The order of a preparation: orient, give it a base, hollow and drain, cut into pieces, judge.
// Hollowing comes after the base, or its cut would open the cavity, and before the pieces, so that
// plugs find the walls that there will be.
#include "argil/io/print_preparation.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

#include "argil/core/no_throw.h"
#include "argil/engine/clay_copy.h"
#include "argil/engine/surface.h"
#include "argil/mesh/bodies.h"
#include "argil/mesh/collapse_folded.h"
#include "argil/mesh/compact.h"
#include "argil/mesh/edges.h"
#include "argil/mesh/rounding.h"
#include "argil/mesh/small_components.h"

#include "convert/print_drains.h"
#include "convert/print_frame.h"
#include "convert/print_pieces.h"

namespace argil::io {
namespace {

class PrintPreparing {
 public:
  PrintPreparing(const Clay& clay, const PreparationOptions& options, const Progress& progress)
      : clay_(copy_of(clay)), options_(options), pace_(progress, "prepare") {}

  Result<PrintPreparation> run();

 private:
  Result<void> check_options() const;
  void orient(const Pace& pace);
  double base_cut() const;
  void place();
  Result<void> cut_base(const Pace& pace);
  Result<void> make_pieces(const Pace& pace);
  std::vector<TriangleMesh> bodies_of(TriangleMesh piece) const;
  PreparedPiece finished(std::string name, TriangleMesh mesh, const Pace& pace) const;
  mesh::OrientationOptions orientation_options() const;

  Clay clay_;
  const PreparationOptions& options_;
  Pace pace_;
  PrintFrame frame_;
  PrintPreparation made_;
};

Error refused(const std::string& what) { return Error{ErrorKind::bad_input, what}; }

Result<void> PrintPreparing::check_options() const {
  if (options_.up && !(length(*options_.up) > 0.0)) {
    return refused("the direction that shall be up is zero; give one such as 0,0,1");
  }
  if (options_.fits_bed && !(options_.printer.bed_mm.z > 0.0)) {
    return refused("the printer names no bed to fit; give it a bed_mm, or do not cut into pieces");
  }
  return {};
}

/// What is assumed to be cut off while orientations are compared: a piece that touches the bed in a
/// point would tip in all of them.
mesh::OrientationOptions PrintPreparing::orientation_options() const {
  mesh::OrientationOptions wanted;
  if (options_.printer.max_overhang_deg > 0.0) {
    wanted.max_overhang_deg = options_.printer.max_overhang_deg;
  }
  constexpr double kUsualCut = 0.01;  // of the diagonal
  if (options_.base == PrintBase::automatic) {
    wanted.cut_mm = kUsualCut * length(bounds(made_.surface).size());
  }
  if (options_.base == PrintBase::cut) wanted.cut_mm = options_.cut_mm;
  return wanted;
}

void PrintPreparing::orient(const Pace& pace) {
  const mesh::OrientationOptions wanted = orientation_options();
  constexpr std::size_t kShown = 3;
  if (options_.up) {
    made_.orientations = {
        mesh::orientation_at(made_.surface, normalized(*options_.up), wanted, pace)};
  } else {
    made_.orientations = mesh::best_orientations(made_.surface, wanted, kShown, pace);
  }
  made_.chosen = made_.orientations.front();
  if (options_.base == PrintBase::lay) {
    made_.chosen.up = mesh::laid_flat(made_.surface, made_.chosen.up);
  }
  frame_.turn = mesh::turn_up(made_.chosen.up);
}

/// Nothing where the contact is a tenth of the diagonal wide and the centre of mass a twentieth of
/// the height within it; else as little as makes it so, but what orientations were compared with
/// at least; what comes nearest to it where a twentieth of the height is not enough.
double PrintPreparing::base_cut() const {
  if (options_.base == PrintBase::cut) return options_.cut_mm;
  if (options_.base != PrintBase::automatic) return 0.0;
  const TriangleMesh standing = frame_.to_bed(made_.surface);
  const double height = bounds(standing).size().z;
  const double width = 0.1 * length(bounds(standing).size());
  const auto is_firm = [&](const mesh::BedContact& contact) {
    return contact.footing_mm >= 0.05 * height && contact.area_mm2 >= width * width;
  };
  mesh::BedContact best_contact = mesh::bed_contact(standing, 0.0);
  if (is_firm(best_contact)) return 0.0;
  constexpr int kSteps = 40;
  const double least = orientation_options().cut_mm;
  const double most = std::max(least, 0.05 * height);
  double best = 0.0;
  for (int step = 0; step <= kSteps; ++step) {
    const double cut = least + (most - least) * step / kSteps;
    const mesh::BedContact contact = mesh::bed_contact(standing, cut);
    if (is_firm(contact)) return cut;
    if (contact.footing_mm <= best_contact.footing_mm) continue;
    best_contact = contact;
    best = cut;
  }
  return best;
}

/// In the middle of the bed, the base on z = 0.
void PrintPreparing::place() {
  frame_.shift_mm = {};
  const Box3 box = bounds(frame_.to_bed(made_.surface));
  const Vec3 middle = box.center();
  const Vec3& bed = options_.printer.bed_mm;
  frame_.shift_mm = {0.5 * bed.x - middle.x, 0.5 * bed.y - middle.y, -box.min.z - made_.cut_mm};
}

Result<void> PrintPreparing::cut_base(const Pace& pace) {
  made_.cut_mm = base_cut();
  place();
  if (made_.cut_mm == 0.0) return {};
  const Cut cut{frame_.to_clay(Vec3{}), frame_.direction_to_clay({0.0, 0.0, 1.0}), true};
  const auto done = clay_.apply(cut, answering(pace));
  if (!done) return Error{done.error().kind, "base: " + done.error().message};
  return {};
}

/// Leaves out cavities that enclose less: what is in them is not worth a drain. Returns how many.
std::int64_t fill_small_cavities(TriangleMesh& mesh, double least_mm3) {
  const mesh::EdgeTable edges(mesh);
  const mesh::MeshParts parts = mesh::mesh_parts(mesh, edges, false);
  const std::vector<double> volumes = mesh::part_volumes(mesh, parts);
  const auto is_small = [&](std::uint32_t part) {
    return part != mesh::kNoPart && volumes[part] < 0.0 && -volumes[part] < least_mm3;
  };
  std::int64_t filled = 0;
  for (std::uint32_t part = 0; part < parts.count; ++part) filled += is_small(part) ? 1 : 0;
  if (filled == 0) return 0;
  mesh = mesh::only_triangles(mesh, [&](std::size_t t) { return !is_small(parts.of_triangle[t]); });
  return filled;
}

/// As an export would write it, and judged as its reader will see it.
PreparedPiece PrintPreparing::finished(std::string name, TriangleMesh mesh,
                                       const Pace& pace) const {
  PreparedPiece piece;
  piece.name = std::move(name);
  mesh::drop_small_components(mesh, clay_.options().voxel_mm);
  piece.filled_cavities =
      fill_small_cavities(mesh, options_.wall_mm > 0.0 ? kLeastCavityMm3 : kLeastPocketMm3);
  const Box3 box = bounds(mesh);
  const Vec3& bed = options_.printer.bed_mm;
  const Vec3 shift{0.5 * bed.x - box.center().x, 0.5 * bed.y - box.center().y, -box.min.z};
  for (Vec3& p : mesh.positions) p += shift;
  piece.mesh = mesh::rounded_to_float(std::move(mesh));
  constexpr int kMostRounds = 4;
  for (int round = 0;; ++round) {
    piece.verdict = mesh::judge_mesh(piece.mesh, options_.printer, 0, mesh::wall_thickness,
                                     pace.part(0.0, 0.7));
    const bool folded = piece.verdict.degenerate + piece.verdict.self_intersections > 0;
    if (!folded || round == kMostRounds || mesh::collapse_folded(piece.mesh) == 0) break;
  }
  if (piece.mesh.triangles.empty()) return piece;  // the verdict says so
  piece.islands = mesh::print_islands(piece.mesh, options_.layer_mm);
  if (options_.wall_mm > 0.0 || options_.printer.needs_drains) {
    const mesh::PocketOptions looked{pocket_pitch_mm(piece.mesh, options_.drain_radius_mm),
                                     kLeastPocketMm3};
    piece.pockets = mesh::liquid_pockets(piece.mesh, looked, pace.part(0.7, 1.0));
  }
  return piece;
}

/// A cut may part what only the rest held together, such as an ear from a head: pieces of their
/// own.
std::vector<TriangleMesh> PrintPreparing::bodies_of(TriangleMesh piece) const {
  mesh::drop_small_components(piece, clay_.options().voxel_mm);
  std::vector<TriangleMesh> bodies = mesh::split_mesh(piece, mesh::mesh_bodies(piece).of_triangle);
  std::erase_if(bodies, [&](const TriangleMesh& body) {
    return signed_volume(body) < options_.printer.min_part_mm3;
  });
  return bodies;
}

Result<void> PrintPreparing::make_pieces(const Pace& pace) {
  TriangleMesh whole = surface_on_bed(clay_, frame_);
  PieceGrid grid{{1, 1, 1}, bounds(whole)};
  if (options_.fits_bed) grid = pieces_for(grid.box, options_.printer.bed_mm);
  if (grid.is_whole()) {
    made_.pieces.push_back(finished("piece", std::move(whole), pace));
    return {};
  }
  const PlugPlan plan = plugs_for(clay_, frame_, grid, options_.plug_tolerance_mm);
  made_.plugs = static_cast<int>(plan.plugs.size());
  made_.plug_radius_mm = made_.plugs > 0 ? plan.radius_mm : 0.0;
  made_.joints_without_plug = plan.joints_without;
  const int count = grid.counts[0] * grid.counts[1] * grid.counts[2];
  for (int i = 0; i < count; ++i) {
    const std::array<int, 3> at{i % grid.counts[0], i / grid.counts[0] % grid.counts[1],
                                i / (grid.counts[0] * grid.counts[1])};
    const Pace part = pace.part(static_cast<double>(i) / count, (i + 1.0) / count);
    const bool is_crossed = std::any_of(whole.positions.begin(), whole.positions.end(),
                                        [&, cell = grid.cell(at)](const Vec3& p) {
                                          return Box3{p, p}.meets(cell);
                                        });
    const bool is_filled = clay_.distance_at(frame_.to_clay(grid.cell(at).center())) < 0.0;
    if (!is_crossed && !is_filled) continue;
    auto piece =
        cut_piece(clay_, frame_, grid, at, plan, options_.plug_tolerance_mm, part.part(0.0, 0.5));
    if (!piece) return piece.error();
    for (TriangleMesh& body : bodies_of(std::move(piece).value())) {
      made_.pieces.push_back(finished(
          "piece " + std::to_string(made_.pieces.size() + 1),
          laid_on_cut(std::move(body), grid, at, options_.printer.bed_mm), part.part(0.5, 1.0)));
    }
  }
  if (made_.plugs > 0)
    made_.pieces.push_back(finished("plugs", plugs_to_print(plan), pace.part(1.0, 1.0)));
  return {};
}

Result<PrintPreparation> PrintPreparing::run() {
  if (auto usable = check_options(); !usable) return usable.error();
  auto surface = extract_surface(clay_, pace_.part(0.0, 0.05).progress());
  if (!surface) return surface.error();
  made_.surface = std::move(surface).value();
  made_.surface.normals.clear();
  mesh::drop_small_components(made_.surface, clay_.options().voxel_mm);
  if (made_.surface.triangles.empty()) return refused("there is no clay to print; add some first");
  orient(pace_.part(0.05, 0.5));
  if (auto cut = cut_base(pace_.part(0.5, 0.55)); !cut) return cut.error();
  mesh::OrientationOptions as_cut = orientation_options();
  as_cut.cut_mm = made_.cut_mm;
  made_.chosen =
      mesh::orientation_at(made_.surface, made_.chosen.up, as_cut, pace_.part(0.55, 0.6));
  if (options_.wall_mm > 0.0) {
    auto holes = hollow_with_drains(clay_, frame_, options_, made_.wall_mm, pace_.part(0.6, 0.8));
    if (!holes) return holes.error();
    made_.holes = std::move(holes).value();
  }
  if (auto pieces = make_pieces(pace_.part(0.8, 1.0)); !pieces) return pieces.error();
  return std::move(made_);
}

}  // namespace

bool PrintPreparation::is_printable() const {
  return std::all_of(pieces.begin(), pieces.end(),
                     [](const PreparedPiece& piece) { return piece.verdict.printable; });
}

Result<PrintPreparation> prepare_print(const Clay& clay, const PreparationOptions& options,
                                       const Progress& progress) {
  return no_throw("the clay", [&]() -> Result<PrintPreparation> {
    return PrintPreparing(clay, options, progress).run();
  });
}

}  // namespace argil::io
