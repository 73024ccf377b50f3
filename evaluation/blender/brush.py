# SPDX-License-Identifier: GPL-3.0-or-later
"""What scripts that use Blender's sculpting brushes share: the program puts this before each of them,
after mesh.py.

The brush operator wants a window with a 3D view, so they run in one (under Xvfb), from a timer that
fires when the window is there. All of it happens within one call of that timer, and Blender draws
only between calls.
"""
import json
import os
import sys

from bpy_extras.view3d_utils import location_3d_to_region_2d
from mathutils import Vector


def view_3d():
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    region = next(region for region in area.regions if region.type == "WINDOW")
    return window, area, region


def used_brush(name, radius_mm, strength):
    """Chosen for the next stroke, and returned for what else is to be set."""
    settings = bpy.context.tool_settings
    settings.unified_paint_settings.use_unified_size = False
    settings.unified_paint_settings.use_unified_strength = False
    brush = bpy.data.brushes[name]
    settings.sculpt.brush = brush
    brush.use_locked_size = "SCENE"  # a radius in units of the scene, not in pixels
    brush.unprojected_radius = radius_mm
    brush.strength = strength
    brush.use_pressure_strength = False
    brush.use_space_attenuation = False  # strength counts for each dab
    return brush


def stroke_through(points, toward, radius_mm, region, view):
    """One element of the operator's stroke makes one dab, seen from the direction `toward`.

    Where a dab is comes from `location`; brushes that drag go by the mouse, whose way through the
    view is that of the points. The first mouse position must be over the mesh.
    """
    points = [Vector(point) for point in points]
    view.view_perspective = "ORTHO"
    view.view_location = points[0]
    view.view_rotation = toward.normalized().to_track_quat("Z", "Y")
    view.view_distance = 8.0 * radius_mm
    view.update()
    stroke = []
    for i, point in enumerate(points):
        mouse = tuple(location_3d_to_region_2d(region, view, point))
        stroke.append({
            "name": "", "location": tuple(point), "mouse": mouse, "mouse_event": mouse,
            "pressure": 1.0, "size": 50.0, "pen_flip": False, "time": 0.01 * i,
            "is_start": i == 0, "x_tilt": 0.0, "y_tilt": 0.0})
    return stroke


def positions_of_active():
    """Of a mesh in plain sculpt mode, or in object mode."""
    vertices = bpy.context.active_object.data.vertices
    positions = array.array("f", [0.0]) * (3 * len(vertices))
    vertices.foreach_get("co", positions)
    return positions


def add_line(job, line):
    with open(job["answers"], "a", encoding="utf-8") as file:
        file.write(json.dumps(line) + "\n")


def run_in_window(run_job):
    """Runs the job of the command line and ends Blender."""

    def run_and_end():
        with open(sys.argv[sys.argv.index("--") + 1], encoding="utf-8") as file:
            job = json.load(file)
        try:
            run_job(job)
        except Exception as error:
            print(error)
        sys.stdout.flush()
        os._exit(0)  # its settings are nobody's

    # Once the window is there, and before it is drawn for the first time: software OpenGL takes ten
    # seconds to compile what it draws with.
    bpy.app.timers.register(run_and_end, first_interval=0.0)


