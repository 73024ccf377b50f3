// SPDX-License-Identifier: GPL-3.0-or-later
#include "rows/rows.h"

#include "argil/core/simd.h"

namespace argil {

const RowLoops& row_loops() noexcept {
#if defined(__x86_64__)
  if (best_simd() != Simd::baseline) return avx2::kRowLoops;
#endif
  return baseline::kRowLoops;
}

}  // namespace argil
