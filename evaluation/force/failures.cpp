// SPDX-License-Identifier: GPL-3.0-or-later
// Five ways in which the volume force, as it is defined, fails, one a panel; docs/forces.md
// discusses them.
#include "force/failures.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <functional>

#include "argil/haptics/force/lattice_force.h"

#include "force/analytic_window.h"

namespace argil::evaluation {
namespace {

using haptics::ForceLaw;
using haptics::ForceMaterial;
using haptics::ForceTool;

ForceTool ball_tool(double radius_mm, const Vec3& center_mm) {
  ForceTool tool;
  tool.radii_mm = {radius_mm, radius_mm, radius_mm};
  tool.position_mm = center_mm;
  return tool;
}

Distance half_space() {
  return [](const Vec3& p) { return p.z; };
}

/// The plain sum on a lattice of `across` nodes along the tool's diameter.
haptics::ForceResult summed(const Distance& field, const ForceTool& tool, double across,
                            const ForceMaterial& material, ForceLaw law) {
  // Two voxels around the kernel, since gradients are differences of neighbours.
  const double voxel = 2.0 * tool.radii_mm.x / across;
  const FieldWindow window = analytic_window(
      field, tool.position_mm, haptics::kKernelSupport * tool.radii_mm.x + 2.0 * voxel, voxel);
  return haptics::volume_force(window.view, tool, material, law);
}

std::string ratio_name(const char* what, double value) {
  char text[48];
  std::snprintf(text, sizeof text, "%s %g", what, value);
  return text;
}

/// Force on a sinking ball where the stored distance ends one skin below the surface.
Panel saturating_field() {
  Panel panel{
      "A field that saturates one skin deep", "depth of the centre / R", "force / f_{c0}", {}};
  const auto sink = [](const std::string& name, double per_skin, bool saturates) {
    Series series{name, {}};
    ForceMaterial material;
    const double radius = per_skin * material.skin_mm;
    const Distance field = [=](const Vec3& p) {
      // Below one skin the field says nothing more, as a narrow band does.
      return saturates ? std::max(p.z, -material.skin_mm) : p.z;
    };
    for (int step = -20; step <= 40; ++step) {
      const double depth = 0.05 * step;
      const auto felt =
          summed(field, ball_tool(radius, {0, 0, -depth * radius}), 24, material, ForceLaw::energy);
      series.points.emplace_back(depth, felt.contact_n.z / material.surface_force_n);
    }
    return series;
  };
  panel.series.push_back(sink("deep distance, R = skin", 1.0, false));
  for (const double per_skin : {1.0, 2.0, 5.0}) {
    panel.series.push_back(sink(ratio_name("saturating, R / skin =", per_skin), per_skin, true));
  }
  return panel;
}

/// Force on a ball pushed through a sheet.
Panel thin_sheet() {
  constexpr double kRadius = 4.0;
  Panel panel{"A thin sheet is pushed through (skin R / 2)",
              "depth of the centre / R",
              "force / f_{c0}",
              {}};
  ForceMaterial material;
  material.skin_mm = 0.5 * kRadius;
  for (const double thickness : {2.0, 1.0, 0.5, 0.25, 0.1}) {
    Series series{ratio_name("thickness / R =", thickness), {}};
    const Distance sheet = [=](const Vec3& p) { return std::abs(p.z) - 0.5 * thickness * kRadius; };
    for (int step = -40; step <= 40; ++step) {
      const double depth = 0.05 * step;
      const auto felt = summed(sheet, ball_tool(kRadius, {0, 0, -depth * kRadius}), 20, material,
                               ForceLaw::energy);
      series.points.emplace_back(depth, felt.contact_n.z / material.surface_force_n);
    }
    panel.series.push_back(std::move(series));
  }
  return panel;
}

/// The node with its 26 neighbours, averaged as a coarser level averages them.
double full_weighting(const FieldWindowView& fine, int i, int j, int k) {
  assert(i > 0 && j > 0 && k > 0);
  assert(i < fine.nodes[0] - 1 && j < fine.nodes[1] - 1 && k < fine.nodes[2] - 1);
  double sum = 0.0;
  for (int m = 0; m < 27; ++m) {
    const int a = m / 9 - 1;
    const int b = m / 3 % 3 - 1;
    const int c = m % 3 - 1;
    // 1/8 at the node, and half as much for each step along an axis: 27 weights that sum to 1.
    const double weight = 0.125 / (1 << (std::abs(a) + std::abs(b) + std::abs(c)));
    sum += weight * static_cast<double>(fine.at(i + a, j + b, k + c));
  }
  return sum;
}

/// Every second node of a window, averaged.
FieldWindow averaged(const FieldWindow& fine) {
  FieldWindow coarse;
  coarse.view.voxel_mm = 2.0 * fine.view.voxel_mm;
  coarse.view.origin_mm = fine.view.origin_mm + fine.view.voxel_mm * Vec3{1.0, 1.0, 1.0};
  for (std::size_t a = 0; a < 3; ++a) coarse.view.nodes[a] = (fine.view.nodes[a] - 1) / 2;
  const auto& n = coarse.view.nodes;
  for (int i = 0; i < n[0]; ++i) {
    for (int j = 0; j < n[1]; ++j) {
      for (int k = 0; k < n[2]; ++k) {
        coarse.storage.push_back(
            static_cast<float>(full_weighting(fine.view, 2 * i + 1, 2 * j + 1, 2 * k + 1)));
      }
    }
  }
  coarse.view.distance_mm = coarse.storage;
  return coarse;
}

/// Median errors of both laws, reading every fourth node averaged, against reading every node.
std::pair<double, double> averaging_errors(const Distance& rough) {
  constexpr double kRadius = 16.0;
  ForceMaterial material;
  material.skin_mm = 16.0;
  std::vector<double> blanch;
  std::vector<double> energy;
  for (int n = 0; n < 5; ++n) {
    const ForceTool tool = ball_tool(kRadius, {0.7 * n, 1.3 * n, 4.0 * n - 8.0});
    const FieldWindow fine =
        analytic_window(rough, tool.position_mm, haptics::kKernelSupport * kRadius + 8.0, 1.0);
    const FieldWindow coarse = averaged(averaged(fine));
    for (const ForceLaw law : {ForceLaw::blanch, ForceLaw::energy}) {
      const Vec3 exact = haptics::volume_force(fine.view, tool, material, law).contact_n;
      const Vec3 felt = haptics::volume_force(coarse.view, tool, material, law).contact_n;
      (law == ForceLaw::blanch ? blanch : energy).push_back(length(felt - exact) / length(exact));
    }
  }
  std::sort(blanch.begin(), blanch.end());
  std::sort(energy.begin(), energy.end());
  return {blanch[blanch.size() / 2], energy[energy.size() / 2]};
}

Panel rough_matter() {
  constexpr double kWavelength = 8.0;
  Panel panel{"Laws on averaged rough matter (8 voxels wide)",
              "height of the bumps / voxel",
              "median error / %",
              {}};
  Series blanch{"unit gradients (blanch)", {}};
  Series energy{"energy", {}};
  for (const double amplitude : {0.25, 0.5, 1.0, 1.5, 2.0}) {
    const Distance rough = rough_box(200.0, 200.0, amplitude, kWavelength);
    const auto [of_blanch, of_energy] = averaging_errors(rough);
    blanch.points.emplace_back(amplitude, 100.0 * of_blanch);
    energy.points.emplace_back(amplitude, 100.0 * of_energy);
  }
  panel.series = {std::move(blanch), std::move(energy)};
  return panel;
}

/// The force along z of a ball whose border is sharp: every node inside counts alike.
double sharp_force(const FieldWindowView& view, const ForceTool& tool,
                   const ForceMaterial& material) {
  double sum = 0.0;
  int count = 0;
  for (int i = 0; i < view.nodes[0]; ++i) {
    for (int j = 0; j < view.nodes[1]; ++j) {
      for (int k = 0; k < view.nodes[2]; ++k) {
        const Vec3 node = view.origin_mm + view.voxel_mm * Vec3{1.0 * i, 1.0 * j, 1.0 * k};
        if (length(node - tool.position_mm) >= tool.radii_mm.x) continue;
        const double u = 1.0 - static_cast<double>(view.at(i, j, k)) / material.skin_mm;
        sum += std::min(std::pow(std::max(u, 0.0), material.exponent), material.clamp_ratio);
        ++count;
      }
    }
  }
  assert(count > 0);  // the window covers the ball
  return material.surface_force_n * sum / count;
}

Panel cogging() {
  Panel panel{"Sliding over flat clay, 8 nodes across", "path / voxel", "force / mean - 1, %", {}};
  ForceMaterial material;
  material.skin_mm = 4.0;
  const ForceTool tool = ball_tool(4.0, {0, 0, 3.2});
  const FieldWindow window = analytic_window(half_space(), tool.position_mm, 12.0, 1.0);
  const haptics::LatticeForce smooth(tool, material, ForceLaw::energy, 1.0);
  const auto slide = [&](const std::string& name,
                         const std::function<double(const ForceTool&)>& f) {
    Series series{name, {}};
    double mean = 0.0;
    constexpr int kSteps = 151;
    for (int step = 0; step < kSteps; ++step) {
      ForceTool there = tool;
      there.position_mm += (0.02 * step) * Vec3{0.8, 0.6, 0.0};
      series.points.emplace_back(0.02 * step, f(there));
      mean += series.points.back().second / kSteps;
    }
    for (auto& point : series.points) point.second = 100.0 * (point.second / mean - 1.0);
    return series;
  };
  panel.series.push_back(slide("sharp ball", [&](const ForceTool& there) {
    return sharp_force(window.view, there, material);
  }));
  panel.series.push_back(slide("smooth kernel", [&](const ForceTool& there) {
    return smooth.evaluate(window.view, there).contact_n.z;
  }));
  return panel;
}

/// Two unequal balls melted together: a field whose gradient is not 1 everywhere.
/// By I. Quilez's smooth minimum.
double melted_balls(const Vec3& p) {
  constexpr double kWidth = 6.0;
  const double a = length(p - Vec3{-8, 0, 0}) - 12.0;
  const double b = length(p - Vec3{11, 0, 0}) - 8.0;
  const double h = std::clamp(0.5 + 0.5 * (b - a) / kWidth, 0.0, 1.0);
  return b + (a - b) * h - kWidth * h * (1.0 - h);
}

/// The work gained on a rectangle, walked again and again.
Panel loop_work() {
  Panel panel{"Work gained on a closed path", "times round", "work / mJ", {}};
  const Vec3 corner{-6, 1, 1.3};
  const Vec3 corners[] = {corner, corner + Vec3{16, 0, 0}, corner + Vec3{16, 22, 0},
                          corner + Vec3{0, 22, 0}, corner};
  const ForceTool tool = ball_tool(4.0, {});
  const FieldWindow window = analytic_window(melted_balls, {2, 12, 1}, 24.0, 1.0);
  for (const ForceLaw law : {ForceLaw::blanch, ForceLaw::energy}) {
    Series series{law == ForceLaw::blanch ? "unit gradients (blanch)" : "energy", {{0.0, 0.0}}};
    const haptics::LatticeForce force(tool, {}, law, 1.0);
    double work = 0.0;
    constexpr int kRounds = 8;
    constexpr int kSteps = 60;
    for (int side = 0; side < 4 * kRounds; ++side) {
      const Vec3 from = corners[side % 4];
      const Vec3 step = (corners[side % 4 + 1] - from) / kSteps;
      for (int n = 0; n < kSteps; ++n) {
        ForceTool there = tool;
        // In the middle of the step: the midpoint rule, whose error would otherwise look like work.
        there.position_mm = from + (n + 0.5) * step;
        work += dot(force.evaluate(window.view, there).contact_n, step);
      }
      if (side % 4 == 3) series.points.emplace_back(side / 4 + 1, work);
    }
    panel.series.push_back(std::move(series));
  }
  return panel;
}

}  // namespace

std::vector<Panel> force_failures() {
  return {saturating_field(), thin_sheet(), rough_matter(), cogging(), loop_work()};
}

}  // namespace argil::evaluation
