// SPDX-License-Identifier: GPL-3.0-or-later
// The force of a tool on a window of the clay, by the array.
#include "force.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "argil/engine/window.h"
#include "argil/haptics/force/lattice_force.h"
#include "argil/haptics/force/tool_force.h"

#include "arrays.h"
#include "choice.h"
#include "clay.h"
#include "common/felt_window.h"
#include "convert.h"
#include "pieces.h"

namespace argil::python {
namespace {

using cli::FeltMethod;
using haptics::ForceResult;
using haptics::ForceTool;

/// What is felt, with what, and how it is summed.
struct ForceSetup {
  ForceTool tool;
  haptics::ForceMaterial material;
  haptics::ForceLaw law = haptics::ForceLaw::energy;
  FeltMethod method = FeltMethod::lod;
};

/// A window with what sums the force on it; never changes.
class ForceWindow {
 public:
  ForceWindow(const ForceSetup& setup, FieldWindow window)
      : setup_(setup),
        window_(std::move(window)),
        sum_(setup.tool, setup.material, setup.law, window_.view.voxel_mm) {}

  const FieldWindowView& view() const noexcept { return window_.view; }
  bool is_exact() const noexcept { return setup_.method == FeltMethod::fine; }

  /// `pose`: position, orientation and velocities; shape and radii are the window's.
  ForceResult at(ForceTool pose) const noexcept {
    pose.shape = setup_.tool.shape;
    pose.radii_mm = setup_.tool.radii_mm;
    switch (setup_.method) {
      case FeltMethod::point:
        return haptics::point_force(window_.view, pose, setup_.material);
      case FeltMethod::fine:
        return haptics::volume_force(window_.view, pose, setup_.material, setup_.law);
      case FeltMethod::lod:
        break;
    }
    return sum_.evaluate(window_.view, pose);
  }

 private:
  ForceSetup setup_;
  FieldWindow window_;
  haptics::LatticeForce sum_;
};

/// Names, ranges and usual values are those of ForceMaterial.
haptics::ForceMaterial material_of(const py::dict& numbers) {
  haptics::ForceMaterial material;
  struct Number {
    const char* name;
    double* value;
    double least;
    double most;
  };
  const std::array known{Number{"surface_force_n", &material.surface_force_n, 0.0, 8.0},
                         Number{"exponent", &material.exponent, 1.0, 8.0},
                         Number{"skin_mm", &material.skin_mm, 1e-6, kMaxReachMm},
                         Number{"clamp_ratio", &material.clamp_ratio, 1.0 + 1e-9, 1e6},
                         Number{"viscosity_force_n", &material.viscosity_force_n, 0.0, 8.0},
                         Number{"viscosity_s_per_mm", &material.viscosity_s_per_mm, 0.0, 1e6}};
  for (const auto& [key, value] : numbers) {
    const auto name = key.cast<std::string>();
    const auto* found = std::find_if(known.begin(), known.end(),
                                     [&](const Number& number) { return name == number.name; });
    if (found == known.end()) raise_bad_input("material has no '" + name + "'");
    *found->value = in_range(name, number_of(name, value), found->least, found->most);
  }
  return material;
}

std::shared_ptr<ForceWindow> make_window(SharedClay& clay, py::handle center_mm,
                                         const std::string& shape, py::handle radii_mm,
                                         double margin_mm, const py::dict& material,
                                         const std::string& law, const std::string& method) {
  ForceSetup setup;
  setup.tool.position_mm = vec3_of("center_mm", center_mm);
  setup.tool.radii_mm = vec3_of("radii_mm", radii_mm);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (setup.tool.radii_mm[axis] > 0.0 && setup.tool.radii_mm[axis] <= kMaxReachMm) continue;
    raise_bad_input("radii_mm is " + std::to_string(setup.tool.radii_mm[axis]) +
                    "; must be above 0");
  }
  in_range("margin_mm", margin_mm, 0.0, kMaxReachMm);
  if (!is_in_reach(setup.tool.position_mm)) raise_bad_input("center_mm is out of reach");
  using haptics::ToolShape;
  setup.tool.shape = choice_of<ToolShape>("shape", shape,
                                          {{"ball", ToolShape::ellipsoid},
                                           {"ellipsoid", ToolShape::ellipsoid},
                                           {"box", ToolShape::box},
                                           {"capsule", ToolShape::capsule}});
  if (shape == "capsule" && (setup.tool.radii_mm.x != setup.tool.radii_mm.y ||
                             setup.tool.radii_mm.z < setup.tool.radii_mm.x)) {
    raise_bad_input("radii_mm of a capsule are (r, r, half its length, at least r)");
  }
  setup.material = material_of(material);
  setup.law = choice_of<haptics::ForceLaw>(
      "law", law, {{"energy", haptics::ForceLaw::energy}, {"blanch", haptics::ForceLaw::blanch}});
  setup.method = choice_of<FeltMethod>(
      "method", method,
      {{"lod", FeltMethod::lod}, {"fine", FeltMethod::fine}, {"point", FeltMethod::point}});
  FieldWindow window = clay.run([&](const Clay& source, const Progress&) {
    return cli::felt_window(source, setup.tool, setup.material, setup.method, margin_mm,
                            {"the tool", "method='fine'"});
  });
  return std::make_shared<ForceWindow>(setup, std::move(window));
}

/// Row `n` of poses (x, y, z, and where there are seven columns qw, qx, qy, qz) and velocities.
ForceTool pose_of(const Rows& poses, const std::optional<Rows>& velocities, std::size_t n) {
  const auto columns = static_cast<std::size_t>(poses.shape(1));
  const double* row = poses.data() + n * columns;
  ForceTool pose;
  pose.position_mm = {row[0], row[1], row[2]};
  if (columns == 7) pose.orientation = normalized(Quat{row[3], row[4], row[5], row[6]});
  if (!velocities) return pose;
  const auto moving = static_cast<std::size_t>(velocities->shape(1));
  const double* fast = velocities->data() + n * moving;
  pose.velocity_mm_per_s = {fast[0], fast[1], fast[2]};
  if (moving == 6) pose.angular_velocity_rad_per_s = {fast[3], fast[4], fast[5]};
  return pose;
}

void check_rows(const char* name, const Rows& rows, py::ssize_t few, py::ssize_t many) {
  if (rows.ndim() != 2 || (rows.shape(1) != few && rows.shape(1) != many)) {
    raise_bad_input(std::string(name) + " has the shape " + shape_text(rows) + "; give (n, " +
                    std::to_string(few) + ") or (n, " + std::to_string(many) + ")");
  }
  const double* number = rows.data();
  for (py::ssize_t n = 0; n < rows.size(); ++n) {
    if (!std::isfinite(number[n])) {
      raise_bad_input(std::string(name) + "[" + std::to_string(n / rows.shape(1)) +
                      "] is not finite; take such rows out");
    }
  }
}

/// Contact and drag together, as the hand feels them; then each figure of its own.
py::dict force(const ForceWindow& self, const Rows& poses, const std::optional<Rows>& velocities) {
  check_rows("poses", poses, 3, 7);
  if (velocities) {
    check_rows("velocities", *velocities, 3, 6);
    if (velocities->shape(0) != poses.shape(0)) {
      raise_bad_input("there are " + std::to_string(poses.shape(0)) + " poses and " +
                      std::to_string(velocities->shape(0)) + " velocities; give as many of both");
    }
  }
  const auto count = static_cast<std::size_t>(poses.shape(0));
  const auto [forces, force_n] = new_points(count);
  const auto [torques, torque_nmm] = new_points(count);
  const auto [energies, energy_nmm] = new_numbers<double>(count);
  const auto [errors, error_n] = new_numbers<double>(count);
  const auto [samples, sample_rows] = new_numbers<std::int32_t>(count);
  const auto [outside, outside_rows] = new_numbers<bool>(count);
  run([&, f = force_n, t = torque_nmm, e = energy_nmm, d = error_n, s = sample_rows,
       o = outside_rows](const Progress& progress) {
    // One of the exact sum may take a thousand times what one of `lod` takes.
    const std::size_t chunk = self.is_exact() ? 1 : 64;
    return in_pieces("force", count, chunk, progress, [&](std::size_t begin, std::size_t end) {
      for (std::size_t n = begin; n < end; ++n) {
        const ForceResult result = self.at(pose_of(poses, velocities, n));
        f[n] = result.contact_n + result.viscosity_n;
        t[n] = result.contact_nmm + result.viscosity_nmm;
        e[n] = result.energy_nmm;
        d[n] = result.error_n;
        s[n] = result.samples;
        o[n] = result.outside_window;
      }
    });
  });
  py::dict dict;
  dict["force_n"] = forces;
  dict["torque_nmm"] = torques;
  dict["energy_nmm"] = energies;
  dict["error_n"] = errors;
  dict["samples"] = samples;
  dict["outside"] = outside;
  return dict;
}

}  // namespace

void add_forces(py::module_& module) {
  py::class_<ForceWindow, std::shared_ptr<ForceWindow>>(module, "ForceWindow")
      .def(py::init(&make_window), py::arg("clay"), py::arg("center_mm"), py::arg("shape"),
           py::arg("radii_mm"), py::arg("margin_mm"), py::arg("material"), py::arg("law"),
           py::arg("method"))
      .def("force", &force, py::arg("poses"), py::arg("velocities"))
      .def("distance_mm",
           [](const py::object& self) {
             const FieldWindowView& view = self.cast<const ForceWindow&>().view();
             return view_of(view.distance_mm.data(), {view.nodes[0], view.nodes[1], view.nodes[2]},
                            self);
           })
      .def("origin_mm", [](const ForceWindow& self) { return tuple_of(self.view().origin_mm); })
      .def("voxel_mm", [](const ForceWindow& self) { return self.view().voxel_mm; })
      .def("level", [](const ForceWindow& self) { return self.view().level; });
}

}  // namespace argil::python
