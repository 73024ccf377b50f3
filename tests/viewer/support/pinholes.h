// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/engine/render.h"

namespace argil::test {

/// How many gaps in the clay a picture of the window shows: patches of the background's grey, of
/// at most 64 pixels, with clay, which is brown, on all sides. A larger one is a hole that was
/// made. `left` and `right` are the first column that is looked at and the one after the last:
/// panels have both colours.
int pinholes(const Image& picture, int left, int right);

}  // namespace argil::test
