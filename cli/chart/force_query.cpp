// SPDX-License-Identifier: GPL-3.0-or-later
#include "chart/force_query.h"

#include <algorithm>
#include <cmath>

namespace argil::cli::chart {

using haptics::ForceMaterial;
using haptics::ForceResult;
using haptics::ForceTool;

namespace {

Answer answer_of(const ForceResult& result) {
  return {{result.contact_n, result.contact_nmm}, result.samples, std::nullopt};
}

}  // namespace

Query::Query(const Method& method, const ForceTool& tool, const ForceMaterial& material)
    : method_(method), material_(material) {
  if (method.way == Way::stencil) points_ = stencil_points(method.size);
  if (method.way == Way::lattice) {
    lattice_.emplace(tool, material, method.law, spacing_mm(method, tool));
  }
}

Answer Query::ask(const FieldWindowView& window, const ForceTool& pose) const {
  switch (method_.way) {
    case Way::point:
      return answer_of(haptics::point_force(window, pose, material_));
    case Way::stencil:
      return {stencil_force(points_, window, pose, material_), method_.size, std::nullopt};
    case Way::lattice: {
      const ForceResult result = lattice_->evaluate(window, pose);
      Answer answer = answer_of(result);
      answer.error_n = result.error_n;
      return answer;
    }
    case Way::sum:
    case Way::fine:
      break;
  }
  return answer_of(haptics::volume_force(window, pose, material_, method_.law));
}

Answer Query::ask(const Distance& distance, const ForceTool& pose) const {
  return {stencil_force(points_, distance, kVoxelMm, pose, material_), method_.size, std::nullopt};
}

FieldWindow finest_window(const Distance& distance, const ForceTool& tool, double margin_mm) {
  const Vec3& radii = tool.radii_mm;
  const double reach =
      haptics::kKernelSupport * std::max({radii.x, radii.y, radii.z}) + margin_mm + kVoxelMm;
  FieldWindow window;
  FieldWindowView& view = window.view;
  view.voxel_mm = kVoxelMm;
  for (std::size_t a = 0; a < 3; ++a) {
    const double low = std::floor((tool.position_mm[a] - reach) / kVoxelMm);
    const double high = std::ceil((tool.position_mm[a] + reach) / kVoxelMm);
    view.origin_mm[a] = low * kVoxelMm;
    view.nodes[a] = static_cast<int>(high - low) + 1;
  }
  window.storage.reserve(view.index(view.nodes[0], 0, 0));
  for (int i = 0; i < view.nodes[0]; ++i) {
    for (int j = 0; j < view.nodes[1]; ++j) {
      for (int k = 0; k < view.nodes[2]; ++k) {
        const Vec3 step{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
        window.storage.push_back(static_cast<float>(distance(view.origin_mm + kVoxelMm * step)));
      }
    }
  }
  view.distance_mm = window.storage;
  return window;
}

Result<const FieldWindowView*> Windows::of(const Method& method) {
  if (method.way == Way::stencil) return nullptr;
  if (method.way == Way::fine) {
    if (!fine_) fine_ = finest_window(scene_.distance, tool_, margin_mm_);
    return &fine_->view;
  }
  haptics::Lattice lattice;
  lattice.voxel_mm = spacing_mm(method, tool_);
  WindowRequest request{tool_.position_mm, lattice.voxel_mm,
                        haptics::window_reach_mm(tool_, lattice, margin_mm_),
                        haptics::window_depth_mm(tool_, material_, lattice)};
  if (method.way == Way::point) {
    constexpr double kBorderVoxels = 3.0;  // for the gradient
    request.reach_mm = margin_mm_ + kBorderVoxels * kVoxelMm;
    if (!centre_) {
      auto window = read_window(*scene_.clay, request, Extension::march);
      if (!window) return window.error();
      centre_ = std::move(window).value();
    }
    return &centre_->view;
  }
  auto known = lattices_.find(lattice.voxel_mm);
  if (known == lattices_.end()) {
    auto window = read_window(*scene_.clay, request, Extension::march);
    if (!window) return window.error();
    known = lattices_.emplace(lattice.voxel_mm, std::move(window).value()).first;
  }
  return &known->second.view;
}

}  // namespace argil::cli::chart
