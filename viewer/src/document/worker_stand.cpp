// SPDX-License-Identifier: GPL-3.0-or-later
// Where pieces stand, by their surfaces: the bounds of a clay are those of its voxels.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

#include "argil/core/no_throw.h"
#include "argil/core/pace.h"
#include "argil/engine/surface.h"
#include "argil/mesh/print_orientation.h"

#include "base/text.h"
#include "document/document_worker.h"
#include "picture/piece_frame.h"

namespace argil::viewer {
namespace {

/// By less a piece misses its place by rounding alone, which is no reason for another step.
constexpr double kThereMm = 1e-9;

bool stands_at(const PieceLook& look, const Placement& placement) {
  return length(placement.position_mm - look.placement.position_mm) < kThereMm &&
         placement.orientation == look.placement.orientation;
}

Box3 box_around(const std::vector<Vec3>& points) {
  Box3 box;
  for (const Vec3& point : points) box.include(point);
  return box;
}

}  // namespace

/// Of the surface in the piece's own frame: asked with every frame, and worked out once a change.
const Box3& DocumentWorker::surface_of_active() {
  const PieceKey piece = feed_.active_key(document_.sculpture());
  const bool is_known = surface_changes_ == changes_ && surface_piece_ == piece;
  if (is_known || document_.clay().is_stroke_open()) return surface_mm_;
  surface_mm_ = surface_bounds_mm(document_.clay());
  surface_changes_ = changes_;
  surface_piece_ = piece;
  return surface_mm_;
}

Result<TriangleMesh> DocumentWorker::standing_surface(std::size_t piece, const Progress& progress) {
  auto surface = extract_surface(document_.sculpture().clay(piece), progress);
  if (surface) place(document_.sculpture().look(piece).placement, surface.value());
  return surface;
}

/// All that are visible by the same way, so that what was put together stays so.
Result<PlacePieces> DocumentWorker::places_on_bed(const Progress& progress) {
  const Sculpture& sculpture = document_.sculpture();
  const auto count = static_cast<double>(sculpture.piece_count());
  const Pace pace(progress, "measure");
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < sculpture.piece_count(); ++n) {
    const PieceLook& look = sculpture.look(n);
    if (!look.is_visible) continue;
    if (look.is_locked) {
      return Error{ErrorKind::bad_input, "the piece " + in_quotes(look.name) +
                                             " is locked; free or hide it, and drop all again"};
    }
    const auto done = static_cast<double>(n);
    auto surface = standing_surface(n, pace.part(done / count, (done + 1.0) / count).progress());
    if (!surface) return surface.error();
    for (const Vec3& point : surface.value().positions) lowest = std::min(lowest, point.z);
  }
  PlacePieces all;
  if (!std::isfinite(lowest)) return all;
  for (std::size_t n = 0; n < sculpture.piece_count(); ++n) {
    const PieceLook& look = sculpture.look(n);
    const Placement there = moved(look.placement, {0.0, 0.0, -lowest});
    if (look.is_visible && !stands_at(look, there)) all.places.push_back({look.name, there});
  }
  return all;
}

/// Turned about the middle of its box so that `up` is up.
Result<Placement> DocumentWorker::laid_on_most(const TriangleMesh& surface, const Vec3& middle_mm,
                                               const Progress& progress) {
  const Placement& at = active_look().placement;
  const Vec3 z{0.0, 0.0, 1.0};
  const Vec3 up = mesh::lying_on_most(surface, z, document_.clay().options().voxel_mm,
                                      Pace(progress, "lay flat"));
  constexpr double kThere = 1e-9;
  const Vec3 across = cross(up, z);
  if (up.z > 0.0 && length(across) < kThere) return at;
  const Vec3 axis = length(across) < kThere ? Vec3{1.0, 0.0, 0.0} : normalized(across);
  const double angle = std::atan2(length(across), up.z) * 180.0 / std::numbers::pi;
  return turned_about(at, middle_mm, axis, angle);
}

/// Of the active piece.
Result<Placement> DocumentWorker::standing_place(StandPiece::Where where,
                                                 const Progress& progress) {
  Placement at = active_look().placement;
  auto surface = standing_surface(document_.sculpture().active(), progress);
  if (!surface) return surface.error();
  if (surface.value().positions.empty()) return at;
  Box3 box = box_around(surface.value().positions);
  if (where == StandPiece::Where::flat) {
    const Placement before = at;
    auto laid = laid_on_most(surface.value(), box.center(), progress);
    if (!laid) return laid;
    at = laid.value();
    box = {};
    for (const Vec3& point : surface.value().positions) {
      box.include(placed(at, unplaced(before, point)));
    }
  }
  const bool is_middle = where == StandPiece::Where::middle;
  return moved(
      at, is_middle ? Vec3{-box.center().x, -box.center().y, 0.0} : Vec3{0.0, 0.0, -box.min.z});
}

/// One step, unless all stand there already. Measuring a large clay takes its time: it hears a
/// stop, and what it has no memory for changes nothing.
void DocumentWorker::on(const StandPiece& wanted) {
  if (!has_clay("move")) return;
  end_open_stroke();
  const bool is_all = wanted.where == StandPiece::Where::all_on_bed;
  if (auto free = document_.sculpture().check_unlocked(); !free && !is_all) {
    return complain(free.error());
  }
  const Progress progress = outbox_.begin_task("measure");
  auto places = no_throw("where the piece stands", [&]() -> Result<PlacePieces> {
    if (is_all) return places_on_bed(progress);
    auto there = standing_place(wanted.where, progress);
    if (!there) return there.error();
    PlacePieces one;
    if (!stands_at(active_look(), there.value())) {
      one.places.push_back({active_look().name, there.value()});
    }
    return one;
  });
  outbox_.end_task();
  if (!places) {
    if (places.error().kind != ErrorKind::interrupted) complain(places.error());
    return;
  }
  if (!places.value().places.empty()) on(DoStep{PieceEdit{std::move(places).value()}});
}

}  // namespace argil::viewer
