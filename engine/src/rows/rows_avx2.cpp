// SPDX-License-Identifier: GPL-3.0-or-later
#define ARGIL_ROWS_SET avx2
#include "rows/rows_impl.h"
