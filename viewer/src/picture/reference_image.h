// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "argil/core/pace.h"
#include "argil/core/vec3.h"

#include "picture/camera.h"

namespace argil::viewer {

/// The straight views, as keys choose them.
enum class StraightView { front, back, right, left, top, bottom };
inline constexpr int kStraightViews = 6;
const char* title_of(StraightView view) noexcept;
/// By its title in lower letters; nothing for another word.
std::optional<StraightView> view_named(std::string_view name) noexcept;

/// Where the picture's right and up are in a straight view, and the way back to the eye.
struct ViewAxes {
  Vec3 right;
  Vec3 up;
  Vec3 back;
};
ViewAxes axes_of(StraightView view) noexcept;
/// The view in which a lens looks, upright and to a thousandth of a radian; nothing aslant.
std::optional<StraightView> straight_view_of(const Lens& lens) noexcept;

/// Pixels in sRGB, four bytes each: red, green, blue, opacity. Rows from the top.
struct PixelLevel {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;
};

/// An image, and what it is when it is drawn smaller, so that nothing is left to reckon then.
struct ReferencePixels : PixelLevel {
  /// Each has half the columns and rows of the one before, rounded down, one at least; the last is
  /// one pixel.
  std::vector<PixelLevel> smaller;
};

/// The same with its smaller ones. A pixel of those is the mean of what it covers of the level
/// before; of an odd side that is two pixels and a part of a third, so that nothing moves.
///
/// Shapes  rgba: 4 * width * height bytes, both at least 1.
/// Errors  throws Interrupted as `pace` says, asked with every row.
/// Cost    2.5 ns a pixel: bench_images.
/// Source  NVIDIA, "Non-Power-of-Two Mipmapping" (2005), box filter.
std::shared_ptr<const ReferencePixels> with_smaller(int width, int height,
                                                    std::vector<std::uint8_t> rgba,
                                                    const Pace& pace);

inline constexpr double kLeastReferenceWidthMm = 1e-3;

/// An image to sculpt by, which is shown while the camera looks in its view: behind the clay, or
/// over it. It stands in the plane through the sculpture's origin.
struct ReferenceImage {
  std::filesystem::path file;  ///< a PNG or a JPEG, absolute
  StraightView view = StraightView::front;
  double right_mm = 0.0;  ///< of its middle from the origin, as the view sees it
  double up_mm = 0.0;
  double width_mm = 100.0;  ///< at least kLeastReferenceWidthMm; its height follows from its pixels
  double opacity = 0.6;     ///< 0 to 1
  bool is_over = false;
  bool is_visible = true;
  std::shared_ptr<const ReferencePixels> pixels = nullptr;  ///< null: not there (yet)
  bool is_awaited = false;                                  ///< its pixels are being read
  friend bool operator==(const ReferenceImage&, const ReferenceImage&) = default;
};

/// A reference image as a picture shows it.
struct ReferenceMark {
  std::shared_ptr<const ReferencePixels> pixels;
  Vec3 corner_mm;  ///< of the first pixel
  Vec3 along_mm;   ///< from there to the end of the first row
  Vec3 down_mm;    ///< and to the start of the last one
  double opacity = 1.0;
  bool is_over = false;
  friend bool operator==(const ReferenceMark&, const ReferenceMark&) = default;
};

/// Those of a view that are to be seen in it.
std::vector<ReferenceMark> marks_of(const std::vector<ReferenceImage>& images,
                                    const std::optional<StraightView>& view);

}  // namespace argil::viewer
