// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include <tbb/enumerable_thread_specific.h>

#include "argil/core/distance_probe.h"
#include "argil/mesh/decimate.h"

namespace argil::mesh {

/// One probe of the field for each thread that asks, kept with what it has looked up.
class ThreadProbes {
 public:
  /// `target` must outlive this, and the field stay as it is.
  explicit ThreadProbes(const DecimationTarget& target)
      : probes_([&target] { return target.probe(); }) {}

  DistanceProbe& mine() { return *probes_.local(); }

 private:
  tbb::enumerable_thread_specific<std::unique_ptr<DistanceProbe>> probes_;
};

}  // namespace argil::mesh
