// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
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
  layers,  ///< closest point of layers beside the surface: what the servo's windows use
  exact,   ///< closest point of the finest surface (Embree): slow, the reference of method `fine`
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
  /// Of WindowPublisher::publish: with the detail that the window is too coarse for
  /// (SurfaceDetail), where the surface is nearest to the centre; 0.6 ms more.
  bool wants_detail = false;
};

/// Reads a dense window of the clay, with the distance extended inside and outside to at least
/// `depth_mm`.
///
/// Levels   layers reads the level L with h_L <= voxel < 2 h_L (no finer than level 0, no coarser
///          than the coarsest) and interpolates between its nodes: tricubic, a copy where nodes
///          coincide. Within a quarter octave above h_L level L - 1 is blended in, linearly in
///          log2(voxel) from its fraction 1 at h_L, so that a growing tool feels no step. Levels
///          finer than that are ignored: their average is what a level holds. exact reads the
///          finest.
/// Distance layers: within a voxel of the surface what the levels say; beyond two voxels the way
///          over the closest point of a layer beside the surface, bent as the surface is there.
///          Points within 12 voxels come from the level itself, farther ones from coarser levels,
///          each to 8 of its voxels.
/// Beyond   the depth values are only sure to be no nearer, and end at the depth + 2 voxels of
///          view.level (layers).
/// Errors   bad_input for numbers out of range, a centre beyond kMaxNode, or a block (this one, or
///          what of a level is asked for points) above 512 nodes a side; memory.
/// Accuracy layers: p95 0.01 to 0.04 voxel where the closest point lies within 12 voxels; where it
///          lies farther, p95 0.15 voxel of the level that is asked there (WindowLayers.*). What
///          that does to the force: WindowForceError.*, docs/forces.md. view.distance_error_mm
///          estimates the root mean square near the surface, most of it what averaging and kinks
///          cost, for the window at hand.
///          exact: to the rounding of float, for the surface that `extract_surface` gives.
/// Threads  clay thread only: allocates.
/// Cost     layers: 10 to 25 ms for windows of 25 nodes a side, most where a level's voxels
///          are half the spacing (docs/forces.md). exact: the whole surface, then about 1 us
///          for each node.
Result<FieldWindow> read_window(const Clay& clay, const WindowRequest& request,
                                Extension extension);

/// Which tool sample a window answers; copied into the slot as it is.
struct WindowAnswer {
  std::uint64_t index = 0;  ///< the newest ToolSample taken into account; 0: none
  double time_s = 0.0;      ///< its time on the servo's clock
};

/// Reads windows into the slots of a channel, for the servo. What the last one took is kept: the
/// next window of a tool that moved a little, or of clay that changed a little, is made of it but
/// for what became different, and has the bits that it would have without (WindowTiles.*). A
/// resting tool's is copied.
///
/// Threads  clay thread only; the servo's thread reads the channel meanwhile.
/// Memory   the channel's, made before and never reallocated; a copy of the last window (at most
///          1 MiB) and what is kept of the clay around it, up to some 10 MB.
class WindowPublisher {
 public:
  /// `channel` must outlive the publisher and have no other writer.
  explicit WindowPublisher(WindowChannel& channel);
  ~WindowPublisher();
  WindowPublisher(const WindowPublisher&) = delete;
  WindowPublisher& operator=(const WindowPublisher&) = delete;

  /// Publishes what read_window(clay, request, Extension::layers) gives, numbered one after the
  /// last and sealed with its checksum, which does not cover `answer`.
  /// Errors   as read_window; bad_input also for a reach above 31 voxels, which kWindowCapacity
  ///          does not hold wherever the centre lies. On error nothing is published.
  /// Cost     the first as read_window; then 1 to 4 ms after a move of 4 nodes, half of the first
  ///          after a dab, and the checksum: 15 us for 40^3 nodes.
  Result<void> publish(const Clay& clay, const WindowRequest& request,
                       const WindowAnswer& answer = {});

 private:
  struct Kept;
  void read(const Clay& clay, const WindowRequest& request);
  void fill(WindowSlot& slot) const;

  WindowChannel& channel_;
  std::uint64_t sequence_ = 0;
  std::unique_ptr<Kept> kept_;
};

}  // namespace argil
