// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "argil/engine/stroke.h"
#include "argil/engine/tool.h"
#include "argil/engine/tool_mesh.h"

#include "commands/stroke_mode.h"
#include "document/tool_info.h"
#include "input/input_event.h"
#include "picture/surface_probe.h"

namespace argil::viewer {

/// The brush as it is set in its panel.
struct Brush {
  Action action = Action::inflate;
  bool is_stamp = false;      ///< the action is add, or carve where inverted
  Shape shape = Shape::ball;  ///< as chosen; what of it an action takes: shape_of
  double height = 1.0;        ///< of all but balls and meshes: along the surface's normal, in radii
  double turn_deg = 0.0;      ///< about that normal
  std::shared_ptr<const ToolMesh> mesh =
      nullptr;  ///< of Shape::mesh; null: a ball until it is there
  double radius_mm = 5.0;
  double radius_pixels = 60.0;
  bool is_screen_size = false;  ///< radius_pixels counts, where the stroke begins
  double strength = 0.5;  ///< 0.01 to 1; for add and carve the fraction of the radius that the
                          ///< tool stands out of the surface, or dips in
  bool is_inverted = false;
  double pressure_to_strength = 1.0;
  double pressure_to_size = 0.0;
  double sharpness = 1.0;             ///< of profiled actions, as in Tool
  double width = 0.6;                 ///< likewise
  Falloff falloff = Falloff::smooth;  ///< smooth where the tool takes no such steep one
  // Of single tools, as Tool has them; the wavelength in radii.
  double plane_offset = 0.0;
  double tip_roundness = 0.18;
  double volume_preservation = 1.0;
  double crease_pinch_factor = 0.5;
  double wavelength = 0.5;
  int seed = 0;
  // Of emboss, as Tool has them; lengths in radii.
  std::shared_ptr<const AlphaImage> alpha = nullptr;
  AlphaMode alpha_mode = AlphaMode::space;  ///< or tiled; StrokeMode::anchored is the third
  double amplitude = 0.25;
  double mid_level = 0.0;
  double angle_deg = 0.0;
  bool use_rake = false;
  double tile = 1.0;
  double spacing = 0.25;
  double steady_mm = 0.0;
  double hold_s = 0.0;
  StrokeMode stroke_mode = StrokeMode::space;  ///< of all but emboss
  StrokeMode emboss_mode = StrokeMode::space;  ///< of emboss
  Mirror mirror;
  Radial radial;
};

inline constexpr double kLeastRadiusMm = 0.01;
inline constexpr double kMostRadiusMm = 1000.0;
inline constexpr double kLeastStrength = 0.01;
inline constexpr double kLeastHeight = 0.1;
inline constexpr double kMostHeight = 4.0;

/// Whether a brush adds or carves its shape, which then may be any.
inline bool is_solid(const Brush& brush) noexcept { return is_stamped(brush.action); }

void choose(Brush& brush, const ToolInfo& tool) noexcept;
inline bool is_chosen(const Brush& brush, const ToolInfo& tool) noexcept {
  return brush.action == tool.action && brush.is_stamp == tool.is_stamp;
}

/// The shape that a brush works with: only what adds or carves has edges.
Shape shape_of(const Brush& brush) noexcept;

/// The mode as it was chosen: emboss has its own.
inline StrokeMode& chosen_mode(Brush& brush) noexcept {
  return brush.action == Action::emboss ? brush.emboss_mode : brush.stroke_mode;
}

/// Whether the tool takes other modes than space: not a stamp, which is one dab anyway, nor what
/// drags matter along.
bool takes_modes(const Brush& brush) noexcept;

/// The mode that a stroke has: the chosen one where the tool takes it.
StrokeMode mode_of(const Brush& brush) noexcept;

/// Half extents of the tool.
Vec3 radii_of(const Brush& brush, double radius_mm) noexcept;

/// The brush of a stroke that begins with these keys held: Ctrl the opposite, Shift smooth.
Brush brush_with(const Brush& brush, const Modifiers& modifiers) noexcept;

/// The radius on a surface where a pixel spans `pixel_mm`.
double radius_on(const Brush& brush, double pixel_mm) noexcept;

Tool tool_of(const Brush& brush, double radius_mm) noexcept;
StrokeStyle style_of(const Brush& brush) noexcept;

/// A point and its images in the brush's symmetry, itself first.
std::vector<SurfaceHit> images_of(const SurfaceHit& hit, const Brush& brush);

/// Where the tool's centre lies for a brush on the surface, its z axis along the normal: what adds
/// or carves stands out by the strength times its height, all else works about the surface itself.
StrokeSample sample_at(const Brush& brush, double radius_mm, const SurfaceHit& hit, double time_s,
                       double pressure) noexcept;

/// The sample of an anchored dab: the tool's x axis points along `way`, as far as that lies in the
/// surface.
StrokeSample anchored_sample(const Brush& brush, double radius_mm, const SurfaceHit& hit,
                             const Vec3& way, double pressure) noexcept;

}  // namespace argil::viewer
