// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/engine/clay.h"
#include "argil/engine/surface.h"

#include "edits/row.h"

namespace argil::evaluation {

/// A clay with its surface, on which strokes are made and undone.
class ArgilBench {
 public:
  ArgilBench(const BumpyBall& ball, Clay clay);

  /// Times both strokes `repeats` times, fewer where that takes seconds, as a hand makes them: the
  /// surface follows each dab. The clay is afterwards as it was. `moved_mm` of the row is that of
  /// the last long stroke.
  /// Errors  as Clay; internal where a sample did not make one dab.
  Result<void> time(const StrokePlan& plan, Action action, int repeats, EditRow& row);

  /// The whole surface after the long stroke; the clay is afterwards as it was.
  Result<TriangleMesh> result_of(const StrokePlan& plan, Action action);

  /// Vertices of the untouched surface that the tool's first dab reaches.
  std::int64_t covered_by(const StrokePlan& plan, Action action) const;

 private:
  Result<StrokeTime> stroke(const Stroke& stroke, int dabs);
  double moved_mm(const StrokePlan& plan) const;
  void undo();

  BumpyBall ball_;
  Clay clay_;
  Surface surface_;
  std::vector<Vec3> vertices_;  ///< of the untouched surface
};

}  // namespace argil::evaluation
