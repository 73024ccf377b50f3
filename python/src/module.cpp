// SPDX-License-Identifier: GPL-3.0-or-later
// argil._native: what the package argil (python/argil) is made of. Nothing outside it calls this.
#include <string>

#include "binding.h"
#include "bridge.h"
#include "clay.h"
#include "errors.h"
#include "force.h"
#include "interpreter.h"
#include "lab.h"
#include "mesh.h"
#include "picture.h"
#include "work.h"

namespace {

/// Before 2.12 pybind11 reads arrays as NumPy 1 lays them out.
void check_numpy() {
  constexpr int kFirstForNumpy2 = 0x020C0000;
  if (PYBIND11_VERSION_HEX >= kFirstForNumpy2) return;
  namespace py = argil::python::py;
  const auto version = py::module_::import("numpy").attr("__version__").cast<std::string>();
  if (version.rfind("1.", 0) == 0) return;
  throw py::import_error("argil was built with pybind11 " + std::to_string(PYBIND11_VERSION_MAJOR) +
                         "." + std::to_string(PYBIND11_VERSION_MINOR) +
                         ", which knows NumPy 1, and this is NumPy " + version +
                         "; install numpy<2, or build argil with pybind11 2.12 or later");
}

/// Left to itself, pybind11 before 2.13 does so when the first array comes, behind a guard, and
/// lets the interpreter go meanwhile: another thread that brings one waits for the guard and keeps
/// the interpreter from whoever holds that.
void look_up_numpy() { argil::python::py::dtype::of<double>(); }

}  // namespace

PYBIND11_MODULE(_native, module) {
  check_numpy();
  look_up_numpy();
  module.attr("__version__") = ARGIL_VERSION;
  argil::python::add_errors(module);
  argil::python::add_end_of_work();
  argil::python::add_threads(module);
  argil::python::add_meshes(module);
  argil::python::add_clay(module);
  argil::python::add_forces(module);
  argil::python::add_pictures(module);
  argil::python::add_lab(module);
  argil::python::add_bridge(module);
}
