// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <utility>

#include "argil/engine/clay.h"
#include "argil/engine/display_surface.h"
#include "argil/engine/surface_picker.h"

#include "binding.h"
#include "work.h"

namespace argil::python {

/// A clay of Python's, which any thread may use, one at a time; with what picks on it.
class SharedClay {
 public:
  explicit SharedClay(Clay clay) : clay_(std::move(clay)) {}

  /// Runs `work(clay, progress)`, which returns a Result, without the interpreter while nobody else
  /// has the clay.
  template <class Work>
  auto run(Work&& work) {
    const WorkLock::Held held = lock_.hold();
    return python::run([&](const Progress& progress) { return work(clay_, progress); });
  }
  /// Runs `look(clay)`, which cannot fail and is over in a moment.
  template <class Look>
  auto look(Look&& look) {
    const WorkLock::Held held = lock_.hold();
    const Clay& clay = clay_;
    return look(clay);
  }
  /// Runs `pick(surface, picker)` with both brought up to date, as run.
  template <class Work>
  auto pick(Work&& work) {
    return run([&](const Clay& clay, const Progress& progress) {
      auto ready = update_picker(clay);
      return ready ? work(surface_, picker_, progress)
                   : decltype(work(surface_, picker_, progress))(ready.error());
    });
  }

 private:
  Result<void> update_picker(const Clay& clay);

  WorkLock lock_;
  Clay clay_;
  DisplaySurface surface_;
  SurfacePicker picker_;
};

void add_clay(py::module_& module);
/// Questions to the field and the surface: distances, slopes, rays.
void add_queries(py::class_<SharedClay, std::shared_ptr<SharedClay>>& clay);

}  // namespace argil::python
