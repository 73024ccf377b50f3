// SPDX-License-Identifier: GPL-3.0-or-later
// The table of commands: a row for each, from which the enumeration, menus, help, search, files of
// keys and docs/keys.md take theirs. To be included wherever ARGIL_COMMAND(name, menu, title, key,
// blender, zbrush) is defined, as often as needed; each time it undefines it.
//
//   name     in files of keys; a row that is renamed makes the keys of older files unknown
//   menu     that lists it; within a menu the order here is the menu's
//   title    as menus and search have it
//   key      "Ctrl+Z", in Argil's own set; "" none
//   blender  in the set for who comes from Blender: the keys of its sculpt mode (3.4), and of its
//            add-on Bool Tool, for what both have; Argil's own for the rest, moved where they would
//            mean something there
//   zbrush   likewise of ZBrush (2024)
//
// Within a set no key is there twice, those of tools (key_map.cpp) included.
#ifndef ARGIL_COMMAND
#define ARGIL_COMMAND(name, menu, title, key, blender, zbrush)
#endif

ARGIL_COMMAND(new_clay, "File", "New...", "Ctrl+N", "Ctrl+N", "Ctrl+N")
ARGIL_COMMAND(open, "File", "Open...", "Ctrl+O", "Ctrl+O", "Ctrl+O")
ARGIL_COMMAND(recent, "File", "Recent files...", "Ctrl+Shift+O", "Ctrl+Shift+O", "Ctrl+Shift+O")
ARGIL_COMMAND(import_mesh, "File", "Import mesh...", "Ctrl+I", "Ctrl+Shift+I", "Ctrl+Shift+I")
ARGIL_COMMAND(save, "File", "Save", "Ctrl+S", "Ctrl+S", "Ctrl+S")
ARGIL_COMMAND(save_as, "File", "Save as...", "Ctrl+Shift+S", "Ctrl+Shift+S", "Ctrl+Shift+S")
ARGIL_COMMAND(export_mesh, "File", "Export for printing...", "Ctrl+E", "Ctrl+E", "Ctrl+E")
ARGIL_COMMAND(screenshot, "File", "Screenshot", "F12", "F12", "F12")
ARGIL_COMMAND(turntable, "File", "Turntable", "Shift+F12", "Ctrl+F12", "Shift+F12")
ARGIL_COMMAND(still, "File", "Still picture...", "", "", "")
ARGIL_COMMAND(quit, "File", "Quit", "Ctrl+Q", "Ctrl+Q", "Ctrl+Q")
ARGIL_COMMAND(undo, "Edit", "Undo", "Ctrl+Z", "Ctrl+Z", "Ctrl+Z")
ARGIL_COMMAND(redo, "Edit", "Redo", "Ctrl+Shift+Z", "Ctrl+Shift+Z", "Ctrl+Shift+Z")
ARGIL_COMMAND(history, "Edit", "History", "Ctrl+H", "Ctrl+Alt+Z", "Ctrl+H")
ARGIL_COMMAND(operations, "Edit", "Whole clay...", "Ctrl+W", "Ctrl+R", "Ctrl+W")
ARGIL_COMMAND(pieces, "Piece", "Pieces", "Ctrl+P", "Ctrl+P", "N")
ARGIL_COMMAND(piece_switch, "Piece", "Sculpt the one here", "Alt+Q", "Alt+Q", "Alt+Q")
ARGIL_COMMAND(piece_gizmo, "Piece", "Move, turn and scale", "Shift+G", "Ctrl+`", "W")
ARGIL_COMMAND(piece_ball, "Piece", "Add a ball", "Shift+A", "Shift+A", "Ctrl+Alt+A")
ARGIL_COMMAND(piece_import, "Piece", "Add a mesh...", "Ctrl+Alt+I", "Ctrl+Alt+I", "Ctrl+Alt+I")
ARGIL_COMMAND(piece_duplicate, "Piece", "Duplicate", "Shift+D", "Shift+D", "Ctrl+Shift+D")
ARGIL_COMMAND(piece_remove, "Piece", "Remove", "Delete", "Delete", "Delete")
ARGIL_COMMAND(piece_split, "Piece", "Split by parts", "", "", "")
ARGIL_COMMAND(piece_bed, "Piece", "Drop to bed", "End", "End", "End")
ARGIL_COMMAND(piece_bed_all, "Piece", "Drop all to bed", "Shift+End", "Shift+End", "Shift+End")
ARGIL_COMMAND(piece_flat, "Piece", "Lay flat", "Alt+End", "Alt+End", "Alt+End")
ARGIL_COMMAND(piece_middle, "Piece", "Centre", "Ctrl+End", "Ctrl+End", "Ctrl+End")
ARGIL_COMMAND(piece_unite, "Piece", "Merge", "Ctrl+J", "Ctrl+NumPlus", "Ctrl+J")
ARGIL_COMMAND(piece_subtract, "Piece", "Subtract", "Ctrl+Shift+J", "Ctrl+NumMinus", "Ctrl+Shift+J")
ARGIL_COMMAND(piece_intersect, "Piece", "Intersect", "Ctrl+Alt+J", "Ctrl+NumTimes", "Ctrl+Alt+J")
ARGIL_COMMAND(mask_invert, "Mask", "Invert", "Ctrl+Shift+I", "Ctrl+I", "Ctrl+I")
ARGIL_COMMAND(mask_clear, "Mask", "Clear", "Alt+M", "Alt+M", "Ctrl+Shift+A")
ARGIL_COMMAND(mask_blur, "Mask", "Blur", "Alt+B", "Alt+B", "Alt+B")
ARGIL_COMMAND(mask_sharpen, "Mask", "Sharpen", "Alt+S", "Alt+S", "Alt+S")
ARGIL_COMMAND(mask_grow, "Mask", "Grow", "Alt+G", "Alt+G", "Alt+G")
ARGIL_COMMAND(mask_shrink, "Mask", "Shrink", "Shift+Alt+G", "Shift+Alt+G", "Shift+Alt+G")
ARGIL_COMMAND(mask_cavity, "Mask", "By cavity", "Alt+C", "Alt+C", "Alt+C")
ARGIL_COMMAND(mask_fill, "Mask", "Fill", "Alt+F", "Alt+F", "Ctrl+A")
ARGIL_COMMAND(symmetry_x, "Brush", "Symmetry X", "X", "Alt+X", "X")
ARGIL_COMMAND(symmetry_y, "Brush", "Symmetry Y", "Y", "Alt+Y", "Alt+Y")
ARGIL_COMMAND(symmetry_z, "Brush", "Symmetry Z", "Shift+X", "Alt+Z", "Shift+X")
ARGIL_COMMAND(brush_size, "Brush", "Size by mouse", "F", "F", "S")
ARGIL_COMMAND(brush_strength, "Brush", "Strength by mouse", "Shift+F", "Shift+F", "U")
ARGIL_COMMAND(presets, "Brush", "Presets", "Shift+B", "Shift+B", "Shift+B")
ARGIL_COMMAND(favourites, "Brush", "Favourites at the pointer", "`", "Q", "`")
ARGIL_COMMAND(favourite_list, "Brush", "Change favourites", "", "", "")
ARGIL_COMMAND(brush_smaller, "Brush", "Smaller", "[", "[", "[")
ARGIL_COMMAND(brush_larger, "Brush", "Larger", "]", "]", "]")
ARGIL_COMMAND(brush_weaker, "Brush", "Weaker", "Shift+[", "Shift+[", "Shift+[")
ARGIL_COMMAND(brush_stronger, "Brush", "Stronger", "Shift+]", "Shift+]", "Shift+]")
ARGIL_COMMAND(view_front, "View", "Front", "Num1", "Num1", "Num1")
ARGIL_COMMAND(view_back, "View", "Back", "Ctrl+Num1", "Ctrl+Num1", "Ctrl+Num1")
ARGIL_COMMAND(view_right, "View", "Right", "Num3", "Num3", "Num3")
ARGIL_COMMAND(view_left, "View", "Left", "Ctrl+Num3", "Ctrl+Num3", "Ctrl+Num3")
ARGIL_COMMAND(view_top, "View", "Top", "Num7", "Num7", "Num7")
ARGIL_COMMAND(view_bottom, "View", "Bottom", "Ctrl+Num7", "Ctrl+Num7", "Ctrl+Num7")
ARGIL_COMMAND(view_parallel, "View", "Perspective or parallel", "Num5", "Num5", "P")
ARGIL_COMMAND(view_frame, "View", "All of it", "Home", "Home", "F")
ARGIL_COMMAND(shading_next, "View", "Next shading", "Z", "Z", "Z")
ARGIL_COMMAND(wires, "View", "Wireframe", "W", "Shift+Z", "Shift+F")
ARGIL_COMMAND(slice, "View", "Slice", "Shift+W", "Shift+W", "Shift+W")
ARGIL_COMMAND(stereo, "View", "Stereo", "Shift+Z", "Alt+W", "Shift+Z")
ARGIL_COMMAND(panels, "View", "Panels", "Tab", "T", "Tab")
ARGIL_COMMAND(references, "View", "Reference images", "", "", "")
ARGIL_COMMAND(theme, "View", "Dark or light", "", "", "")
ARGIL_COMMAND(figures, "View", "Clay's figures", "", "", "")
ARGIL_COMMAND(print, "View", "Print", "", "", "")
ARGIL_COMMAND(measure_distance, "Measure", "Distance", "Shift+U", "Shift+U", "Shift+U")
ARGIL_COMMAND(measure_angle, "Measure", "Angle", "Ctrl+U", "Ctrl+U", "Ctrl+U")
ARGIL_COMMAND(measure_thickness, "Measure", "Thickness", "Alt+U", "Alt+U", "Alt+U")
ARGIL_COMMAND(measure_list, "Measure", "List of measurements", "Ctrl+Alt+U", "Ctrl+Alt+U",
              "Ctrl+Alt+U")
ARGIL_COMMAND(measure_clear, "Measure", "Clear all", "", "", "")
ARGIL_COMMAND(search, "Help", "Search commands", "Ctrl+K", "F3", "B")
ARGIL_COMMAND(help, "Help", "Keys", "F1", "F1", "F1")
ARGIL_COMMAND(keys, "Help", "Change keys", "Shift+F1", "Shift+F1", "Shift+F1")
ARGIL_COMMAND(messages, "Help", "Messages", "Ctrl+M", "Ctrl+M", "Ctrl+M")
ARGIL_COMMAND(emergency_stop, "Device", "Stop the force", "Space", "Space", "Space")
ARGIL_COMMAND(give_force, "Device", "Give the force again", "Ctrl+Shift+G", "Ctrl+Shift+G",
              "Ctrl+Shift+G")
ARGIL_COMMAND(device, "Device", "Device panel", "", "", "")

#undef ARGIL_COMMAND
