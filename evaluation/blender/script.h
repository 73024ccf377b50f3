// SPDX-License-Identifier: GPL-3.0-or-later
// The scripts that Blender runs, which the program carries with it.
#pragma once

namespace argil::evaluation {

/// blender/mesh.py, blender/brush.py and edits/blender_strokes.py.
const char* strokes_script();

/// blender/mesh.py, blender/brush.py and gallery/blender_gallery.py.
const char* gallery_script();

/// blender/mesh.py and blender/made_mesh.py.
const char* made_mesh_script();

}  // namespace argil::evaluation
