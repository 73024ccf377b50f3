// SPDX-License-Identifier: GPL-3.0-or-later
#define ARGIL_LANES_SET baseline
#define ARGIL_LANES_REGISTER 16
#include "scene/sine_network_impl.h"
