// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/references.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "settings/reference_list.h"

namespace argil::viewer {

void add_reference(const std::filesystem::path& file, UiState& ui) {
  constexpr double kWithoutClayMm = 100.0;
  const StraightView view =
      straight_view_of(ui.camera.lens(ui.clay.all_bounds_mm)).value_or(StraightView::front);
  auto read = reference_of(file, view, kWithoutClayMm);
  if (!read) {
    ui.notices.push_back(notice_of(read.error()));
    return;
  }
  ReferenceImage& image = read.value();
  const ViewAxes axes = axes_of(view);
  const Box3& all = ui.clay.all_bounds_mm;
  if (!all.empty()) {
    // Its longer side is the clay's in this view.
    const double side =
        std::max(std::abs(dot(all.size(), axes.right)), std::abs(dot(all.size(), axes.up)));
    const double longer = std::max(image.pixels->width, image.pixels->height);
    image.width_mm = std::max(kLeastReferenceWidthMm, side * image.pixels->width / longer);
    image.right_mm = dot(all.center(), axes.right);
    image.up_mm = dot(all.center(), axes.up);
  }
  ui.camera.look_from(axes.back, axes.up);
  ui.references.push_back(std::move(image));
  ui.panels.has_references = true;
}

}  // namespace argil::viewer
