// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/engine/clay.h"
#include "argil/mesh/check.h"
#include "argil/mesh/liquid_pockets.h"
#include "argil/mesh/print_islands.h"
#include "argil/mesh/print_orientation.h"
#include "argil/mesh/printer.h"

namespace argil::io {

/// What is done for a flat base.
enum class PrintBase : std::uint8_t {
  automatic,  ///< cut off as little as gives a firm stand, nothing where there is one
  cut,        ///< cut off what lies lower than cut_mm above the lowest point
  lay,        ///< roll the piece until it rests on a flat side or three points
  none
};

struct PreparationOptions {
  mesh::Printer printer;  ///< an overhang angle of 0 counts as 50 degrees for orientation
  /// What shall be up, any length but zero; none: the best of what is found.
  std::optional<Vec3> up;
  PrintBase base = PrintBase::automatic;
  double cut_mm = 0.0;   ///< with PrintBase::cut: above 0, less than the height
  double wall_mm = 0.0;  ///< above 0: hollow, with drains; as Hollow has it
  /// As Drain has it: usually 1.5 for resin.
  double drain_radius_mm = 1.5;
  bool fits_bed = false;            ///< cut into pieces where it is larger than the bed
  double plug_tolerance_mm = 0.15;  ///< air around a plug in its hole, 0 to 2
  double layer_mm = 0.2;            ///< above 0: islands that are lower are none
};

/// A hole drilled for liquid to run out, or for air to come in; in the frame of the bed.
struct PrintHole {
  Vec3 mouth_mm;
  Vec3 inward;  ///< unit
  bool is_for_air = false;
};

/// One thing to print, standing on z = 0 in the middle of the bed (about x = y = 0 without one).
struct PreparedPiece {
  std::string name;  ///< "piece", "piece 1"..., "plugs"
  TriangleMesh mesh;
  mesh::MeshVerdict verdict;
  std::int64_t filled_cavities =
      0;  ///< of less than 10 mm3, of 500 where it is hollowed: not worth drains
  std::vector<mesh::PrintIsland> islands;
  std::vector<mesh::LiquidPocket> pockets;  ///< looked for in what is hollow or needs drains
};

struct PrintPreparation {
  TriangleMesh surface;  ///< of the clay as given, in its own frame
  /// Best first, at most three; the one that was asked for alone, where `up` was.
  std::vector<mesh::PrintOrientation> orientations;
  mesh::PrintOrientation chosen;  ///< figures with the base as it was cut or laid
  double cut_mm = 0.0;
  /// As asked, or up to 10 % more where that keeps two cavities from leaving a film between them
  /// that is thinner than the printer prints; 0: solid.
  double wall_mm = 0.0;
  std::vector<PrintHole> holes;
  std::vector<PreparedPiece> pieces;
  int plugs = 0;  ///< that join the pieces; the last piece holds them all
  double plug_radius_mm = 0.0;
  int joints_without_plug = 0;  ///< cut faces between two pieces too small for any

  /// Whether all pieces are.
  bool is_printable() const;
};

/// Makes clay ready for a printer: oriented (mesh::best_orientations), set on a flat base, hollowed
/// with a drain at the lowest place of each cavity (and, for a printer that needs drains, a hole
/// for air at the highest), cut into pieces that fit the bed with holes for plugs in their cut
/// faces, each laid on one where that fits, and judged. What a cut parts from the rest of its piece
/// is a piece of its own. The clay itself stays as it is.
///
/// Errors       bad_input: no clay, a number out of range, a wall or drain that the clay's voxels
///              do not hold, a bed to fit that the printer does not name; memory; interrupted.
/// Accuracy     of the operations (engine/operation.h); drains are checked on the surface itself,
///              by liquid_pockets with lines no farther apart than 2/3 of a drain's radius.
/// Determinism  same bits for any number of threads.
/// Threads      as Clay; spreads over TBB.
/// Cost         docs/printing.md, "Preparing".
Result<PrintPreparation> prepare_print(const Clay& clay, const PreparationOptions& options,
                                       const Progress& progress = {});

}  // namespace argil::io
