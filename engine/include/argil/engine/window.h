// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "argil/core/field_window.h"
#include "argil/core/result.h"
#include "argil/engine/clay.h"

namespace argil {

/// A window that owns its memory.
struct FieldWindow {
  FieldWindowView view;         ///< view.distance_mm refers to `storage`
  std::vector<float> storage;

  FieldWindow() = default;
  FieldWindow(FieldWindow&&) = default;             // moving a vector keeps its memory in place
  FieldWindow& operator=(FieldWindow&&) = default;
  FieldWindow(const FieldWindow&) = delete;
  FieldWindow& operator=(const FieldWindow&) = delete;
};

/// How distance beyond the narrow band is found.
enum class Extension {
  march,  ///< second-order fast marching from the band: what the servo's windows use
  exact,  ///< closest point of the finest surface (Embree): slow, the reference of method `fine`
};

/// Reads a dense window of one level around `center_mm`, reaching `reach_mm` to every side, with the
/// distance extended inside and outside to at least `depth_mm`.
///
/// Levels   level 0 is the finest; a negative level interpolates between the finest nodes.
/// Errors   bad_input when the block would exceed 512 nodes along a side.
/// Accuracy march: second order, p95 about 0.02 voxel (tests/engine: WindowMarch.*).
/// Threads  clay thread only: allocates.
Result<FieldWindow> read_window(const Clay& clay, int level, const Vec3& center_mm,
                                double reach_mm, double depth_mm, Extension extension);

}  // namespace argil
