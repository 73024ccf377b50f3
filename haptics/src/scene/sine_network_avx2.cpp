// SPDX-License-Identifier: GPL-3.0-or-later
#define ARGIL_LANES_SET avx2
#define ARGIL_LANES_REGISTER 32
#include "scene/sine_network_impl.h"
