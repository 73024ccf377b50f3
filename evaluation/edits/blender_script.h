// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace argil::evaluation {

/// The text of blender_strokes.py, which the program carries with it.
const char* blender_script();

}  // namespace argil::evaluation
