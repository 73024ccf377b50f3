// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/piece_export.h"

#include <cstddef>
#include <string_view>
#include <utility>

#include "argil/io/mesh_file.h"
#include "argil/io/safe_file.h"

#include "mesh_format/mesh_write.h"

namespace argil::io {
namespace {

constexpr double kPiecesShare = 0.95;  // of the work: the rest is the file of all

/// Of work that tells its own way from 0 to 1.
Progress part_of(const Progress& whole, double begin, double end) {
  if (!whole) return {};
  return [&whole, begin, end](std::string_view stage, double fraction) {
    return whole(stage, begin + fraction * (end - begin));
  };
}

std::vector<std::size_t> visible_pieces(const Sculpture& sculpture) {
  std::vector<std::size_t> visible;
  for (std::size_t n = 0; n < sculpture.piece_count(); ++n) {
    if (sculpture.look(n).is_visible) visible.push_back(n);
  }
  return visible;
}

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
  // Before any work, and by the name that was asked for.
  if (auto holds = check_holds_parts(file); !holds) return holds.error();
  const std::vector<std::size_t> visible = visible_pieces(sculpture);
  if (visible.empty()) return Error{ErrorKind::bad_input, "no piece is visible; show one first"};
  std::vector<PieceExport> exported;
  Assembly assembly;
  const auto share = [&](std::size_t done) {
    return kPiecesShare * static_cast<double>(done) / static_cast<double>(visible.size());
  };
  const auto write_all = [&](const std::filesystem::path& temporary) -> Result<void> {
    for (const std::size_t n : visible) {
      const PieceLook& look = sculpture.look(n);
      const double begin = share(exported.size());
      auto report = add_piece(assembly, look, sculpture.clay(n), temporary, options,
                              part_of(progress, begin, share(exported.size() + 1)));
      if (!report) {
        return Error{report.error().kind, "'" + look.name + "': " + report.error().message};
      }
      exported.push_back({look.name, std::move(report).value()});
    }
    return write_assembly(temporary, assembly, part_of(progress, kPiecesShare, 1.0));
  };
  if (auto written = replace_file(file, write_all); !written) return written.error();
  return exported;
}

}  // namespace argil::io
