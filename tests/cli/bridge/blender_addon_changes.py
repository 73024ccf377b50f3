# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on feels what shows now: after adding, moving, hiding, deleting, and File > Open.

Usage: blender -b --factory-startup --python-exit-code 3 --python blender_addon_changes.py -- PORT
"""
import os
import sys
import tempfile

import bpy
from mathutils import Vector

folder = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(folder, "..", "..", "..", "examples", "blender"))

import argil_addon  # noqa: E402


def felt(place):
    """Signed distance of what the exchange has after the next tick."""
    bpy.context.view_layer.update()
    argil_addon.Coupling.tick()
    found = argil_addon.Coupling.exchange.contact.surface.nearest(Vector(place))
    return None if found is None else round(found.distance, 4)


with tempfile.TemporaryDirectory() as scratch:
    other = os.path.join(scratch, "other.blend")
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.5, location=(9.0, 0.0, 0.0))
    bpy.context.object.name = "Same"
    bpy.ops.wm.save_as_mainfile(filepath=other)
    bpy.data.objects.remove(bpy.context.object)

    argil_addon.register()
    bpy.context.scene.argil_port = int(sys.argv[sys.argv.index("--") + 1])
    bpy.ops.argil.couple()
    assert felt((0.0, 0.0, 1.0)) is None
    bpy.ops.mesh.primitive_cube_add(size=1.0)
    cube = bpy.context.object
    assert felt((0.0, 0.0, 1.0)) == 0.5, "added"
    cube.location.z = 0.25
    assert felt((0.0, 0.0, 1.0)) == 0.25, "moved"
    cube.hide_set(True)
    assert felt((0.0, 0.0, 1.0)) is None, "hidden"
    cube.hide_set(False)
    assert felt((0.0, 0.0, 1.0)) == 0.25, "shown"
    bpy.data.objects.remove(cube)
    assert felt((0.0, 0.0, 1.0)) is None, "deleted"
    bpy.ops.mesh.primitive_cube_add(size=1.0)
    bpy.context.object.name = "Same"
    assert felt((0.0, 0.0, 1.0)) == 0.5
    bpy.ops.wm.open_mainfile(filepath=other)
    assert bpy.app.timers.is_registered(argil_addon.tick), "the timer outlives File > Open"
    assert abs(felt((9.0, 0.0, 1.0)) - 0.5) < 1e-3, "another file"
    assert argil_addon.Coupling.exchange.is_alive()
    bpy.ops.argil.couple()
    argil_addon.unregister()
