// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "argil/core/field_window.h"
#include "argil/core/result.h"
#include "argil/engine/clay.h"

namespace argil {

/// A window that owns its memory.
struct FieldWindow {
  FieldWindowView view;  ///< view.distance_mm refers to `storage`
  std::vector<float> storage;

  FieldWindow() = default;
  FieldWindow(FieldWindow&&) = default;  // moving a vector keeps its memory in place
  FieldWindow& operator=(FieldWindow&&) = default;
  FieldWindow(const FieldWindow&) = delete;
  FieldWindow& operator=(const FieldWindow&) = delete;
};

/// How distance beyond the narrow band is found.
enum class Extension {
  march,  ///< second-order fast marching from the band: what the servo's windows use
  exact,  ///< closest point of the finest surface (Embree): slow, the reference of method `fine`
};

/// Reads a dense window of one level around `center_mm`, reaching `reach_mm` to every side, with
/// the distance extended inside and outside to at least `depth_mm`.
///
/// Levels   level 0 is the finest; a negative level, down to -10, interpolates between the finest
///          nodes. Finer levels are ignored: their restriction is what a level holds.
/// Units    mm; reach > 0; depth >= 0, usually 2 R + skin. Beyond the depth values are only sure to
///          be no nearer, and end at depth + 2 voxels (march).
/// Errors   bad_input for a level the clay does not have, a centre beyond kMaxNode, or a block
/// (this
///          one, or the coarser one that reaches the depth) above 512 nodes a side; memory.
/// Accuracy march: p95 0.01 to 0.04 voxel where the closest place lies within the window; where it
///          lies outside, p95 0.15 voxel of a coarser level with voxels up to depth / 10
///          (WindowMarch.*). WindowForce.* holds the force to 1 %.
///          exact: to the rounding of float, for the surface that `extract_surface` gives.
/// Threads  clay thread only: allocates.
/// Cost     march: 7 to 30 ms for 25 to 35 nodes a side. exact: the whole surface, then about 1 us
///          for each node.
Result<FieldWindow> read_window(const Clay& clay, int level, const Vec3& center_mm, double reach_mm,
                                double depth_mm, Extension extension);

}  // namespace argil
