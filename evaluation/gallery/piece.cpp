// SPDX-License-Identifier: GPL-3.0-or-later
#include "gallery/piece.h"

#include <utility>

#include "argil/engine/clay.h"
#include "argil/engine/surface.h"

namespace argil::evaluation {
namespace {

Result<Clay> body_clay(Body body, double voxel_mm) {
  constexpr double kHighestMm = 1.0;  // of welt and bumps
  const double half = kGalleryBall + kHighestMm + 2.0 * voxel_mm;
  ClayOptions options;
  options.voxel_mm = voxel_mm;
  return Clay::from_distance([body](const Vec3& p) { return body_distance(body, p); },
                             {{-half, -half, -half}, {half, half, half}}, options);
}

}  // namespace

Result<TriangleMesh> body_surface(Body body, double voxel_mm, const Progress& progress) {
  auto clay = body_clay(body, voxel_mm);
  if (!clay) return clay.error();
  return extract_surface(clay.value(), progress);
}

Result<Piece> argil_piece(const Plate& plate, double voxel_mm, const Progress& progress) {
  auto clay = body_clay(plate.body, voxel_mm);
  if (!clay) return clay.error();
  Piece piece;
  for (const PlateStroke& each : plate.strokes) {
    const auto made = clay.value().apply(each.stroke, progress);
    if (!made) return made.error();
    piece.level = made.value().level;
  }
  auto surface = extract_surface(clay.value(), progress);
  if (!surface) return surface.error();
  piece.mesh = std::move(surface).value();
  return piece;
}

}  // namespace argil::evaluation
