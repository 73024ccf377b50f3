// SPDX-License-Identifier: GPL-3.0-or-later
// Included once by each rows_SET.cpp, which defines ARGIL_ROWS_SET, the namespace. No standard
// header may be included: see rows.h. The loops over k have no branches, so that the compiler turns
// each into vectors of the set (-O3 -fno-math-errno -fno-trapping-math, engine/CMakeLists.txt).
#include "rows/rows.h"

namespace argil::ARGIL_ROWS_SET {
namespace {

#define ARGIL_ROWS static inline __attribute__((always_inline))

ARGIL_ROWS float lesser(float a, float b) { return a < b ? a : b; }
ARGIL_ROWS float greater(float a, float b) { return a < b ? b : a; }
ARGIL_ROWS float magnitude(float a) { return a < 0.0F ? -a : a; }

/// From a node of a HaloBlock to the next along each axis.
constexpr int kStride[3] = {HaloBlock::kSide * HaloBlock::kRow, HaloBlock::kRow, 1};

#include "rows/ball_impl.h"
#include "rows/bounds_impl.h"
#include "rows/contour_impl.h"
#include "rows/displace_impl.h"
#include "rows/layer_impl.h"
#include "rows/move_impl.h"
#include "rows/profile_impl.h"
#include "rows/project_impl.h"
#include "rows/ray_impl.h"
#include "rows/resample_impl.h"
#include "rows/restrict_impl.h"
#include "rows/sweep_impl.h"
#include "rows/upwind_impl.h"

// After those whose functions they use.
#include "rows/deepen_impl.h"
#include "rows/join_impl.h"
#include "rows/triangle_impl.h"

}  // namespace

extern const RowLoops kRowLoops;
const RowLoops kRowLoops{seed,
                         sweep,
                         deepen,
                         lower_to_triangles,
                         lower_cube,
                         choose_balls,
                         sign_distances,
                         find_out_of_bounds,
                         ball_distances,
                         restrict_leaf,
                         place_cuts,
                         choose_diagonals,
                         find_feet,
                         pull,
                         draw_to_plane,
                         displace,
                         read,
                         read_cubic,
                         add_pinch,
                         add_drag,
                         lay_profile,
                         curve_along,
                         project_to_layers,
                         measure_clusters,
                         lower_to_layer,
                         enter_boxes,
                         meet_triangles,
                         find_upwind,
                         join_told};

}  // namespace argil::ARGIL_ROWS_SET
