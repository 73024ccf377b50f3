// SPDX-License-Identifier: GPL-3.0-or-later
// argil._native: what the package argil (python/argil) is made of. Nothing outside it calls this.
#include <pybind11/pybind11.h>

#include "bridge.h"
#include "clay.h"
#include "errors.h"
#include "force.h"
#include "lab.h"
#include "mesh.h"
#include "picture.h"
#include "work.h"

PYBIND11_MODULE(_native, module) {
  module.attr("__version__") = ARGIL_VERSION;
  argil::python::add_errors(module);
  argil::python::add_threads(module);
  argil::python::add_meshes(module);
  argil::python::add_clay(module);
  argil::python::add_forces(module);
  argil::python::add_pictures(module);
  argil::python::add_lab(module);
  argil::python::add_bridge(module);
}
