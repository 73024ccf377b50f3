// SPDX-License-Identifier: GPL-3.0-or-later
// One method asked for the force at a pose, and the windows that it reads: made once and shared by
// all methods with the same lattice.
#include "force/query.h"

#include <cassert>

#include "argil/haptics/force/point_choice.h"

#include "common/tool_option.h"
#include "force/analytic_window.h"

namespace argil::evaluation {

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
  if (method.quadrature == Quadrature::stencil) points_ = stencil_points(method.size);
  if (method.quadrature == Quadrature::lattice || method.quadrature == Quadrature::chosen) {
    lattice_.emplace(tool, material, method.law, spacing_mm(method, tool));
  }
}

Answer Query::ask(const FieldWindowView& window, const ForceTool& pose) const {
  switch (method_.quadrature) {
    case Quadrature::point:
      return answer_of(haptics::point_force(window, pose, material_));
    case Quadrature::stencil:
      return {stencil_force(points_, window, pose, material_), method_.size, std::nullopt};
    case Quadrature::chosen:
    case Quadrature::lattice: {
      const bool is_point = method_.quadrature == Quadrature::chosen &&
                            haptics::is_centre_enough(window, pose, material_);
      const ForceResult result = is_point ? haptics::point_energy_force(window, pose, material_)
                                          : lattice_->evaluate(window, pose);
      Answer answer = answer_of(result);
      answer.error_n = result.error_n;
      return answer;
    }
    case Quadrature::sum:
    case Quadrature::fine:
      break;
  }
  return answer_of(haptics::volume_force(window, pose, material_, method_.law));
}

Answer Query::ask(const Distance& distance, const ForceTool& pose) const {
  assert(method_.quadrature == Quadrature::stencil && !points_.empty());
  return {stencil_force(points_, distance, kVoxelMm, pose, material_), method_.size, std::nullopt};
}

FieldWindow finest_window(const Distance& distance, const ForceTool& tool, double margin_mm) {
  const double reach =
      haptics::kKernelSupport * cli::largest_radius_mm(tool) + margin_mm + kVoxelMm;
  return analytic_window(distance, tool.position_mm, reach, kVoxelMm);
}

Result<const FieldWindowView*> Windows::of(const Method& method) {
  // Stencils read the distance in closed form.
  if (method.quadrature == Quadrature::stencil) return nullptr;
  if (method.quadrature == Quadrature::fine) {
    if (!fine_) fine_ = finest_window(scene_.distance, tool_, margin_mm_);
    return &fine_->view;
  }
  haptics::Lattice lattice;
  lattice.voxel_mm = spacing_mm(method, tool_);
  WindowRequest request{tool_.position_mm, lattice.voxel_mm,
                        haptics::window_reach_mm(tool_, lattice, margin_mm_),
                        haptics::window_depth_mm(tool_, material_, lattice)};
  if (method.quadrature == Quadrature::point) {
    request.reach_mm = margin_mm_ + kPointBorder * kVoxelMm;
    if (!centre_) {
      auto window = read_window(*scene_.clay, request, Extension::layers);
      if (!window) return window.error();
      centre_ = std::move(window).value();
    }
    return &centre_->view;
  }
  auto known = lattices_.find(lattice.voxel_mm);
  if (known == lattices_.end()) {
    auto window = read_window(*scene_.clay, request, Extension::layers);
    if (!window) return window.error();
    known = lattices_.emplace(lattice.voxel_mm, std::move(window).value()).first;
  }
  return &known->second.view;
}

}  // namespace argil::evaluation
