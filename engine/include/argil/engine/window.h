// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "argil/core/field_window.h"
#include "argil/core/result.h"
#include "argil/core/window_channel.h"
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

/// Which window is wanted.
struct WindowRequest {
  Vec3 center_mm;
  /// Spacing of the nodes, which lie at its multiples. Usually a quarter of the tool's radius, so
  /// that every tool is summed over as many nodes. At least 1/1024 of the finest voxel; what is
  /// finer than the clay holds is interpolated.
  double voxel_mm = 0.0;
  /// What the window covers to every side of the centre: the kernel's support and a margin for
  /// motion. Too small and the servo runs out of the window before the next one comes. > 0.
  double reach_mm = 0.0;
  /// How deep distance must be known: 2 R + skin. Less and a large tool saturates. >= 0.
  double depth_mm = 0.0;
};

/// Reads a dense window of the clay, with the distance extended inside and outside to at least
/// `depth_mm`.
///
/// Levels   march reads the level L with h_L <= voxel < 2 h_L (no finer than level 0, no coarser
///          than the coarsest) and interpolates between its nodes: tricubic, a copy where nodes
///          coincide. Within a quarter octave above h_L level L - 1 is blended in, linearly in
///          log2(voxel) from its fraction 1 at h_L, so that a growing tool feels no step. Levels
///          finer than that are ignored: their average is what a level holds. exact reads the
///          finest.
/// Beyond   the depth values are only sure to be no nearer, and end at the depth + 2 voxels of
///          view.level (march).
/// Errors   bad_input for numbers out of range, a centre beyond kMaxNode, or a block (this one, the
///          stored one it is read from, or the coarser one that reaches the depth) above 512 nodes
///          a side; memory.
/// Accuracy march: p95 0.01 to 0.04 voxel where the closest point lies within the window; where it
///          lies outside, p95 0.15 voxel of a coarser level with voxels up to depth / 8
///          (WindowMarch.*). What that does to the force: WindowForceError.*, docs/forces.md.
///          view.distance_error_mm estimates the root mean square within three voxels of the
///          surface, most of it what averaging and kinks cost, for the window at hand.
///          exact: to the rounding of float, for the surface that `extract_surface` gives.
/// Threads  clay thread only: allocates.
/// Cost     march: 4 to 30 ms for windows of 20 nodes a side, most where the spacing is nearly
///          twice the level's or two levels are blended. exact: the whole surface, then about 1 us
///          for each node.
Result<FieldWindow> read_window(const Clay& clay, const WindowRequest& request,
                                Extension extension);

/// Which tool sample a window answers; copied into the slot as it is.
struct WindowAnswer {
  std::uint64_t index = 0;  ///< the newest ToolSample taken into account; 0: none
  double time_s = 0.0;      ///< its time on the servo's clock
};

/// Marches windows into the slots of a channel, for the servo to read. What the last march gave is
/// kept: a resting tool asks for the same window of the same clay again and again.
///
/// Threads  clay thread only; the servo's thread reads the channel meanwhile.
/// Memory   the channel's, made before and never reallocated, and a copy of the last window
///          (at most 1 MiB); a march needs scratch memory that it gives back.
class WindowPublisher {
 public:
  /// `channel` must outlive the publisher and have no other writer.
  explicit WindowPublisher(WindowChannel& channel) noexcept : channel_(channel) {}

  /// Publishes what read_window(clay, request, Extension::march) gives, numbered one after the last
  /// and sealed with its checksum, which does not cover `answer`.
  /// Errors   as read_window; bad_input also for a reach above 31 voxels, which kWindowCapacity
  ///          does not hold wherever the centre lies. On error nothing is published.
  /// Cost     as read_window, and the checksum: 15 us for 40^3 nodes. A copy where clay, nodes and
  ///          depth are those of the last window.
  Result<void> publish(const Clay& clay, const WindowRequest& request,
                       const WindowAnswer& answer = {});

 private:
  /// The last window, and what it was marched for.
  struct Marched {
    FieldWindow window;
    double depth_mm = 0.0;
    std::uint64_t clay = 0;
    std::uint64_t revision = 0;
    std::uint64_t checksum = 0;
  };
  void march(const Clay& clay, const WindowRequest& request);
  void fill(WindowSlot& slot) const;

  WindowChannel& channel_;
  std::uint64_t sequence_ = 0;
  Marched marched_;
};

}  // namespace argil
