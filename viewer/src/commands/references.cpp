// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/references.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <system_error>
#include <utility>

namespace argil::viewer {

void add_reference(const std::filesystem::path& file, UiState& ui) {
  const StraightView view =
      straight_view_of(ui.camera.lens(ui.clay.all_bounds_mm)).value_or(StraightView::front);
  std::error_code error;
  ui.reference_wishes.push_back({std::filesystem::absolute(file, error), view, false});
  const ViewAxes axes = axes_of(view);
  ui.camera.look_from(axes.back, axes.up);
  ui.panels.has_references = true;
}

void put_reference(const ReferenceWish& wish, std::shared_ptr<const ReferencePixels> pixels,
                   UiState& ui) {
  constexpr double kWithoutClayMm = 100.0;
  assert(pixels && pixels->width > 0 && pixels->height > 0);
  ReferenceImage image;
  image.file = wish.file;
  image.view = wish.view;
  image.width_mm = kWithoutClayMm;
  const ViewAxes axes = axes_of(wish.view);
  const Box3& all = ui.clay.all_bounds_mm;
  if (!all.empty()) {
    // Its longer side is the clay's in this view.
    const double side =
        std::max(std::abs(dot(all.size(), axes.right)), std::abs(dot(all.size(), axes.up)));
    const double longer = std::max(pixels->width, pixels->height);
    image.width_mm = std::max(kLeastReferenceWidthMm, side * pixels->width / longer);
    image.right_mm = dot(all.center(), axes.right);
    image.up_mm = dot(all.center(), axes.up);
  }
  image.pixels = std::move(pixels);
  ui.references.push_back(std::move(image));
}

}  // namespace argil::viewer
