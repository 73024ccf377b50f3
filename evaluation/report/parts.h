// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/progress.h"
#include "argil/core/result.h"

#include "report/figure.h"

namespace argil::evaluation {

// The parts of the report; all repeat to the bit. What runs for long reports its progress under
// "report", fractions of its own, and ends with `interrupted` when it is asked to.

/// Blanch et al. 2004, figure 2: cubes and surface of a small clay.
Result<ReportFigure> cubes_figure();
/// Its figure 4, and equations (3) to (5) and (6) to (12) over time.
ReportFigures force_figures();

/// The Falcon report, section 3.1 and figures 1 to 3.
Result<ReportFigures> mechanics_figures(const Progress& progress);
/// Its figures 4 to 11, and the click of section 3.7.2.
Result<ReportFigures> scene_figures(const Progress& progress);
/// Its sections 3.4.2 and 3.4.3: walls with fixed and with adaptive damping.
Result<ReportFigure> damping_figure(const Progress& progress);
/// Its sections 4.1 and 4.2: both couplings in the scenes of part 1; `quick`: with two hands of
/// four.
Result<ReportFigure> coupling_figure(bool quick, const Progress& progress);

/// One page with all of them: pictures that lie beside it, and where `has_pictures` is false none.
std::string report_page(const ReportFigures& figures, bool has_pictures);
/// "figure,number,unit,printed,ours".
std::string report_csv(const ReportFigures& figures);

}  // namespace argil::evaluation
