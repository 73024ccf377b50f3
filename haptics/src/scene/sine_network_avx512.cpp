// SPDX-License-Identifier: GPL-3.0-or-later
#define ARGIL_LANES_SET avx512
#define ARGIL_LANES_REGISTER 64
#include "scene/sine_network_impl.h"
