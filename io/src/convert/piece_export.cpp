// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/piece_export.h"

#include <utility>

#include "argil/io/mesh_file.h"
#include "argil/io/safe_file.h"

namespace argil::io {
namespace {

Affine affine_of_placement(const Placement& placement) {
  const Quat& q = placement.orientation;
  return {{rotate(q, {1.0, 0.0, 0.0}), rotate(q, {0.0, 1.0, 0.0}), rotate(q, {0.0, 0.0, 1.0}),
           placement.position_mm}};
}

}  // namespace

Result<ExportReport> add_piece(Assembly& assembly, const PieceLook& look, const Clay& clay,
                               const std::filesystem::path& temporary, const ExportOptions& options,
                               const Progress& progress) {
  auto report = export_mesh(temporary, clay, options, progress);
  if (!report) return report;
  auto mesh = read_mesh(temporary);
  if (!mesh) return mesh.error();
  assembly.items.push_back({"", {{assembly.objects.size(), affine_of_placement(look.placement)}}});
  assembly.objects.push_back({look.name, look.color, std::move(mesh).value()});
  return report;
}

Result<std::vector<PieceExport>> export_pieces(const std::filesystem::path& file,
                                               const Sculpture& sculpture,
                                               const ExportOptions& options,
                                               const Progress& progress) {
  std::vector<PieceExport> exported;
  Assembly assembly;
  const auto write_all = [&](const std::filesystem::path& temporary) -> Result<void> {
    for (std::size_t n = 0; n < sculpture.piece_count(); ++n) {
      const PieceLook& look = sculpture.look(n);
      if (!look.is_visible) continue;
      auto report = add_piece(assembly, look, sculpture.clay(n), temporary, options, progress);
      if (!report) {
        return Error{report.error().kind, "'" + look.name + "': " + report.error().message};
      }
      exported.push_back({look.name, std::move(report).value()});
    }
    if (!exported.empty()) return write_assembly(temporary, assembly, progress);
    return Error{ErrorKind::bad_input, "no piece is visible; show one first"};
  };
  if (auto written = replace_file(file, write_all); !written) return written.error();
  return exported;
}

}  // namespace argil::io
