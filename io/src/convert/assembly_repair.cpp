// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/assembly_repair.h"

#include <string>
#include <utility>

#include "argil/core/no_throw.h"

namespace argil::io {
namespace {

/// The share of the whole that one of the objects is.
Progress share_of(const Progress& whole, double first, double count, double all) {
  if (!whole) return {};
  return [&whole, first, count, all](std::string_view stage, double fraction) {
    return whole(stage, (first + fraction * count) / all);
  };
}

Error in_part(const std::string& name, Error error) {
  if (!name.empty() && error.kind != ErrorKind::interrupted) {
    error.message = "'" + name + "': " + error.message;
  }
  return error;
}

}  // namespace

Result<RepairedAssembly> repair_assembly(Assembly assembly, const RepairOptions& options,
                                         const Progress& progress) {
  return no_throw("repairing parts", [&]() -> Result<RepairedAssembly> {
    RepairedAssembly made{with_true_sizes(std::move(assembly)), {}};
    double all = 0.0;
    for (const AssemblyObject& object : made.assembly.objects) {
      all += static_cast<double>(object.mesh.triangles.size());
    }
    double first = 0.0;
    for (AssemblyObject& object : made.assembly.objects) {
      const auto count = static_cast<double>(object.mesh.triangles.size());
      auto repaired = repair_mesh(object.mesh, options, share_of(progress, first, count, all));
      if (!repaired) return in_part(object.name, repaired.error());
      object.mesh = std::move(repaired.value().mesh);
      made.reports.push_back(std::move(repaired.value().report));
      first += count;
    }
    return made;
  });
}

}  // namespace argil::io
