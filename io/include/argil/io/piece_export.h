// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/engine/sculpture.h"
#include "argil/io/assembly.h"
#include "argil/io/export.h"

namespace argil::io {

struct PieceExport {
  std::string name;
  ExportReport report;  ///< as if it were alone, in its own frame
};

/// Adds a piece to an assembly, by its name and where it stands: written as export_mesh does, to
/// `temporary`, measured and judged; what was read back becomes an object of its own.
///
/// Errors   as export_mesh and read_mesh: the assembly is as it was.
/// Threads  as Clay. Cost  of the export and of reading it back.
Result<ExportReport> add_piece(Assembly& assembly, const PieceLook& look, const Clay& clay,
                               const std::filesystem::path& temporary, const ExportOptions& options,
                               const Progress& progress = {});

/// All visible pieces as objects of one 3MF, by their names and colours; the file appears only when
/// all are written.
///
/// Errors   as add_piece and write_assembly; bad_input where none is visible.
/// Threads  as Sculpture. Cost  of the exports, one after the other.
Result<std::vector<PieceExport>> export_pieces(const std::filesystem::path& file,
                                               const Sculpture& sculpture,
                                               const ExportOptions& options,
                                               const Progress& progress = {});

}  // namespace argil::io
