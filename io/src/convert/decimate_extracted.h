// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/mesh/decimate.h"

#include "compare/extracted_surface.h"

namespace argil::io {

/// decimate() of a surface that is measured afterwards, so that its cells are found only once.
Result<mesh::Decimated> decimate_extracted(ExtractedSurface& surface,
                                           const mesh::DecimateOptions& options,
                                           const Progress& progress);

}  // namespace argil::io
